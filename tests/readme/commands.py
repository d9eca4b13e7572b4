"""Runs the commands of the README's recipes and of the text about energies as a user would type
them: one after the other, in a folder that tools/demo has made.

    commands.py PROGRAM WORK
"""

import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def blocks(path, section=None):
    """The blocks of commands in a text or in one of its sections."""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        text = file.read()
    if section is not None:
        text = text.split(f"## {section}\n", 1)[1].split("\n## ", 1)[0]
    found = re.findall(r"```sh\n(.*?)```", text, re.DOTALL)
    if not found:
        sys.exit(f"{path} has no commands")
    return found


def main():
    program, work = map(os.path.abspath, sys.argv[1:3])
    shutil.rmtree(work, ignore_errors=True)
    demo = os.path.join(work, "build", "demo")
    os.makedirs(demo)
    os.symlink(program, os.path.join(work, "build", "ibmfair"))
    subprocess.run([sys.executable, os.path.join(ROOT, "tools", "lib", "demo_files.py"), program, demo],
                   check=True)
    commands = blocks("README.md", "Six recipes") + blocks("src/ibmfair/energy/README.md")
    if len(commands) < 7:
        sys.exit(f"only {len(commands)} blocks of commands")
    script = "set -euo pipefail\n" + "".join(commands)
    subprocess.run(["bash", "-xc", script], cwd=work, check=True)
    given = set(re.findall(r"[\w/]+\.(?:ply|obj|off|html|json|csv|png|txt)\b", script)) - {"x.ply"}
    missing = sorted(name for name in given if not os.path.getsize(os.path.join(demo, name)))
    if missing:
        sys.exit(f"empty: {missing}")


main()
