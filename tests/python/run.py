"""Runs pytest on one file of this folder; ends with 77 (skipped) where pytest, numpy or hypothesis is
missing.

    run.py FILE
"""

import importlib.util
import os
import pathlib
import sys

missing = [name for name in ("numpy", "pytest", "hypothesis") if importlib.util.find_spec(name) is None]
if missing:
    print(f"skipped: {sys.executable} has no {', '.join(missing)}")
    sys.exit(77)

import pytest  # noqa: E402

folder = pathlib.Path(__file__).parent
os.chdir(folder)
sys.path.insert(0, str(folder))
sys.exit(pytest.main(["-q", "-rs", "-p", "no:cacheprovider", str(folder / sys.argv[1])]))
