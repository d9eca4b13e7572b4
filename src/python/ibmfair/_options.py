"""The options of the command line as keywords: names, checks and documentation come from the table
that the program's help and man pages come from (`ibmfair --json-usage`)."""

import contextlib
import difflib
import functools
import inspect
import json
import numbers
import os
import re
import sys
import textwrap
import warnings

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
    return re.sub(r"""(^|[\s(`'"])--([a-z][a-z0-9-]*)""",
                  lambda match: match[1] + match[2].replace("-", "_"), text)


@contextlib.contextmanager
def python_names():
    """Raises the library's exceptions with the names of options as keywords."""
    try:
        yield
    except errors.Error as error:
        raise type(error)(in_python(str(error))) from None


def warn(text):
    """Warns at the line outside of this package."""
    package, frame, level = os.path.dirname(__file__), sys._getframe(1), 2
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == package:
        frame, level = frame.f_back, level + 1
    warnings.warn(in_python(text), errors.MeshWarning, stacklevel=level)


def path(value, name="path"):
    """A path as bytes, in which "-" is a file like any other."""
    found = os.fsencode(os.fspath(value))
    if b"\0" in found:
        raise ValueError(f"{name}: embedded null byte")
    return b"./-" if found == b"-" else found


def check_names(function, given, known):
    for name in given:
        if name not in known:
            close = difflib.get_close_matches(name, known, n=1)
            hint = f"; did you mean '{close[0]}'?" if close else ""
            raise TypeError(f"{function}() got an unexpected keyword argument '{name}'{hint}")


def _plain(value, whole):
    """A number as Python's own; `whole`: 3.0 becomes 3."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, numbers.Number) and not isinstance(value, (bool, int, complex)):
        value = float(value)
        if whole and value.is_integer():
            value = int(value)
    return value


def words(keyword, option, value):
    """The words of the command line for one keyword and its value."""
    name, whole = option["name"], option["type"] == "integer" or bool(option["choices"])
    value = _plain(value, whole)
    if value is None or value is False:
        return []
    if value is True:
        if option["type"] != "flag":
            raise ValueError(f"{keyword} needs a value")
        return [name]
    if option["type"] == "flag" and not option["optional_value"]:
        raise ValueError(f"{keyword} must be True or False, not {value!r}")
    if isinstance(value, (str, bytes)) and not value:
        raise ValueError(f"{keyword} is empty")
    if isinstance(value, (str, bytes, os.PathLike)):
        if option["file"] is not None or not isinstance(value, str):
            return [os.fsencode(name) + b"=" + path(value, keyword)]
        if "\0" in value:
            raise ValueError(f"{keyword}: embedded null byte")
        return [f"{name}={value}"]
    if isinstance(value, (int, float)):
        return [f"{name}={value!r}"]
    try:
        rows = list(value)
    except TypeError:
        raise ValueError(f"{keyword}: cannot use {value!r}") from None
    if rows and (keyword == "report" or np.ndim(rows[0]) > 0):
        return [word for row in rows for word in words(keyword, option, row)]
    whole = keyword in ("only", "bridge")
    rows = [_plain(row, whole) for row in rows]
    if not rows or not all(isinstance(row, (int, float, str)) for row in rows):
        raise ValueError(f"{keyword}: cannot use {value!r}")
    return [f"{name}={','.join(row if isinstance(row, str) else repr(row) for row in rows)}"]


def _kind(keyword, option):
    """The type of a keyword in its documentation."""
    if keyword in _keywords.KINDS:
        return _keywords.KINDS[keyword]
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
    text = _keywords.ON_ARRAYS.get(keyword)
    if text is None:
        text = re.sub(r" \((?:see [^)]* below|the next word [^)]*)\)", "", option["help"])
        text = text[0].upper() + text[1:] + (f" ({'; '.join(details)})" if details else "") + "."
    body = textwrap.fill(in_python(text), 88, break_on_hyphens=False)
    return f"{keyword} : {_kind(keyword, option)}, optional\n{textwrap.indent(body, '    ')}"


MESH = """V : array_like of shape (n, 3), or Mesh
    Positions.
F : array_like of shape (m, 3), list of faces, or packed faces
    Faces, vertex numbers counted from 0; None if `V` is a Mesh."""


def documented(command, without=()):
    """Completes a function's docstring and signature by the options of the command. The line
    `{options}` in the docstring stands for their entries, and `{mesh}` for those of V and F.
    `without`: keywords that the function sets itself."""

    def complete(function):
        known = {name: option for name, option in keywords(command).items() if name not in without}
        if function.__doc__ is not None:  # as under python3 -OO
            entries = "\n".join(_entry(name, option) for name, option in known.items())
            text = inspect.cleandoc(function.__doc__)
            function.__doc__ = text.replace("{options}", entries).replace("{mesh}", MESH)
        signature = inspect.signature(function)
        own = [parameter for parameter in signature.parameters.values()
               if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
        taken = {parameter.name for parameter in own}
        function.__signature__ = signature.replace(parameters=own + [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None)
            for name in known if name not in taken])
        return function

    return complete
