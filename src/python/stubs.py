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

LENGTH = "float | str"
TYPES = {"flag": "bool", "integer": "int", "number": "float", "length": LENGTH,
         "name or file": "ArrayLike | str", "bytes": "int | str"}


def annotation(option):
    """The type of a keyword."""
    name = option["name"].lstrip("-")
    if option["choices"]:
        kind = "Literal[" + ", ".join(f'"{choice}"' for choice in option["choices"]) + "]"
    elif name in _keywords.PER_VERTEX or name == "fix":
        kind = "ArrayLike | str"
    elif option["optional_value"]:
        kind = f"bool | {LENGTH}"
    elif name == "report":
        kind = "str | PathLike[str] | Sequence[str | PathLike[str]]"
    elif option["file"]:
        kind = "str | PathLike[str]"
    else:
        kind = TYPES.get(option["type"], "float | str | Sequence[float]")
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
