#!/usr/bin/env python3
"""Simulates `sbatch` or `srun`, depending on the name by which it is called, as far as
`ibmfair help batch` uses them. A job is one command or an array of tasks that all run at once on
this machine. sbatch returns when the job has ended, so that dependent jobs may run.

If the environment variable MISHAPS is set, every second task of an array is killed once the task
has produced output, and is restarted.
"""

import argparse
import os
import signal
import subprocess
import sys
import time


def options_of(script):
    """The arguments in the #SBATCH lines of a script."""
    with open(script, encoding="utf-8") as file:
        lines = [line.split()[1:] for line in file if line.startswith("#SBATCH ")]
    return [word for line in lines for word in line]


def parse(words):
    parser = argparse.ArgumentParser(prog="sbatch", allow_abbrev=False)
    parser.add_argument("--array")
    parser.add_argument("--requeue", action="store_true")
    parser.add_argument("--parsable", action="store_true")
    parser.add_argument("--dependency")
    parser.add_argument("--wrap")
    parser.add_argument("script", nargs="?")
    return parser.parse_args(words)


def begin(script, task, restarts):
    environment = {**os.environ, "SLURM_ARRAY_TASK_ID": str(task),
                   "SLURM_RESTART_COUNT": str(restarts)}
    return subprocess.Popen([script], env=environment, start_new_session=True,
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def kill_and_restart(script, task, process):
    """Waits until the list has begun, kills the process, and returns the process of the restart."""
    while process.poll() is None and not os.path.exists("fair"):
        time.sleep(0.002)
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    return begin(script, task, 1)


def run_array(array, script):
    first, last = map(int, array.split("-"))
    running = {task: begin(script, task, 0) for task in range(first, last + 1)}
    if os.environ.get("MISHAPS"):
        for task in list(running)[::2]:
            running[task] = kill_and_restart(script, task, running[task])
    return max(process.wait() for process in running.values())


def sbatch(words):
    given = parse(words)
    if given.wrap:
        if given.dependency and not given.dependency.startswith("afterany:4711"):
            sys.exit(f"sbatch: no such job: {given.dependency}")
        return subprocess.run(["sh", "-c", given.wrap], check=False).returncode
    given = parse(options_of(given.script) + words)
    run_array(given.array, os.path.abspath(given.script))
    print("4711" if given.parsable else "Submitted batch job 4711")
    return 0


def main():
    if os.path.basename(sys.argv[0]) == "srun":
        os.execvp(sys.argv[1], sys.argv[1:])
    sys.exit(sbatch(sys.argv[1:]))


main()
