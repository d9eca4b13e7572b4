"""The options of the command line as keywords: names, checks and documentation come from the table
that the program's help and man pages come from (`ibmfair --json-usage`)."""

import difflib
import functools
import inspect
import json
import os
import re
import textwrap

import numpy as np

from . import _core

# Options that concern files of meshes, the terminal or other processes, and have no meaning for a
# function on arrays.
NOT_KEYWORDS = frozenset({
    "format", "input-format", "precision", "checkpoint", "engine", "json", "quiet", "verbose",
    "dump-config", "help", "json-usage"})
MANY_FILES = "Many files"

# Options whose value may be an array with one number for each vertex.
PER_VERTEX = frozenset({"weights", "h0", "mask", "region"})


@functools.lru_cache(maxsize=None)
def table():
    """The options of each command: {command: {option without dashes: its row in the usage}}."""
    usage = json.loads(_core.usage())
    return {command["name"]: {option["name"].lstrip("-"): option for option in command["options"]}
            for command in usage["commands"]}


def is_keyword(option):
    return (option["name"].lstrip("-") not in NOT_KEYWORDS and option["group"] != MANY_FILES)


def keywords(command):
    """{keyword: row} of the options that the function for this command takes."""
    return {name.replace("-", "_"): option for name, option in table()[command].items()
            if is_keyword(option)}


def in_python(text):
    """A message of the library with the names of options as keywords."""
    return re.sub(r"--([a-z][a-z0-9-]*)", lambda match: match[1].replace("-", "_"), text)


def check_names(function, given, known):
    for name in given:
        if name not in known:
            close = difflib.get_close_matches(name, known, n=1)
            hint = f"; did you mean '{close[0]}'?" if close else ""
            raise TypeError(f"{function}() got an unexpected keyword argument '{name}'{hint}")


def word(option, value):
    """The words of the command line for one keyword and its value."""
    name = option["name"]
    if value is None or value is False:
        return []
    if value is True:
        if option["type"] != "flag":
            raise ValueError(f"{name.lstrip('-').replace('-', '_')} needs a value")
        return [name]
    if isinstance(value, (str, os.PathLike)):
        return [f"{name}={os.fspath(value)}"]
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name.lstrip('-').replace('-', '_')}: cannot use {value!r}")
    return [f"{name}={','.join(repr(number) for number in array.reshape(-1).tolist())}"]


def _entry(keyword, option):
    """An entry of a numpydoc section."""
    kind = {"flag": "bool", "integer": "int", "number": "float"}.get(option["type"], "str")
    if option["name"].lstrip("-") in PER_VERTEX:
        kind = "array_like of shape (n,) or str"
    elif option["name"] == "--fix":
        kind = "array_like of flags (n,) or of vertex numbers, or str"
    elif option["type"] == "length" or "mesh units" in (option["unit"] or ""):
        kind = "float or str"
    if option["choices"]:
        kind = "{" + ", ".join(repr(choice) for choice in option["choices"]) + "}"
    text = in_python(option["help"])
    details = []
    if option["unit"]:
        details.append(f"unit: {option['unit']}")
    default = option["default"] if option["default"] is not None else option["default_text"]
    if default and option["type"] != "flag":
        details.append(f"default: {in_python(default)}")
    if details:
        text += f" ({'; '.join(details)})"
    body = textwrap.fill(text[0].upper() + text[1:] + ".", 88, break_on_hyphens=False)
    return f"{keyword} : {kind}, optional\n{textwrap.indent(body, '    ')}"


def documented(command):
    """Completes a function's docstring and signature by the options of the command. The line
    `{options}` in the docstring stands for their entries."""

    def complete(function):
        known = keywords(command)
        entries = "\n".join(_entry(name, option) for name, option in known.items())
        function.__doc__ = inspect.cleandoc(function.__doc__).replace("{options}", entries)
        signature = inspect.signature(function)
        own = [parameter for parameter in signature.parameters.values()
               if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
        taken = {parameter.name for parameter in own}
        function.__signature__ = signature.replace(parameters=own + [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None)
            for name in known if name not in taken])
        return function

    return complete
