"""The tour runs as it stands, and what it prints is what it promises."""

import os
import pathlib
import re
import subprocess
import sys

from conftest import ROOT


def test_the_tour_runs(tmp_path):
    run = subprocess.run([sys.executable, ROOT / "tools" / "python_tour.py", tmp_path],
                         capture_output=True, text=True,
                         env={**os.environ, "PYTHONPATH": str(pathlib.Path(os.environ["PYTHONPATH"].split(":")[0]))})
    assert run.returncode == 0 and run.stderr == "", run.stderr
    before, after = (float(number) for number in re.findall(r"(\S+) from the true torus", run.stdout))
    assert after < before / 5
    patch = re.search(r"patch: (\d+) vertices, at most (\S+) from", run.stdout)
    assert int(patch[1]) > 5 and float(patch[2]) < 0.05
    assert re.search(r"moved: [1-9]\d* vertices, all above 0: True", run.stdout)
    energies = [float(number) for number in re.findall(r"step +\d+: energy +(\S+),", run.stdout)]
    assert energies == sorted(energies, reverse=True) and len(energies) == 5
    assert (tmp_path / "denoised.png").read_bytes()[1:4] == b"PNG" and (tmp_path / "clean.ply").exists()
