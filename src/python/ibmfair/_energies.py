"""Bending energies, their gradients, and the matrices that they are made of."""

import numpy as np

from . import _core
from ._arrays import per_vertex
from ._options import python_names
from ._run import Input


def _name(value, keyword):
    if value is not None and not isinstance(value, str):
        raise TypeError(f"{keyword} must be a string, not {value!r}")
    return value or ""


def _arrays(V, F):
    mesh = Input(V, F)
    return mesh.V, mesh.faces.first, mesh.faces.corner


def energy(V, F=None, laplacian="crouzeix-raviart", *, mass=None, h0=None, gradient=False):
    """The discrete bending energy E_b = 1/2 tr(X^T L^T M^-1 L X) of a mesh.

    Parameters
    ----------
    V : array_like of shape (n, 3), or Mesh
    F : array_like of shape (m, 3), list of faces, or packed faces; None if `V` is a Mesh
    laplacian : str
        A member of the family: 'crouzeix-raviart', 'lagrange', 'weighted', 'intrinsic-delaunay',
        'umbrella'.
    mass : str, optional
        The mass matrix; None is the default of the Laplacian, 'none' leaves it out.
    h0 : float or array_like of shape (n,), optional
        The spontaneous curvature H0 of 1/2 integral (H - H0)^2, 1 / length; 'lagrange' only.
    gradient : bool
        Also return the gradient.

    Returns
    -------
    E : float
        Not negative; dimensionless with a mass matrix, length^2 without. Triangles without area
        carry no energy.
    G : ndarray of shape (n, 3)
        The exact gradient, only with `gradient`; the unit is that of E divided by length.

    Raises
    ------
    BadOption
        For an unknown name, or a mass matrix that does not fit the Laplacian.

    References
    ----------
    Wardetzky, Bergou, Harmon, Zorin, Grinspun: Discrete Quadratic Curvature Energies, 2007,
    section 2.3.
    """
    mesh = _arrays(V, F)
    curvature = np.empty(0) if h0 is None else per_vertex(h0, len(mesh[0]), "h0")
    with python_names():
        E, G = _core.energy(*mesh, _name(laplacian, "laplacian"), _name(mass, "mass"), curvature,
                            bool(gradient))
    return (E, G) if gradient else E


def laplacian(V, F=None, name="lagrange", *, mass=None):
    """The Laplacian and the mass matrix of a member of the family.

    Parameters
    ----------
    V : array_like of shape (n, 3), or Mesh
    F : array_like of shape (m, 3), list of faces, or packed faces; None if `V` is a Mesh
    name : str
        As for `energy`.
    mass : str, optional
        As for `energy`.

    Returns
    -------
    L : scipy.sparse.csr_matrix
        k x k, symmetric, dimensionless, with constants in its kernel. k is the number of vertices;
        with 'crouzeix-raviart' the nodes are edges, and k is the number of rows of `edges(V, F)`.
        Boundary nodes are included without boundary conditions. Rows of nodes without a triangle of
        positive area are empty.
    M : scipy.sparse.csr_matrix
        k x k, symmetric and positive on all other nodes, length^2.

    References
    ----------
    Wardetzky et al. 2007, sections 2.1 and 2.2.
    """
    from scipy import sparse

    with python_names():
        size, L, M = _core.laplacian(*_arrays(V, F), _name(name, "name"), _name(mass, "mass"))

    def symmetric(row, column, value):
        lower = sparse.coo_matrix((value, (row, column)), shape=(size, size)).tocsr()
        return lower + sparse.tril(lower, -1).T.tocsr()

    return symmetric(*L), symmetric(*M)


def edges(V, F=None):
    """The edges of the triangulated mesh.

    Parameters
    ----------
    V : array_like of shape (n, 3), or Mesh
    F : array_like of shape (m, 3), list of faces, or packed faces; None if `V` is a Mesh

    Returns
    -------
    ndarray of int32, shape (k, 2)
        Vertex numbers, the smaller one first; the rows are sorted.
    """
    return _core.edges(*_arrays(V, F))


def triangles(V, F=None):
    """The triangles that all functions work on.

    Parameters
    ----------
    V : array_like of shape (n, 3), or Mesh
    F : array_like of shape (m, 3), list of faces, or packed faces; None if `V` is a Mesh

    Returns
    -------
    ndarray of int32, shape (t, 3)
        The triangles of `F`, with polygons cut along diagonals that give good angles.
    """
    return _core.triangles(*_arrays(V, F))
