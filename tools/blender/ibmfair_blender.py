"""A Blender add-on of one file: smooths meshes and fills their holes with ibmfair.

The operators "Smooth Fairly" and "Fill Holes Fairly" run `ibmfair.smooth`, `ibmfair.denoise` and
`ibmfair.fill` on the mesh of the active object, in Object Mode and in Edit Mode. In Edit Mode only
selected vertices move, and only holes whose rims are selected are filled; if nothing is selected,
everything that is visible counts as selected. README.md says how to install the add-on.

Only the mesh itself is read and changed, in its own coordinates: modifiers are not applied, and the
object's scale does not matter. The active shape key is what is smoothed, as by Blender's own tools.
"""

import contextlib
import importlib
import math
import sys
import textwrap
import warnings

import bmesh
import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from mathutils.kdtree import KDTree

bl_info = {
    "name": "Fair Meshes (ibmfair)",
    "author": "The ibmfair authors",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Fair; menus Object and Mesh",
    "description": "Removes noise without shrinking, and fills holes so that the surface goes on",
    "category": "Mesh",
}

# Weights in vertex groups that are smaller are left out.
SMALLEST_WEIGHT = 1e-4

# Where the texture coordinates of one vertex differ by more than this, it is on a seam.
SEAM_TOLERANCE = 1e-5

# The layers of a bmesh that hold floating-point numbers, and how many each.
WIDTHS = {"float": 1, "float_vector": 3, "float_color": 4, "color": 4, "uv": 2}


class Failed(Exception):
    """Ends an operator; the message is for the user, and the mesh is as it was before."""


# --------------------------------------------------------------------------------------------------
# The package ibmfair

def chosen_folder(context):
    """The folder in the preferences, or None."""
    addon = context.preferences.addons.get(__name__)
    folder = addon.preferences.folder if addon else ""
    return bpy.path.abspath(folder) if folder else None


def load_package(context):
    """Imports the package ibmfair, from the folder in the preferences if one is given there.

    Raises
    ------
    Failed
        Says how to install the package, or why this Python cannot load it.
    """
    folder = chosen_folder(context)
    if folder:
        sys.path.insert(0, folder)
    importlib.invalidate_caches()
    try:
        return importlib.import_module("ibmfair")
    except ImportError as error:
        if isinstance(error, ModuleNotFoundError) and error.name == "ibmfair":
            raise Failed("The Python package ibmfair is missing: install the Debian package "
                         "python3-ibmfair, or name the folder 'python' of a build of ibmfair in "
                         "the preferences of this add-on") from None
        raise Failed(f"The Python package ibmfair cannot be loaded by Blender's Python "
                     f"{sys.version_info.major}.{sys.version_info.minor}: {error}. It must be "
                     "built for the same version of Python") from None
    finally:
        if folder:
            sys.path.remove(folder)


@contextlib.contextmanager
def progress_of(window_manager):
    """Shows the progress at the cursor; gives the callable that ibmfair calls."""
    window_manager.progress_begin(0, 100)
    try:
        yield lambda stage, share: window_manager.progress_update(int(100 * (share or 0)))
    finally:
        window_manager.progress_end()


# --------------------------------------------------------------------------------------------------
# Arrays from Blender's meshes

def numbers(collection, name, width=1, kind=np.int32):
    """The property `name` of all elements of the collection: (n,), or (n, width)."""
    array = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(name, array)
    return array if width == 1 else array.reshape(-1, width)


def positions(collection):
    """The positions of vertices, or of the points of a shape key: float32 (n, 3)."""
    return numbers(collection, "co", 3, np.float32)


def current_positions(obj):
    """The positions that Edit Mode shows: those of the active shape key, if there are any."""
    key = obj.active_shape_key
    return positions(obj.data.vertices if key is None else key.data)


def faces_of(mesh):
    """The polygons: an array (m, k) where all have k corners, and a list of arrays otherwise."""
    first, count = (numbers(mesh.polygons, name) for name in ("loop_start", "loop_total"))
    corners = numbers(mesh.loops, "vertex_index")
    if (count == count[0]).all():
        return corners[first[:, None] + np.arange(count[0])]
    return [corners[start:start + length] for start, length in zip(first, count)]


def editable_vertices(obj):
    """Flags of the vertices that may change. In Edit Mode these are the selected ones or, if none
    is selected, all visible ones; in Object Mode all."""
    vertices = obj.data.vertices
    if obj.mode != "EDIT":
        return np.ones(len(vertices), bool)
    visible = ~numbers(vertices, "hide", kind=bool)
    selected = numbers(vertices, "select", kind=bool) & visible
    return selected if selected.any() else visible


# --------------------------------------------------------------------------------------------------
# Moving vertices

def dependent_keys(keys, active):
    """The other shape keys that are given relative to the active one, directly, and all."""
    if not keys.use_relative:
        return [], []
    others = [key for key in keys.key_blocks if key != active]
    direct = [key for key in others if key.relative_key == active]
    found, new = list(direct), list(direct)
    while new:
        new = [key for key in others if key.relative_key in new and key not in found]
        found += new
    return direct, found


def move_vertices(obj, old, new):
    """Moves the vertices whose positions differ, float32 (n, 3). Shape keys that are relative to
    the active one keep their offsets from it."""
    moved = np.flatnonzero((old != new).any(axis=1))
    move = new[moved].astype(np.float64) - old[moved]
    if obj.mode == "EDIT":
        move_in_edit_mode(obj, moved, move, new[moved])
        return
    mesh, active = obj.data, obj.active_shape_key
    if active is None or active == mesh.shape_keys.reference_key:
        mesh.vertices.foreach_set("co", new.reshape(-1))
    if active is not None:
        active.data.foreach_set("co", new.reshape(-1))
        for key in dependent_keys(mesh.shape_keys, active)[1]:
            points = positions(key.data)
            points[moved] = points[moved] + move
            key.data.foreach_set("co", points.reshape(-1))
    mesh.update()


def move_in_edit_mode(obj, moved, move, places):
    """The same on the mesh in Edit Mode, of which Blender itself moves the shape keys when it is
    left: up to 3.6 only those that are directly relative to the active one."""
    mesh, active = obj.data, obj.active_shape_key
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    vertices = [bm.verts[index] for index in moved.tolist()]
    for vertex, place in zip(vertices, places.tolist()):
        vertex.co = place
    if active is not None and bpy.app.version < (4, 0, 0):
        direct, found = dependent_keys(mesh.shape_keys, active)
        for key in found:
            if key not in direct:
                layer = bm.verts.layers.shape[key.name]
                for vertex, offset in zip(vertices, move.tolist()):
                    vertex[layer] = [a + b for a, b in zip(vertex[layer], offset)]
    bm.normal_update()
    bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=False)


# --------------------------------------------------------------------------------------------------
# Patches in holes

def triangles_at_edges(T):
    """{(smaller vertex, larger vertex): [rows of T]}."""
    found = {}
    for row, (a, b, c) in enumerate(T.tolist()):
        for edge in ((a, b), (b, c), (c, a)):
            found.setdefault((min(edge), max(edge)), []).append(row)
    return found


def neighbours_of(count, at_edges):
    """For each triangle those with which it shares edges."""
    beside = [[] for _ in range(count)]
    for rows in at_edges.values():
        for row in rows:
            beside[row] += (other for other in rows if other != row)
    return beside


def spread(beside, values):
    """Spreads values over edges: a triangle whose value is None takes that of a nearest one."""
    front = [row for row, value in enumerate(values) if value is not None]
    while front:
        following = []
        for row in front:
            for other in beside[row]:
                if values[other] is None:
                    values[other] = values[row]
                    following.append(other)
        front = following


def components_of(beside):
    """The triangles that are connected by edges: a list of lists of rows."""
    components, seen = [], set()
    for first in range(len(beside)):
        if first in seen:
            continue
        seen.add(first)
        component = [first]
        for row in component:
            new = [other for other in dict.fromkeys(beside[row]) if other not in seen]
            seen.update(new)
            component += new
        components.append(component)
    return components


def extend(P, T, known, values):
    """Extends values at known vertices to all vertices of a patch as harmonic functions.

    Solves sum_j w_ij (u_i - u_j) = 0 at the unknown vertices by conjugate gradients, with the
    weights w_ij = cot a + cot b of Pinkall and Polthier (Computing Discrete Minimal Surfaces and
    Their Conjugates, 1993). Weights that are not positive are raised to a small one, so that no
    value leaves the range of the known ones. Linear functions on a plane are continued exactly
    where the triangles are those of Delaunay.

    Parameters
    ----------
    P : ndarray of shape (n, 3)
        Positions.
    T : ndarray of shape (m, 3)
        Triangles; every vertex is in one of them.
    known : ndarray of bool, shape (n,)
    values : ndarray of shape (n, k)
        The rows of unknown vertices are overwritten.
    """
    a, b, c = T.ravel(), T[:, [1, 2, 0]].ravel(), T[:, [2, 0, 1]].ravel()
    to_a, to_b = P[a] - P[c], P[b] - P[c]
    twice_area = np.linalg.norm(np.cross(to_a, to_b), axis=1)
    cotangent = (to_a * to_b).sum(axis=1) / np.maximum(twice_area, np.finfo(float).tiny)
    edges, at = np.unique(np.sort(np.stack((a, b), axis=1), axis=1), axis=0, return_inverse=True)
    weight = np.clip(np.bincount(at.reshape(-1), cotangent), 1e-3, 1e3)[:, None]
    tail, tip = edges.T
    order = np.argsort(edges.T.ravel(), kind="stable")
    starts = np.searchsorted(edges.T.ravel()[order], np.arange(len(P)))
    free = ~known[:, None]

    def at_vertices(outgoing, incoming):
        return free * np.add.reduceat(np.concatenate((outgoing, incoming))[order], starts)

    def laplacian(u):
        flow = weight * (u[tail] - u[tip])
        return at_vertices(flow, -flow)

    diagonal = np.where(free, at_vertices(weight, weight), 1)
    values[~known] = values[known].mean(axis=0)
    residual = -laplacian(values)
    direction = residual / diagonal
    product = (residual * direction).sum(axis=0)
    enough = 1e-24 * product
    for _ in range(2 * np.count_nonzero(free)):
        if not (product > enough).any():
            break
        image = laplacian(direction)
        curvature = (direction * image).sum(axis=0)
        length = np.divide(product, curvature, out=np.zeros_like(product), where=curvature > 0)
        values += length * direction
        residual -= length * image
        scaled = residual / diagonal
        product, before = (residual * scaled).sum(axis=0), product
        ratio = np.divide(product, before, out=np.zeros_like(product), where=before > 0)
        direction = scaled + ratio * direction
    values[~known] = np.clip(values[~known], values[known].min(axis=0), values[known].max(axis=0))


def float_layers(layers):
    """(layer, kind) of each layer of floating-point numbers."""
    return [(layer, kind) for kind in WIDTHS if hasattr(layers, kind)
            for layer in getattr(layers, kind).values()]


def get_layer(element, layer, kind):
    """The numbers of an element as a list."""
    value = element[layer].uv if kind == "uv" else element[layer]
    return [value] if WIDTHS[kind] == 1 else list(value)


def set_layer(element, layer, kind, value):
    if kind == "uv":
        element[layer].uv = value
    else:
        element[layer] = value[0] if WIDTHS[kind] == 1 else value


class Patch:
    """Triangles in one hole of a bmesh, which take over what is known at the rim.

    Vertex groups, colours, texture coordinates and other floating-point numbers are extended from
    the rim as harmonic functions, and so are the offsets of shape keys from the active one. UV maps
    in which a seam crosses the rim cannot go on: their coordinates are 0 in the patch.

    Parameters
    ----------
    bm : BMesh
    verts : list of BMVert
        The vertices of the patch.
    new : list of int
        Those of them that are new.
    faces : list of BMFace
        The triangles, new faces.
    T : ndarray of shape (m, 3)
        The triangles, as indices in `verts`.
    rim_faces : dict
        For each vertex of the rim the old faces that share its edges of the rim.
    """

    def __init__(self, bm, verts, new, faces, T, rim_faces):
        self.bm, self.verts, self.new, self.faces, self.T = bm, verts, new, faces, T
        self.rim_faces = rim_faces
        self.split_maps = set()

    def take_over(self, P, offsets):
        """P: positions of the vertices; offsets: those of each shape key, zeros at new vertices."""
        known = np.array([row in self.rim_faces for row in range(len(self.verts))])
        columns = [*self.corner_columns()]
        if self.new:
            columns += [*self.vertex_columns(), *self.group_columns(), *self.key_columns(offsets)]
        if not columns:
            return
        values = np.concatenate([block for block, _ in columns], axis=1).astype(np.float64)
        extend(P, self.T, known, values)
        at = 0
        for block, write in columns:
            write(values[:, at:at + block.shape[1]].tolist())
            at += block.shape[1]

    def vertex_columns(self):
        """Yields the known values of a layer (n, k), and a function that writes extended ones."""
        for layer, kind in float_layers(self.bm.verts.layers):
            def write(values, layer=layer, kind=kind):
                for row in self.new:
                    set_layer(self.verts[row], layer, kind, values[row])
            yield np.array([get_layer(vertex, layer, kind) for vertex in self.verts]), write

    def group_columns(self):
        """The same for weights in vertex groups."""
        for layer in self.bm.verts.layers.deform.values():
            groups = sorted({group for row in self.rim_faces
                             for group in self.verts[row][layer].keys()})

            def write(values, layer=layer, groups=groups):
                for row in self.new:
                    weights = self.verts[row][layer]
                    weights.clear()
                    for group, weight in zip(groups, values[row]):
                        if weight > SMALLEST_WEIGHT:
                            weights[group] = weight
            if groups:
                yield np.array([[vertex[layer].get(group, 0.0) for group in groups]
                                for vertex in self.verts]), write

    def key_columns(self, offsets):
        """The same for offsets of shape keys."""
        for layer, offset in zip(self.bm.verts.layers.shape.values(), offsets):
            def write(values, layer=layer):
                for row in self.new:
                    place = self.verts[row].co
                    self.verts[row][layer] = [a + b for a, b in zip(place, values[row])]
            yield offset, write

    def corner_columns(self):
        """The same for values at the corners of faces, of which there is one at each vertex of the
        patch: the mean of those that the rim has there."""
        for layer, kind in float_layers(self.bm.loops.layers):
            block = np.zeros((len(self.verts), WIDTHS[kind]))
            split = False
            for row, faces in self.rim_faces.items():
                corners = [get_layer(loop, layer, kind) for face in faces for loop in face.loops
                           if loop.vert == self.verts[row]]
                block[row] = np.mean(corners, axis=0)
                split |= bool((np.ptp(corners, axis=0) > SEAM_TOLERANCE).any())
            if split and kind == "uv":
                self.split_maps.add(layer.name)
                continue

            def write(values, layer=layer, kind=kind):
                for face, triangle in zip(self.faces, self.T.tolist()):
                    for loop, row in zip(face.loops, triangle):
                        set_layer(loop, layer, kind, values[row])
            yield block, write


def require_new_faces(bm, verts, T):
    """A bmesh cannot hold two faces with the same vertices."""
    seen = set()
    for triangle in T.tolist():
        corners = tuple(sorted(triangle))
        if corners in seen or (corners[-1] < len(verts) and
                               bm.faces.get([verts[index] for index in corners]) is not None):
            raise Failed("A hole cannot be filled: a triangle would cover a face that exists "
                         f"(vertices {', '.join(map(str, corners))})")
        seen.add(corners)


def find_rim(bm, verts, at_edges):
    """{edge: the face of the mesh at this edge} of the edges that patches share with the mesh."""
    rim = {}
    for a, b in at_edges:
        edge = bm.edges.get((verts[a], verts[b])) if b < len(verts) else None
        if edge is not None and edge.link_faces:
            rim[a, b] = edge.link_faces[0]
    return rim


def add_vertices(bm, verts, rim, P):
    """Appends the vertices P[len(verts):] as copies of the nearest vertex of the rim."""
    at_rim = {index for edge in rim for index in edge}
    tree = KDTree(len(at_rim))
    for index in at_rim:
        tree.insert(P[index], index)
    tree.balance()
    layers = [getattr(bm.verts.layers, name, None) for name in ("bevel_weight", "crease")]
    not_copied = [layer for kind in layers if kind is not None for layer in kind.values()]
    for place in P[len(verts):].tolist():
        vertex = bm.verts.new(place, verts[tree.find(place)[1]])
        vertex.hide = False
        for layer in not_copied:
            vertex[layer] = 0.0
        verts.append(vertex)


def add_faces(bm, P, T, old_count, offsets):
    """Adds the triangles T to the bmesh, with the new vertices P[old_count:] at the end. They take
    material, shading and other attributes from the face at the nearest edge of the rim.

    Returns the new faces, and the names of the UV maps that could not go on in all patches.
    """
    bm.verts.ensure_lookup_table()
    verts = [bm.verts[index] for index in range(old_count)]
    require_new_faces(bm, verts, T)
    at_edges = triangles_at_edges(T)
    rim = find_rim(bm, verts, at_edges)
    examples = [None] * len(T)
    for edge, face in rim.items():
        for row in at_edges[edge]:
            examples[row] = face
    beside = neighbours_of(len(T), at_edges)
    spread(beside, examples)
    add_vertices(bm, verts, rim, P)
    faces = []
    for triangle, example in zip(T.tolist(), examples):
        face = bm.faces.new([verts[index] for index in triangle], example)
        face.hide = False
        faces.append(face)
    split_maps = set()
    for rows in components_of(beside):
        indices, corners = np.unique(T[rows], return_inverse=True)
        corners = corners.reshape(-1, 3)
        rim_faces = {}
        for triangle, local in zip(T[rows].tolist(), corners.tolist()):
            for here, there in ((0, 1), (1, 2), (2, 0)):
                a, b = triangle[here], triangle[there]
                face = rim.get((min(a, b), max(a, b)))
                if face is not None:
                    rim_faces.setdefault(local[here], []).append(face)
                    rim_faces.setdefault(local[there], []).append(face)
        new = np.flatnonzero(indices >= old_count).tolist()
        patch = Patch(bm, [verts[index] for index in indices], new, [faces[row] for row in rows],
                      corners, rim_faces)
        patch.take_over(P[indices], [offset[indices] for offset in offsets])
        split_maps |= patch.split_maps
    return faces, sorted(split_maps)


def select_only(bm, faces):
    """Selects these faces and nothing else."""
    for elements in (bm.faces, bm.edges, bm.verts):
        for element in elements:
            element.select = False
    bm.select_history.clear()
    for face in faces:
        face.select = True


def fill_holes(obj, P, T):
    """Adds new vertices, which are the last rows of P, and the triangles T to the mesh, and selects
    the triangles. Returns the names of the UV maps that could not go on in all patches."""
    mesh, active = obj.data, obj.active_shape_key
    old_count = len(mesh.vertices)
    offsets = []
    if active is not None:
        new = np.zeros((len(P) - old_count, 3))
        here = positions(active.data).astype(np.float64)
        offsets = [np.concatenate((positions(key.data) - here, new))
                   for key in mesh.shape_keys.key_blocks]
    if obj.mode == "EDIT":
        bm = bmesh.from_edit_mesh(mesh)
        faces, split_maps = add_faces(bm, P, T, old_count, offsets)
        select_only(bm, faces)
        bm.normal_update()
        bmesh.update_edit_mesh(mesh, loop_triangles=True, destructive=True)
        return split_maps
    bm = bmesh.new()
    try:
        bm.from_mesh(mesh, use_shape_key=True, shape_key_index=obj.active_shape_key_index)
        faces, split_maps = add_faces(bm, P, T, old_count, offsets)
        select_only(bm, faces)
        bm.to_mesh(mesh)
    finally:
        bm.free()
    mesh.update()
    return split_maps


# --------------------------------------------------------------------------------------------------
# Operators

class FairOperator:
    """What the operators share: where they can run, and how they report."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        obj = context.active_object
        if obj is None or obj.type != "MESH":
            reason = "The active object is not a mesh"
        elif obj.mode not in {"OBJECT", "EDIT"}:
            reason = "Only in Object Mode and in Edit Mode"
        elif obj.data.library is not None or obj.data.override_library is not None:
            reason = "The mesh is linked from another file; make it local first"
        elif obj.mode == "OBJECT" and obj.data.is_editmode:
            reason = "Another object with the same mesh is in Edit Mode"
        else:
            return True
        cls.poll_message_set(reason)
        return False

    def execute(self, context):
        self.warned = False
        obj = context.active_object
        if obj.mode == "EDIT":
            obj.update_from_editmode()
        try:
            if not obj.data.polygons:
                raise Failed("The mesh has no faces")
            package = load_package(context)
            with progress_of(context.window_manager) as progress:
                summary = self.change(obj, package, progress)
        except Failed as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        # The status bar shows the last report, which must not hide warnings.
        if summary and not self.warned:
            self.report({"INFO"}, summary)
        return {"FINISHED"} if summary else {"CANCELLED"}

    def warn(self, text):
        self.warned = True
        self.report({"WARNING"}, text)

    def call(self, package, function, *arguments, **options):
        """Calls a function of ibmfair; reports its warnings."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                result = getattr(package, function)(*arguments, **options)
            except (package.Error, ValueError, MemoryError) as error:
                raise Failed(str(error)) from error
        for warning in caught:
            if issubclass(warning.category, package.MeshWarning):
                self.warn(str(warning.message))
        return result

    def draw(self, _context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.draw_options(self.layout, self)


class MESH_OT_ibmfair_smooth(FairOperator, bpy.types.Operator):
    """Calls `ibmfair.smooth`."""

    bl_idname = "mesh.ibmfair_smooth"
    bl_label = "Smooth Fairly"
    bl_description = ("Smooth noise and ripples away without shrinking the mesh. In Edit Mode only "
                      "selected vertices move, or all visible ones if none is selected")

    denoise: BoolProperty(
        name="Denoise",
        description="Estimate the noise of the mesh, remove just that, and keep sharp edges and "
                    "the volume")
    cutoff: FloatProperty(
        name="Cut-Off", default=8, min=0, soft_max=50, step=50, precision=2,
        description="Wavelength up to which ripples are smoothed away, in mean edge lengths")
    twicing: IntProperty(
        name="Twicing", default=0, min=0, soft_max=3,
        description="Smooth the removed part as well and add it back, so many times: bumps keep "
                    "their height, and the cut-off can be longer")
    steps: IntProperty(
        name="Steps", default=0, min=0, soft_max=64,
        description="Number of time steps in which the cut-off is reached; 0 leaves it to ibmfair")
    use_keep_sharp: BoolProperty(
        name="Keep Sharp",
        description="Keep edges sharp at which the surface turns by more than the angle")
    sharp_angle: FloatProperty(
        name="Angle", default=math.radians(30), min=math.radians(1), max=math.radians(180),
        subtype="ANGLE", description="Edges at which the surface turns by more than this are sharp")
    keep_volume: BoolProperty(
        name="Keep Volume", description="Keep the volume of a closed mesh exactly")
    boundary: EnumProperty(
        name="Boundary", default="AUTO",
        items=(("AUTO", "Automatic", "Fair with Denoise, and fixed otherwise"),
               ("FIXED", "Fixed", "Open boundaries and the next ring of vertices do not move"),
               ("POSITION", "Position", "Open boundaries do not move"),
               ("FREE", "Free", "Open boundaries move with the surface"),
               ("FAIR", "Fair", "Open boundaries are smoothed as curves first; corners stay")),
        description="What happens to open boundaries")
    max_move: FloatProperty(
        name="Max Move", default=0, min=0, subtype="DISTANCE",
        description="Move no vertex further than this, in the mesh's own units, without the scale "
                    "of the object; 0 is no limit")

    def keywords(self):
        """The keywords of `ibmfair.smooth`."""
        options = {}
        if self.denoise:
            options["denoise"] = True
        else:
            options.update(cutoff=round(self.cutoff, 6), twicing=self.twicing,
                           keep_volume=self.keep_volume)
            if self.steps > 0:
                options["steps"] = self.steps
            if self.use_keep_sharp:
                options["keep_sharp"] = round(math.degrees(self.sharp_angle), 4)
        if self.boundary != "AUTO":
            options["boundary"] = self.boundary.lower()
        if self.max_move > 0:
            options["max_move"] = self.max_move
        return options

    def change(self, obj, package, progress):
        old = current_positions(obj)
        moves = editable_vertices(obj)
        options = self.keywords()
        if not moves.all():
            options["mask"] = moves
        V, _ = self.call(package, "smooth", old, faces_of(obj.data), progress=progress, **options)
        new = V.astype(np.float32)
        moved = np.linalg.norm(new - old, axis=1)
        if not moved.any():
            if not self.warned:
                self.report({"INFO"}, "No noise was found" if self.denoise else "No vertex moved")
            return None
        move_vertices(obj, old, new)
        return f"Smoothed: {np.count_nonzero(moved)} vertices moved, by {moved.max():.3g} at most"

    @staticmethod
    def draw_options(layout, options):
        layout.prop(options, "denoise")
        column = layout.column()
        column.active = not options.denoise
        for name in ("cutoff", "twicing", "steps", "use_keep_sharp"):
            column.prop(options, name)
        angle = column.column()
        angle.active = options.use_keep_sharp
        angle.prop(options, "sharp_angle")
        column.prop(options, "keep_volume")
        layout.prop(options, "boundary")
        layout.prop(options, "max_move")


class MESH_OT_ibmfair_fill(FairOperator, bpy.types.Operator):
    """Calls `ibmfair.fill`."""

    bl_idname = "mesh.ibmfair_fill"
    bl_label = "Fill Holes Fairly"
    bl_description = ("Fill holes with patches that continue the surface, and select the patches. "
                      "In Edit Mode only holes whose rims are selected are filled, or all if "
                      "nothing is selected")

    holes: EnumProperty(
        name="Holes", default="SELECTED",
        items=(("SELECTED", "Selected", "Holes whose rims are selected in Edit Mode; all holes in "
                                        "Object Mode, and if no vertex is selected"),
               ("ALL", "All", "All holes without hidden vertices at their rims")),
        description="Which holes are filled")
    outer_borders: BoolProperty(
        name="Outer Borders",
        description="Also fill the outer borders of open sheets. A border that is selected is "
                    "filled in any case")
    max_edges: IntProperty(
        name="Max Edges", default=0, min=0,
        description="Leave holes open that have more edges than this; 0 is no limit")
    edge_length: FloatProperty(
        name="Edge Length", default=0, min=0, subtype="DISTANCE",
        description="Edge length inside the patches, in the mesh's own units, without the scale of "
                    "the object; 0 is the edge length along the rim")
    continuity: EnumProperty(
        name="Continuity", default="2",
        items=(("2", "Curvature", "The patch in a sphere is a part of the sphere"),
               ("1", "Tangents", "No crease between patch and mesh"),
               ("0", "Positions", "A soap film: a flat lid on a flat rim")),
        description="What the patches continue at their rims")
    keep_sharp: EnumProperty(
        name="Keep Sharp", default="NONE",
        items=(("NONE", "None", "Patches are smooth"),
               ("AUTO", "Automatic", "Sharp edges that end at a hole go on; the angle is found in "
                                     "the mesh"),
               ("ANGLE", "By Angle", "Edges that are sharper than the angle go on")),
        description="Continue sharp edges that end at a hole; with Curvature only")
    sharp_angle: FloatProperty(
        name="Angle", default=math.radians(30), min=math.radians(1), max=math.radians(180),
        subtype="ANGLE", description="Edges at which the surface turns by more than this are sharp")

    def keywords(self):
        """The keywords of `ibmfair.fill`."""
        options = {"continuity": self.continuity}
        if self.max_edges > 0:
            options["max_edges"] = self.max_edges
        if self.edge_length > 0:
            options["edge_length"] = self.edge_length
        if self.continuity == "2" and self.keep_sharp != "NONE":
            options["keep_sharp"] = ("auto" if self.keep_sharp == "AUTO" else
                                     round(math.degrees(self.sharp_angle), 4))
        return options

    def chosen(self, obj, holes):
        """The ids of the holes to fill."""
        selected = editable_vertices(obj)
        visible = (np.ones_like(selected) if obj.mode != "EDIT" else
                   ~numbers(obj.data.vertices, "hide", kind=bool))
        by_selection = self.holes == "SELECTED" and (selected != visible).any()
        allowed = selected if by_selection else visible
        ids = [hole["id"] for hole in holes if allowed[hole["vertices"]].all() and
               (by_selection or self.outer_borders or not hole["outer_border"])]
        if not ids:
            if not holes:
                raise Failed("The mesh has no holes")
            if by_selection:
                raise Failed("No hole has a rim whose vertices are all selected")
            if all(hole["outer_border"] for hole in holes):
                raise Failed("All boundaries are outer borders of open sheets; turn on Outer "
                             "Borders to fill them")
            raise Failed("All holes are outer borders or have hidden vertices at their rims")
        return ids

    def change(self, obj, package, progress):
        P, F = current_positions(obj), faces_of(obj.data)
        ids = self.chosen(obj, self.call(package, "holes", P, F))
        V, F2, info = self.call(package, "fill", P, F, holes=ids, progress=progress,
                                **self.keywords())
        for hole in info["holes"]:
            if hole["status"] == "failed":
                self.warn(f"A hole of {hole['edges']} edges stays open: {hole['reason']}")
        T = np.array(F2[len(F):], dtype=np.int64).reshape(-1, 3)
        if not len(T):
            return None
        split_maps = fill_holes(obj, V, T)
        if split_maps:
            self.warn("Seams cross the rims of holes, so that patches have no texture coordinates "
                      f"in these UV maps: {', '.join(split_maps)}. Unwrap the patches")
        filled = sum(hole["new_triangles"] > 0 for hole in info["holes"])
        return f"Filled: {filled} holes with {len(T)} triangles, {len(V) - len(P)} new vertices"

    @staticmethod
    def draw_options(layout, options):
        for name in ("holes", "outer_borders", "max_edges", "edge_length", "continuity"):
            layout.prop(options, name)
        column = layout.column()
        column.active = options.continuity == "2"
        column.prop(options, "keep_sharp")
        angle = column.column()
        angle.active = options.keep_sharp == "ANGLE"
        angle.prop(options, "sharp_angle")


# --------------------------------------------------------------------------------------------------
# Panels, menus, preferences

class FairPanel:
    """A panel in the sidebar: the button of an operator, and the options it will run with."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fair"

    @classmethod
    def poll(cls, context):
        return context.mode in {"OBJECT", "EDIT_MESH"}

    def draw(self, context):
        layout = self.layout
        layout.operator(self.operator.bl_idname)
        layout.use_property_split = True
        layout.use_property_decorate = False
        self.operator.draw_options(
            layout, context.window_manager.operator_properties_last(self.operator.bl_idname))


class VIEW3D_PT_ibmfair_smooth(FairPanel, bpy.types.Panel):
    bl_label = "Smooth"
    operator = MESH_OT_ibmfair_smooth


class VIEW3D_PT_ibmfair_fill(FairPanel, bpy.types.Panel):
    bl_label = "Fill Holes"
    operator = MESH_OT_ibmfair_fill


class FairPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    folder: StringProperty(
        name="Folder of ibmfair", subtype="DIR_PATH",
        description="The folder that holds the Python package ibmfair, such as build/python; empty "
                    "if the package is installed. A package that is loaded already stays until "
                    "Blender is started again")

    def draw(self, context):
        self.layout.prop(self, "folder")
        try:
            package = load_package(context)
        except Failed as failure:
            column = self.layout.column(align=True)
            for row, line in enumerate(textwrap.wrap(str(failure), 80)):
                column.label(text=line, icon="BLANK1" if row else "ERROR")
        else:
            self.layout.label(text=f"ibmfair {package.__version__} in {package.__path__[0]}")


def draw_menu(self, _context):
    self.layout.separator()
    for operator in (MESH_OT_ibmfair_smooth, MESH_OT_ibmfair_fill):
        self.layout.operator(operator.bl_idname)


CLASSES = (FairPreferences, MESH_OT_ibmfair_smooth, MESH_OT_ibmfair_fill, VIEW3D_PT_ibmfair_smooth,
           VIEW3D_PT_ibmfair_fill)
MENUS = ("VIEW3D_MT_object", "VIEW3D_MT_edit_mesh")


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for menu in MENUS:
        getattr(bpy.types, menu).append(draw_menu)


def unregister():
    for menu in MENUS:
        getattr(bpy.types, menu).remove(draw_menu)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)


if __name__ == "__main__":
    register()
