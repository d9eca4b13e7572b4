"""The part of tools/denoise_table over folders of pairs: noise that others made or measured.

A pair is a folder with noisy.obj (or .ply, .off) and original.obj of the same connectivity. The
program runs with --denoise and nothing else; it also runs with --denoise on each original, which
should stay as it is. Two small meshes with noise that is not random, if they are in the folder
`reported` of the shared meshes, follow: the steps of a voxel ball, and rounded heights.
"""

import glob
import math
import os
import tempfile
import time

from tables import SHARED, ibmfair, read_off, row, smooth

HEADINGS = ["pair", "noisy", "Ea", "Ev / 1e-4", "moved", "s", "smooth", "chosen"]
WIDTHS = [22, 6, 6, 9, 7, 6, 6, 20]


def mesh_in(folder, name):
    return next(iter(sorted(glob.glob(os.path.join(folder, name + ".*")))), None)


def folders_of_pairs(folder):
    return [path for path in sorted(glob.glob(os.path.join(folder, "*")))
            if mesh_in(path, "noisy") and mesh_in(path, "original")]


def figures_of(mesh, original):
    """Ea, the mean angle of face normals (degrees); Ev, the root mean square distance to the
    original's surface over the diagonal of its box."""
    report = ibmfair("compare", mesh, original, "--json")
    box = ibmfair("info", original, "--json")["bounding_box"]
    diagonal = math.dist(box["min"], box["max"])
    return (report["face_normal_degrees"]["mean"],
            report["surface_distance"]["a_to_b"]["rms"] / diagonal)


def timed(*arguments):
    start = time.perf_counter()
    report = smooth(*arguments)
    return report, time.perf_counter() - start


def chosen(report):
    """The choice in words: cut-off in mean edge lengths, least angle of the creases kept, and the
    kind of noise where the program names it."""
    edge, choice = report["mesh"]["mean_edge_length"], report["cutoff_choice"]
    text = f"{choice['cutoff'] / edge:.1f} edges"
    if "keep_sharp" in choice:
        text += f", {choice['keep_sharp']:.0f} deg"
    kind = choice.get("kind", "independent")
    return text if kind == "independent" else f"{text}, {kind}"


def denoised(source, scratch):
    """The result's path, the report, the rms move in mean edge lengths, and the seconds that
    --denoise and plain smooth take."""
    target, plain = (os.path.join(scratch, name) for name in ("denoised.ply", "smooth.ply"))
    report, seconds = timed(source, target, "--denoise")
    _, plain_seconds = timed(source, plain)
    moved = report["rms_move"] / report["mesh"]["mean_edge_length"]
    return target, report, moved, seconds, plain_seconds, plain


def show(name, before, ea, ev, moved, seconds, plain_seconds, report):
    row([name, before, ea, ev, f"{moved:.4f}", f"{seconds:.2f}", f"{plain_seconds:.2f}",
         "  " + chosen(report)], WIDTHS)


def show_pairs(folder, scratch):
    for pair in folders_of_pairs(folder):
        noisy, original = mesh_in(pair, "noisy"), mesh_in(pair, "original")
        before, _ = figures_of(noisy, original)
        target, report, *moved_and_times, _ = denoised(noisy, scratch)
        ea, ev = figures_of(target, original)
        show(os.path.basename(pair), f"{before:.1f}", f"{ea:.2f}", f"{1e4 * ev:.2f}",
             *moved_and_times, report)


def show_originals(folder, scratch):
    for pair in folders_of_pairs(folder):
        original = mesh_in(pair, "original")
        target, report, *moved_and_times, _ = denoised(original, scratch)
        ea, ev = figures_of(target, original)
        show(os.path.basename(pair), "0.0", f"{ea:.2f}", f"{1e4 * ev:.2f}", *moved_and_times, report)


def normals_off_sphere(mesh):
    return ibmfair("compare", mesh, "--sphere", "fit", "--json")["exact_surface"][
        "triangle_normal_degrees"]["rms"]


GRID, BORDER = 119, 4.5  # the largest x and y, and the margin where the fixed border is felt


def height(x, y):
    bump = math.exp(-((x - 70) ** 2 + (y - 50) ** 2) / 500)
    return 8 * math.sin(x / 28) * math.cos(y / 33) + 4 * bump


def height_error(mesh):
    with tempfile.TemporaryDirectory() as scratch:
        copy = os.path.join(scratch, "copy.off")
        smooth(mesh, copy, "--steps", 0)
        points, _ = read_off(copy)
    inner = [point for point in points if all(BORDER < c < GRID - BORDER for c in point[:2])]
    return math.sqrt(sum((z - height(x, y)) ** 2 for x, y, z in inner) / len(inner))


REPORTED = [("ball8_1.off", "rms angle to the normals of the sphere, degrees", normals_off_sphere),
            ("dem_q1.off", "rms error of the height", height_error)]


def show_reported(scratch):
    for name, meaning, error in REPORTED:
        source = os.path.join(SHARED, "reported", name)
        if os.path.exists(source):
            target, report, _, seconds, plain_seconds, plain = denoised(source, scratch)
            print(f"{name}: {meaning}: {error(source):.3f} as it is, {error(target):.3f} with "
                  f"--denoise, {error(plain):.3f} with plain smooth; {seconds:.2f} and "
                  f"{plain_seconds:.2f} s; {chosen(report)}")


def show_tables(folder):
    with tempfile.TemporaryDirectory() as scratch:
        row(HEADINGS, WIDTHS)
        show_pairs(folder, scratch)
        print("\nThe originals, which should stay as they are:")
        row(HEADINGS, WIDTHS)
        show_originals(folder, scratch)
        print()
        show_reported(scratch)
