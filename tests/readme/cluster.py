"""Runs the cluster commands of `ibmfair help batch` exactly as the help text prints them: with
Slurm, whose commands fake_slurm.py simulates, and with GNU parallel, if installed, whose ssh to
the nodes stays on this machine. In each case, the merged summary must equal that of a single run.

    cluster.py PROGRAM WORK
"""

import csv
import os
import re
import shutil
import subprocess
import sys
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
JOBS = """{"defaults": {"command": "smooth", "options": {"steps": 2, "cutoff": 4}},
           "jobs": [{"input": "scans/*.ply", "output": "fair/"}]}"""
# Like a login, this ssh sets the shell and starts at home: parallel relies on both.
SSH = """#!/bin/sh
while [ "${1#-}" != "$1" ]; do shift; done
echo "$1" >> "$NODES"
shift
[ "$1" != -- ] || shift
cd
export SHELL=/bin/sh
exec sh -c "$*"
"""


def blocks_of_help(program):
    """The indented blocks: Slurm script, its submission, parallel here and on several machines."""
    text = subprocess.run([program, "help", "batch"], check=True, capture_output=True, text=True).stdout
    section = text.split("\nOn a cluster:\n", 1)[1]
    blocks = re.findall(r"(?:^ {6}.*\n)+", section, re.MULTILINE)
    script, submission, local, remote = (textwrap.dedent(block) for block in blocks)
    return script, submission, local, remote


def make_executable(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    os.chmod(path, 0o755)


def prepare(program, work):
    """Makes a folder with meshes to smooth, one of them invalid, and a folder of commands."""
    shutil.rmtree(work, ignore_errors=True)
    commands = os.path.join(work, "commands")
    os.makedirs(commands)
    for name in ("home", "scans"):
        os.makedirs(os.path.join(work, name))
    os.symlink(program, os.path.join(commands, "ibmfair"))
    for name in ("sbatch", "srun"):
        os.symlink(os.path.join(HERE, "fake_slurm.py"), os.path.join(commands, name))
    make_executable(os.path.join(commands, "ssh"), SSH)
    for seed in range(20):
        subprocess.run([program, "make", "icosphere", f"scans/{seed}.ply", "--noise", "0.1", "--seed",
                        str(seed), "--quiet"], cwd=work, check=True)
    with open(os.path.join(work, "scans", "bad.ply"), "w", encoding="utf-8") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex many\n")
    with open(os.path.join(work, "jobs.json"), "w", encoding="utf-8") as file:
        file.write(JOBS)
    return {**os.environ, "HOME": os.path.join(work, "home"),
            "PATH": commands + ":" + os.environ["PATH"], "NODES": os.path.join(work, "nodes")}


def lasting(work, name):
    """The lines of a summary without times and memory, which differ between runs."""
    with open(os.path.join(work, name), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [{key: row[key] for key in row if key not in ("seconds", "peak_megabytes")} for row in rows]


def outputs(work):
    folder = os.path.join(work, "fair")
    found = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            found[name] = file.read()
    return found


def start_anew(work):
    shutil.rmtree(os.path.join(work, "fair"), ignore_errors=True)
    for name in os.listdir(work):
        if name.startswith("jobs.json.journal") or name == "summary.csv":
            path = os.path.join(work, name)
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def check(what, found, expected):
    if found != expected:
        sys.exit(f"{what}: {found}\nexpected: {expected}")


def main():
    program, work = map(os.path.abspath, sys.argv[1:3])
    script, submission, local, remote = blocks_of_help(program)
    environment = prepare(program, work)

    def run(command, codes, **more):
        done = subprocess.run(["bash", "-c", command], cwd=work, env={**environment, **more},
                              check=False)
        if done.returncode not in codes:
            sys.exit(f"exit code {done.returncode}: {command}")

    run("ibmfair batch jobs.json --summary summary.csv", [1])
    summary, meshes = lasting(work, "summary.csv"), outputs(work)
    check("items that are done", sum(row["status"] == "ok" for row in summary), 20)

    make_executable(os.path.join(work, "fair.sbatch"), script)
    # In the second run, tasks are killed and restarted.
    for mishaps in ("", "killed"):
        start_anew(work)
        run(submission, [0, 1], MISHAPS=mishaps)
        check("the summary of Slurm's tasks", lasting(work, "summary.csv"), summary)
        check("what Slurm's tasks write", outputs(work), meshes)

    if shutil.which("parallel") is None:
        print("no GNU parallel: its part is left out")
        return
    *several, merge = remote.splitlines()
    for command in (local, "\n".join(several)):
        start_anew(work)
        run(command, [1])  # the exit code is the number of failed jobs
        run(merge, [1])
        check("the summary of parallel's jobs", lasting(work, "summary.csv"), summary)
        check("what parallel's jobs write", outputs(work), meshes)
    with open(environment["NODES"], encoding="utf-8") as file:
        check("nodes", set(file.read().split()), {"node1", "node2"})


main()
