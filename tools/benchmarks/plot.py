"""Draws the time and memory of smoothing against the number of vertices, for tools/bench.

    plot.py RESULTS.json PICTURE.svg|png
"""

import json
import math
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

STAGES = ["analyse", "factor", "solve", "20 iterations", "gradient"]


def curve(axes, points, label, **style):
    points = [(vertices, value) for vertices, value in points if value is not None]
    if points:
        axes.plot(*zip(*points), marker="o", markersize=3, label=label, **style)


def reference(axes, points):
    """A reference line through the last point, since constant costs distort the first points."""
    points = [(vertices, value) for vertices, value in points if value is not None]
    if points:
        vertices, value = points[-1]
        unit = value / (vertices * math.log(vertices))
        axes.plot([n for n, _ in points], [unit * n * math.log(n) for n, _ in points],
                  color="black", linestyle=":", linewidth=1, label="n log n")


def column(spheres, value):
    return [(sphere["vertices"], value(sphere)) for sphere in spheres]


def seconds_of(stage):
    return lambda sphere: sphere["stages"].get(stage, {}).get("1", {}).get("seconds")


def draw(results, path):
    spheres = [mesh for mesh in results["stages"] if mesh["mesh"].startswith("sphere")]
    figure, (time, memory) = pyplot.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    seconds = column(spheres, lambda sphere: sphere.get("smooth", {}).get("seconds"))
    bytes_ = column(spheres, lambda sphere: sphere.get("smooth", {}).get("peak_bytes"))
    megabytes = [(n, peak and peak / 1e6) for n, peak in bytes_]
    curve(time, seconds, "smooth --steps 16", color="black")
    for stage in STAGES:
        curve(time, column(spheres, seconds_of(stage)), stage, linewidth=1)
    curve(memory, megabytes, "smooth --steps 16", color="black")
    for axes, points, unit in ((time, seconds, "seconds"), (memory, megabytes, "peak memory, MB")):
        reference(axes, points)
        axes.set(xscale="log", yscale="log", xlabel="vertices", ylabel=unit)
        axes.grid(alpha=0.3)
        axes.legend(frameon=False, fontsize=8)
    figure.savefig(path, dpi=150)


with open(sys.argv[1]) as file:
    draw(json.load(file), sys.argv[2])
