"""The tour and the example of the README run as they stand, and give what they promise."""

import re
import subprocess
import sys

import numpy as np

import ibmfair
from conftest import ROOT


def run_script(script, folder):
    run = subprocess.run([sys.executable, *script], capture_output=True, text=True, cwd=folder)
    assert run.returncode == 0 and run.stderr == "", run.stderr
    return run.stdout


def test_the_tour_runs(tmp_path):
    text = run_script([ROOT / "tools" / "python_tour.py", tmp_path / "tour"], tmp_path)
    before, after = (float(number) for number in re.findall(r"(\S+) from the true torus", text))
    assert after < before / 5
    patch = re.search(r"patch: (\d+) vertices, at most (\S+) from", text)
    assert int(patch[1]) > 5 and float(patch[2]) < 0.05
    assert re.search(r"moved: [1-9]\d* vertices, all above 0: True", text)
    energies = [float(number) for number in re.findall(r"step +\d+: energy +(\S+),", text)]
    assert energies == sorted(energies, reverse=True) and len(energies) == 5
    assert (tmp_path / "tour" / "denoised.png").read_bytes()[1:4] == b"PNG"
    assert (tmp_path / "tour" / "clean.ply").exists()


def test_the_example_of_the_readme_runs(tmp_path):
    V, F = ibmfair.make("icosphere", subdivide=4, noise=0.1)
    ibmfair.write(tmp_path / "scan.ply", V, F[V[F].mean(axis=1)[:, 2] < 0.8])
    example = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)[1]
    (tmp_path / "example.py").write_text(example)
    text = run_script(["example.py"], tmp_path)
    energies = [float(line.split()[1]) for line in text.splitlines()]
    assert len(energies) == 3 and energies == sorted(energies, reverse=True)
    closed = ibmfair.read(tmp_path / "closed.ply")
    assert ibmfair.holes(closed) == []
    radius = np.linalg.norm(closed.V, axis=1)
    assert radius[:len(V)].std() < np.linalg.norm(V, axis=1).std() / 2
    assert np.abs(radius[len(V):] - 1).max() < 0.05  # the patch
