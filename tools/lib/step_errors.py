"""The part of tools/denoise_table with errors that come in steps.

Surfaces of voxels: the faces between the voxels whose centres are inside a solid and the others.
Rounded coordinates: the original of every pair in a folder (denoise_pairs.py), with coordinates
rounded to multiples of 0.35, 0.5 and 0.7 mean edge lengths. --denoise runs with no other option,
and plain smooth beside it.
"""

import math
import os
import tempfile

from denoise_pairs import chosen, denoised, figures_of, folders_of_pairs, mesh_in
from tables import ibmfair, read_off, row, smooth, write_off

WIDTHS = [22, 7, 8, 8, 8, 8, 30]
RADII = [6.3, 11.7, 25.2]  # voxels
STEPS = [0.35, 0.5, 0.7]  # mean edge lengths
TILT = [(0.8, 0.36, -0.48), (-0.6, 0.48, -0.64), (0, 0.8, 0.6)]  # no axis becomes another one


def tilted(solid):
    return lambda p, r: solid([sum(a * x for a, x in zip(line, p)) for line in TILT], r)


def box(*half_sides):
    """The distance to a box with these half sides, in radii."""
    def distance(p, r):
        beyond = [abs(x) - half * r for x, half in zip(p, half_sides)]
        return min(max(beyond), 0) + math.hypot(*(max(x, 0) for x in beyond))
    return distance


def torus(p, r):
    return math.hypot(math.hypot(p[0], p[1]) - r, p[2]) - 0.4 * r


def cylinder(p, r):
    beyond = (math.hypot(p[0], p[1]) - 0.7 * r, abs(p[2]) - r)
    return min(max(beyond), 0) + math.hypot(*(max(x, 0) for x in beyond))


SOLIDS = {"ball": lambda p, r: math.hypot(*p) - r, "torus": tilted(torus),
          "box": tilted(box(1, 0.7, 0.5)), "cylinder": tilted(cylinder),
          "slab": tilted(box(1, 1, 0.2))}


def faces_of(voxel):
    """The six faces of a voxel, as the neighbour beyond and four corners, outward."""
    for axis in range(3):
        for side in (0, 1):
            beyond = tuple(x + (2 * side - 1) * (i == axis) for i, x in enumerate(voxel))
            corners = []
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                corner = list(voxel)
                corner[axis] += side
                corner[(axis + 1) % 3] += u
                corner[(axis + 2) % 3] += v
                corners.append(tuple(corner))
            yield beyond, corners


def write_voxels(path, distance):
    """The surface of the voxels with centres at distances below 0 (a function of a point)."""
    reach = range(-int(2 * RADII[-1]), int(2 * RADII[-1]))
    inside = {(i, j, k) for i in reach for j in reach for k in reach
              if distance((i + 0.5, j + 0.5, k + 0.5)) < 0}
    numbers, faces = {}, []
    for voxel in sorted(inside):
        for beyond, corners in faces_of(voxel):
            if beyond not in inside:
                a, b, c, d = (numbers.setdefault(corner, len(numbers)) for corner in corners)
                faces += [f"3 {a} {b} {c}", f"3 {a} {c} {d}"]
    write_off(path, list(numbers), faces)


def show_voxels(scratch):
    row(["voxels of a", "radius", "steps", "denoise", "smooth", "least", "chosen"], WIDTHS)
    source, copy = os.path.join(scratch, "voxels.off"), os.path.join(scratch, "copy.off")
    for name, solid in SOLIDS.items():
        for radius in RADII:
            def distance(point, solid=solid, radius=radius):
                return solid(point, radius)

            def error(mesh, distance=distance):
                smooth(mesh, copy, "--steps", 0)
                points, _ = read_off(copy)
                return math.sqrt(sum(distance(p) ** 2 for p in points) / len(points))
            write_voxels(source, distance)
            target, report, *_, plain = denoised(source, scratch)
            errors = [error(mesh) for mesh in (source, target, plain)]
            row([name, radius, *(f"{e:.3f}" for e in errors), names_of_least(errors),
                 "  " + chosen(report)], WIDTHS)


def names_of_least(errors):
    return ("steps", "denoise", "smooth")[errors.index(min(errors))]


def show_rounded(folder, scratch):
    row(["rounded", "to", "steps", "denoise", "smooth", "least", "chosen"], WIDTHS)
    original, source = (os.path.join(scratch, name) for name in ("original.off", "rounded.off"))
    for pair in folders_of_pairs(folder):
        smooth(mesh_in(pair, "original"), original, "--steps", 0)
        points, faces = read_off(original)
        edge = ibmfair("info", original, "--json")["edge_length"]["mean"]
        for edges in STEPS:
            step = edges * edge
            write_off(source, [[step * round(x / step) for x in point] for point in points], faces)
            target, report, *_, plain = denoised(source, scratch)
            errors = [figures_of(mesh, original)[0] for mesh in (source, target, plain)]
            row([os.path.basename(pair), edges, *(f"{e:.2f}" for e in errors),
                 names_of_least(errors), "  " + chosen(report)], WIDTHS)


def show_steps(folder):
    with tempfile.TemporaryDirectory() as scratch:
        show_voxels(scratch)
        print()
        show_rounded(folder, scratch)
