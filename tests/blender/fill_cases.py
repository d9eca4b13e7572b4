"""Tests of "Fill Holes Fairly": what is filled, what patches take over, what stays. Runs in Blender."""

import unittest.mock

import bmesh
import bpy
import ibmfair
import numpy as np
from scenes import (AddonTest, add_keys, add_loose, array, boundary_vertices, coordinates, decorate,
                    delete_faces, elements, everything, faces, fill, grid, icosphere, in_mode,
                    select, settings)


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
