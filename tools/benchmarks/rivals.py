"""Other tools, compared on surfaces that are known exactly: the second section of tools/bench.
Every tool gets the same noisy mesh. The quick flow and the bi-Laplacian have a cut-off of 12 mean
edge lengths; VTK's pass band and CGAL's cut-off are the best of several values tried on the
smallest torus (CGAL's mean curvature flow shrinks the tube at 12)."""

import os
import subprocess
import sys

from runs import PROGRAMS, make, note, short_count, smoothing_time, time_text
from tables import ibmfair, row, smooth

CUTOFF = 12
ROUNDS = 3
SLOW = 3  # seconds: tools that take longer are run once only
LEVELS = range(6, 9)

SHAPES = {  # how to make the shape at a level, and the true surface
    "torus": (lambda level: ["torus", "--ratio", 2.5, "--rows", 2 << level, "--columns", 5 << level],
              ["--torus", "1,0.4"]),
    "sphere": (lambda level: ["icosphere", "--subdivide", level], ["--sphere", 1]),
}


def ours(*options):
    def run(source, target):
        report = smooth(source, target, *options)
        return sum(seconds for stage, seconds in report["seconds"].items()
                   if stage not in ("read", "measure", "write"))
    return run


def program(name, *arguments):
    """A driver that prints its own seconds; None if it was not built or its module is missing.
    Arguments that are functions are called with the path of the mesh."""
    def run(source, target):
        path = os.path.join(PROGRAMS, name)
        command = [path]
        if name.endswith(".py"):
            path = os.path.join(os.path.dirname(os.path.abspath(__file__)), name)
            command = ["/usr/bin/python3", path]  # this python3 has the packages of tools/setup
        if not os.path.exists(path):
            return None
        values = [str(value(source) if callable(value) else value) for value in arguments]
        done = subprocess.run([*command, source, target, *values], capture_output=True, text=True)
        if done.returncode != 0:
            note(f"{name}: exit {done.returncode}\n{done.stderr}")
            return None
        return float(done.stdout.splitlines()[-1])
    return run


QUICK = ("--cutoff", CUTOFF, "--steps", 2, "--solver-tolerance", 0.2)

TOOLS = {
    "ibmfair, defaults": ours(),
    "ibmfair, quick": ours(*QUICK),
    "ibmfair, quick, one thread": ours(*QUICK, "--threads", 1),
    "OpenMesh Jacobi C1, 100": program("openmesh_smooth", 100),
    "VTK windowed sinc, 100": program("vtk_smooth.py", 100, 0.03),
    "CGAL smooth_shape, 5": program("cgal_smooth", 5, lambda mesh: smoothing_time(mesh, 5, 2)),
    "bi-Laplacian, CHOLMOD, 5": program("bilaplacian_smooth", 5,
                                        lambda mesh: smoothing_time(mesh, CUTOFF, 4)),
}


def errors(mesh, surface):
    figures = ibmfair("compare", mesh, "--json", *surface)["exact_surface"]
    normals = figures["triangle_normal_degrees"]
    return {"rms": figures["vertex_distance"]["rms"], "normal_degrees": normals["mean"],
            "flipped": normals["flipped"]}


def measure_shape(source, surface, scratch):
    """The shortest time in seconds and the errors of every tool."""
    target = os.path.join(scratch, "smoothed.ply")
    figures = {}
    for turn in range(ROUNDS):
        for tool, run in TOOLS.items():
            if turn > 0 and figures[tool].get("seconds", SLOW) >= SLOW:
                continue
            seconds = run(source, target)
            if turn == 0:
                figures[tool] = {"seconds": seconds, **errors(target, surface)} if seconds else {}
            else:
                figures[tool]["seconds"] = min(seconds, figures[tool]["seconds"])
    return figures


def measure(largest, scratch):
    results = []
    for level in LEVELS:
        for shape, (arguments, surface) in SHAPES.items():
            if level > largest:
                continue
            mesh = make(scratch, "rivals.ply", *arguments(level))
            vertices = ibmfair("info", mesh, "--json")["vertices"]
            note(f"rivals on the {shape} of {vertices} vertices")
            results.append({"shape": shape, "vertices": vertices, "noisy": errors(mesh, surface),
                            "tools": measure_shape(mesh, surface, scratch)})
    return results


def ratios(results):
    """Seconds and errors of ibmfair, divided by those of each other tool."""
    found = {}
    for result in results:
        mesh = f"{result['shape']} {short_count(result['vertices'])}"
        us = result["tools"]["ibmfair, quick"]
        for tool, them in result["tools"].items():
            if not tool.startswith("ibmfair") and them:
                for figure in ("seconds", "rms", "normal_degrees"):
                    found[f"{mesh}: {figure}, {tool}"] = us[figure] / them[figure]
    return found


def show(results):
    widths = [28, 10, 10, 10, 8]
    for result in results:
        row([f"noisy {result['shape']}, {short_count(result['vertices'])}", "algorithm", "RMS",
             "normal deg", "flipped"], widths)
        for tool, figure in {"as it is": result["noisy"], **result["tools"]}.items():
            seconds = time_text(figure["seconds"]) if "seconds" in figure else "-"
            row([tool, seconds, *([f"{figure['rms']:.2e}", f"{figure['normal_degrees']:.2f}",
                                   figure["flipped"]] if figure else ["-"] * 3)], widths)
    if not results:
        print("rivals: only for 40k vertices and more", file=sys.stderr)
