"""Arrays of vertices and faces, checked, in the form that the extension module takes."""

import numpy as np

MANY_CORNERS = 32  # of polygons in an array of three or four rows: rather a transposed array


def _array(values, name, what):
    """The values as an array; ValueError with `what` they should be if they cannot become one."""
    try:
        array = np.asarray(values)
    except (TypeError, ValueError, RuntimeError) as error:
        raise ValueError(f"{name} must be {what}: {error}") from None
    if np.ma.is_masked(values):
        raise ValueError(f"{name} has masked entries")
    return array


def _numbers(values, name, what):
    """The values as a C-contiguous float64 array; a copy only where one is needed."""
    array = _array(values, name, what)
    if array.dtype.kind not in "fiub":
        raise ValueError(f"{name} must be {what}, not {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def vertices(V, name="V"):
    """Returns `V` as a C-contiguous float64 array (n, 3); a copy only where one is needed."""
    array = _numbers(V, name, "an array of numbers of shape (n, 3)")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have the shape (n, 3), not {array.shape}")
    if len(array) == 0:
        raise ValueError(f"{name} has no rows")
    finite = np.isfinite(array)
    if not finite.all():
        row = int(np.flatnonzero(~finite.all(axis=1))[0])
        raise ValueError(f"{name}: row {row} is not finite: {array[row].tolist()}")
    return array


class Faces:
    """Faces in any of the forms that callers use, and the way back to that form.

    `first` (int64) and `corner` (int32): face f has the corners first[f] .. first[f + 1] - 1.
    """

    def __init__(self, F, vertex_count, name="F"):
        self._dtype = np.dtype(np.int64)
        self._form = "list"
        corner, self.first = self._read(F, name)
        if len(self.first) < 2:
            raise ValueError(f"{name} has no faces")
        wrong = (corner < 0) | (corner >= vertex_count)
        if wrong.any():
            at = int(np.flatnonzero(wrong)[0])
            face = int(np.searchsorted(self.first, at, side="right")) - 1
            raise ValueError(f"{name}: face {face} names vertex {int(corner[at])}, but the vertices "
                             f"are 0 to {vertex_count - 1}")
        self.corner = np.ascontiguousarray(corner, dtype=np.int32)

    def _read(self, F, name):
        try:
            array = np.asarray(F)
        except ValueError:  # rows of different lengths
            return self._read_rows(F, name)
        except (TypeError, RuntimeError) as error:
            raise ValueError(f"{name} must be an array (m, 3) or a list of faces: {error}") from None
        if np.ma.is_masked(F):
            raise ValueError(f"{name} has masked entries")
        if array.dtype == object and array.ndim < 2:
            return self._read_rows(F, name)
        if array.size == 0:
            return np.empty(0, np.int64), np.zeros(1, np.int64)
        if array.dtype.kind not in "iu":
            if array.dtype.kind != "f" or not (np.abs(array) < 2**31).all() \
                    or not (array == np.floor(array)).all():
                raise ValueError(f"{name} must hold vertex numbers, which are integers, not "
                                 f"{array.dtype}")
            array = array.astype(np.int64)
        if array.ndim == 1:
            return self._read_packed(array, name)
        if array.ndim != 2 or array.shape[1] < 3:
            raise ValueError(f"{name} must have the shape (m, 3), or (m, k) for polygons, not "
                             f"{array.shape}")
        count, corners = array.shape
        if count in (3, 4) and corners > MANY_CORNERS:
            raise ValueError(f"{name} has the shape {array.shape}, and must have (m, 3): it seems to "
                             "be transposed")
        if corners > 3 and count > corners and (array[:, 0] == corners - 1).all():
            raise ValueError(f"{name} seems to be packed, with the number of corners in the first "
                             "column; give it flat, as (number of corners, corners, ...)")
        if not isinstance(F, (list, tuple)):
            self._form = "array"
            self._dtype = array.dtype
        return array.reshape(-1), np.arange(0, count * corners + 1, corners, dtype=np.int64)

    def _read_rows(self, F, name):
        try:
            rows = [np.asarray(row) for row in F]
            lengths = np.array([len(row) for row in rows], dtype=np.int64)
        except (TypeError, ValueError):
            raise ValueError(f"{name} must be an array (m, 3) or a list of faces") from None
        for face, row in enumerate(rows):
            if row.ndim != 1 or len(row) < 3 or row.dtype.kind not in "iu":
                raise ValueError(f"{name}: face {face} must be three or more vertex numbers, which "
                                 f"are integers, not {row.tolist()!r} ({row.dtype})")
        corner = np.concatenate(rows) if rows else np.empty(0, np.int64)
        return corner, np.concatenate(([0], np.cumsum(lengths)))

    def _read_packed(self, packed, name):
        """The form of VTK: the number of corners of each face, followed by them."""
        self._form = "packed"
        self._dtype = packed.dtype
        starts = []
        at = 0
        while at < len(packed):
            count = int(packed[at])
            if count < 3 or at + 1 + count > len(packed):
                raise ValueError(f"{name}: packed faces are (number of corners, corners...) one after "
                                 f"the other, but entry {at} is {count}")
            starts.append(at)
            at += 1 + count
        counts_at = np.array(starts, dtype=np.int64)
        corner = np.delete(packed, counts_at)
        return corner, np.concatenate(([0], np.cumsum(packed[counts_at].astype(np.int64))))

    def like(self, faces):
        """Faces of the extension module, (first, corner), in the form that the caller used; in a
        wider type where the caller's has no room for new vertices."""
        first, corner = faces
        counts = np.diff(first)
        room = np.iinfo(self._dtype).max >= max(corner.max(), counts.max())
        kind = self._dtype if room else np.dtype(np.int64)
        if self._form == "packed":
            return np.insert(corner.astype(np.int64), first[:-1], counts).astype(kind)
        if self._form == "array" and (counts == counts[0]).all():
            return corner.reshape(-1, counts[0]).astype(kind)
        return [row.tolist() for row in np.split(corner, first[1:-1])]


def per_vertex(values, vertex_count, name):
    """Numbers at the vertices as a float64 array (n,); a single number stands for all."""
    array = _numbers(values, name, "an array of numbers")
    if np.ndim(values) == 0:
        array = np.full(vertex_count, array.item())
    if array.shape != (vertex_count,):
        raise ValueError(f"{name} must have one number for each of the {vertex_count} vertices, not "
                         f"the shape {array.shape}")
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: entry {int(np.flatnonzero(~np.isfinite(array))[0])} is not finite")
    return array


def vertex_set(chosen, vertex_count, name):
    """Vertices, given as flags (n,) or as numbers, as a bool array (n,)."""
    what = "flags (n,) or vertex numbers"
    array = _array(chosen, name, what)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.ndim != 1 or array.dtype.kind not in "biuf":
        raise ValueError(f"{name} must be {what}, not {array.dtype} of shape {array.shape}")
    # A list of so many vertex numbers that are all 0 or 1 would be nonsense.
    if len(array) == vertex_count and ((array == 0) | (array == 1)).all():
        return array.astype(bool)
    if array.dtype == bool:
        raise ValueError(f"{name} must have one flag for each of the {vertex_count} vertices, not "
                         f"the shape {array.shape}")
    if array.dtype.kind == "f":
        raise ValueError(f"{name} must be {what}; numbers other than 0 and 1 must be integers")
    if len(array) > 0 and (array.min() < 0 or array.max() >= vertex_count):
        raise ValueError(f"{name}: the vertices are 0 to {vertex_count - 1}")
    flags = np.zeros(vertex_count, dtype=bool)
    flags[array] = True
    return flags
