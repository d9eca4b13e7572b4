"""The commands of the program as functions on arrays."""

import numpy as np

from ._files import Mesh
from ._options import documented, in_python
from ._run import Input, interrupt, run
from .errors import NotReached


def _positions(result, mesh):
    """The positions of all vertices of the input; merged vertices share one."""
    if result["V"] is None:
        return mesh.V.copy()
    merged = result["merged"]
    return result["V"][merged] if len(merged) > 0 else result["V"]


def _name(value, name):
    if not isinstance(value, str):
        raise TypeError(f"{name} must be a string, not {value!r}")
    return value


def _require_mesh(result):
    if result["V"] is None:
        raise NotReached(in_python("; ".join(result["warnings"]) or "no mesh was made"))


def _smooth(function, V, F, options, progress, given=()):
    mesh = Input(V, F)
    result = run(function, "smooth", [mesh], options, progress, [""], given)
    positions = _positions(result, mesh)
    if result["error"] is not None:
        interrupt(result, positions)
    return positions, result["info"]


def _with_ids(options):
    """The options of fill with the holes in `only` as numbers; no hole at all if it is empty."""
    only = options.get("only")
    if only is None or isinstance(only, (str, int, np.integer)):
        return options
    ids = [hole["id"] if isinstance(hole, dict) else hole for hole in only]
    if ids:
        return {**options, "only": ids}
    return {**options, "only": None, "max_edges": 1}  # no hole has so few


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
        After Ctrl-C, at the end of the step. While the flow runs, its attributes `V` and `info` hold
        the state reached; both are None if no step was complete.

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
        ``info["outliers"]``, if there are any, lists the vertices far off the surface of their
        neighbours, which were moved onto it first.

    See Also
    --------
    smooth : what is raised and warned.
    """
    return _smooth("denoise", V, F, options, progress, given=("denoise",))


@documented("fill")
def fill(V, F=None, *, holes=None, progress=None, **options):
    """Closes holes with patches that continue the surface.

    Parameters
    ----------
    {mesh}
    holes : sequence, optional
        The holes to fill: their numbers, or entries of what `ibmfair.holes` gives; the same as `only`.
    progress : callable, optional
        As for `smooth`.
    {options}

    Returns
    -------
    V2 : ndarray of shape (n + new, 3)
        The vertices of the input, followed by those of the patches. The former stay where they are,
        unless `region` or `rim_smooth` is given.
    F2 : ndarray or list
        The faces of the input followed by the triangles of the patches, in the form of `F`.
    info : dict
        The report: each hole with its patch, and warnings.

    Raises
    ------
    NotReached
        With `strict`, if a hole could not be filled as asked.
    ValueError, BadOption, BadMesh, OutOfMemory, KeyboardInterrupt
        As for `smooth`; Ctrl-C ends between two holes, without a result.

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
    result = run("fill", "fill", [mesh], _with_ids(options), progress, [""])
    if result["error"] is not None:
        interrupt(result, None)
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
    result = run("holes", "holes", [Input(V, F)], options)
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
    return run("info", "info", [Input(V, F)], options)["info"]


@documented("make")
def make(shape, **options):
    """Makes a test shape whose exact values are known.

    Parameters
    ----------
    shape : str
        The name of the shape, as 'icosphere', 'torus', 'cube'; the error for an unknown name lists
        all.
    {options}

    Returns
    -------
    V : ndarray of shape (n, 3)
    F : ndarray of shape (m, 3)
    """
    result = run("make", "make", [], options, arguments=[_name(shape, "shape"), ""])
    first, corner = result["F"]
    return result["V"], corner.reshape(len(first) - 1, -1)


@documented("compare")
def compare(V, F=None, V2=None, F2=None, **options):
    """Measures the distances between two meshes, or between a mesh and an exact sphere or torus.

    Parameters
    ----------
    {mesh}
    V2, F2 : array_like, or Mesh, optional
        The second mesh; None for `F2` means the faces of the first. Two of type Mesh may also follow
        each other.
    {options}

    Returns
    -------
    dict
        Distances (length) from vertex to vertex and from surface to surface, angles between normals
        (degrees), ratios of area and volume.
    """
    if isinstance(F, Mesh) and V2 is None:
        V2, F = F, None
    meshes = [Input(V, F)]
    if V2 is not None:
        if F2 is None and not isinstance(V2, Mesh):
            F2 = V.F if isinstance(V, Mesh) else F
        meshes.append(Input(V2, F2, "other"))
    return run("compare", "compare", meshes, options)["info"]
