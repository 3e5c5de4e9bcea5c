# SPDX-License-Identifier: Apache-2.0
"""Drives the installed workbench without a window: freecadcmd test_workbench.py. scripts/test_freecad runs
it. MSQ_FREECAD_TEST: part of the name of the only tests to run."""
import glob
import importlib
import io
import os
import re
import sys
import tempfile
import threading
import traceback
import unittest
import zipfile

import FreeCAD
import Mesh
import numpy as np
import Part
from PIL import Image

import msq
from freecad.msq_workbench import export, filling, layers, waiting

MM = FreeCAD.Units.Quantity


def bracket():
    """An angle with a bearing: faces that are flat, round and cut by others."""
    foot = Part.makeBox(40, 24, 6)
    back = Part.makeBox(6, 24, 30)
    bearing = Part.makeCylinder(9, 12, FreeCAD.Vector(28, 12, 0))
    hole = Part.makeCylinder(5, 40, FreeCAD.Vector(28, 12, -5))
    return foot.fuse([back, bearing]).cut(hole).removeSplitter()


class Workbench(unittest.TestCase):
    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def solid(self, shape, name="Solid"):
        source = self.document.addObject("Part::Feature", name)
        source.Shape = shape
        return source

    def filled(self, shape=None, **values):
        made = filling.make(self.solid(shape or Part.makeBox(20, 15, 10)))
        for name, value in {"CellSize": 5.0, "Radius": 0.8, "PreviewPitch": 0.5, **values}.items():
            setattr(made, name, value)
        self.document.recompute()
        return made

    def check_solid(self, made):
        self.assertTrue(made.isValid(), made.getStatusString())
        mesh = made.Mesh
        self.assertTrue(mesh.isSolid())
        self.assertFalse(mesh.hasNonManifolds())
        self.assertFalse(mesh.hasNonUniformOrientedFacets())
        self.assertGreater(mesh.Volume, 0)
        self.assertEqual(made.PreviewFacets, mesh.CountFacets)
        return mesh

    # Previews

    def test_each_kind_is_a_closed_solid(self):
        for kind in filling.KINDS:
            with self.subTest(kind=kind):
                mesh = self.check_solid(self.filled(Kind=kind, PreviewPitch=0.3))
                self.assertLess(mesh.Volume, 0.95 * 3000)

    def test_a_bracket(self):
        shape = bracket()
        made = self.filled(shape, Skin=0.8, Radius=0.5, TopRadius=0.9, CellSize=4.0)
        mesh = self.check_solid(made)
        self.assertLess(mesh.Volume, 0.9 * shape.Volume)
        model = filling.recipe_of(made)()
        low, high = (np.array(corner) for corner in model.bounds)
        counts = (24, 16, 20)
        sample = msq.Stratified(low, (high - low) / counts, counts, per_cell=64)
        expected = model.volume_fraction(sample).value * np.prod(high - low)
        self.assertAlmostEqual(mesh.Volume / expected, 1, delta=0.02)

    def test_without_holes_the_volume_is_that_of_the_solid(self):
        shape = bracket()
        made = self.filled(shape, Radius=5.0)
        self.assertAlmostEqual(self.check_solid(made).Volume / shape.Volume, 1, delta=0.005)

    def test_a_preview_becomes_a_solid_of_part(self):
        mesh = self.check_solid(self.filled(Part.makeBox(6, 6, 6), Kind="Lattice", CellSize=6.0))
        shape = Part.Shape()
        shape.makeShapeFromMesh(mesh.Topology, 0.01)
        solid = Part.Solid(Part.Shell(shape.Faces))
        self.assertTrue(solid.isClosed())
        self.assertTrue(solid.isValid())
        self.assertAlmostEqual(abs(solid.Volume) / mesh.Volume, 1, delta=1e-4)

    def test_it_follows_its_parameters_and_its_source(self):
        made = self.filled()
        thin = made.Mesh.Volume
        made.Radius = MM("1.2 mm")
        self.assertIn("Touched", made.State)
        self.document.recompute()
        thick = self.check_solid(made).Volume
        self.assertGreater(thick, 1.5 * thin)
        made.Source.Shape = Part.makeBox(20, 15, 20)
        self.document.recompute()
        self.assertGreater(self.check_solid(made).Volume, 1.8 * thick)
        made.Preview = False
        self.document.recompute()
        self.assertEqual((made.PreviewFacets, made.Mesh.CountFacets), (0, 0))

    def test_placements(self):
        made = self.filled()
        box = made.Mesh.BoundBox
        made.Source.Placement.Base = FreeCAD.Vector(5, 0, 0)
        part = self.document.addObject("App::Part", "Part")
        part.Placement.Base = FreeCAD.Vector(0, 0, 100)
        part.addObject(made.Source)
        self.document.recompute()
        self.assertAlmostEqual(made.Mesh.BoundBox.ZMin, box.ZMin + 100, delta=1e-3)
        self.assertAlmostEqual(made.Mesh.BoundBox.XMax, box.XMax + 5, delta=1e-3)

    def test_a_mesh_as_source(self):
        source = self.document.addObject("Mesh::Feature", "Ball")
        source.Mesh = Mesh.createSphere(8.0, 40)
        source.Placement.Base = FreeCAD.Vector(30, 0, 0)
        made = filling.make(source)
        made.PreviewPitch = 0.5
        self.document.recompute()
        self.assertAlmostEqual(self.check_solid(made).BoundBox.Center.x, 30, delta=0.5)

    def test_properties_of_other_kinds_are_hidden(self):
        made = self.filled()
        self.assertEqual(made.getEditorMode("UnitCell"), ["Hidden"])
        made.Kind = "Lattice"
        self.assertEqual(made.getEditorMode("UnitCell"), [])
        self.assertEqual(made.getEditorMode("Jitter"), ["Hidden"])

    def test_a_document_is_saved_and_opened(self):
        made = self.filled(Kind="TPMS sheet", Function="diamond", WallThickness=0.9)
        stack = layers.make(made)
        self.document.recompute()
        facets, areas = made.PreviewFacets, list(stack.Areas)
        self.document.saveAs(self.path("filled.FCStd"))
        FreeCAD.closeDocument(self.document.Name)
        self.document = FreeCAD.openDocument(self.path("filled.FCStd"))
        made = next(obj for obj in self.document.Objects if filling.is_filling(obj))
        self.assertEqual((made.Function, made.WallThickness.Value), ("diamond", 0.9))
        self.assertEqual(made.Mesh.CountFacets, facets)
        for obj in self.document.Objects:
            obj.touch()
        self.document.recompute()
        self.assertEqual(self.check_solid(made).CountFacets, facets)
        self.assertEqual(list(self.document.getObject("Layers").Areas), areas)

    # Layers

    def test_layers_are_faces(self):
        made = self.filled(bracket(), Radius=0.7, PreviewPitch=0.25)
        stack = layers.make(made)
        stack.LayerHeight, stack.Tolerance = 0.5, 0.02
        self.document.recompute()
        self.assertTrue(stack.isValid(), stack.getStatusString())
        self.assertEqual(len(stack.Shape.SubShapes), 60)
        self.assertTrue(stack.Shape.isValid())
        for layer, z, area in zip(stack.Shape.SubShapes, stack.Heights, stack.Areas):
            self.assertAlmostEqual(layer.BoundBox.ZMin, z, delta=1e-6)
            self.assertAlmostEqual(layer.Area, area, delta=1e-4 * max(area, 1))
        self.assertAlmostEqual(0.5 * sum(stack.Areas) / made.Mesh.Volume, 1, delta=0.03)
        made.Radius = 0.9
        self.document.recompute()
        self.assertAlmostEqual(0.5 * sum(stack.Areas) / made.Mesh.Volume, 1, delta=0.03)

    def test_some_layers(self):
        stack = layers.make(self.filled())
        stack.FirstLayer, stack.LayerCount = 3, 2
        self.document.recompute()
        self.assertEqual(list(stack.Heights), [3.5, 4.5])
        stack.FirstLayer = 9
        self.document.recompute()
        self.assertFalse(stack.isValid())
        self.assertIn("FirstLayer is 9 and LayerCount 2; there are 10", stack.getStatusString())

    # Files

    def test_mesh_files(self):
        made = self.filled()
        for suffix in ("stl", "ply", "3mf"):
            with self.subTest(suffix=suffix):
                export.save_mesh(made, self.path("part." + suffix))
        for suffix in ("stl", "ply"):
            read = Mesh.Mesh(self.path("part." + suffix))
            self.assertEqual(read.CountFacets, made.PreviewFacets)
            self.assertTrue(read.isSolid())
        info = msq.Shape.from_file(self.path("part.3mf")).info  # FreeCAD wrote it
        self.assertTrue(info.closed)
        self.assertEqual(info.triangles, made.PreviewFacets)
        self.assertAlmostEqual(info.volume / made.Mesh.Volume, 1, delta=1e-4)
        export.save_mesh(made, self.path("part.stl"), 1.0)  # again, coarser
        self.assertLess(Mesh.Mesh(self.path("part.stl")).CountFacets, made.PreviewFacets / 2)
        self.assertEqual(sorted(os.listdir(self.folder.name)), ["part.3mf", "part.ply", "part.stl"])

    def test_images(self):
        made = self.filled()
        folder = self.path("images")
        self.assertEqual(export.save_images(made, folder, 0.25, 0.125), 40)
        files = sorted(glob.glob(os.path.join(folder, "*")))
        self.assertEqual(len(files), 40)
        solid = filling.recipe_of(made)().slicer(layer_height=0.25, pitch=0.125)
        for number in (0, 17, 39):
            pixels = np.asarray(Image.open(files[number]).convert("L"))
            np.testing.assert_array_equal(pixels[::-1] == 255, solid[number].pixels)
        with self.assertRaises(FileExistsError):
            export.save_images(made, folder, 0.25, 0.125)
        self.assertEqual(os.listdir(self.folder.name), ["images"])

    def test_an_archive(self):
        try:
            importlib.import_module("msq.io")
        except ImportError as error:
            self.skipTest(str(error))
        made = self.filled()
        path = self.path("part.sl1")
        panel = {"pixels": (250, 160), "size": (25.0, 16.0)}
        self.assertEqual(export.save_sl1(made, path, 0.5, **panel), 20)
        with zipfile.ZipFile(path) as archive:
            images = [name for name in archive.namelist() if re.fullmatch(r"part\d+\.png", name)]
            self.assertEqual(len(images), 20)
            self.assertIn("layerHeight = 0.5", archive.read("config.ini").decode())
            image = np.asarray(Image.open(io.BytesIO(archive.read(images[10]))))
        self.assertEqual(image.shape, (250, 160))  # portrait: x runs along columns
        # Of the part in the middle of the panel: as much as the filling there.
        solid = filling.recipe_of(made)().slicer(layer_height=0.5, pitch=0.1)[10].pixels.mean()
        self.assertAlmostEqual(image.mean() / 255 * 250 * 160 / (200 * 150), solid, delta=0.01)
        with self.assertRaisesRegex(ValueError, "must end in .sl1"):
            export.save_sl1(made, self.path("part.zip"), 0.5)
        self.assertEqual(os.listdir(self.folder.name), ["part.sl1"])

    # What goes wrong

    def test_errors_are_shown(self):
        made = self.filled()
        facets = made.PreviewFacets
        for name, value, message in (("CellSize", 0.0, "cell"), ("Deflection", 0.0, "Deflection is 0 mm"),
                                     ("Source", None, "Source is empty")):
            with self.subTest(name=name):
                before = getattr(made, name)
                setattr(made, name, value)
                self.document.recompute()
                self.assertIn("Invalid", made.State)
                self.assertIn(message, made.getStatusString())
                self.assertEqual(made.Mesh.CountFacets, facets)  # as it was
                setattr(made, name, before)
                self.document.recompute()
                self.check_solid(made)
        with self.assertRaisesRegex(ValueError, "must end in"):
            export.save_mesh(made, self.path("part.obj"))
        with self.assertRaises(FileNotFoundError):
            export.save_mesh(made, self.path("none/part.stl"))
        made.Source = self.document.addObject("App::FeaturePython", "Text")
        with self.assertRaisesRegex(ValueError, "neither a shape nor a mesh"):
            export.save_mesh(made, self.path("part.stl"))
        made.Source = self.solid(Part.makePlane(3, 3))
        with self.assertRaisesRegex(ValueError, "no solid"):
            export.save_mesh(made, self.path("part.stl"))
        self.assertEqual(os.listdir(self.folder.name), [])

    def cancelled(self, work):
        """Does work and cancels it as soon as msq computes."""
        stop = threading.Event()

        def poll():
            while not stop.wait(0.002) and not waiting.cancel():
                pass

        thread = threading.Thread(target=poll)
        thread.start()
        try:
            work()
        finally:
            stop.set()
            thread.join()

    def test_cancel(self):
        made = self.filled()
        facets = made.PreviewFacets
        made.Source.Shape = Part.makeBox(80, 80, 80)
        made.CellSize, made.Radius, made.PreviewPitch = 2.0, 0.3, 0.1  # some minutes
        self.cancelled(self.document.recompute)
        self.assertFalse(made.isValid())
        self.assertIn("cancel", made.getStatusString())
        self.assertEqual(made.Mesh.CountFacets, facets)
        for name in ("part.stl", "part.ply", "part.3mf"):
            with self.assertRaises(msq.CancelledError):
                self.cancelled(lambda name=name: export.save_mesh(made, self.path(name), 0.05))
        with self.assertRaises(msq.CancelledError):
            self.cancelled(lambda: export.save_images(made, self.path("images"), 0.05, 0.02))
        self.assertEqual(os.listdir(self.folder.name), [])
        self.assertFalse(waiting.cancel())


def main():
    try:
        found = unittest.defaultTestLoader.loadTestsFromTestCase(Workbench)
        only = os.environ.get("MSQ_FREECAD_TEST")
        if only:
            found = unittest.TestSuite([test for test in found if only in test.id()])
        return 0 if unittest.TextTestRunner(verbosity=2).run(found).wasSuccessful() else 1
    except BaseException:
        traceback.print_exc()
        return 1


sys.exit(main())
