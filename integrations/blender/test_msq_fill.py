# SPDX-License-Identifier: Apache-2.0
"""Drives the installed add-on without a window: blender -b --factory-startup --python-exit-code 1 -P
test_msq_fill.py. scripts/test_blender runs it."""
import sys
import threading
import time
import unittest

import bmesh
import bpy
import numpy as np

bpy.ops.preferences.addon_enable(module="msq_fill")

import msq  # noqa: E402
import msq_fill  # noqa: E402


def volume_and_edges(obj):
    """The volume of a mesh object, and its edges that do not have two faces."""
    made = bmesh.new()
    made.from_mesh(obj.data)
    volume, bad = made.calc_volume(signed=True), [edge for edge in made.edges if not edge.is_manifold]
    made.free()
    return volume, len(bad)


class AddOn(unittest.TestCase):
    def setUp(self):
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_cube_add(size=2)
        self.cube = bpy.context.object

    def fill(self, **values):
        bpy.context.view_layer.objects.active = self.cube
        for name, value in values.items():
            setattr(self.cube.msq, name, value)
        self.assertEqual(bpy.ops.object.msq_fill(), {"FINISHED"})
        return bpy.context.object

    def test_each_kind_is_closed(self):
        for kind in ("FOAM", "CLOSED_FOAM", "LATTICE", "SHEET"):
            with self.subTest(kind=kind):
                made = self.fill(kind=kind, pitch=0.025)
                self.assertIsNot(made, self.cube)
                volume, bad = volume_and_edges(made)
                self.assertEqual(bad, 0)
                self.assertFalse(made.data.validate())  # it had nothing to correct
                self.assertTrue(0.2 < volume < 6, volume)

    def test_the_mesh_is_that_of_msq(self):
        made = self.fill(kind="LATTICE", unit_cell="OCTET", cell_size=0.5, radius=0.06, skin=0.05)
        model = msq.Model(msq.Shape.box((-1, -1, -1), (1, 1, 1)),
                          [msq.Scale(msq.Lattice("octet", cell_size=0.5, radius=0.06), skin=0.05)])
        mesh = model.mesh(0.05)
        self.assertEqual(len(made.data.polygons), len(mesh.triangles))
        points = np.empty(3 * len(made.data.vertices), np.float32)
        made.data.vertices.foreach_get("co", points)
        self.assertLess(np.abs(points.reshape(-1, 3) - mesh.vertices).max(), 1e-6)

    def test_modifiers_and_transforms(self):
        self.cube.modifiers.new("Subdivision", "SUBSURF").levels = 2
        self.cube.location = (10, 0, 0)
        self.cube.scale = (-1, 2, 1)
        bpy.context.view_layer.update()
        vertices, triangles = msq_fill.triangles_of(self.cube, bpy.context.evaluated_depsgraph_get())
        self.assertGreater(msq.Shape.from_mesh(vertices, triangles).info.volume, 0)  # as seen in no mirror
        made = self.fill(skin=0.2)
        volume, bad = volume_and_edges(made)
        self.assertEqual(bad, 0)
        self.assertGreater(volume, 0)  # not turned inside out
        points = np.array([vertex.co for vertex in made.data.vertices])
        np.testing.assert_allclose(points.mean(axis=0), (10, 0, 0), atol=0.1)
        self.assertGreater(np.ptp(points[:, 1]), 1.5 * np.ptp(points[:, 0]))

    def test_errors(self):
        count = len(bpy.data.objects)
        for values, message in (({"cell_size": 0}, "cell_size is 0"), ({"radius": 9}, "radius"),
                                ({"radius": 0.001, "cell_size": 1.5}, "nothing is solid")):
            with self.assertRaisesRegex(RuntimeError, message):
                self.fill(**{"cell_size": 0.4, "radius": 0.04, **values})
        self.assertEqual(len(bpy.data.objects), count)
        bpy.ops.object.light_add()
        self.assertFalse(bpy.ops.object.msq_fill.poll())

    def test_cancel(self):
        made, jobs = msq.Job, []

        def job():
            jobs.append(made())
            threading.Timer(0.3, jobs[0].cancel).start()
            return jobs[0]

        msq.Job = job
        try:
            start = time.monotonic()
            with self.assertRaisesRegex(RuntimeError, "cancel"):
                self.fill(cell_size=0.02, radius=0.003, pitch=0.001)  # some minutes
            self.assertLess(time.monotonic() - start, 60)
        finally:
            msq.Job = made


suite = unittest.defaultTestLoader.loadTestsFromTestCase(AddOn)
if not unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful():
    sys.exit(1)
