"""Bending energies, their gradients, and the matrices that they are made of."""

import numpy as np

from . import _core
from ._arrays import Faces, per_vertex, vertices
from ._options import python_names


def energy(V, F, laplacian="crouzeix-raviart", *, mass=None, h0=None, gradient=False):
    """The discrete bending energy E_b = 1/2 tr(X^T L^T M^-1 L X) of a mesh.

    Parameters
    ----------
    V : array_like of shape (n, 3)
    F : array_like of shape (m, 3), list of faces, or packed faces
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
        Not negative; dimensionless with a mass matrix, length^2 without. NaN or infinite if a
        triangle has no area.
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
    V = vertices(V)
    faces = Faces(F, len(V))
    curvature = np.empty(0)
    if h0 is not None:
        curvature = per_vertex(np.broadcast_to(h0, len(V)) if np.ndim(h0) == 0 else h0, len(V), "h0")
    with python_names():
        E, G = _core.energy(V, faces.first, faces.corner, laplacian, mass or "", curvature, gradient)
    return (E, G) if gradient else E


def laplacian(V, F, name="lagrange", *, mass=None):
    """The Laplacian and the mass matrix of a member of the family.

    Parameters
    ----------
    V : array_like of shape (n, 3)
    F : array_like of shape (m, 3), list of faces, or packed faces
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

    V = vertices(V)
    faces = Faces(F, len(V))
    with python_names():
        size, L, M = _core.laplacian(V, faces.first, faces.corner, name, mass or "")

    def symmetric(row, column, value):
        lower = sparse.coo_matrix((value, (row, column)), shape=(size, size)).tocsr()
        return lower + sparse.tril(lower, -1).T.tocsr()

    return symmetric(*L), symmetric(*M)


def edges(V, F):
    """The edges of the triangulated mesh as vertex numbers (k, 2), the smaller one first, sorted."""
    V = vertices(V)
    faces = Faces(F, len(V))
    return _core.edges(V, faces.first, faces.corner)


def triangles(V, F):
    """The triangles (t, 3) that the functions work on: those of `F`, with polygons cut along
    diagonals that give good angles."""
    V = vertices(V)
    faces = Faces(F, len(V))
    return _core.triangles(V, faces.first, faces.corner)
