"""Mesh files with everything they hold."""

import os
import warnings

import numpy as np

from . import _core, errors
from ._arrays import Faces, vertices
from ._options import in_python, python_names


class Mesh:
    """A mesh as a file holds it: positions, faces, and everything else for writing it again.

    Attributes
    ----------
    V : ndarray of shape (n, 3), float64
        The positions; assign new ones to write them.
    F : ndarray of shape (m, 3) or list of lists
        The faces in the order of the file, with vertex numbers counted from 0. Read only.
    path : str
        The file.
    """

    def __init__(self, file):
        self._file = file
        first, corner = file.faces()
        counts = np.diff(first)
        if (counts == counts[0]).all():
            self.F = corner.reshape(-1, counts[0])
            self.F.flags.writeable = False
        else:
            self.F = [row.tolist() for row in np.split(corner, first[1:-1])]
        self._before = file.positions()
        self.V = self._before.copy()

    @property
    def path(self):
        """The path of the file as it was given."""
        return self._file.name

    @property
    def V(self):
        """ndarray of shape (n, 3): the positions."""
        return self._V

    @V.setter
    def V(self, positions):
        positions = vertices(positions)
        if len(positions) != len(self._before):
            raise ValueError(f"V must have the {len(self._before)} vertices of the file, not "
                             f"{len(positions)}")
        self._V = positions

    def mask(self, name):
        """Flags (n,) of the vertices of an OBJ group, object or material, or of those whose PLY
        property of this name is not zero."""
        return np.array(self._file.vertex_mask(name), dtype=bool)

    def values(self, name):
        """The values (n,) of a PLY vertex property, or None if the file has none of this name."""
        found = self._file.vertex_values(name)
        return None if found is None else np.array(found)

    def unchanged_file(self):
        """The file for the extension module, or None if the positions are others by now."""
        return self._file if np.array_equal(self._V, self._before) else None

    def write(self, path, *, overwrite=False, format=None, precision="keep"):
        """Writes the mesh with its positions `V`. In the format of the file that was read, all bytes
        stay but the coordinates of vertices that moved, and normals that depend on them.

        Parameters
        ----------
        path : str or path-like
        overwrite : bool
            Replace the file if it exists.
        format : str, optional
            The format, if the extension does not tell it.
        precision : {'keep', 'float', 'double'}
            How PLY files declare coordinates.

        Returns
        -------
        dict
            `patched` (whether the bytes of the source were kept), `moved_vertices`, `bytes`, and
            `notes` about what the format cannot hold.

        Raises
        ------
        CannotWrite
            If the file exists and may not be replaced, or cannot be written; it is then as before.
        BadOption
            If the format cannot be written.
        """
        return _written(_core.write, (self._file, vertices(self._V)), path, format, precision,
                        overwrite)

    def __repr__(self):
        return f"<ibmfair.Mesh {self.path!r}: {len(self._before)} vertices, {len(self.F)} faces>"


def _written(write, mesh, path, format, precision, overwrite):
    if precision not in ("keep", "float", "double"):
        raise errors.BadOption(f"precision: '{precision}' is not known; write one of keep, float, "
                               "double")
    with python_names():
        return write(*mesh, os.fspath(path), format or "", precision, overwrite)


def read(path, *, format=None, weld=False):
    """Reads a mesh file: OBJ, PLY, OFF, STL and 3MF exactly, other formats through assimp, where the
    program ibmfair is installed.

    Parameters
    ----------
    path : str or path-like
    format : str, optional
        The format, if neither the extension nor the first bytes tell it.
    weld : bool
        Merge vertices at exactly the same position.

    Returns
    -------
    Mesh

    Raises
    ------
    BadFile
        If the file cannot be read or is malformed; the message names the place.
    """
    with python_names():
        file = _core.read(os.fspath(path), format or "", weld)
    for warning in file.warnings:
        warnings.warn(in_python(warning), errors.MeshWarning, stacklevel=2)
    return Mesh(file)


def write(path, V, F, *, overwrite=False, format=None, precision="keep"):
    """Writes arrays to a mesh file; see Mesh.write for the parameters."""
    V = vertices(V)
    faces = Faces(F, len(V))
    return _written(_core.write_arrays, (V, faces.first, faces.corner), path, format, precision,
                    overwrite)
