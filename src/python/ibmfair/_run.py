"""Runs a command of the command line on arrays."""

import json
import logging
import os

import numpy as np

from . import _core
from ._arrays import Faces, per_vertex, vertex_set, vertices
from ._files import Mesh
from ._keywords import PER_VERTEX
from ._options import check_names, in_python, keywords, python_names, warn, words

log = logging.getLogger("ibmfair")


class Input:
    """A mesh that a command reads, and the options that are arrays at its vertices."""

    def __init__(self, V, F, name="mesh"):
        self.name = name
        self._file = None
        if isinstance(V, Mesh):
            if F is not None:
                raise TypeError("a Mesh has its own faces; give either a Mesh, or V and F")
            self._file = V.file()
            V, F = V.V, V.F
        elif F is None:
            raise TypeError("F is missing")
        self.V = vertices(V)
        self.faces = Faces(F, len(self.V))
        self._properties = {}

    def option(self, keyword, value):
        """Adds the values at the vertices to the mesh; returns the value on the command line."""
        count = len(self.V)
        if keyword in ("mask", "region"):
            values = vertex_set(value, count, keyword).astype(np.float64)
        else:
            values = per_vertex(value, count, keyword)
        name = "@" + keyword
        self._properties[name] = values
        return name

    def for_core(self):
        """The mesh for the extension module."""
        file = self._file
        if file is None:
            file = _core.mesh_file(self.name, self.V, self.faces.first, self.faces.corner)
        for name, values in self._properties.items():
            file = file.with_values(name, values)
        return file


def fixed_as_mask(mesh, options):
    """Replaces vertices in `fix` by a mask of those that move."""
    fix = options["fix"]
    if fix is None or fix is False or isinstance(fix, (str, bytes, os.PathLike)):
        return options
    mask = options.get("mask")
    if isinstance(mask, str):
        raise ValueError("fix with an array cannot be combined with a mask that is a name; give the "
                         "mask as an array, too")
    count = len(mesh.V)
    moves = np.ones(count, bool) if mask is None else vertex_set(mask, count, "mask")
    return {**options, "fix": None, "mask": moves & ~vertex_set(fix, count, "fix")}


def words_of(mesh, options, known):
    """The words of the command line for these keywords."""
    found = []
    if "fix" in options:
        options = fixed_as_mask(mesh, options)
    for keyword, value in options.items():
        named = value is None or value is False or isinstance(value, (str, bytes, os.PathLike))
        if keyword in PER_VERTEX and not named:
            value = mesh.option(keyword, value)
        found += words(keyword, known[keyword], value)
    return found


def run(function, command, meshes, options, progress=None, arguments=(), given=()):
    """Runs the command; returns what the extension module returns, with `info` in place of the
    figures. `arguments` follow the names of the meshes. `given`: keywords that the function sets
    itself, to True. Warnings go to `warnings`, notes to the logger "ibmfair"."""
    known = keywords(command)
    check_names(function, options, [name for name in known if name not in given])
    options = {**dict.fromkeys(given, True), **options}
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be callable, not {progress!r}")
    line = [command, *words_of(meshes[0] if meshes else None, options, known)]
    line += ["--json"] if command in ("holes", "info", "compare") else []
    line += ["--", *(mesh.name for mesh in meshes), *arguments]
    with python_names():
        result = _core.run(line, [(mesh.name, mesh.for_core()) for mesh in meshes], progress)
    result["info"] = json.loads(result.pop("figures") or "{}")
    for note in result["notes"]:
        log.info(in_python(note))
    if result["error"] is None:
        for warning in result["warnings"]:
            warn(warning)
    return result


def interrupt(result, V):
    """Raises the exception that ended a run early, with the state that was reached: None if there
    was none yet."""
    error = result["error"]
    reached = result["V"] is not None
    try:
        error.V, error.info = (V, result["info"]) if reached else (None, None)
    except AttributeError:  # an exception of the caller's that takes none
        pass
    raise error
