"""What the tests of the Python package share: shapes that the real program makes, and the program."""

import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np
import pytest
from hypothesis.configuration import set_hypothesis_home_dir

import ibmfair

# What Hypothesis stores for later runs does not belong in the sources.
set_hypothesis_home_dir(pathlib.Path(tempfile.gettempdir()) / "hypothesis")

PROGRAM = os.environ["IBMFAIR"]
ROOT = pathlib.Path(__file__).parents[2]
SHARED = ROOT.parent / "shared" / "meshes"  # real meshes, where present


def program(*arguments, expect=0):
    """Runs the program; returns its standard output, parsed where it is JSON."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert run.returncode == expect, f"{arguments}: {run.returncode}\n{run.stderr}"
    return json.loads(run.stdout) if run.stdout.startswith("{") else run.stdout


def noisy(V, amount, seed=1):
    """The positions with normal noise of `amount` times the first edge's length or so."""
    edge = np.linalg.norm(V.max(axis=0) - V.min(axis=0)) / np.sqrt(len(V))
    return V + np.random.default_rng(seed).normal(0, amount * edge, V.shape)


@pytest.fixture(scope="session")
def shapes(tmp_path_factory):
    """{name: path} of shapes of `ibmfair make`, with triangles and with polygons."""
    folder = tmp_path_factory.mktemp("shapes")
    paths = {}
    for name, arguments in {"icosphere": ["icosphere", "--subdivide", "4"],
                            "torus": ["torus"]}.items():
        paths[name] = folder / f"{name}.ply"
        program("make", *arguments, paths[name])
    mesh = ibmfair.read(paths["icosphere"])
    open_sphere = mesh.F[(mesh.V[mesh.F].mean(axis=1)[:, 2] < 0.8)]
    paths["open"] = folder / "open.ply"
    ibmfair.write(paths["open"], mesh.V, open_sphere)
    paths["noisy"] = folder / "noisy.ply"
    ibmfair.write(paths["noisy"], noisy(mesh.V, 0.1), mesh.F)
    paths["quads"] = folder / "quads.obj"
    V, F = grid(12)
    ibmfair.write(paths["quads"], V, F)
    paths["holed quads"] = folder / "holed.obj"
    ibmfair.write(paths["holed quads"], V, np.delete(F, 64, axis=0))
    return paths


def grid(n):
    """A bumpy sheet of n x n quadrilaterals: V, F (n n, 4)."""
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    V = np.column_stack([x.ravel(), y.ravel(), np.sin(3 * x.ravel()) * np.cos(2 * y.ravel())])
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    return V, np.column_stack([corner, corner + 1, corner + n + 2, corner + n + 1])


@pytest.fixture
def sphere(shapes):
    mesh = ibmfair.read(shapes["noisy"])
    return mesh.V, np.array(mesh.F)


@pytest.fixture
def opened(shapes):
    mesh = ibmfair.read(shapes["open"])
    return mesh.V, np.array(mesh.F)
