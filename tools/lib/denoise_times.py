"""The part of tools/denoise_table about time: how long --denoise takes beside smooth.

The meshes: of those that are shared, three models and a voxel ball; the noisy meshes of the
pairs in a folder (denoise_pairs.py), with and without an original; and two made shapes with noise,
of 568k and 1.3M triangles.
"""

import glob
import os
import tempfile

from denoise_pairs import chosen, mesh_in, timed
from tables import SHARED, ibmfair, row

HEADINGS = ["mesh", "vertices", "default", "--steps 16", "--denoise", "ratio", "chosen"]
WIDTHS = [22, 8, 8, 10, 9, 6, 30]
RUNS = 3  # the shortest counts
MODELS = ["models/hand_24192.off", "models/diplodocus_48k_cgal.off", "models/dinosaur_44928.off",
          "reported/ball8_1.off"]
MADE = [("torus", ["--ratio", 2.5, "--rows", 362]), ("icosphere", ["--subdivide", 8])]
NOISE = 0.2  # mean edge lengths


def meshes(folder, scratch):
    """Names and paths."""
    for name in MODELS:
        path = os.path.join(SHARED, name)
        if os.path.exists(path):
            yield os.path.splitext(os.path.basename(path))[0], path
    for path in sorted(glob.glob(os.path.join(folder, "*"))):
        if noisy := mesh_in(path, "noisy"):
            yield os.path.basename(path), noisy
    for shape, options in MADE:
        path = os.path.join(scratch, shape + ".ply")
        ibmfair("make", shape, path, *options, "--noise", NOISE)
        yield shape, path


def show_times(folder):
    row(HEADINGS, WIDTHS)
    with tempfile.TemporaryDirectory() as scratch:
        target = os.path.join(scratch, "smooth.ply")
        for name, path in meshes(folder, scratch):
            seconds = []
            for options in ([], ["--steps", 16], ["--denoise"]):
                runs = [timed(path, target, *options) for _ in range(RUNS)]
                seconds.append(min(time for _, time in runs))
            report = runs[0][0]
            row([name, report["mesh"]["vertices"], *(f"{s:.2f}" for s in seconds),
                 f"{seconds[2] / seconds[0]:.1f}", "  " + chosen(report)], WIDTHS)
