"""Checks the links of every text of the project: the linked file must exist, and the linked heading
must exist in that file. Files that a text names in backticks must exist, too.

    links.py [ROOT]
"""

import os
import re
import sys

ROOT = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.dirname(
    os.path.dirname(os.path.abspath(__file__))))
LINK = re.compile(r"\]\(([^)\s]+)\)")
# As in `tools/bench --full`; paths are relative to the root or to the folder of the text.
NAMED = re.compile(r"`((?:src|tools|data|tests|\.github)/[\w./-]+)[^`]*`")


def texts():
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [name for name in folders if name != ".git" and name != "node_modules" and
                      not (folder == ROOT and name.startswith("build"))]
        yield from (os.path.join(folder, name) for name in files if name.endswith(".md"))


def without_code(text):
    return re.sub(r"```.*?```", "", text, flags=re.DOTALL)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def anchors(path):
    """Anchors of headings as GitHub makes them: lower case, hyphens for blanks, no punctuation."""
    headings = re.findall(r"(?m)^#+ (.*)$", without_code(read(path)))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(path):
    text = without_code(read(path))
    for link in LINK.findall(text):
        if re.match(r"[a-z]+:", link):
            continue  # a link to another site
        name, _, anchor = link.partition("#")
        target = os.path.join(os.path.dirname(path), name) if name else path
        if not os.path.exists(target):
            yield f"no file {link}"
        elif anchor and anchor not in anchors(target):
            yield f"no heading {link}"
    for name in NAMED.findall(text):
        if not os.path.exists(os.path.join(ROOT, name.rstrip("."))):
            yield f"no file `{name}`"


def main():
    found = sorted(texts())
    if os.path.join(ROOT, "README.md") not in found:
        sys.exit(f"no README.md in {ROOT}")
    broken = [f"{os.path.relpath(path, ROOT)}: {fault}" for path in found
              for fault in broken_links(path)]
    print(f"{len(found)} texts")
    if broken:
        sys.exit("\n".join(broken))


main()
