"""Fairs triangle meshes by discrete Willmore flow: the functions of the program ibmfair on arrays.

A mesh is a pair of arrays, `V` (n, 3) of positions and `F` (m, 3) of vertex numbers counted from 0;
polygons may also come as a list of faces or in VTK's packed form. Functions have no state and never
change their arguments. Lengths are given as on the command line: a number or "6e" in mean edge
lengths where that is the unit of the option, "2%" of the diagonal, "0.4u" in the unit of the mesh.

>>> import ibmfair
>>> V2, info = ibmfair.denoise(V, F)
>>> V2, info = ibmfair.smooth(V, F, cutoff=6, twicing=1)
>>> V2, F2, info = ibmfair.fill(V, F)

Each `info` is a dict by the schema of the program's reports (data/report.schema.json). Warnings go
through `warnings` as `MeshWarning`, remarks to the logger "ibmfair".
"""

from . import _core
from ._commands import compare, denoise, fill, holes, info, make, smooth
from ._energies import edges, energy, laplacian, triangles
from ._files import Mesh, read, write
from ._flow import Flow, StepRecord
from .errors import (BadFile, BadMesh, BadOption, CannotWrite, Error, FactorizationFailed,
                     MeshWarning, NotReached, OutOfMemory)

__version__ = _core.version
__all__ = [
    "BadFile", "BadMesh", "BadOption", "CannotWrite", "Error", "FactorizationFailed", "Flow", "Mesh",
    "MeshWarning", "NotReached", "OutOfMemory", "StepRecord", "compare", "denoise", "edges",
    "energy", "fill", "holes", "info", "laplacian", "make", "read", "smooth", "triangles", "write"]
