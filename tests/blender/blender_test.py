"""The add-on for Blender, in Blender without a window, installed as its users install it.

    tests/blender/blender_test.py [TEST...]

Started by Python, this file starts Blender with itself. BLENDER is the program, and IBMFAIR_PYTHON
the folder of the Python package. Where either is missing, or Blender has another Python than the
package, the tests are skipped (exit code 77).
"""

import contextlib
import importlib.machinery
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

SKIPPED = 77
ADDON = pathlib.Path(__file__).parents[2] / "tools" / "blender" / "ibmfair_blender.py"

try:
    import bpy
except ImportError:
    bpy = None
else:
    import bmesh
    import numpy as np


def start_blender():
    """Runs the tests in Blender, with settings of its own; returns the exit code."""
    blender = shutil.which(os.environ.get("BLENDER") or "blender")
    if not blender:
        print("skipped: Blender is not installed")
        return SKIPPED
    package = pathlib.Path(os.environ.get("IBMFAIR_PYTHON", ADDON.parents[2] / "build" / "python"))
    if not list((package / "ibmfair").glob("_core*")):
        print(f"skipped: the Python package ibmfair is not built in {package}")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        settings = {f"BLENDER_USER_{kind}": folder for kind in ("CONFIG", "SCRIPTS", "DATAFILES")}
        # A Blender that has no Python of its own takes the modules of the first one in the path.
        settings["PATH"] = os.path.dirname(blender) + os.pathsep + os.environ["PATH"]
        return subprocess.run(
            [blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python",
             __file__, "--", *sys.argv[1:]],
            env={**os.environ, **settings, "IBMFAIR_PYTHON": str(package.resolve())}).returncode


# --------------------------------------------------------------------------------------------------
# Meshes

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
        preferences = bpy.context.preferences.addons[ADDON.stem].preferences
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


class SmoothTest(AddonTest):
    def test_noise_goes(self):
        for mode in ("OBJECT", "EDIT"):
            for options in ({}, {"denoise": True}):
                obj = icosphere(noise=0.02)
                before = np.abs(np.linalg.norm(coordinates(obj.data.vertices), axis=1) - 1).mean()
                with in_mode(obj, mode):
                    self.assertEqual(smooth(**options), {"FINISHED"})
                after = np.abs(np.linalg.norm(coordinates(obj.data.vertices), axis=1) - 1).mean()
                self.assertLess(after, 0.35 * before, (mode, options))

    def test_every_option_does_what_it_does_in_python(self):
        cases = (({}, {"cutoff": 8, "steps": 16}),
                 ({"cutoff": 5}, {"cutoff": 5}), ({"steps": 3}, {"cutoff": 8, "steps": 3}),
                 ({"twicing": 1}, {"cutoff": 8, "twicing": 1}),
                 ({"use_keep_sharp": True, "sharp_angle": np.radians(40)}, {"keep_sharp": 40}),
                 ({"sharp_angle": np.radians(40)}, {}),
                 ({"keep_volume": True}, {"keep_volume": True}),
                 ({"max_move": 0.0625}, {"max_move": 0.0625}),
                 ({"denoise": True, "cutoff": 3, "steps": 2}, {"denoise": True}))
        borders = (("FIXED", "fixed"), ("POSITION", "position"), ("FREE", "free"), ("FAIR", "fair"))
        for options, keywords in cases:
            self.compare_with_python(icosphere(noise=0.03), options, keywords)
        for boundary, keyword in borders:
            obj = icosphere(noise=0.03)
            delete_faces(obj, lambda x, y, z: z > 0.5)
            self.compare_with_python(obj, {"boundary": boundary}, {"boundary": keyword})

    def compare_with_python(self, obj, options, keywords):
        before = coordinates(obj.data.vertices)
        expected, _ = ibmfair.smooth(before, faces(obj.data), **{"cutoff": 8, **keywords}
                                     if "denoise" not in keywords else keywords)
        smooth(**options)
        with self.subTest(options=options):
            self.assert_same(coordinates(obj.data.vertices), expected)
            self.assertTrue((expected != before).any())

    def test_polygons_of_any_size(self):
        for dissolve in (False, True):
            obj = grid()
            if dissolve:
                delete_faces(obj, lambda x, y, z: x > 0.8 and y > 0.8)
                with in_mode(obj, "EDIT"):
                    bm = bmesh.from_edit_mesh(obj.data)
                    bmesh.ops.dissolve_verts(bm, verts=[vertex for vertex in bm.verts if
                                                        vertex.co.xy.length < 0.15])
                    bmesh.update_edit_mesh(obj.data)
                self.assertGreater(len({len(face) for face in faces(obj.data)}), 1)
            add_noise(obj.data, 0.02)
            self.compare_with_python(obj, {}, {})

    def test_only_selected_vertices_move(self):
        obj = icosphere(noise=0.02)
        before = coordinates(obj.data.vertices)
        chosen = before[:, 2] > 0.3
        hidden = before[:, 0] > 0.8
        select(obj, np.flatnonzero(chosen), np.flatnonzero(hidden))
        with in_mode(obj, "EDIT"):
            smooth()
        after = coordinates(obj.data.vertices)
        moves = chosen & ~hidden
        self.assert_same(after[~moves], before[~moves])
        self.assertGreater((after != before).any(axis=1).sum(), 0.9 * moves.sum())
        expected, _ = ibmfair.smooth(before, faces(obj.data), cutoff=8, mask=moves)
        self.assert_same(after, expected)

    def test_hidden_vertices_stay_if_none_is_selected(self):
        obj = icosphere(noise=0.02)
        before = coordinates(obj.data.vertices)
        hidden = before[:, 0] > 0.5
        select(obj, (), np.flatnonzero(hidden))
        with in_mode(obj, "EDIT"):
            smooth()
        after = coordinates(obj.data.vertices)
        self.assert_same(after[hidden], before[hidden])
        self.assertTrue((after[~hidden] != before[~hidden]).any(axis=1).mean() > 0.8)

    def test_all_else_stays(self):
        for mode in ("OBJECT", "EDIT"):
            obj = icosphere(noise=0.02)
            add_loose(obj)
            decorate(obj)
            add_keys(obj)
            loose = coordinates(obj.data.vertices)[:3]
            self.assertEqual(loose.tolist(), [[3, 0, 0], [3, 1, 0], [3, 2, 0]])
            before = everything(obj)
            with in_mode(obj, mode):
                smooth()
            after = everything(obj)
            self.assertEqual(after[0], before[0])
            self.assertEqual(after[2:], before[2:])
            self.assertNotEqual(after[1], before[1])
            self.assert_same(coordinates(obj.data.vertices)[:3], loose)

    def test_keys_move_with_the_one_to_which_they_are_relative(self):
        moving = {0: (0, 1, 2, 3), 1: (1, 2), 2: (2,), 3: (3,)}
        for mode in ("OBJECT", "EDIT"):
            for active, relative in moving.items():
                self.smooth_keys(mode, active, True, relative)
            self.smooth_keys(mode, 0, False, (0,))

    def smooth_keys(self, mode, active, use_relative, moving):
        """Smooths the active key; `moving` are those that move."""
        obj = icosphere(noise=0.02)
        keys = add_keys(obj)
        obj.data.shape_keys.use_relative = use_relative
        obj.active_shape_key_index = active
        before = [coordinates(key.data) for key in keys]
        new, _ = ibmfair.smooth(before[active], faces(obj.data), cutoff=8)
        with in_mode(obj, mode):
            smooth()
        after = [coordinates(key.data) for key in obj.data.shape_keys.key_blocks]
        with self.subTest(mode=mode, active=active, use_relative=use_relative):
            self.assert_same(after[active], new)
            for index in range(4):
                move = new - before[active] if index in moving else 0
                self.assertLess(np.abs(after[index] - before[index] - move).max(), 1e-6)
            self.assert_same(coordinates(obj.data.vertices), after[0])

    def test_other_objects_with_the_mesh_change_too(self):
        obj = icosphere(noise=0.02)
        other = bpy.data.objects.new("other", obj.data)
        before = coordinates(other.data.vertices)
        smooth()
        self.assertTrue((coordinates(other.data.vertices) != before).any())
        self.assertEqual(obj.data.users, 2)

    def test_scale_of_the_object_is_not_used(self):
        results = []
        for scale in (1, 100):
            obj = icosphere(noise=0.02)
            obj.scale = (scale, 1, 1)
            smooth(max_move=0.02)
            results.append(coordinates(obj.data.vertices))
        self.assert_same(*results)

    def test_undo(self):
        for mode in ("OBJECT", "EDIT"):
            obj = icosphere(noise=0.02)
            name = obj.name
            add_keys(obj)
            with in_mode(obj, mode):
                before = [coordinates(key.data).tobytes() for key in obj.data.shape_keys.key_blocks]
                bpy.ops.ed.undo_push(message="before")
                smooth()
                obj.update_from_editmode()
                after = [coordinates(key.data).tobytes() for key in obj.data.shape_keys.key_blocks]
                self.assertNotEqual(after, before)
                self.assertEqual(bpy.ops.ed.undo(), {"FINISHED"})
                obj = bpy.data.objects[name]
                self.assertEqual(obj.mode, mode)
                obj.update_from_editmode()
                keys = obj.data.shape_keys.key_blocks
                self.assertEqual([coordinates(key.data).tobytes() for key in keys], before)
            self.setUp()

    def test_errors_change_nothing(self):
        obj = icosphere(noise=0.02)
        delete_faces(obj, lambda x, y, z: z > 0.5)
        for mode in ("OBJECT", "EDIT"):
            with in_mode(obj, mode):
                self.assert_refused(obj, smooth, "need a closed mesh", keep_volume=True)
        with unittest.mock.patch.object(ibmfair, "smooth", side_effect=MemoryError("no memory")):
            self.assert_refused(obj, smooth, "no memory")
        obj.data.vertices[5].co.x = float("nan")
        with self.assertRaisesRegex(RuntimeError, "not finite"):
            smooth()
        empty = bpy.data.objects.new("empty", bpy.data.meshes.new("empty"))
        bpy.context.collection.objects.link(empty)
        for mode in ("OBJECT", "EDIT"):
            with in_mode(empty, mode):
                self.assert_refused(empty, smooth, "no faces")
                self.assert_refused(empty, fill, "no faces")

    def test_warnings_are_reported(self):
        obj = grid(2)
        before = everything(obj)
        with self.assert_reported("Warning: no vertex is free to move"):
            self.assertEqual(smooth(), {"CANCELLED"})
        self.assertEqual(everything(obj), before)

    def test_mesh_without_noise(self):
        obj = icosphere()
        before = everything(obj)
        with self.assert_reported("Info: No noise was found"):
            self.assertEqual(smooth(denoise=True), {"CANCELLED"})
        self.assertEqual(everything(obj), before)


class FillTest(AddonTest):
    def holed_sphere(self, noise=0.0):
        """Holes at both poles."""
        obj = icosphere(noise)
        delete_faces(obj, lambda x, y, z: abs(z) > 0.9)
        self.assertEqual(len(ibmfair.holes(coordinates(obj.data.vertices), faces(obj.data))), 2)
        return obj

    def test_fills_all_holes_as_python_does(self):
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            P, F = coordinates(obj.data.vertices), faces(obj.data)
            V, F2, _ = ibmfair.fill(P, F)
            with in_mode(obj, mode):
                self.assertEqual(fill(), {"FINISHED"})
            after = coordinates(obj.data.vertices)
            self.assertEqual(boundary_vertices(obj.data), set())
            self.assert_same(after, V)
            self.assert_same(after[:len(P)], P)
            self.assertEqual([sorted(face) for face in faces(obj.data)],
                             [sorted(face) for face in F2])
            self.assertEqual(faces(obj.data)[:len(F)], F)
            self.assertLess(np.abs(np.linalg.norm(after, axis=1) - 1).max(), 0.01)
            self.assertFalse(obj.data.validate())
            self.assert_outward(obj.data)

    def assert_outward(self, mesh):
        for polygon in mesh.polygons:
            self.assertGreater(polygon.normal.dot(polygon.center), 0.5)

    def test_options_do_what_they_do_in_python(self):
        cases = (({"continuity": "1"}, {"continuity": 1}), ({"continuity": "0"}, {"continuity": 0}),
                 ({"edge_length": 0.0625}, {"edge_length": 0.0625}),
                 ({"keep_sharp": "ANGLE", "sharp_angle": np.radians(50)}, {"keep_sharp": 50}),
                 ({"keep_sharp": "AUTO"}, {"keep_sharp": "auto"}),
                 ({"keep_sharp": "AUTO", "continuity": "1"}, {"continuity": 1}))
        for options, keywords in cases:
            obj = self.holed_sphere(noise=0.01)
            V, F2, _ = ibmfair.fill(coordinates(obj.data.vertices), faces(obj.data), **keywords)
            fill(**options)
            with self.subTest(options=options):
                self.assert_same(coordinates(obj.data.vertices), V)
                self.assertEqual(len(obj.data.polygons), len(F2))

    def test_max_edges(self):
        obj = icosphere()
        delete_faces(obj, lambda x, y, z: z > 0.5 or z < -0.95)
        small, large = sorted(ibmfair.holes(coordinates(obj.data.vertices), faces(obj.data)),
                              key=lambda hole: hole["edges"])
        fill(max_edges=small["edges"])
        self.assertEqual(boundary_vertices(obj.data), set(large["vertices"]))

    def test_fills_the_selected_hole(self):
        obj = self.holed_sphere()
        upper, lower = ({vertex for vertex in boundary_vertices(obj.data)
                         if sign * obj.data.vertices[vertex].co.z > 0} for sign in (1, -1))
        select(obj, upper)
        with in_mode(obj, "EDIT"):
            fill()
        self.assertEqual(boundary_vertices(obj.data), lower)

    def test_part_of_a_rim_is_no_selection(self):
        obj = self.holed_sphere()
        select(obj, list(boundary_vertices(obj.data))[:3])
        with in_mode(obj, "EDIT"):
            self.assert_refused(obj, fill, "No hole has a rim whose vertices are all selected")
            fill(holes="ALL")
        self.assertEqual(boundary_vertices(obj.data), set())

    def test_holes_at_hidden_vertices_stay(self):
        obj = self.holed_sphere()
        upper = [vertex for vertex in boundary_vertices(obj.data)
                 if obj.data.vertices[vertex].co.z > 0]
        select(obj, (), upper[:1])
        with in_mode(obj, "EDIT"):
            fill()
        self.assertEqual(boundary_vertices(obj.data), set(upper))
        select(obj, (), upper[:1])
        with in_mode(obj, "EDIT"):
            self.assert_refused(obj, fill, "hidden vertices")

    def test_outer_borders_are_filled_only_if_asked(self):
        obj = grid()
        self.assert_refused(obj, fill, "outer borders")
        fill(outer_borders=True)
        self.assertEqual(boundary_vertices(obj.data), set())
        obj = grid()
        select(obj, boundary_vertices(obj.data))
        with in_mode(obj, "EDIT"):
            fill()
        self.assertEqual(boundary_vertices(obj.data), set())

    def test_the_patches_are_selected(self):
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            count = len(obj.data.polygons)
            with in_mode(obj, mode):
                fill()
            selected = array(obj.data.polygons, "select", 1, bool).reshape(-1)
            self.assertTrue(selected[count:].all())
            if mode == "OBJECT":
                self.assertFalse(selected[:count].any())
            new = {vertex for polygon in obj.data.polygons[count:] for vertex in polygon.vertices}
            flags = array(obj.data.vertices, "select", 1, bool).reshape(-1)
            self.assertEqual(set(np.flatnonzero(flags).tolist()), new)

    def test_all_else_stays(self):
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            add_loose(obj)
            decorate(obj)
            add_keys(obj)
            before, whole = elements(obj), settings(obj)
            keys = [coordinates(key.data) for key in obj.data.shape_keys.key_blocks]
            with in_mode(obj, mode):
                fill()
            after = elements(obj)
            self.assertEqual(settings(obj), whole)
            self.assertEqual(set(after), set(before))
            for name, values in before.items():
                with self.subTest(mode=mode, name=name):
                    self.assertGreater(len(after[name]), len(values))
                    if isinstance(values, list):
                        self.assertEqual(after[name][:len(values)], values)
                    else:
                        self.assert_same(after[name][:len(values)], values)
            for key, old in zip(obj.data.shape_keys.key_blocks, keys):
                self.assert_same(coordinates(key.data)[:len(old)], old)

    def test_faces_take_after_their_neighbours(self):
        """The sphere has one material and shading in each half, and a hole at each pole."""
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            for name in ("lower", "upper"):
                obj.data.materials.append(bpy.data.materials.new(name))
            for polygon in obj.data.polygons:
                polygon.material_index = int(polygon.center.z > 0)
                polygon.use_smooth = polygon.center.z > 0
            with in_mode(obj, mode):
                fill()
            for polygon in obj.data.polygons:
                self.assertEqual(polygon.material_index, int(polygon.center.z > 0))
                self.assertEqual(polygon.use_smooth, polygon.center.z > 0)

    def holed_grid(self):
        obj = grid()
        delete_faces(obj, lambda x, y, z: max(abs(x), abs(y)) < 0.5)
        return obj

    def test_linear_values_in_a_plane_go_on(self):
        """Texture coordinates, weights, colours and offsets of keys that are linear in x and y."""
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_grid()
            mesh = obj.data
            group = obj.vertex_groups.new(name="group")
            obj.vertex_groups.new(name="empty")
            mesh.color_attributes.new("colour", "FLOAT_COLOR", "POINT")
            mesh.color_attributes.new("corner", "BYTE_COLOR", "CORNER")
            for index, (x, y, _) in enumerate(coordinates(mesh.vertices).tolist()):
                group.add([index], 0.5 + x / 4, "REPLACE")
                colour = mesh.color_attributes["colour"].data[index]
                colour.color = (0.5 + x / 4, 0.5 + y / 4, 0.5, 1)
            for datum in mesh.color_attributes["corner"].data:
                datum.color = (1, 0, 0, 1)
            obj.shape_key_add(name="Basis")
            key = obj.shape_key_add(name="sheared", from_mix=False)
            for point in key.data:
                point.co.z += point.co.x
            count = len(mesh.vertices)
            with in_mode(obj, mode):
                self.assertEqual(fill(), {"FINISHED"})
            mesh = obj.data
            self.assertGreater(len(mesh.vertices), count)
            for vertex in mesh.vertices:
                x, y, _ = vertex.co
                (weight,) = vertex.groups
                self.assertAlmostEqual(weight.weight, 0.5 + x / 4, delta=1e-5)
                colour = mesh.color_attributes["colour"].data[vertex.index].color
                for got, expected in zip(colour, (0.5 + x / 4, 0.5 + y / 4, 0.5, 1)):
                    self.assertAlmostEqual(got, expected, delta=1e-5)
                point = mesh.shape_keys.key_blocks["sheared"].data[vertex.index].co
                self.assertLess((point - vertex.co).xy.length, 1e-5)
                self.assertAlmostEqual(point.z - vertex.co.z, x, delta=1e-5)
            for corner, uv in zip(mesh.loops, mesh.uv_layers.active.data):
                x, y, _ = mesh.vertices[corner.vertex_index].co
                self.assertLess((uv.uv - type(uv.uv)((x / 2 + 0.5, y / 2 + 0.5))).length, 1e-5)
            for datum in mesh.color_attributes["corner"].data:
                self.assertEqual(tuple(datum.color), (1, 0, 0, 1))

    def test_maps_with_a_seam_at_the_rim_are_named(self):
        obj = self.holed_grid()
        count = len(obj.data.loops)
        split = obj.data.uv_layers.new(name="split")
        for polygon in obj.data.polygons:
            if polygon.center.x > 0:
                for corner in polygon.loop_indices:
                    split.data[corner].uv.x += 7
        whole = obj.data.uv_layers[0].name
        with self.assert_reported("Warning: Seams .* UV maps: split"):
            fill()
        self.assertFalse(array(obj.data.uv_layers["split"].data, "uv", 2)[count:].any())
        self.assertTrue(array(obj.data.uv_layers[whole].data, "uv", 2)[count:].all())

    def test_key_that_is_active_is_filled(self):
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            keys = add_keys(obj)
            obj.active_shape_key_index = 3
            V, _, _ = ibmfair.fill(coordinates(keys[3].data), faces(obj.data))
            with in_mode(obj, mode):
                fill()
            keys = [coordinates(key.data) for key in obj.data.shape_keys.key_blocks]
            self.assert_same(keys[3], V)
            self.assert_same(coordinates(obj.data.vertices), keys[0])
            # Patches of other keys continue their rims: no new vertex is far from the sphere.
            for key in keys:
                self.assertLess(np.abs(np.linalg.norm(key, axis=1) - 1).max(), 0.6)

    def test_undo(self):
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            decorate(obj)
            name = obj.name
            with in_mode(obj, mode):
                obj.update_from_editmode()
                before = everything(obj)
                bpy.ops.ed.undo_push(message="before")
                fill()
                obj.update_from_editmode()
                self.assertNotEqual(everything(obj), before)
                self.assertEqual(bpy.ops.ed.undo(), {"FINISHED"})
                obj = bpy.data.objects[name]
                obj.update_from_editmode()
                self.assertEqual(everything(obj), before)
            self.setUp()

    def test_mesh_without_holes(self):
        obj = icosphere()
        for mode in ("OBJECT", "EDIT"):
            with in_mode(obj, mode):
                self.assert_refused(obj, fill, "The mesh has no holes")

    def test_border_of_a_single_triangle(self):
        mesh = bpy.data.meshes.new("triangle")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
        obj = bpy.data.objects.new("triangle", mesh)
        bpy.context.collection.objects.link(obj)
        bpy.context.view_layer.objects.active = obj
        before = everything(obj)
        with self.assert_reported("Warning: A hole of 3 edges stays open: .* single triangle"):
            self.assertEqual(fill(outer_borders=True), {"CANCELLED"})
        self.assertEqual(everything(obj), before)

    def test_no_face_is_added_twice(self):
        """What Blender could not hold is refused before anything changes."""
        obj = self.holed_sphere()
        V, F, info = ibmfair.fill(coordinates(obj.data.vertices), faces(obj.data))
        for more in ([F[0][::-1]], [F[-1][::-1]]):
            result = V, [*map(list, F), *map(list, more)], info
            for mode in ("OBJECT", "EDIT"):
                with (unittest.mock.patch.object(ibmfair, "fill", return_value=result),
                      in_mode(obj, mode)):
                    self.assert_refused(obj, fill, "would cover a face that exists")

    def test_creases_and_bevels_end_at_the_rim(self):
        for mode in ("OBJECT", "EDIT"):
            obj = self.holed_sphere()
            count = len(obj.data.vertices)
            with in_mode(obj, "EDIT"):
                bm = bmesh.from_edit_mesh(obj.data)
                for layer in (bm.verts.layers.bevel_weight.new(), bm.verts.layers.crease.new()):
                    for vertex in bm.verts:
                        vertex[layer] = 1.0
                bmesh.update_edit_mesh(obj.data)
            with in_mode(obj, mode):
                fill()
            with in_mode(obj, "EDIT"):
                bm = bmesh.from_edit_mesh(obj.data)
                for layers in (bm.verts.layers.bevel_weight, bm.verts.layers.crease):
                    values = [vertex[layers.verify()] for vertex in bm.verts]
                    self.assertEqual(values, [1.0] * count + [0.0] * (len(values) - count))

    def test_many_holes(self):
        obj = icosphere(subdivisions=6)
        mesh = obj.data
        with in_mode(obj, "EDIT"):
            bm = bmesh.from_edit_mesh(mesh)
            bmesh.ops.delete(bm, geom=list(bm.faces)[::40], context="FACES_ONLY")
            bmesh.update_edit_mesh(mesh)
        self.assertGreater(len(boundary_vertices(mesh)), 1000)
        fill()
        self.assertEqual(boundary_vertices(mesh), set())


class AddonItselfTest(AddonTest):
    def test_needs_a_mesh_of_this_file(self):
        light = bpy.data.objects.new("light", bpy.data.lights.new("light", "POINT"))
        bpy.context.collection.objects.link(light)
        bpy.context.view_layer.objects.active = light
        for operator in (smooth, fill):
            with self.assertRaisesRegex(RuntimeError, "The active object is not a mesh"):
                operator()
        bpy.context.view_layer.objects.active = None
        with self.assertRaisesRegex(RuntimeError, "The active object is not a mesh"):
            smooth()
        obj = icosphere()
        bpy.ops.object.mode_set(mode="SCULPT")
        with self.assertRaisesRegex(RuntimeError, "Only in Object Mode and in Edit Mode"):
            smooth()
        bpy.ops.object.mode_set(mode="OBJECT")
        with tempfile.TemporaryDirectory() as folder:
            library = os.path.join(folder, "library.blend")
            bpy.data.libraries.write(library, {obj.data})
            with bpy.data.libraries.load(library, link=True) as (source, target):
                target.meshes = source.meshes
            obj.data = target.meshes[0]
            with self.assertRaisesRegex(RuntimeError, "linked from another file"):
                smooth()

    def test_says_how_to_install_a_missing_package(self):
        obj = icosphere(noise=0.02)
        loaded = {name: module for name, module in sys.modules.items()
                  if name.partition(".")[0] == "ibmfair"}
        for name in loaded:
            del sys.modules[name]
        preferences = bpy.context.preferences.addons[ADDON.stem].preferences
        try:
            preferences.folder = ""
            if subprocess.run([sys.executable, "-c", "import ibmfair"],
                              capture_output=True).returncode != 0:
                self.assert_refused(obj, smooth, "python3-ibmfair.*preferences")
            with tempfile.TemporaryDirectory() as folder:
                package = pathlib.Path(folder, "ibmfair")
                package.mkdir()
                (package / "__init__.py").write_text("from . import _core\n")
                preferences.folder = folder
                self.assert_refused(obj, fill, "cannot be loaded by Blender's Python 3")
        finally:
            for name in list(sys.modules):
                if name.partition(".")[0] == "ibmfair":
                    del sys.modules[name]
            sys.modules.update(loaded)

    def test_panels_show_every_property(self):
        for name in ("smooth", "fill"):
            panel = getattr(bpy.types, f"VIEW3D_PT_ibmfair_{name}")
            layout = Layout()
            panel.draw(type("Panel", (), {"layout": layout, "operator": panel.operator}),
                       bpy.context)
            operator = f"mesh.ibmfair_{name}"
            properties = properties_of(getattr(bpy.ops.mesh, f"ibmfair_{name}"))
            self.assertEqual(layout.operators, [operator])
            self.assertEqual(sorted(layout.shown), sorted(properties))
            for property in properties.values():
                self.assertTrue(property.description)

    def test_panels_set_what_the_next_run_does(self):
        options = bpy.context.window_manager.operator_properties_last("mesh.ibmfair_smooth")
        options.max_move = 0.25
        again = bpy.context.window_manager.operator_properties_last("mesh.ibmfair_smooth")
        self.assertEqual(again.max_move, 0.25)
        again.max_move = 0

    def test_menus(self):
        for menu in ("VIEW3D_MT_object", "VIEW3D_MT_edit_mesh"):
            layout = Layout()
            for draw in getattr(bpy.types, menu).draw._draw_funcs:
                if draw.__module__ == ADDON.stem:
                    draw(type("Menu", (), {"layout": layout}), bpy.context)
            self.assertEqual(layout.operators, ["mesh.ibmfair_smooth", "mesh.ibmfair_fill"])

    def test_can_be_disabled_and_enabled(self):
        for _ in range(2):
            bpy.ops.preferences.addon_disable(module=ADDON.stem)
            self.assertFalse(hasattr(bpy.types, "MESH_OT_ibmfair_smooth"))
            for draw in bpy.types.VIEW3D_MT_object.draw._draw_funcs:
                self.assertNotEqual(draw.__module__, ADDON.stem)
            bpy.ops.preferences.addon_enable(module=ADDON.stem)
        self.assertTrue(hasattr(bpy.types, "MESH_OT_ibmfair_smooth"))


class Layout:
    """Takes the place of a layout of Blender, and notes what is drawn."""

    def __init__(self):
        self.shown, self.operators = [], []

    def column(self):
        return self

    def separator(self):
        pass

    def operator(self, name):
        self.operators.append(name)

    def prop(self, data, name):
        if not hasattr(data, name):
            raise AttributeError(name)
        self.shown.append(name)


def run_in_blender():
    global ibmfair
    folder = os.environ["IBMFAIR_PYTHON"]
    print(f"Blender {bpy.app.version_string}, Python {sys.version.split()[0]}")
    if not any(pathlib.Path(folder, "ibmfair", "_core" + suffix).exists()
               for suffix in importlib.machinery.EXTENSION_SUFFIXES):
        print("skipped: the Python package ibmfair is built for another version of Python")
        return SKIPPED
    sys.path.insert(0, folder)
    import ibmfair
    sys.path.remove(folder)
    bpy.ops.preferences.addon_install(filepath=str(ADDON))
    bpy.ops.preferences.addon_enable(module=ADDON.stem)
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    result = unittest.main(argv=[__file__, *words], exit=False).result
    return 0 if result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.stdout.flush()
    sys.exit(run_in_blender() if bpy else start_blender())
