"""Holes across the creases of closed meshes: filled by ibmfair without and with --keep-sharp, and by
CGAL, and compared with the piece that was cut out."""

import math
import random

import numpy as np

from cut_holes import LEAST_DISTANCE, TRIES, ClosedMesh, Hole, disc_of_rings
from tables import row

WIDTHS = [26, 5, 5, 9] + 4 * [9] + 4 * [9]
TOOLS = ["default", "sharp", "CGAL C1", "CGAL C2"]
HEADINGS = ["mesh", "rings", "holes", "continued", *TOOLS, *TOOLS]
UNITS = ["", "", "", "", *4 * ["RMS %"], *4 * ["normal"]]


def vertices_on_creases(mesh, degrees):
    """The vertices of edges whose two triangles have normals that differ by more than the angle."""
    X, F = mesh.X, mesh.F
    N = np.cross(X[F[:, 1]] - X[F[:, 0]], X[F[:, 2]] - X[F[:, 0]])
    N /= np.maximum(np.linalg.norm(N, axis=1), 1e-300)[:, None]
    sides = np.vstack([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]])
    triangle = np.tile(np.arange(len(F)), 3)
    order = np.lexsort(np.sort(sides, axis=1).T)
    sides, triangle = np.sort(sides, axis=1)[order], triangle[order]
    same = (sides[1:] == sides[:-1]).all(axis=1)
    cosine = (N[triangle[1:]] * N[triangle[:-1]]).sum(axis=1)
    return np.unique(sides[1:][same & (cosine < math.cos(math.radians(degrees)))])


def holes_across(mesh, degrees, rings, count, generator):
    seeds = vertices_on_creases(mesh, degrees)
    for _ in range(count if len(seeds) else 0):
        for _ in range(TRIES):
            triangles = disc_of_rings(mesh, int(seeds[generator.randrange(len(seeds))]), rings)
            if triangles is not None:
                yield triangles
                break


class Tally:
    """For each tool, the distances in parts of the hole's diameter and the angles between normals."""

    def __init__(self):
        self.distances, self.angles = [], []
        self.continued = 0

    def add(self, hole, found, creases):
        least = LEAST_DISTANCE * hole.diameter
        self.distances.append([max(rms, least) / hole.diameter for rms, _ in found])
        self.angles.append([angle for _, angle in found])
        self.continued += creases is not None and creases["reason"] == ""

    def join(self, other):
        self.distances += other.distances
        self.angles += other.angles
        self.continued += other.continued

    def print(self, name, rings):
        if not self.distances:
            row([name, rings, 0, *9 * ["-"]], WIDTHS)
            return
        means = 100 * np.exp(np.log(np.array(self.distances)).mean(axis=0))
        angles = np.array(self.angles).mean(axis=0)
        row([name, rings, len(self.distances), self.continued, *(f"{mean:.3g}" for mean in means),
             *(f"{angle:.2f}" for angle in angles)], WIDTHS)


def crease_table(paths, ring_counts, count, seed, degrees, options, scratch):
    """Prints a line for each mesh and number of rings, and the sums: geometric means of the RMS
    distance (both ways, per cent of the hole's diameter), and means of the mean angle between the
    normals of patch and piece (degrees)."""
    row(HEADINGS, WIDTHS)
    row(UNITS, WIDTHS)
    total, reasons = Tally(), {}
    for path in paths:
        mesh = ClosedMesh(path, scratch)
        for rings in ring_counts:
            tally = Tally()
            generator = random.Random(f"{seed} {rings}")
            for triangles in holes_across(mesh, degrees, rings, count, generator):
                hole = Hole(mesh, triangles, scratch)
                default, _ = hole.by_ibmfair(options, hole.closeness)
                sharp, report = hole.by_ibmfair([*options, "--keep-sharp", str(degrees)],
                                                hole.closeness)
                rivals = [hole.by_cgal(continuity, hole.closeness) for continuity in (1, 2)]
                found = [default, sharp, *rivals]
                if None not in found:
                    tally.add(hole, found, report.get("creases"))
                reason = report.get("creases", {"reason": "no crease at the rim"})["reason"]
                reasons[reason] = reasons.get(reason, 0) + 1
            tally.print("/".join(path.split("/")[-2:])[1 - WIDTHS[0]:], rings)
            total.join(tally)
    total.print("all", "")
    for reason, times in sorted(reasons.items()):
        print(f"{times} {reason or 'continued'}")
