"""Runs the commands of the README's tour as somebody would who types them: one after the other, in a
folder that tools/demo has made.

    tour.py PROGRAM WORK
"""

import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SECTION = "## Eleven things to do with it"


def commands():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
        text = file.read()
    section = text.split(SECTION + "\n", 1)[1].split("\n## ", 1)[0]
    return re.findall(r"```sh\n(.*?)```", section, re.DOTALL)


def main():
    program, work = map(os.path.abspath, sys.argv[1:3])
    shutil.rmtree(work, ignore_errors=True)
    demo = os.path.join(work, "build", "demo")
    os.makedirs(demo)
    os.symlink(program, os.path.join(work, "build", "ibmfair"))
    subprocess.run([sys.executable, os.path.join(ROOT, "tools", "lib", "demo_files.py"), program, demo],
                   check=True)
    blocks = commands()
    if len(blocks) < 10:
        sys.exit(f"only {len(blocks)} blocks of commands in the tour")
    script = "set -euo pipefail\n" + "".join(blocks)
    subprocess.run(["bash", "-xc", script], cwd=work, check=True)
    given = set(re.findall(r"[\w/]+\.(?:ply|obj|off|html|json|csv|png|txt)\b", script)) - {"x.ply"}
    missing = sorted(name for name in given if not os.path.getsize(os.path.join(demo, name)))
    if missing:
        sys.exit(f"empty: {missing}")


main()
