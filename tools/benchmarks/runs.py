"""Functions shared by the sections of tools/bench: running programs and printing figures."""

import json
import math
import os
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "lib"))
from tables import PROGRAM, ibmfair  # noqa: E402

PROGRAMS = os.path.join(os.path.dirname(PROGRAM), "benchmarks")
TOOLS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def note(text):
    """Prints the current task to standard error, as a sign of progress."""
    print(f"bench: {text}", file=sys.stderr, flush=True)


def build(packages):
    """Installs further packages, and builds ibmfair and its rivals beside PROGRAM."""
    subprocess.run([os.path.join(TOOLS, "setup"), *packages], check=True, stdout=sys.stderr)
    script = 'source "$0"; configure "$1" -D CMAKE_BUILD_TYPE=Release; compile "$1" ibmfair benchmarks'
    subprocess.run(["bash", "-c", script, os.path.join(TOOLS, "lib", "build.sh"),
                    os.path.dirname(PROGRAM)], check=True, stdout=subprocess.DEVNULL)


def wall_clock(command, longest=120):
    """Seconds and peak memory (bytes) of a process; None if it fails or takes too long. The process
    starts as a copy of this one, so peaks below about 17 MB cannot be measured."""
    start = time.perf_counter()
    process = subprocess.Popen(list(map(str, command)), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    limit = threading.Timer(longest, process.kill)
    limit.start()
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    limit.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    unit = 1 if sys.platform == "darwin" else 1024
    return None if process.returncode else (seconds, usage.ru_maxrss * unit)


def factorization(mesh, splits, solver, order="default", threads=1, blas_threads=1, openmp=False):
    """Runs the program `factorizations`; returns its figures. `openmp`: CHOLMOD's loops run on the
    four threads for which they ask OpenMP."""
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": str(blas_threads)}
    if not openmp:
        environment["OMP_THREAD_LIMIT"] = "1"
    run = subprocess.run([os.path.join(PROGRAMS, "factorizations"), mesh, str(splits), solver, order,
                          str(threads)], check=True, capture_output=True, text=True, env=environment)
    return json.loads(run.stdout)


def make(scratch, name, shape, *arguments):
    """Makes a shape with noise of 0.2 mean edge lengths; returns its path."""
    path = os.path.join(scratch, name)
    ibmfair("make", shape, path, "--noise", 0.2, "--overwrite", "--quiet", *arguments)
    return path


def smoothing_time(mesh, cutoff, order):
    """The time in which diffusion of that order (2 or 4) shrinks ripples of wavelength `cutoff` (in
    mean edge lengths) to 1/e of their height, in the mesh's unit of length to that power."""
    edge = ibmfair("info", mesh, "--json")["edge_length"]["mean"]
    return (cutoff * edge / (2 * math.pi)) ** order


def time_text(seconds):
    for unit, size in (("s", 1), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size or unit == "us":
            return f"{seconds / size:#.3g}".rstrip(".") + " " + unit


def short_count(count):
    """A count in short form, such as 164k or 2.62M."""
    return f"{count / 1e6:.3g}M" if count >= 1e6 else f"{count / 1e3:.3g}k"
