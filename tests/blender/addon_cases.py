"""Tests of the add-on itself: its panels, menus and preferences, and where it does not run. Runs in Blender."""

import os
import pathlib
import subprocess
import sys
import tempfile

import bpy
from scenes import MODULE, AddonTest, fill, icosphere, properties_of, smooth


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
        preferences = bpy.context.preferences.addons[MODULE].preferences
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
                if draw.__module__ == MODULE:
                    draw(type("Menu", (), {"layout": layout}), bpy.context)
            self.assertEqual(layout.operators, ["mesh.ibmfair_smooth", "mesh.ibmfair_fill"])

    def test_can_be_disabled_and_enabled(self):
        for _ in range(2):
            bpy.ops.preferences.addon_disable(module=MODULE)
            self.assertFalse(hasattr(bpy.types, "MESH_OT_ibmfair_smooth"))
            for draw in bpy.types.VIEW3D_MT_object.draw._draw_funcs:
                self.assertNotEqual(draw.__module__, MODULE)
            bpy.ops.preferences.addon_enable(module=MODULE)
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
