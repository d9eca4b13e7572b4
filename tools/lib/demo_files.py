"""Writes the files that the README's recipes use into a folder:

    demo_files.py IBMFAIR FOLDER

scan.ply      the bunny with noise and two holes
part.obj      two sheets that meet in a rough blend, the group `blend`
scans/        three noisy meshes
"""

import math
import os
import random
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
NOISE = 0.04  # of the bunny, in its units; a tenth of an edge length
HOLES = [((-2.6, 5.8, 1.4), 1.1), ((1.2, 3.6, 2.9), 0.9)]  # centre and radius


def read_obj(path):
    points, faces = [], []
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(word) for word in words[1:4]])
            elif words[:1] == ["f"]:
                faces.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return points, faces


def write_ply(path, points, faces):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty float x\n"
                   f"property float y\nproperty float z\nelement face {len(faces)}\n"
                   "property list uchar int vertex_indices\nend_header\n")
        for x in points:
            file.write("%.6f %.6f %.6f\n" % tuple(x))
        for face in faces:
            file.write(f"{len(face)} {' '.join(map(str, face))}\n")


def scan(points, faces):
    """The bunny without the triangles near the holes' centres and without their unused vertices."""
    kept = [face for face in faces
            if all(math.dist([sum(points[v][k] for v in face) / 3 for k in range(3)], centre) > radius
                   for centre, radius in HOLES)]
    used = sorted({v for face in kept for v in face})
    number = {v: i for i, v in enumerate(used)}
    return [points[v] for v in used], [[number[v] for v in face] for face in kept]


def write_part(path):
    """The graph of 0.8 |x| over [-1, 1] x [0, 1]: rough where |x| < 0.3."""
    columns, rows, blend = 41, 21, 0.3
    points, groups = [], {"flanks": [], "blend": []}
    for row in range(rows):
        for column in range(columns):
            x, y = 2 * column / (columns - 1) - 1, row / (rows - 1)
            rough = 0.02 * random.gauss(0, 1) if abs(x) < blend - 0.06 else 0
            points.append((x, y, 0.8 * abs(x) + rough))
    for row in range(rows - 1):
        for column in range(columns - 1):
            v = row * columns + column + 1
            middle = (column + 0.5) * 2 / (columns - 1) - 1
            groups["blend" if abs(middle) < blend else "flanks"].append(
                (v, v + 1, v + columns + 1, v + columns))
    with open(path, "w", encoding="ascii") as file:
        for x in points:
            file.write("v %.6f %.6f %.6f\n" % x)
        for group, quads in groups.items():
            file.write(f"g {group}\n")
            for quad in quads:
                file.write("f %d %d %d %d\n" % quad)


def main():
    program, folder = sys.argv[1:3]
    os.makedirs(os.path.join(folder, "scans"), exist_ok=True)
    random.seed(1)
    points, faces = read_obj(os.path.join(ROOT, "data", "bunny.obj"))
    noisy = [[coordinate + random.gauss(0, NOISE) for coordinate in x] for x in points]
    write_ply(os.path.join(folder, "scan.ply"), *scan(noisy, faces))
    write_part(os.path.join(folder, "part.obj"))
    for shape in ("torus", "cylinder", "icosphere"):
        options = ["--subdivide", "4"] if shape == "icosphere" else ["--rows", "48"]
        subprocess.run([program, "make", shape, os.path.join(folder, "scans", shape + ".ply"),
                        "--noise", "0.15", "--overwrite", "--quiet", *options], check=True)


main()
