"""Functions shared by the scripts that print tables: running ibmfair and reading its reports."""

import json
import os
import random
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PROGRAM = os.environ.get("IBMFAIR", os.path.join(ROOT, "build", "ibmfair"))
SHARED = os.path.join(os.path.dirname(ROOT), "shared", "meshes")  # real meshes, where present


def ibmfair(*arguments):
    """Runs the program; returns its standard output, parsed where it is JSON."""
    if not os.access(PROGRAM, os.X_OK):
        sys.exit(f"{PROGRAM}: not built yet; run tools/demo, or name the program in IBMFAIR")
    run = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"ibmfair {' '.join(map(str, arguments))}: exit {run.returncode}\n{run.stderr}")
    return json.loads(run.stdout) if run.stdout.startswith("{") else run.stdout


def smooth(source, target, *options):
    """Smooths and returns the report."""
    return ibmfair("smooth", source, target, "--json", "--quiet", "--overwrite", *options)


def read_off(path):
    """The points, and the lines of the faces, of an OFF file with its keyword on a line of its own."""
    with open(path) as file:
        lines = [line for line in file.read().splitlines() if line.split("#")[0].strip()]
    count = int(lines[1].split()[0])
    return [tuple(map(float, line.split()[:3])) for line in lines[2:2 + count]], lines[2 + count:]


def write_off(path, points, faces):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(faces)} 0\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in points)
        file.write("\n".join(faces) + "\n")


def add_noise(source, target, amount, seed=1):
    """Adds normal noise, in mean edge lengths, to every coordinate of an OFF file."""
    points, faces = read_off(source)
    deviation = amount * ibmfair("info", source, "--json")["edge_length"]["mean"]
    generator = random.Random(seed)
    write_off(target, [[x + generator.gauss(0, deviation) for x in point] for point in points], faces)


def row(cells, widths):
    print("  ".join(str(cell).rjust(width) if i else str(cell).ljust(width)
                    for i, (cell, width) in enumerate(zip(cells, widths))))
