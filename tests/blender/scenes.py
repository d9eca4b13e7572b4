"""Meshes in Blender, what they hold, and the base of the tests of the add-on. Runs in Blender."""

import contextlib
import os
import sys
import tempfile
import unittest

import bmesh
import bpy
import numpy as np

MODULE = "ibmfair_blender"


def array(collection, name, width, kind="float32"):
    values = np.empty(len(collection) * width, dtype=kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width)


def coordinates(collection):
    return array(collection, "co", 3)


def set_coordinates(collection, places):
    collection.foreach_set("co", np.ascontiguousarray(places, np.float32).reshape(-1))


def faces(mesh):
    return [list(polygon.vertices) for polygon in mesh.polygons]


def add_noise(mesh, amount, seed=1):
    places = coordinates(mesh.vertices)
    noise = np.random.default_rng(seed).standard_normal(places.shape)
    set_coordinates(mesh.vertices, places + amount * noise)


def icosphere(noise=0.0, subdivisions=4):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    obj = bpy.context.active_object
    add_noise(obj.data, noise)
    return obj


def grid(count=12):
    """A square of 2 x 2 in the plane z = 0, of quads, with one UV island."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=count, y_subdivisions=count)
    return bpy.context.active_object


def delete_faces(obj, chosen):
    """Deletes the faces for whose centre chosen(x, y, z) is true, with what becomes loose."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    gone = [face for face in bm.faces if chosen(*face.calc_center_median())]
    bmesh.ops.delete(bm, geom=gone, context="FACES")
    bm.to_mesh(obj.data)
    bm.free()


def add_loose(obj):
    """Adds a loose vertex and a loose edge in front of all other vertices."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    loose = [bm.verts.new(place) for place in ((3, 0, 0), (3, 1, 0), (3, 2, 0))]
    bm.edges.new(loose[1:])
    bm.verts.index_update()
    for vertex in bm.verts:
        vertex.index = (vertex.index - len(bm.verts) + 3) % len(bm.verts)
    bm.verts.sort()
    bm.to_mesh(obj.data)
    bm.free()


def decorate(obj):
    """Gives the mesh everything that Blender can store with it."""
    mesh = obj.data
    rng = np.random.default_rng(3)
    for name in ("red", "blue"):
        mesh.materials.append(bpy.data.materials.new(name))
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons)))
    mesh.polygons.foreach_set("use_smooth", rng.integers(0, 2, len(mesh.polygons)) > 0)
    for name in ("one", "two"):
        layer = mesh.uv_layers.new(name=name)
        layer.data.foreach_set("uv", rng.random(2 * len(mesh.loops)).astype(np.float32))
        group = obj.vertex_groups.new(name=name)
        for vertex in range(0, len(mesh.vertices), 3):
            group.add([vertex], rng.random(), "REPLACE")
    for kind, domain, width in (("FLOAT_COLOR", "POINT", 4), ("BYTE_COLOR", "CORNER", 4)):
        colours = mesh.color_attributes.new(kind, kind, domain)
        colours.data.foreach_set("color", rng.random(width * len(colours.data)).astype(np.float32))
    for kind, domain in (("INT", "FACE"), ("FLOAT", "POINT"), ("BOOLEAN", "EDGE")):
        values = mesh.attributes.new(kind, kind, domain).data
        values.foreach_set("value", rng.integers(0, 2, len(values)))
    for name in ("use_edge_sharp", "use_seam"):
        mesh.edges.foreach_set(name, rng.integers(0, 5, len(mesh.edges)) == 0)
    for name in ("crease", "bevel_weight"):
        mesh.edges.foreach_set(name, rng.random(len(mesh.edges)).astype(np.float32))
    mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices([(0, 0, 1)] * len(mesh.vertices))
    obj.modifiers.new("Subdivision", "SUBSURF")


def add_keys(obj):
    """Basis, A relative to it, B relative to A, and C relative to the basis."""
    rng = np.random.default_rng(5)
    keys = [obj.shape_key_add(name=name, from_mix=False) for name in ("Basis", "A", "B", "C")]
    keys[2].relative_key = keys[1]
    for key in keys[1:]:
        places = coordinates(key.data)
        set_coordinates(key.data, places + 0.1 * rng.standard_normal(places.shape))
    return keys


VALUES = {"FLOAT": ("value", 1, np.float32), "INT": ("value", 1, np.int32),
          "BOOLEAN": ("value", 1, bool), "FLOAT_VECTOR": ("vector", 3, np.float32),
          "FLOAT_COLOR": ("color", 4, np.float32), "BYTE_COLOR": ("color", 4, np.float32),
          "FLOAT2": ("vector", 2, np.float32)} if bpy else {}
SELECTION = (".select_vert", ".select_edge", ".select_poly")


def elements(obj):
    """What vertices, edges, corners and faces have, but positions and selection: {name: array}."""
    mesh = obj.data
    found = {"edges": array(mesh.edges, "vertices", 2, np.int32),
             "corners": array(mesh.loops, "vertex_index", 1, np.int32),
             "faces": array(mesh.polygons, "loop_total", 1, np.int32),
             "materials": array(mesh.polygons, "material_index", 1, np.int32),
             "smooth": array(mesh.polygons, "use_smooth", 1, bool),
             "groups": [[(group.group, group.weight) for group in vertex.groups]
                        for vertex in mesh.vertices]}
    for name in ("use_edge_sharp", "use_seam"):
        found[name] = array(mesh.edges, name, 1, bool)
    for name in ("crease", "bevel_weight"):
        found[name] = array(mesh.edges, name, 1)
    for layer in mesh.uv_layers:
        found["uv " + layer.name] = array(layer.data, "uv", 2)
    for attribute in mesh.attributes:
        if attribute.name not in SELECTION:
            found["attribute " + attribute.name] = array(attribute.data,
                                                         *VALUES[attribute.data_type])
    return found


def settings(obj):
    """What the object and the mesh have as a whole."""
    mesh = obj.data
    return {"materials": [material.name for material in mesh.materials],
            "groups": [group.name for group in obj.vertex_groups],
            "uvs": [(layer.name, layer.active, layer.active_render) for layer in mesh.uv_layers],
            "attributes": sorted((attribute.name, attribute.domain, attribute.data_type)
                                 for attribute in mesh.attributes
                                 if attribute.name not in SELECTION),
            "colour": mesh.color_attributes.active_color and
                      mesh.color_attributes.active_color.name,
            "normals": mesh.has_custom_normals,
            "modifiers": [modifier.name for modifier in obj.modifiers],
            "keys": [(key.name, key.relative_key.name, key.value)
                     for key in mesh.shape_keys.key_blocks] if mesh.shape_keys else None}


def everything(obj):
    """All that an operator could change, as text and bytes."""
    mesh = obj.data
    places = [mesh.vertices] + [key.data for key in mesh.shape_keys.key_blocks
                                ] if mesh.shape_keys else [mesh.vertices]
    flags = [array(collection, name, 1, bool).tobytes() for name in ("select", "hide")
             for collection in (mesh.vertices, mesh.edges, mesh.polygons)]
    parts = {name: part if isinstance(part, list) else part.tobytes()
             for name, part in elements(obj).items()}
    return parts, [coordinates(place).tobytes() for place in places], flags, settings(obj), obj.mode


@contextlib.contextmanager
def in_mode(obj, mode):
    """Edit Mode or Object Mode, which is left for Object Mode at the end."""
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode=mode)
    try:
        yield
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


def select(obj, chosen, hidden=()):
    """Selects vertices in Object Mode, for Edit Mode by vertices; hides others."""
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    mesh = obj.data
    flags = np.zeros(len(mesh.vertices), bool)
    flags[list(chosen)] = True
    hide = np.zeros(len(mesh.vertices), bool)
    hide[list(hidden)] = True
    for collection in (mesh.edges, mesh.polygons):
        collection.foreach_set("select", np.array([flags[list(element.vertices)].all()
                                                   for element in collection]))
        collection.foreach_set("hide", np.array([hide[list(element.vertices)].any()
                                                 for element in collection]))
    mesh.vertices.foreach_set("select", flags)
    mesh.vertices.foreach_set("hide", hide)


def boundary_vertices(mesh):
    bm = bmesh.new()
    bm.from_mesh(mesh)
    found = {vertex.index for edge in bm.edges if edge.is_boundary for vertex in edge.verts}
    bm.free()
    return found


def properties_of(operator):
    return {key: value for key, value in operator.get_rna_type().properties.items()
            if key != "rna_type"}


def call(operator, options):
    """Calls an operator with an undo step. Blender would keep options from the call before."""
    defaults = {key: value.default for key, value in properties_of(operator).items()}
    return operator("EXEC_DEFAULT", True, **{**defaults, **options})


def smooth(**options):
    return call(bpy.ops.mesh.ibmfair_smooth, options)


def fill(**options):
    return call(bpy.ops.mesh.ibmfair_fill, options)


class AddonTest(unittest.TestCase):
    def setUp(self):
        for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.materials):
            for block in list(collection):
                collection.remove(block)
        preferences = bpy.context.preferences.addons[MODULE].preferences
        preferences.folder = os.environ["IBMFAIR_PYTHON"]

    def assert_same(self, got, expected):
        self.assertEqual(got.shape, expected.shape)
        self.assertEqual(got.tobytes(), expected.astype(got.dtype).tobytes())

    def assert_refused(self, obj, operator, reason, **options):
        """The operator gives an error with this reason, and changes nothing."""
        before = everything(obj)
        with self.assertRaisesRegex(RuntimeError, reason):
            operator(**options)
        if obj.mode == "EDIT":
            obj.update_from_editmode()
        self.assertEqual(everything(obj), before)

    @contextlib.contextmanager
    def assert_reported(self, text):
        """Blender prints the report; it writes past sys.stdout."""
        with tempfile.TemporaryFile() as file:
            sys.stdout.flush()
            stdout = os.dup(1)
            os.dup2(file.fileno(), 1)
            try:
                yield
            finally:
                sys.stdout.flush()
                os.dup2(stdout, 1)
                os.close(stdout)
            file.seek(0)
            self.assertRegex(file.read().decode(), text)
