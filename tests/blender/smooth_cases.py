"""Tests of "Smooth Fairly": what moves, and what stays. Runs in Blender."""

import unittest.mock

import bmesh
import bpy
import ibmfair
import numpy as np
from scenes import (AddonTest, add_keys, add_loose, add_noise, coordinates, decorate, delete_faces,
                    everything, faces, fill, grid, icosphere, in_mode, select, smooth)


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
        cases = (({}, {"cutoff": 8}), ({"steps": 16}, {"cutoff": 8, "steps": 16}),
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
