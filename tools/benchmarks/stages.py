"""The stages of smoothing, beside the machine's limits: the first section of tools/bench."""

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
# What the nanoseconds of a gradient are divided by.
PER_STENCIL = {"gradient": ("hinges", "ns per hinge"),
               "lagrange gradient": ("triangles", "ns per triangle")}


def kernels(mesh, target, repetitions):
    """The context, and for NAME/THREADS the shortest seconds with bytes or flops."""
    run = subprocess.run([os.path.join(PROGRAMS, "kernels"), mesh, target,
                          "--benchmark_format=json",
                          f"--benchmark_repetitions={repetitions}",
                          "--benchmark_enable_random_interleaving=true"],
                         capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"kernels {mesh}: exit {run.returncode}\n{run.stderr}")
    report = json.loads(run.stdout)
    shortest = {}
    for entry in report["benchmarks"]:
        name = "/".join(entry["name"].split("/")[:2])
        if entry["run_type"] == "iteration" and \
                not entry["real_time"] > shortest.get(name, entry)["real_time"]:
            shortest[name] = entry
    return report["context"], shortest


def limits(entries):
    """Bytes or flops a second; and seconds for the bytes of the file."""
    rates = {name.removeprefix("limit: "): entry.get("bytes", entry.get("flops")) / entry["real_time"]
             for name, entry in entries.items() if name.startswith("limit: ")}
    return {"memory": {threads: rates[f"memory/{threads}"] for threads in THREADS},
            "dgemm": rates["dgemm/1"], "sgemm": rates["sgemm/1"],
            "read": rates["read/1"], "write": rates["write/1"]}


def least_seconds(stage, threads, entry, limit):
    """What the machine needs for the bytes or flops of a stage."""
    if stage in ("read", "write"):
        return entry["bytes"] / limit[stage]
    if "flops" in entry:
        product = "sgemm" if stage.endswith("float32") else "dgemm"
        return entry["flops"] / (int(threads) * limit[product])
    return entry["bytes"] / limit["memory"][threads]


def measure_mesh(name, path, repetitions, scratch):
    note(f"stages of {name}")
    target = os.path.join(scratch, "smoothed.off")
    context, entries = kernels(path, target, repetitions)
    limit = limits(entries)
    figures = {}
    for stage in STAGES:
        for threads in THREADS:
            entry = entries.get(f"{stage}/{threads}")
            if entry is not None:
                seconds = entry["real_time"]
                least = least_seconds(stage, threads, entry, limit)
                figures.setdefault(stage, {})[threads] = {
                    "seconds": seconds, "limit": least, "ratio": seconds / least}
    result = {"mesh": name, "limits": limit, "stages": figures}
    for count in ("vertices", "triangles", "hinges"):
        result[count] = int(context[count])
    smoothing = wall_clock([PROGRAM, "smooth", path, target, "--steps", 16, "--quiet",
                            "--overwrite"])
    if smoothing:
        result["smooth"] = dict(zip(("seconds", "peak_bytes"), smoothing))
    return result


def measure(largest, scratch):
    results = []
    for level in range(4, largest + 1):
        mesh = make(scratch, "icosphere.off", "icosphere", "--subdivide", level)
        name = "sphere " + short_count(10 * 4 ** level + 2)
        results.append(measure_mesh(name, mesh, {8: 3, 9: 1}.get(level, 5), scratch))
    for model in MODELS:
        source = os.path.join(SHARED, "models", model + ".off")
        if not os.path.exists(source):
            note(f"{source}: not there, left out")
            continue
        results.append(measure_mesh(model.split("_")[0], source, 5, scratch))
    return results


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
    """Nanoseconds on one and two threads."""
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
    """A column a mesh, of seconds and how many times the limit that is."""
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
