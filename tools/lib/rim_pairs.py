"""The part of tools/denoise_table about open boundaries: pairs of a noisy mesh and its original.

Each pair of a folder (lib/denoise_pairs.py) that is open is taken as it is; from all of them a ball
and a half are cut off, the same triangles of both meshes. The program runs with --denoise, once with
fixed boundaries and once as it does by itself. Lengths are in mean edge lengths of the original.
"""

import os
import tempfile

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from denoise_pairs import folders_of_pairs, mesh_in
from tables import read_off, row, smooth

HEADINGS = ["pair", "cut", "boundary", "inside", "near", "ratio", "curve", "jagged", "of truth",
            "against it"]
WIDTHS = [22, 6, 9, 7, 7, 6, 7, 7, 9, 11]
NEAR = 5  # rings
BALL = 0.12  # radius, of the diagonal of the box
BALL_AT, HALF_ALONG = (0.2, 0.5, 0.85), (0.3, 0.8, 0.5)  # directions, chosen without a look
CANDIDATES = 16  # triangles and edges with the nearest centres, among which the nearest is looked for


def read(path, scratch):
    copy = os.path.join(scratch, "copy.off")
    smooth(path, copy, "--steps", 0)
    points, faces = read_off(copy)
    return np.array(points), np.array([line.split()[1:4] for line in faces], dtype=int)


def write(path, points, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in points)
        file.writelines("3 %d %d %d\n" % tuple(face) for face in faces)


def directed_edges(faces):
    return np.vstack([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


def edges_with_counts(faces):
    return np.unique(np.sort(directed_edges(faces), 1), axis=0, return_counts=True)


def largest_component(faces):
    edges = directed_edges(faces)
    size = faces.max() + 1
    links = coo_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), (size, size))
    label = connected_components(links, False)[1][faces[:, 0]]
    return faces[label == np.bincount(label).argmax()]


def kept_faces(points, faces, how):
    """The faces that stay; None if the mesh is closed and nothing is cut."""
    centres = points[faces].mean(1)
    low, high = points.min(0), points.max(0)
    if how == "ball":
        farthest = points[(points @ np.array(BALL_AT)).argmax()]
        kept = np.linalg.norm(centres - farthest, axis=1) > BALL * np.linalg.norm(high - low)
    elif how == "half":
        kept = (centres - (low + high) / 2) @ np.array(HALF_ALONG) < 0
    else:
        return faces if (edges_with_counts(faces)[1] == 1).any() else None
    return largest_component(faces[kept])


def rims_of(faces):
    """The closed boundary loops that meet no vertex twice, as arrays of vertices."""
    all_edges = set(map(tuple, directed_edges(faces)))
    following, twice = {}, set()
    for a, b in all_edges:
        if (b, a) not in all_edges:
            if a in following:
                twice.add(a)
            following[a] = b
    loops = []
    while following:
        start = at = next(iter(following))
        loop = []
        while at in following:
            loop.append(at)
            at = following.pop(at)
        if at == start and len(loop) > 2 and not twice.intersection(loop):
            loops.append(np.array(loop))
    return loops


def to_segments(points, a, b):
    along = b - a
    t = ((points - a) * along).sum(-1) / np.maximum((along * along).sum(-1), 1e-300)
    return np.linalg.norm(points - a - np.clip(t, 0, 1)[..., None] * along, axis=-1)


def to_triangles(points, a, b, c):
    sides = np.minimum(np.minimum(to_segments(points, a, b), to_segments(points, b, c)),
                       to_segments(points, c, a))
    normal = np.cross(b - a, c - a)
    squared = np.maximum((normal * normal).sum(-1), 1e-300)
    height = ((points - a) * normal).sum(-1)
    foot = points - (height / squared)[..., None] * normal
    inside = np.ones(height.shape, bool)
    for p, q in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(q - p, foot - p) * normal).sum(-1) >= 0
    return np.where(inside, np.abs(height) / np.sqrt(squared), sides)


def rms(lengths):
    return float(np.sqrt(np.mean(lengths ** 2))) if len(lengths) else 0.0


class Truth:
    """The part of the original that is left after a cut. Distances are those from the whole original,
    as the triangles that were cut off say where the surface goes on."""

    def __init__(self, points, faces, whole):
        self.points, self.faces, self.whole = points, faces, whole
        edges, counts = edges_with_counts(faces)
        self.edge = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean()
        self.rims = rims_of(faces)
        rings = np.full(len(points), NEAR + 1)
        rings[edges[counts == 1].ravel()] = 0
        for _ in range(NEAR):
            nearer = np.minimum(rings[edges[:, 0]], rings[edges[:, 1]]) + 1
            np.minimum.at(rings, edges[:, 0], nearer)
            np.minimum.at(rings, edges[:, 1], nearer)
        self.near = rings <= NEAR

    def off_surface(self, result):
        _, nearest = cKDTree(self.whole.mean(1)).query(result, CANDIDATES)
        corners = self.whole[nearest]
        return to_triangles(result[:, None], *(corners[:, :, k] for k in range(3))).min(1)

    def off_rim(self, result, rim):
        a, b = self.points[rim], np.roll(self.points[rim], -1, 0)
        _, nearest = cKDTree((a + b) / 2).query(result[rim], min(CANDIDATES, len(rim)))
        return to_segments(result[rim][:, None], a[nearest], b[nearest]).min(1)

    def figures(self, result):
        """Distances from the surface inside and near rims, from the rim as a curve; and the second
        differences along rims: of the result, and of its difference from the original."""
        off = self.off_surface(result) / self.edge
        curve = np.concatenate([self.off_rim(result, rim) for rim in self.rims]) / self.edge
        return (rms(off[~self.near]), rms(off[self.near]), rms(curve), self.jagged(result),
                self.jagged(result - self.points))

    def jagged(self, points):
        turns = [np.roll(points[rim], 1, 0) - 2 * points[rim] + np.roll(points[rim], -1, 0)
                 for rim in self.rims]
        return rms(np.linalg.norm(np.concatenate(turns), axis=1)) / self.edge


def show(name, how, boundary, figures, of_truth):
    inside, near, curve, jagged, against = figures
    row([name, how, boundary, f"{inside:.3f}", f"{near:.3f}",
         f"{near / inside:.2f}" if inside > 0 else "-", f"{curve:.3f}", f"{jagged:.3f}",
         f"{of_truth:.3f}", f"{against:.3f}"], WIDTHS)


def show_rims(folder):
    row(HEADINGS, WIDTHS)
    with tempfile.TemporaryDirectory() as scratch:
        noisy_cut, target = (os.path.join(scratch, name) for name in ("noisy.off", "target.off"))
        for pair in folders_of_pairs(folder):
            original, faces = read(mesh_in(pair, "original"), scratch)
            noisy, _ = read(mesh_in(pair, "noisy"), scratch)
            for how in ("-", "ball", "half"):
                kept = kept_faces(original, faces, how)
                if kept is None:
                    continue
                used, numbers = np.unique(kept, return_inverse=True)
                truth = Truth(original[used], numbers.reshape(-1, 3), original[faces])
                if not truth.rims:
                    continue
                write(noisy_cut, noisy[used], truth.faces)
                of_truth = truth.jagged(truth.points)
                show(os.path.basename(pair), how, "as it is", truth.figures(noisy[used]), of_truth)
                for name, options in (("fixed", ("--boundary", "fixed")), ("fair", ())):
                    smooth(noisy_cut, target, "--denoise", *options)
                    show("", "", name, truth.figures(np.array(read_off(target)[0])), of_truth)
