"""The stages of smoothing, compared with the machine's limits: the first section of tools/bench."""

import json
import os
import subprocess
import sys

from runs import PROGRAMS, make, note, short_count, time_text, wall_clock
from tables import PROGRAM, SHARED, row

MODELS = ["hand_24192", "dinosaur_44928"]
STAGES = ["read", "topology", "bind", "pattern", "assemble", "analyse", "factor", "factor float32",
          "solve", "solve float32", "rows", "20 iterations", "gradient", "energy",
          "lagrange gradient", "lagrange energy", "write"]
THREADS = ["1", "2"]
# Repetitions in a process, and processes; large meshes get only a few.
SAMPLES = (3, 6)
SAMPLES_OF_LEVEL = {8: (3, 3), 9: (1, 2)}
# The counts by which the nanoseconds of a gradient are divided.
PER_STENCIL = {"gradient": ("hinges", "ns per hinge"),
               "lagrange gradient": ("triangles", "ns per triangle")}


class Mesh:
    """The measurements of a mesh so far. All meshes are measured in turn, several times, because
    other work on the machine may last as long as the measurement of one mesh."""

    def __init__(self, name, path, repetitions, rounds):
        self.name, self.path, self.repetitions, self.rounds = name, path, repetitions, rounds
        self.counts = {}
        self.shortest = {}  # by NAME/THREADS, with bytes or flops
        self.smoothing = []  # seconds and peak memory of whole commands

    def measure(self, target):
        note(f"stages of {self.name}")
        run = subprocess.run([os.path.join(PROGRAMS, "kernels"), self.path, target,
                              "--benchmark_format=json",
                              f"--benchmark_repetitions={self.repetitions}",
                              "--benchmark_enable_random_interleaving=true"],
                             capture_output=True, text=True)
        if run.returncode != 0:
            sys.exit(f"kernels {self.path}: exit {run.returncode}\n{run.stderr}")
        report = json.loads(run.stdout)
        self.counts = {count: int(report["context"][count])
                       for count in ("vertices", "triangles", "hinges")}
        for entry in report["benchmarks"]:
            if entry["run_type"] == "iteration":
                self.add("/".join(entry["name"].split("/")[:2]), entry)
        smoothing = wall_clock([PROGRAM, "smooth", self.path, target, "--steps", 16, "--quiet",
                                "--overwrite"])
        if smoothing:
            self.smoothing.append(smoothing)

    def add(self, name, entry):
        if not entry["real_time"] > self.shortest.get(name, entry)["real_time"]:
            self.shortest[name] = entry

    def result(self):
        limit = limits(self.shortest)
        figures = {}
        for stage in STAGES:
            for threads in THREADS:
                entry = self.shortest.get(f"{stage}/{threads}")
                if entry is not None:
                    seconds = entry["real_time"]
                    least = least_seconds(stage, threads, entry, limit)
                    figures.setdefault(stage, {})[threads] = {
                        "seconds": seconds, "limit": least, "ratio": seconds / least}
        result = {"mesh": self.name, "limits": limit, "stages": figures, **self.counts}
        if self.smoothing:
            result["smooth"] = {"seconds": min(seconds for seconds, _ in self.smoothing),
                                "peak_bytes": max(peak for _, peak in self.smoothing)}
        return result


def limits(entries):
    """Bytes or flops per second, and seconds for the bytes of the file."""
    rates = {name.removeprefix("limit: "): entry.get("bytes", entry.get("flops")) / entry["real_time"]
             for name, entry in entries.items() if name.startswith("limit: ")}
    return {"memory": {threads: rates[f"memory/{threads}"] for threads in THREADS},
            "dgemm": rates["dgemm/1"], "sgemm": rates["sgemm/1"],
            "read": rates["read/1"], "write": rates["write/1"]}


def least_seconds(stage, threads, entry, limit):
    """The least time in which the machine can process the bytes or flops of a stage."""
    if stage in ("read", "write"):
        return entry["bytes"] / limit[stage]
    if "flops" in entry:
        product = "sgemm" if stage.endswith("float32") else "dgemm"
        return entry["flops"] / (int(threads) * limit[product])
    return entry["bytes"] / limit["memory"][threads]


def meshes(largest, scratch):
    for level in range(4, largest + 1):
        mesh = make(scratch, f"icosphere{level}.off", "icosphere", "--subdivide", level)
        name = "sphere " + short_count(10 * 4 ** level + 2)
        yield Mesh(name, mesh, *SAMPLES_OF_LEVEL.get(level, SAMPLES))
    for model in MODELS:
        source = os.path.join(SHARED, "models", model + ".off")
        if os.path.exists(source):
            yield Mesh(model.split("_")[0], source, *SAMPLES)
        else:
            note(f"{source}: not there, left out")


def measure(largest, scratch):
    all_meshes = list(meshes(largest, scratch))
    target = os.path.join(scratch, "smoothed.off")
    for done in range(max(mesh.rounds for mesh in all_meshes)):
        for mesh in all_meshes:
            if done < mesh.rounds:
                mesh.measure(target)
    return [mesh.result() for mesh in all_meshes]


def ratios(results):
    return {f"{result['mesh']}: {stage}, {threads} threads": figure["ratio"]
            for result in results for stage, by_threads in result["stages"].items()
            for threads, figure in by_threads.items()}


def best(results, rate):
    return max(rate(result["limits"]) for result in results) / 1e9


def show_limits(results):
    memory = " / ".join(f"{best(results, lambda limit: limit['memory'][threads]):.1f}"
                        for threads in THREADS)
    print(f"limits: memory {memory} GB/s on 1 / 2 threads; on one thread dgemm "
          f"{best(results, lambda limit: limit['dgemm']):.1f}, sgemm "
          f"{best(results, lambda limit: limit['sgemm']):.1f} GFLOP/s")


def cell(figure):
    return f"{time_text(figure['seconds'])} {figure['ratio']:#7.3g}".rstrip(".") if figure else "-"


def per_stencil(result, stage):
    """Nanoseconds per stencil on one and two threads."""
    count = result[PER_STENCIL[stage][0]]
    return " / ".join(f"{1e9 * figure['seconds'] / count:.1f}"
                      for figure in result["stages"][stage].values())


def show_smoothing(results, widths):
    smoothing = [result.get("smooth") for result in results]
    row(["smooth --steps 16", "all", *(time_text(run["seconds"]) if run else "-"
                                       for run in smoothing)], widths)
    row(["  peak memory", "", *(f"{run['peak_bytes'] / 1e6:.0f} MB" if run else "-"
                                for run in smoothing)], widths)


def show(results):
    """Prints one column per mesh: seconds, and their ratio to the limit."""
    show_limits(results)
    widths = [19, 7] + [17] * len(results)
    row(["time and x limit", "threads", *(result["mesh"] for result in results)], widths)
    for stage in STAGES:
        for threads in THREADS:
            row([stage if threads == "1" else "", threads,
                 *(cell(result["stages"].get(stage, {}).get(threads)) for result in results)], widths)
        if stage in PER_STENCIL:
            row(["  " + PER_STENCIL[stage][1], "1 / 2",
                 *(per_stencil(result, stage) for result in results)], widths)
    show_smoothing(results, widths)
