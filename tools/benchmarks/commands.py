"""Times whole processes from start to end: the third section of tools/bench."""

import os
import statistics

from runs import PROGRAMS, note, smoothing_time, time_text, wall_clock
from tables import PROGRAM, SHARED, row

MESH = os.path.join(SHARED, "models", "dinosaur_44928.off")
START_UP = "ibmfair --version"
NOTHING = "true"
SMOOTH = "ibmfair smooth, 16 steps"
CGAL = "CGAL smooth_shape, 5"


def start_up_commands():
    return {NOTHING: ["true"], START_UP: [PROGRAM, "--version"]}


def smoothing_commands(scratch):
    """Two smoothing commands, both with the default cut-off of eight mean edge lengths."""
    if not os.path.exists(MESH):
        note(f"{MESH}: not there, left out")
        return {}
    target = os.path.join(scratch, "dinosaur.off")
    commands = {SMOOTH: [PROGRAM, "smooth", MESH, target, "--steps", 16, "--quiet", "--overwrite"]}
    rival = os.path.join(PROGRAMS, "cgal_smooth")
    if os.path.exists(rival):
        commands[CGAL] = [rival, MESH, target, 5, smoothing_time(MESH, 8, 2)]
    return commands


def medians(commands, rounds):
    """The median and the shortest time of processes that run in turn. On a virtual machine, the
    median also depends on how much memory the host has reclaimed."""
    times = {name: [] for name in commands}
    for _ in range(rounds):
        for name, command in commands.items():
            times[name].append(wall_clock(command))
    found = {}
    for name, runs in times.items():
        if None not in runs:
            seconds = [wall for wall, _ in runs]
            found[name] = {"seconds": statistics.median(seconds), "shortest": min(seconds)}
    return found


def measure(_, scratch):
    note("whole processes")
    return {**medians(start_up_commands(), 21), **medians(smoothing_commands(scratch), 11)}


def ratios(results):
    found = {}
    for ours, theirs in ((START_UP, NOTHING), (SMOOTH, CGAL)):
        if ours in results and theirs in results:
            found[f"{ours} / {theirs}"] = results[ours]["shortest"] / results[theirs]["shortest"]
    return found


def show(results):
    widths = [34, 10, 10]
    row(["process (smooth: the dinosaur)", "median", "shortest"], widths)
    for name, figure in results.items():
        row([name, time_text(figure["seconds"]), time_text(figure["shortest"])], widths)
