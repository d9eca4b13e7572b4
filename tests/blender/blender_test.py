"""The add-on for Blender, in Blender without a window, installed as its users install it.

    tests/blender/blender_test.py [TEST...]      as smooth_cases.SmoothTest

Started by Python, this file starts Blender with itself. BLENDER is the program, and IBMFAIR_PYTHON
the folder of the Python package. Where either is missing, or Blender has another Python than the
package, the tests are skipped (exit code 77).
"""

import importlib.machinery
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SKIPPED = 77
ADDON = pathlib.Path(__file__).parents[2] / "tools" / "blender" / "ibmfair_blender.py"
CASES = ("smooth_cases", "fill_cases", "addon_cases")

try:
    import bpy
except ImportError:
    bpy = None


def start_blender():
    """Runs the tests in Blender, with settings of its own; returns the exit code."""
    blender = shutil.which(os.environ.get("BLENDER") or "blender")
    if not blender:
        print("skipped: Blender is not installed")
        return SKIPPED
    package = pathlib.Path(os.environ.get("IBMFAIR_PYTHON", ADDON.parents[2] / "build" / "python"))
    if not list((package / "ibmfair").glob("_core*")):
        print(f"skipped: the Python package ibmfair is not built in {package}")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        settings = {f"BLENDER_USER_{kind}": folder for kind in ("CONFIG", "SCRIPTS", "DATAFILES")}
        # A Blender that has no Python of its own takes the modules of the first one in the path.
        settings["PATH"] = os.path.dirname(blender) + os.pathsep + os.environ["PATH"]
        return subprocess.run(
            [blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
             __file__, "--", *sys.argv[1:]],
            env={**os.environ, **settings, "IBMFAIR_PYTHON": str(package.resolve())}).returncode


def run_in_blender():
    folder = os.environ["IBMFAIR_PYTHON"]
    print(f"Blender {bpy.app.version_string}, Python {sys.version.split()[0]}")
    if not any(pathlib.Path(folder, "ibmfair", "_core" + suffix).exists()
               for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        print("skipped: the Python package ibmfair is built for another version of Python")
        return SKIPPED
    sys.path[:0] = [folder, str(pathlib.Path(__file__).parent)]
    importlib.import_module("ibmfair")
    sys.path.remove(folder)
    bpy.ops.preferences.addon_install(filepath=str(ADDON))
    bpy.ops.preferences.addon_enable(module=ADDON.stem)
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    loader = unittest.defaultTestLoader
    suite = (loader.loadTestsFromNames(words) if words else
             unittest.TestSuite(map(loader.loadTestsFromName, CASES)))
    return 0 if unittest.TextTestRunner().run(suite).wasSuccessful() else 1


if __name__ == "__main__":
    sys.stdout.flush()
    sys.exit(run_in_blender() if bpy else start_blender())
