"""The commands of the program as functions on arrays."""

import numpy as np

from ._options import documented
from ._run import Input, interrupt, run
from .errors import NotReached


def _positions(result, mesh):
    """The positions of all vertices of the input; merged vertices share one."""
    if result["V"] is None:
        return mesh.V.copy()
    merged = result["merged"]
    return result["V"][merged] if len(merged) > 0 else result["V"]


def _require_mesh(result):
    if result["V"] is None:
        raise NotReached("; ".join(result["warnings"]) or "no mesh was made")


def _smooth(function, V, F, options, progress):
    mesh = Input(V, F)
    result = run(function, "smooth", [mesh], options, progress, arguments=[""])
    positions = _positions(result, mesh)
    if result["error"] is not None:
        interrupt(result, positions, result["info"])
    return positions, result["info"]


@documented("smooth")
def smooth(V, F=None, *, progress=None, **options):
    """Removes noise and ripples without shrinking the shape.

    Parameters
    ----------
    {mesh}
    progress : callable, optional
        Called with the stage (str) and its share that is done (float in 0 to 1, or None), at most
        twenty times a second. An exception that it raises ends the run after the step.
    {options}

    Returns
    -------
    V2 : ndarray of shape (n, 3)
        The positions after smoothing.
    info : dict
        The report: energies, moves, volume, steps, times and warnings.

    Raises
    ------
    ValueError
        For arrays of a wrong shape, and numbers that are not finite.
    BadOption, BadMesh, FactorizationFailed, OutOfMemory
    KeyboardInterrupt
        After Ctrl-C, at the end of the step; its attributes `V` and `info` hold the state reached.

    Warns
    -----
    MeshWarning
        About defects of the mesh, changes of volume and thickness, and runs that ended early.

    References
    ----------
    Wardetzky, Bergou, Harmon, Zorin, Grinspun: Discrete Quadratic Curvature Energies, 2007.
    """
    return _smooth("smooth", V, F, options, progress)


@documented("smooth", without=("denoise",))
def denoise(V, F=None, *, progress=None, **options):
    """Removes noise of any strength and keeps sharp edges: `smooth` with ``denoise=True``.

    Parameters
    ----------
    {mesh}
    progress : callable, optional
        As for `smooth`.
    {options}

    Returns
    -------
    V2 : ndarray of shape (n, 3)
        The positions without noise.
    info : dict
        The report; ``info["cutoff_choice"]`` tells the kind and the strength of the noise.

    See Also
    --------
    smooth : what is raised and warned.
    """
    return _smooth("denoise", V, F, {"denoise": True, **options}, progress)


@documented("fill")
def fill(V, F=None, *, holes=None, progress=None, **options):
    """Closes holes with patches that continue the surface.

    Parameters
    ----------
    {mesh}
    holes : sequence of int, optional
        The holes to fill, by the numbers that `ibmfair.holes` gives; the same as `only`.
    progress : callable, optional
        As for `smooth`.
    {options}

    Returns
    -------
    V2 : ndarray of shape (n + new, 3)
        The vertices of the input, unmoved, followed by those of the patches.
    F2 : ndarray or list
        The faces of the input followed by the triangles of the patches, in the form of `F`.
    info : dict
        The report: each hole with its patch, and warnings.

    Raises
    ------
    NotReached
        With `strict`, if a hole could not be filled as asked.
    ValueError, BadOption, BadMesh, OutOfMemory, KeyboardInterrupt
        As for `smooth`; Ctrl-C ends between two holes.

    Warns
    -----
    MeshWarning
        About defects of the mesh, and holes that could not be filled as asked.
    """
    if holes is not None:
        if options.get("only") is not None:
            raise TypeError("holes and only mean the same; give one of them")
        options["only"] = holes
    mesh = Input(V, F)
    result = run("fill", "fill", [mesh], options, progress, arguments=[""])
    if result["error"] is not None:
        interrupt(result, mesh.V.copy(), result["info"])
    _require_mesh(result)
    faces = result["F"] or (mesh.faces.first, mesh.faces.corner)
    return result["V"], mesh.faces.like(faces), result["info"]


@documented("holes")
def holes(V, F=None, **options):
    """Lists the holes: the loops of boundary edges.

    Parameters
    ----------
    {mesh}
    {options}

    Returns
    -------
    list of dict
        For each hole its `id`, number of `edges`, `perimeter`, `diameter`, `kind`, `vertices`, ...
    """
    result = run("holes", "holes", [Input(V, F)], options, arguments=["--json"])
    return result["info"]["holes"]


@documented("info")
def info(V, F=None, **options):
    """Measures a mesh: counts, defects, lengths, area, volume, energies.

    Parameters
    ----------
    {mesh}
    {options}

    Returns
    -------
    dict
        The report of `ibmfair info`.
    """
    return run("info", "info", [Input(V, F)], options, arguments=["--json"])["info"]


@documented("make")
def make(shape, **options):
    """Makes a test shape whose exact values are known.

    Parameters
    ----------
    shape : str
        The name of the shape, as 'icosphere', 'torus', 'cube'; `ibmfair help make` lists them.
    {options}

    Returns
    -------
    V : ndarray of shape (n, 3)
    F : ndarray of shape (m, 3)
    """
    result = run("make", "make", [], options, arguments=[str(shape), ""])
    first, corner = result["F"]
    return result["V"], corner.reshape(len(first) - 1, -1)


@documented("compare")
def compare(V, F, V2=None, F2=None, **options):
    """Measures the distances between two meshes, or between a mesh and an exact sphere or torus.

    Parameters
    ----------
    V : array_like of shape (n, 3)
        Positions of the first mesh.
    F : array_like of shape (m, 3), list of faces, or packed faces
        Faces of the first mesh.
    V2, F2 : array_like, optional
        The second mesh; None for `F2` means the faces of the first.
    {options}

    Returns
    -------
    dict
        Distances (length) from vertex to vertex and from surface to surface, angles between normals
        (degrees), ratios of area and volume.
    """
    first = Input(V, F)
    meshes = [first]
    if V2 is not None:
        meshes.append(Input(V2, F if F2 is None else F2, "other"))
    return run("compare", "compare", meshes, options, arguments=["--json"])["info"]
