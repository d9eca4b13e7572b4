"""Writes the type stubs of the package: the template __init__.pyi.in with the keywords of each command
from the program's own list of options.

    stubs.py PROGRAM TEMPLATE OUTPUT
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).parent
sys.path.insert(0, str(ROOT / "ibmfair"))
import _keywords  # noqa: E402  (needs neither numpy nor the extension module)

FLOAT, INT, PATH = "SupportsFloat", "SupportsIndex", "str | PathLike[str]"
TYPES = {"flag": "bool", "integer": f"{INT} | float", "number": FLOAT, "length": f"{FLOAT} | str",
         "bytes": f"{INT} | str"}
# Keywords that take arrays or lists.
LISTS = {"report": f"{PATH} | Sequence[{PATH}]", "only": "ArrayLike | str", "bridge": "ArrayLike | str",
         "fix": "ArrayLike | str", "torus": "ArrayLike | str", "center": "ArrayLike | str",
         "move": "ArrayLike | str", "anisotropy": "ArrayLike | str",
         **dict.fromkeys(_keywords.PER_VERTEX, "ArrayLike | str")}


def annotation(option):
    """The type of a keyword."""
    name = option["name"].lstrip("-")
    if name in LISTS:
        kind = LISTS[name]
    elif option["choices"]:
        kind = "Literal[" + ", ".join(f'"{choice}"' for choice in option["choices"]) + "]"
        kind += " | int" if all(choice.isdigit() for choice in option["choices"]) else ""
    elif option["optional_value"]:
        kind = f"bool | {FLOAT} | str"
    elif option["file"]:
        kind = PATH
    else:
        kind = TYPES.get(option["type"], f"{FLOAT} | str")
    return f"{kind} | None"


def parameters(commands, function, left_out, indent):
    """The lines of the keywords of a function."""
    command = "smooth" if function == "flow" else function
    known = _keywords.keywords(commands[command]["options"])
    names = _keywords.OF_STEPS if function == "flow" else known
    return "".join(f"{indent}{name}: {annotation(known[name])} = ...,\n" for name in names
                   if name != left_out)


def main(program, template, output):
    usage = json.loads(subprocess.run([program, "--json-usage"], capture_output=True, text=True,
                                      check=True).stdout)
    commands = {command["name"]: command for command in usage["commands"]}
    text = pathlib.Path(template).read_text()
    text = re.sub(r"( *)@(\w+)(?: without (\w+))?@\n",
                  lambda match: parameters(commands, match[2], match[3], match[1]), text)
    pathlib.Path(output).write_text(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
