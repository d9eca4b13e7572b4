"""Runs a command of the command line on arrays."""

import json
import logging
import warnings

import numpy as np

from . import _core, errors
from ._arrays import Faces, per_vertex, vertex_set, vertices
from ._files import Mesh
from ._keywords import PER_VERTEX
from ._options import check_names, in_python, keywords, python_names, word

log = logging.getLogger("ibmfair")


class Input:
    """A mesh that a command reads, and the options that are arrays at its vertices."""

    def __init__(self, V, F, name="mesh"):
        self.name = name
        self._file = None
        if isinstance(V, Mesh):
            if F is not None:
                raise TypeError("a Mesh has its own faces; give either a Mesh, or V and F")
            self._file = V.unchanged_file()
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
        self._file = None
        name = "@" + keyword
        self._properties[name] = values
        return name

    def packed(self):
        """The mesh in the form that the extension module takes."""
        if self._file is not None:
            return (self.name, self._file)
        return (self.name, self.V, self.faces.first, self.faces.corner, self._properties)


def fixed_as_mask(mesh, options):
    """Replaces vertices in `fix` by a mask of those that move."""
    fix = options.get("fix")
    if fix is None or isinstance(fix, str):
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
    words = []
    if "fix" in options:
        options = fixed_as_mask(mesh, options)
    for keyword, value in options.items():
        option = known[keyword]
        takes_array = option["name"].lstrip("-") in PER_VERTEX
        if takes_array and value is not None and not isinstance(value, str) and np.ndim(value) > 0:
            value = mesh.option(keyword, value)
        words += word(option, value)
    return words


def run(function, command, meshes, options, progress=None, arguments=None):
    """Runs the command; returns what the extension module returns, with `info` in place of the
    figures. Warnings go to `warnings`, notes to the logger "ibmfair"."""
    known = keywords(command)
    check_names(function, options, known)
    words = [command] + [mesh.name for mesh in meshes] + (arguments or [])
    words += words_of(meshes[0] if meshes else None, options, known)
    with python_names():
        result = _core.run(words, [mesh.packed() for mesh in meshes], progress)
    result["info"] = json.loads(result.pop("figures") or "{}")
    for note in result["notes"]:
        log.info(in_python(note))
    if result["error"] is None:
        for warning in result["warnings"]:
            warnings.warn(in_python(warning), errors.MeshWarning, stacklevel=4)
    return result


def interrupt(result, V, info, F=None):
    """Raises the exception that ended a run early, with the state that was reached."""
    error = result["error"]
    error.V, error.info = V, info
    if F is not None:
        error.F = F
    raise error
