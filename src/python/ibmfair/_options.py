"""The options of the command line as keywords: names, checks and documentation come from the table
that the program's help and man pages come from (`ibmfair --json-usage`)."""

import contextlib
import difflib
import functools
import inspect
import json
import os
import re
import textwrap

import numpy as np

from . import _core, _keywords, errors

@functools.lru_cache(maxsize=None)
def table():
    """{command: {keyword: row of the program's list of options}}."""
    usage = json.loads(_core.usage())
    return {command["name"]: _keywords.keywords(command["options"])
            for command in usage["commands"]}


def keywords(command):
    """{keyword: row} of the options that the function for this command takes."""
    return table()[command]


def in_python(text):
    """A message of the library with the names of options as keywords."""
    return re.sub(r"--([a-z][a-z0-9-]*)", lambda match: match[1].replace("-", "_"), text)


@contextlib.contextmanager
def python_names():
    """Raises the library's exceptions with the names of options as keywords."""
    try:
        yield
    except errors.Error as error:
        raise type(error)(in_python(str(error))) from None


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
    if isinstance(value, (list, tuple)) and value and isinstance(value[0], (str, os.PathLike)):
        return [f"{name}={os.fspath(one)}" for one in value]
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name.lstrip('-').replace('-', '_')}: cannot use {value!r}")
    return [f"{name}={','.join(repr(number) for number in array.reshape(-1).tolist())}"]


def _kind(option):
    """The type of a keyword in its documentation."""
    name = option["name"].lstrip("-")
    if name in _keywords.PER_VERTEX:
        return "array_like of shape (n,) or str"
    if name == "fix":
        return "array_like of flags (n,) or of vertex numbers"
    if option["choices"]:
        return "{" + ", ".join(repr(choice) for choice in option["choices"]) + "}"
    if option["type"] == "length" or "mesh units (" in (option["unit"] or ""):
        return "bool, float or str" if option["optional_value"] else "float or str"
    return {"flag": "bool", "integer": "int", "number": "float"}.get(option["type"], "str")


def _entry(keyword, option):
    """An entry of a numpydoc section."""
    default = option["default"] if option["default"] is not None else option["default_text"]
    details = [f"unit: {option['unit']}"] if option["unit"] else []
    if default and option["type"] != "flag":
        details.append(f"default: {default}")
    if keyword in _keywords.ON_ARRAYS:
        text = _keywords.ON_ARRAYS[keyword]
    else:
        text = option["help"][0].upper() + option["help"][1:]
        text = in_python(text + (f" ({'; '.join(details)})" if details else "") + ".")
    body = textwrap.fill(text, 88, break_on_hyphens=False)
    return f"{keyword} : {_kind(option)}, optional\n{textwrap.indent(body, '    ')}"


MESH = """V : array_like of shape (n, 3), or Mesh
    Positions.
F : array_like of shape (m, 3), list of faces, or packed faces
    Faces, vertex numbers counted from 0; None if `V` is a Mesh."""


def documented(command, without=()):
    """Completes a function's docstring and signature by the options of the command. The line
    `{options}` in the docstring stands for their entries, and `{mesh}` for those of V and F. `without`: keywords that the function sets
    itself."""

    def complete(function):
        known = {name: option for name, option in keywords(command).items() if name not in without}
        entries = "\n".join(_entry(name, option) for name, option in known.items())
        function.__doc__ = inspect.cleandoc(function.__doc__).replace("{options}", entries).replace("{mesh}", MESH)
        signature = inspect.signature(function)
        own = [parameter for parameter in signature.parameters.values()
               if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
        taken = {parameter.name for parameter in own}
        function.__signature__ = signature.replace(parameters=own + [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None)
            for name in known if name not in taken])
        return function

    return complete
