"""Holes with a known answer: discs of a number of rings are cut out of a closed mesh, filled by ibmfair
and by CGAL, and each patch is compared with the piece that was cut out."""

import json
import math
import os
import random
import subprocess

import numpy as np

from tables import PROGRAM, ROOT, ibmfair, row

WIDTHS = [26, 5, 6, 8, 8, 8, 8, 7, 9, 5]
HEADINGS = ["mesh", "rings", "holes", "to C1", "to C2", "better", "worst", "nearest", "balloons",
            "open"]
SAMPLES = 4000
TRIES = 200  # seeds tried for one hole before the mesh counts as too small for it
LEAST_DISTANCE = 1e-9  # of the hole's diameter; smaller distances, in planes, are rounding errors
CGAL_FILL = os.path.join(ROOT, "build", "cgal_fill")


class ClosedMesh:
    """A closed mesh as an array of triangles, with the text of its lines ready to be written."""

    def __init__(self, path, scratch):
        converted = os.path.join(scratch, "mesh.off")
        if ibmfair("fill", path, converted, "--json", "--overwrite", "--quiet")["holes"]:
            raise SystemExit(f"{path}: has holes of its own")
        with open(converted) as file:
            lines = [line for line in file.read().splitlines() if line.split("#")[0].strip()]
        vertices, faces = map(int, lines[1].split()[:2])
        self.vertex_lines = lines[2:2 + vertices]
        self.X = np.array([line.split()[:3] for line in self.vertex_lines], dtype=float)
        polygons = [list(map(int, line.split()[1:])) for line in
                    lines[2 + vertices:2 + vertices + faces]]
        self.F = np.array([[p[0], p[i], p[i + 1]] for p in polygons for i in range(1, len(p) - 1)])
        self.face_lines = ["3 %d %d %d" % tuple(f) for f in self.F]
        order = np.argsort(self.F.ravel(), kind="stable")
        self.first = np.searchsorted(self.F.ravel()[order], np.arange(vertices + 1))
        self.star = order // 3

    def triangles_at(self, vertices):
        parts = [self.star[self.first[v]:self.first[v + 1]] for v in vertices]
        return np.unique(np.concatenate(parts))

    def write(self, path, X_lines, face_lines):
        with open(path, "w") as file:
            file.write(f"OFF\n{len(X_lines)} {len(face_lines)} 0\n")
            file.write("\n".join(X_lines) + "\n" + "\n".join(face_lines) + "\n")


def boundary_is_one_loop(F):
    """Whether the directed edges of F without an opposite edge form one loop that meets no vertex
    twice."""
    edges = {(a, b) for f in F.tolist() for a, b in zip(f, f[1:] + f[:1])}
    following = {}
    for a, b in edges:
        if (b, a) not in edges:
            if a in following:
                return False
            following[a] = b
    if not following:
        return False
    start = at = next(iter(following))
    length = 0
    while True:
        if at not in following:
            return False
        at = following[at]
        length += 1
        if at == start:
            return length == len(following)


def disc_of_rings(mesh, seed, rings):
    """The triangles within `rings` rings of triangles around the vertex; None if they are no disc."""
    vertices = np.array([seed])
    for _ in range(rings):
        triangles = mesh.triangles_at(vertices)
        vertices = np.unique(mesh.F[triangles])
    F = mesh.F[triangles]
    edges = np.unique(np.sort(np.vstack([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1), axis=0)
    is_disc = len(vertices) - len(edges) + len(F) == 1 and boundary_is_one_loop(F)
    return triangles if is_disc and 2 * len(triangles) < len(mesh.F) else None


def holes_of(mesh, rings, count, generator):
    used = np.unique(mesh.F)
    for _ in range(count):
        for _ in range(TRIES):
            triangles = disc_of_rings(mesh, int(used[generator.randrange(len(used))]), rings)
            if triangles is not None:
                yield triangles
                break


def read_patch(path, old_faces):
    """The vertices, and the triangles from number `old_faces` on, of an OFF file."""
    with open(path) as file:
        tokens = file.read().split()[1:]
    vertices, faces = int(tokens[0]), int(tokens[1])
    X = np.array(tokens[3:3 + 3 * vertices], dtype=float).reshape(-1, 3)
    F = np.array(tokens[3 + 3 * vertices:3 + 3 * vertices + 4 * faces], dtype=int)
    return X, F.reshape(-1, 4)[old_faces:, 1:]


def write_surface(path, X, F):
    used, corners = np.unique(F, return_inverse=True)
    with open(path, "w") as file:
        file.write(f"OFF\n{len(used)} {len(F)} 0\n")
        file.writelines("%.17g %.17g %.17g\n" % tuple(x) for x in X[used])
        file.writelines("3 %d %d %d\n" % tuple(f) for f in corners.reshape(-1, 3))


class Hole:
    """One hole: the files of the mesh with the hole and of the piece that was cut out."""

    def __init__(self, mesh, triangles, scratch):
        self.scratch = scratch
        self.source, self.truth = (os.path.join(scratch, name) for name in ("in.off", "truth.off"))
        keep = np.ones(len(mesh.F), dtype=bool)
        keep[triangles] = False
        self.kept = int(keep.sum())
        mesh.write(self.source, mesh.vertex_lines,
                   [line for line, stays in zip(mesh.face_lines, keep) if stays])
        write_surface(self.truth, mesh.X, mesh.F[triangles])
        piece = mesh.X[np.unique(mesh.F[triangles])]
        self.diameter = float(np.linalg.norm(piece.max(axis=0) - piece.min(axis=0)))

    def comparison(self, filled):
        """Patch compared with piece and piece with patch; None if the hole is still open."""
        X, F = read_patch(filled, self.kept)
        if len(F) == 0:
            return None
        patch = os.path.join(self.scratch, "patch.off")
        write_surface(patch, X, F)
        found = ibmfair("compare", patch, self.truth, "--samples", SAMPLES, "--json", "--quiet",
                        "--threads", 1)
        return [found["surface_distance"][way] for way in ("a_to_b", "b_to_a")]

    def distance(self, filled):
        """RMS distance of patch and piece, both ways, and the largest from the patch to the piece;
        None if the hole is still open."""
        ways = self.comparison(filled)
        return ways and (rms_of(ways), ways[0]["max"])

    def closeness(self, filled):
        """RMS distance of patch and piece, both ways, and the mean angle between their normals in
        degrees; None if the hole is still open."""
        ways = self.comparison(filled)
        return ways and (rms_of(ways), sum(way["normal_degrees"]["mean"] for way in ways) / 2)

    def by_ibmfair(self, options, measure=None):
        target = os.path.join(self.scratch, "ours.off")
        run = subprocess.run([PROGRAM, "fill", self.source, target, "--all", "--json", "--quiet",
                              "--overwrite", "--threads", "1", *options], capture_output=True,
                             text=True)
        if run.returncode not in (0, 1):
            raise SystemExit(f"{self.source}: exit {run.returncode}\n{run.stderr}")
        return (measure or self.distance)(target), json.loads(run.stdout)["holes"][0]

    def by_cgal(self, continuity, measure=None):
        target = os.path.join(self.scratch, "cgal.off")
        subprocess.run([CGAL_FILL, self.source, target, str(continuity)], check=True,
                       capture_output=True)
        return (measure or self.distance)(target)


def rms_of(ways):
    return math.sqrt(sum(way["rms"] ** 2 for way in ways) / 2)


class Tally:
    """Ratios of our distance to those of CGAL, over several holes."""

    def __init__(self):
        self.ratios = []  # to continuity 1, to continuity 2
        self.balloons = self.open = 0

    def add(self, hole, ours, rivals):
        if ours is None:
            self.open += 1
            return
        rms, largest = ours
        self.balloons += largest > hole.diameter
        least = LEAST_DISTANCE * hole.diameter
        self.ratios.append([max(rms, least) / max(rival[0], least) for rival in rivals])

    def join(self, other):
        self.ratios += other.ratios
        self.balloons += other.balloons
        self.open += other.open

    def print(self, name, rings):
        if not self.ratios:
            row([name, rings, self.open, *["-"] * 6, self.open], WIDTHS)
            return
        ratios = np.array(self.ratios)
        to_better = ratios.max(axis=1)  # the ratio to the nearer of the two is the larger one
        means = np.exp(np.log(np.column_stack([ratios, to_better])).mean(axis=0))
        row([name, rings, len(ratios) + self.open, *(f"{mean:.3f}" for mean in means),
             f"{to_better.max():.2f}", int((to_better < 1).sum()), self.balloons, self.open], WIDTHS)


def cut_table(paths, ring_counts, count, seed, options, scratch):
    """Prints a line for each mesh and number of rings, and the sums. `better`, `worst`: the mean and
    the largest ratio to the nearer of CGAL's two patches. A balloon is a patch with a point farther
    from the missing piece than the piece's diameter."""
    row(HEADINGS, WIDTHS)
    total, how = Tally(), {}
    for path in paths:
        mesh = ClosedMesh(path, scratch)
        for rings in ring_counts:
            tally = Tally()
            generator = random.Random(f"{seed} {rings}")
            for number, triangles in enumerate(holes_of(mesh, rings, count, generator)):
                hole = Hole(mesh, triangles, scratch)
                ours, report = hole.by_ibmfair(options)
                rivals = [hole.by_cgal(continuity) for continuity in (1, 2)]
                tally.add(hole, ours, rivals)
                outcome = f"{report['status']}, {report.get('method', '')}"
                how[outcome] = how.get(outcome, 0) + 1
            tally.print("/".join(path.split("/")[-2:])[1 - WIDTHS[0]:], rings)
            total.join(tally)
    total.print("all", "")
    print("; ".join(f"{n} {outcome}" for outcome, n in sorted(how.items())))
