"""Mesh files with everything they hold."""

import numpy as np

from . import _core, errors
from ._arrays import Faces, vertices
from ._options import path as path_of
from ._options import python_names, warn


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
            self._F = corner.reshape(-1, counts[0])
            self._F.flags.writeable = False
        else:
            self._F = [row.tolist() for row in np.split(corner, first[1:-1])]
        self._before = file.positions()
        self._V = self._before.copy()

    @property
    def path(self):
        """The path of the file as it was given."""
        return self._file.name

    @property
    def F(self):
        """The faces: ndarray of shape (m, k), or a list of lists where their sizes differ."""
        return self._F

    @property
    def V(self):
        """ndarray of shape (n, 3): the positions."""
        return self._V

    @V.setter
    def V(self, positions):
        positions = np.array(vertices(positions))
        if len(positions) != len(self._before):
            raise ValueError(f"V must have the {len(self._before)} vertices of the file, not "
                             f"{len(positions)}")
        self._V = positions

    def mask(self, name):
        """The vertices that a name in the file selects.

        Parameters
        ----------
        name : str
            An OBJ group, object or material, or a PLY vertex property.

        Returns
        -------
        ndarray of bool, shape (n,)
            The vertices of the faces of the group, or those whose property is not zero.

        Raises
        ------
        BadOption
            With a list of the names in the file, if `name` is none of them.
        """
        return np.array(self._file.vertex_mask(str(name)), dtype=bool)

    def values(self, name):
        """The values of a PLY vertex property.

        Parameters
        ----------
        name : str

        Returns
        -------
        ndarray of shape (n,), or None
            None if the file has no property of this name.
        """
        found = self._file.vertex_values(str(name))
        return None if found is None else np.array(found)

    def file(self):
        """The file for the extension module, with the positions as they are now."""
        V = vertices(self._V)
        return self._file if np.array_equal(V, self._before) else self._file.with_positions(V)

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

    def __copy__(self):
        other = Mesh(self._file)
        other.V = self._V
        return other

    def __deepcopy__(self, memo):
        return self.__copy__()

    def __repr__(self):
        return f"<ibmfair.Mesh {self.path!r}: {len(self._before)} vertices, {len(self.F)} faces>"


def _written(write, mesh, path, format, precision, overwrite):
    if precision not in ("keep", "float", "double"):
        raise errors.BadOption(f"precision: {precision!r} is not known; write one of keep, float, "
                               "double")
    with python_names():
        return write(*mesh, path_of(path), str(format or ""), precision, bool(overwrite))


def read(path, *, format=None, weld=False):
    """Reads a mesh file. OBJ, PLY, OFF and 3MF are read exactly; STL and other formats are read by a
    helper of the program ibmfair, in single precision.

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
        file = _core.read(path_of(path), str(format or ""), bool(weld))
    for warning in file.warnings:
        warn(warning)
    return Mesh(file)


def write(path, V, F=None, *, overwrite=False, format=None, precision="keep"):
    """Writes arrays to a mesh file.

    Parameters
    ----------
    path : str or path-like
    V : array_like of shape (n, 3), or Mesh
        Positions.
    F : array_like of shape (m, 3), list of faces, or packed faces
        Faces, vertex numbers counted from 0; None if `V` is a Mesh.
    overwrite, format, precision
        As for `Mesh.write`.

    Returns
    -------
    dict
        As of `Mesh.write`.

    Raises
    ------
    CannotWrite, BadOption
        As by `Mesh.write`.
    """
    if isinstance(V, Mesh) and F is None:
        return V.write(path, overwrite=overwrite, format=format, precision=precision)
    V = vertices(V)
    faces = Faces(F, len(V))
    return _written(_core.write_arrays, (V, faces.first, faces.corner), path, format, precision,
                    overwrite)
