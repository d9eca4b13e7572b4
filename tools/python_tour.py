#!/usr/bin/env python3
"""A tour of ibmfair in Python, to be read from top to bottom like a notebook and run as it stands.

    PYTHONPATH=build/python tools/python_tour.py [FOLDER]

FOLDER receives the files and pictures that the tour writes; without it they go to a folder that is
removed at the end. Needs numpy, and scipy for the spectrum.
"""

# %% A noisy shape. A mesh is a pair of arrays: positions V (n, 3) and vertex numbers F (m, 3).

import os
import sys
import tempfile

import numpy as np

import ibmfair

scratch = None if len(sys.argv) > 1 else tempfile.TemporaryDirectory()
folder = sys.argv[1] if scratch is None else scratch.name
os.makedirs(folder, exist_ok=True)
V, F = ibmfair.make("torus", rows=48, ratio=2.5, noise=0.2)
print(f"a torus of {len(V)} vertices with noise of a fifth of an edge length")

# %% Without noise. `info` is the report that `ibmfair smooth --json` prints.

picture = os.path.join(folder, "denoised.png")
clean, info = ibmfair.denoise(V, F, picture=picture, overwrite=True)
choice = info["cutoff_choice"]
print(f"noise: {choice['kind']}, {choice['noise']:.3g}; smoothed up to {choice['cutoff']:.3g}")
for name, positions in [("before", V), ("after", clean)]:
    distance = ibmfair.compare(positions, F, torus=[1, 0.4])["exact_surface"]["vertex_distance"]["rms"]
    print(f"{name:>8}: {distance:.2e} from the true torus (RMS)")

# %% By hand. Options are those of the command line, with underscores. A number means what it means
# there: six mean edge lengths; "2%" of the diagonal and "0.1u" in the unit of the mesh work, too.

smooth, info = ibmfair.smooth(V, F, cutoff=6, twicing=1, keep_volume=True)
print(f"volume: {info['before']['volume']:.6f} -> {info['after']['volume']:.6f}")

# %% A part of it: arrays choose vertices.

upper, _ = ibmfair.smooth(V, F, mask=V[:, 2] > 0)
print(f"moved: {(upper != V).any(axis=1).sum()} vertices, all above 0: {(V[(upper != V).any(axis=1), 2] > 0).all()}")

# %% A hole, and a patch that continues the surface.

opened = F[np.linalg.norm(clean[F].mean(axis=1) - [1, 0, 0.4], axis=1) > 0.3]
for hole in ibmfair.holes(clean, opened):
    print(f"hole {hole['id']}: {hole['edges']} edges, perimeter {hole['perimeter']:.3g}")
picture = os.path.join(folder, "filled.png")
filled, faces, info = ibmfair.fill(clean, opened, holes=[0], picture=picture, overwrite=True)
new = filled[len(clean):]
distance = np.hypot(np.hypot(new[:, 0], new[:, 1]) - 1, new[:, 2]) - 0.4
print(f"patch: {len(new)} vertices, at most {np.abs(distance).max():.1e} from the torus")

# %% The flow of the paper, step by step: the Jacobian is factored once.

flow = ibmfair.Flow(V, F, laplacian="lagrange", cutoff=6, steps=16)
for record in flow.steps(16):
    if record.step in (1, 2, 4, 8, 16):
        print(f"step {record.step:2}: energy {record.energy:8.3f}, largest move {record.largest_move:.1e}")

# %% Energies and matrices. On a sphere 1/2 integral H^2 is 8 pi.

ball, triangles = ibmfair.make("icosphere", subdivide=4)
energy, gradient = ibmfair.energy(ball, triangles, "lagrange", gradient=True)
print(f"energy of a sphere: {energy:.4f}, 8 pi is {8 * np.pi:.4f}")
try:
    from scipy.sparse.linalg import eigsh

    L, M = ibmfair.laplacian(ball, triangles, "lagrange")
    values = np.sort(eigsh(L, 9, M, sigma=-1e-2)[0])
    print("spectrum of the sphere:", np.round(values, 2), "- truth 0, 2 (three times), 6 (five times)")
except ImportError:
    print("no scipy: the spectrum is left out")

# %% Files, exactly: only the coordinates that moved change in the bytes.

path = os.path.join(folder, "torus.ply")
ibmfair.write(path, V, F, overwrite=True)
mesh = ibmfair.read(path)
mesh.V = clean
report = mesh.write(os.path.join(folder, "clean.ply"), overwrite=True)
print(f"wrote {report['bytes']} bytes, {report['moved_vertices']} vertices moved")
if scratch is not None:
    scratch.cleanup()
