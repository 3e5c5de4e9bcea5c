# SPDX-License-Identifier: Apache-2.0
"""Exceptions with the messages of C, lifetimes, threads, jobs and interrupts."""
import copy
import errno
import gc
import os
import pathlib
import pickle
import signal
import sys
import tempfile
import threading
import time
import unittest
import warnings
from unittest import mock

import numpy as np

import msq
from msq import _handle
from msq._library import lib
from support import SOURCE, box_model, random_points

CUBE = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
FACES = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7),
         (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]


class Exceptions(unittest.TestCase):
    def test_have_the_message_and_a_kind_for_each_status(self):
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        tight = msq.Context(memory_limit=1000)
        cases = [
            (msq.ArgumentError, "radius", lambda: msq.Shape.sphere((0, 0, 0), -1)),
            (ValueError, "radius", lambda: msq.Shape.sphere((0, 0, 0), float("nan"))),
            (msq.ArgumentError, "min", lambda: msq.Shape.box((0, 0, 0), (1, -1, 1))),
            (msq.ArgumentError, "point 1",
             lambda: msq.Model(box).contains([(0, 0, 0), (0, 0, np.inf)])),
            (msq.ArgumentError, "character 5", lambda: msq.Functional(expression="sin(")),
            (msq.FileError, "nothing.stl", lambda: msq.Shape.from_file("/nothing.stl")),
            (OSError, "nothing.stl", lambda: msq.Shape.from_file(pathlib.Path("/nothing.stl"))),
            (msq.UnsupportedError, "", lambda: msq.Shape.from_file(__file__)),
            (msq.MeshError, "8", lambda: msq.Shape.from_mesh(CUBE, [(0, 1, 8)])),
            (msq.LimitError, "1000", lambda: msq.Model(box, context=tight).slicer(
                layer_height=0.01, pitch=0.01).layer(0)),
            (msq.LimitError, "radius", lambda: msq.Foam(radius=3)),
            (msq.ArgumentError, "radius", msq.Foam),
            (msq.LimitError, "wall_thickness reaches 3", lambda: msq.Foam(wall_thickness=3)),
            (msq.ArgumentError, "without wall_thickness",
             lambda: msq.Foam(radius=0.1, vent_radius=0.1)),
        ]
        if not msq.build_info().with_assimp:
            cases = [case for case in cases if case[0] not in (msq.FileError, OSError)]
        for kind, text, call in cases:
            with self.assertRaisesRegex(kind, text) as caught:
                call()
            self.assertIsInstance(caught.exception, msq.Error)
            self.assertEqual(type(caught.exception).status, caught.exception.status)

    def test_of_python_come_before_c(self):
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        for kind, text, call in (
                (ValueError, "'cubic', 'bcc'", lambda: msq.Lattice("bbc", radius=1)),
                (ValueError, "'network', 'sheet'", lambda: msq.Functional("gyroid", kind="x")),
                (ValueError, "one of", lambda: msq.Lattice("custom cell", radius=1)),
                (ValueError, "threads", lambda: msq.Context(threads=2**32)),
                (ValueError, "seed", lambda: msq.Foam(radius=0.1, seed=-1)),
                (ValueError, "3", lambda: msq.Shape.sphere((1, 2), 1)),
                (ValueError, "rotation", lambda: msq.Foam(radius=0.1, rotation=np.eye(2))),
                (ValueError, "whole", lambda: msq.Shape.from_mesh(CUBE, [(0, 1, -1)])),
                (ValueError, "whole", lambda: msq.Shape.from_mesh(CUBE, [(0, 1, 2.5)])),
                (TypeError, "Structure", lambda: msq.Model(box, [box])),
                (TypeError, "Shape", lambda: msq.Model(msq.Foam(radius=0.1))),
                (TypeError, "Job", lambda: msq.Model(box).contains([(0, 0, 0)], job=1)),
                (TypeError, "one of the two", lambda: msq.Functional("gyroid", expression="x")),
                (TypeError, "made by", msq.Shape), (TypeError, "made by", msq.Field),
                (ValueError, "counts", lambda: msq.Model(box).contains(
                    msq.PointGrid((0, 0, 0), 1, (1, 1, -1))))):
            with self.assertRaisesRegex(kind, text):
                call()

    def test_are_in_words_of_python(self):
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        graded = msq.Field.gradient((0, 0, 0), 1, (1, 0, 0), 9)
        for text, call in (
                ("^cell_size is 0;", lambda: msq.Lattice(cell_size=0, radius=1)),
                ("^the number of scales is 65;",
                 lambda: msq.Model(box, [msq.Lattice(radius=0.1)] * 64)),
                ("must be 'auto' or 'direct'",
                 lambda: msq.Foam(radius=0.1, density=graded, method="point"))):
            with self.assertRaisesRegex(msq.Error, text):
                call()

    def test_fields_stand_where_the_readme_says(self):
        field = msq.Field.gradient((0, 0, 0), 0.125, (1, 0, 0), 0.25)
        steel = msq.Material(1, density=field)
        for make in (lambda: msq.Lattice(radius=field), lambda: msq.Foam(radius=field, density=field),
                     lambda: msq.Foam(wall_thickness=field),
                     lambda: msq.Foam(wall_thickness=0.1, vent_radius=field),
                     lambda: msq.Functional("gyroid", level=field),
                     lambda: msq.Functional("gyroid", kind="sheet", thickness=field),
                     lambda: msq.Lattice(["bcc", "cubic"], cell_choice=field, radius=0.1),
                     lambda: msq.Scale(msq.Foam(radius=0.1), skin=field),
                     lambda: msq.Material.blend(2, steel, steel, field)):
            make()
        for make in (lambda: msq.Foam(radius=0.1, jitter=field),
                     lambda: msq.Foam(radius=0.1, cell_size=field),
                     lambda: msq.Shape.voxels(np.ones((2, 2, 2)), field),
                     lambda: msq.Functional(expression="x + a", parameters={"a": field}),
                     lambda: msq.UnitCell("bcc", strut_factors=[field] * 8)):
            with self.assertRaises(TypeError):
                make()

    def test_walls_close_the_cells_of_a_foam(self):
        box = msq.Shape.box((0, 0, 0), (4, 4, 4))
        points = msq.PointGrid((0.1, 0.1, 0.1), 0.2, (19, 19, 19))
        struts, walls, both = (
            np.asarray(msq.Model(box, [msq.Foam(**sizes)]).contains(points)).astype(bool)
            for sizes in ({"radius": 0.12}, {"wall_thickness": 0.1},
                          {"radius": 0.12, "wall_thickness": 0.1}))
        self.assertTrue(np.array_equal(both, struts | walls))
        self.assertTrue(walls.any() and (struts & ~walls).any() and not both.all())
        open_walls = msq.Foam(wall_thickness=0.1, vent_radius=0.2)
        vented = np.asarray(msq.Model(box, [open_walls]).contains(points)).astype(bool)
        self.assertTrue((walls & ~vented).any() and not (vented & ~walls).any())

    def test_triangles_of_any_whole_type_are_one_mesh(self):
        for dtype in (np.uint32, np.int64, np.uint8, np.float64):
            faces = np.array(FACES, dtype=dtype)
            self.assertEqual(msq.Shape.from_mesh(CUBE, faces).info.volume, 1)
            self.assertEqual(msq.Shape.from_mesh(CUBE, np.asfortranarray(faces)).info.volume, 1)

    def test_messages_belong_to_threads(self):
        texts = {}

        def fail(number):
            for _ in range(50):
                try:
                    msq.Shape.sphere((0, 0, 0), -number)
                except msq.ArgumentError as error:
                    texts.setdefault(number, set()).add(str(error))

        threads = [threading.Thread(target=fail, args=(number,)) for number in range(1, 9)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for number in range(1, 9):
            self.assertEqual(len(texts[number]), 1)
            self.assertIn(f"-{number}", texts[number].pop())


class Lifetimes(unittest.TestCase):
    def count_releases(self, kind):
        """Replaces msq_<kind>_release of objects made from now on by one that counts."""
        real, released = getattr(lib, f"msq_{kind}_release"), []

        def release(pointer):
            released.append(pointer)
            real(pointer)

        patch = mock.patch.object(lib, f"msq_{kind}_release", release)
        patch.start()
        self.addCleanup(patch.stop)
        return released

    def test_release_follows_the_last_reference(self):
        released = self.count_releases("model")
        model = box_model()
        again = model
        del model
        self.assertEqual(released, [])
        del again
        self.assertEqual(len(released), 1)
        with box_model() as model:
            self.assertFalse(model.closed)
        self.assertEqual(len(released), 2)
        self.assertTrue(model.closed)
        model.close()
        self.assertEqual(len(released), 2)
        with self.assertRaisesRegex(ValueError, "this Model is closed"):
            model.contains([(1, 1, 1)])

    def test_what_is_built_outlives_what_it_is_built_from(self):
        context = msq.Context(threads=1)
        before = context.memory.bytes
        points = random_points(2000)
        expected = box_model().contains(points)
        model = box_model(context=context)
        slicer = model.slicer(layer_height=0.5, pitch=0.25)
        layers = iter(slicer)
        first = next(layers)
        self.assertTrue(np.array_equal(model.contains(points), expected))
        model.close()
        slicer.close()
        self.assertGreater(first.inside_count, 0)
        slicer = box_model(context=context).slicer(layer_height=0.5, pitch=0.25)
        context.clear_cache()
        with slicer:
            self.assertGreater(slicer[3].inside_count, 0)
        mesh = msq.Shape.from_mesh(CUBE, FACES, context=context)
        self.assertGreater(context.memory.bytes, before)
        model = msq.Model(mesh)
        mesh.close()
        self.assertTrue(model.contains((0.5, 0.5, 0.5)))
        model.close()
        del mesh, model, slicer, layers
        gc.collect()
        context.clear_cache()
        self.assertEqual(context.memory.bytes, before)

    def test_closing_within_a_call_is_safe(self):
        model = box_model()
        slicer = model.slicer(layer_height=0.25, pitch=0.125, slab_layers=2)
        seen = []

        def take(layer):
            slicer.close()
            model.close()
            gc.collect()
            seen.append(layer.inside_count)

        self.assertTrue(slicer.run(take))
        self.assertEqual(len(seen), 16)

        model, job, ended = slow_model(), msq.Job(), []

        def work():
            try:
                model.distance(slow_points(), job=job)
            except msq.CancelledError as error:
                ended.append(error)

        thread = threading.Thread(target=work)
        thread.start()
        while job.progress == 0 and thread.is_alive():
            time.sleep(0.001)
        model.close()
        gc.collect()
        job.cancel()
        thread.join()
        self.assertEqual(len(ended), 1)

    def test_nothing_is_leaked_by_failures_and_calls(self):
        made, dropped = [], []

        class Counted(_handle.Reference):
            def __init__(self, *arguments):
                made.append(1)
                super().__init__(*arguments)

            def __del__(self):
                dropped.append(1)
                super().__del__()

        msq.Foam(radius=0.1)  # in the context that all share
        with mock.patch.object(_handle, "Reference", Counted):
            for _ in range(20):
                model = box_model()
                model.contains(random_points(100))
                for layer in model.slicer(layer_height=1, pitch=0.5):
                    self.assertEqual(layer.rows.dtype, np.uint8)
                with self.assertRaises(msq.ArgumentError):
                    msq.Foam(radius=-1)
                with self.assertRaises(ZeroDivisionError):
                    model.slicer(layer_height=1, pitch=0.5).run(lambda layer: 1 // 0)
            del model
            gc.collect()
        self.assertGreater(len(made), 99)
        self.assertEqual(len(dropped), len(made))

    def test_arrays_are_held_no_longer_than_the_call(self):
        points = random_points(50000)
        model = box_model()
        count = sys.getrefcount(points)
        out = model.contains(points)
        model.distance(points[:100])
        gc.collect()
        self.assertEqual(sys.getrefcount(points), count)
        self.assertLessEqual(sys.getrefcount(out), 2)

    def test_contexts_are_shared_by_what_is_built(self):
        context = msq.Context()
        box = msq.Shape.box((0, 0, 0), (1, 1, 1), context=context)
        field = msq.Field.gradient((0, 0, 0), 0.1, (1, 0, 0), 0.2, context=context)
        self.assertIs(msq.Foam(radius=field).context, context)
        self.assertIs(msq.Model(box).context, context)
        self.assertIsNot(msq.Foam(radius=0.1).context, context)
        self.assertIs(msq.Foam(radius=0.1).context, msq.Shape.box((0, 0, 0), (1, 1, 1)).context)
        self.assertEqual(context.cache.hits, 0)
        self.assertEqual(msq.Context(memory_limit=12345678).memory.limit_bytes, 12345678)
        self.assertEqual(msq.Context(cache_bytes=12345).cache.limit_bytes, 12345)
        self.assertEqual(msq.Context(cache_policy="segmented").cache.cells, 0)
        with self.assertRaisesRegex(ValueError, "cache_policy"):
            msq.Context(cache_policy="lifo")

    def test_objects_keep_a_context_that_is_closed(self):
        with msq.Context(threads=1) as context:
            box = msq.Shape.box((0, 0, 0), (4, 4, 4), context=context)
            foam = msq.Foam(radius=0.1, context=context)
            field = msq.Field.gradient((0, 0, 0), 1, (4, 0, 0), 2, context=context)
            walls = msq.Functional("gyroid", kind="sheet", thickness=0.1, context=context)
            with self.assertRaisesRegex(AttributeError, "context cannot be set: a Foam is immutable"):
                foam.context = context
        with self.assertRaisesRegex(ValueError, "this Context is closed"):
            context.memory
        self.assertGreater(foam.onset((1, 1, 1)), 0)
        self.assertGreater(len(foam.strut_graph((0, 0, 0), (2, 2, 2))), 0)
        sample = msq.Stratified((0, 0, 0), 1, (2, 2, 2), 64)
        self.assertGreater(foam.calibrate(0.1, sample=sample).parameter, 0)
        self.assertEqual(field.evaluate((2.0, 0, 0)), 1.5)
        self.assertGreater(walls.fill_cell_size(0.4, 0.2)[0], 0)
        self.assertGreater(len(walls.fill_lines([(0, 0), (40, 0), (40, 40)], 0.5, scale=0.1)), 0)
        for made in (box, msq.Model(box, [foam]), foam | walls, msq.Foam(radius=field, cell_size=4)):
            self.assertEqual(made.context.threads, 1)


class Refused(unittest.TestCase):
    """Messages name the argument."""

    def test_arguments(self):
        box = msq.Shape.box((0, 0, 0), (4, 4, 4))
        foam = msq.Foam(radius=0.1, cell_size=np.array(2.0))
        walls = msq.Functional("gyroid", kind="sheet", thickness=0.1)
        grid = msq.PointGrid((0, 0, 0), 1, (3, 4, 5))
        self.assertEqual(grid.coordinates(60).shape, (0, 3))
        model = msq.Model(box)
        cube = [(1 + 0j, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0)]
        for error, message, call in (
                (TypeError, "warp is a int; it must be a Warp or a SampledWarp",
                 lambda: msq.Foam(radius=0.1, warp=7)),
                (TypeError, "u of the warp is a int; it must be a Field",
                 lambda: msq.Foam(radius=0.1, warp=msq.SampledWarp(1, 2, 3))),
                (TypeError, "period is a int; it must be a Period",
                 lambda: msq.Foam(radius=0.1, period=7)),
                (TypeError, "shape is a NoneType; it must be a Shape",
                 lambda: msq.Field.shape_distance(None, [(0, 0), (1, 1)])),
                (TypeError, "cell_size is None; it must be a number or three numbers",
                 lambda: msq.Foam(radius=0.1, cell_size=None)),
                (ValueError, "min has 2 numbers; it must have 3",
                 lambda: foam.strut_graph((0, 0), (4, 4))),
                (TypeError, "shape is a int; it must be a Shape",
                 lambda: foam.strut_graph((0, 0, 0), (4, 4, 4), shape=1)),
                (ValueError, "origin has 1 numbers; it must have 2",
                 lambda: walls.fill_lines([(0, 0), (9, 0), (9, 9)], 1, origin=(1,))),
                (ValueError, "first is 61; there are 60 points", lambda: grid.coordinates(61)),
                (ValueError, "output is 'channel'; it must be one of bits, .*, onset, or a list",
                 lambda: model.slicer(layer_height=1, pitch=1, output="channel")),
                (TypeError, "cell_size is .*; it must be a number or three",
                 lambda: msq.Foam(radius=0.1, cell_size=np.array([1, 2, 3j]))),
                (TypeError, "radius is a complex; it must be a number",
                 lambda: msq.Foam(radius=1j)),
                (TypeError, "matrix is complex; it must be real", lambda: box.placed(cube)),
                (TypeError, "layer_z is complex", lambda: model.slicer(layer_z=[1j], pitch=1)),
                (TypeError, "positions is complex",
                 lambda: msq.Foam(radius=0.1, period=msq.Period([0, 1j], [1, 2]))),
                (TypeError, "t_max is complex",
                 lambda: model.cast((0.0, 0, 0), (1.0, 0, 0), t_max=1j))):
            with self.assertRaisesRegex(error, message):
                call()


class Copies(unittest.TestCase):
    def test_share_the_object_or_are_refused_in_plain_words(self):
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        foam = msq.Foam(radius=0.2)
        with warnings.catch_warnings(record=True), mock.patch.object(sys, "unraisablehook") as hook:
            for handle in (box, foam, msq.Model(box), msq.Context(), msq.Job(),
                           msq.Field.gradient((0, 0, 0), 0, (0, 0, 1), 1)):
                for refused in (pickle.dumps, copy.deepcopy):
                    with self.assertRaisesRegex(TypeError, type(handle).__name__ + " objects can"):
                        refused(handle)
            gc.collect()
            hook.assert_not_called()
        shared = copy.copy(box)
        box.close()
        self.assertEqual(shared.info.max, (1, 1, 1))
        self.assertTrue(msq.Model(shared).contains((0.5, 0.5, 0.5)))


class Files(unittest.TestCase):
    def test_errors_are_those_of_python(self):
        with tempfile.TemporaryDirectory() as folder:
            bad = pathlib.Path(folder) / "bad.off"
            bad.write_text("OFF\n3 1 0\n0 0\n")
            missing = pathlib.Path(folder) / "missing.off"
            for path, kind, number in ((missing, FileNotFoundError, errno.ENOENT),
                                       (folder, IsADirectoryError, errno.EISDIR),
                                       (bad, msq.FileError, None)):
                with self.assertRaises(kind) as caught:
                    msq.Shape.from_file(path, format="off")
                error = caught.exception
                self.assertIsInstance(error, msq.FileError)
                self.assertEqual((error.errno, error.filename), (number, os.fspath(path)))
                self.assertTrue(str(error).startswith(os.fspath(path)), str(error))
                again = pickle.loads(pickle.dumps(error))
                self.assertEqual((type(again), str(again)), (type(error), str(error)))


class Meshes(unittest.TestCase):
    def test_from_arrays_of_any_kind(self):
        points = random_points(2000) / 8
        expected = ((points > 0) & (points < 1)).all(axis=1)
        padded = np.zeros((8, 5), np.float32)
        padded[:, 1:4] = CUBE
        for vertices in (CUBE, np.array(CUBE, np.float64), padded[:, 1:4]):
            for faces in (FACES, np.array(FACES, np.uint32), np.array(FACES, np.int64).T.copy().T):
                shape = msq.Shape.from_mesh(vertices, faces)
                self.assertTrue(np.array_equal(msq.Model(shape).contains(points), expected))
        info = shape.info
        self.assertTrue(info.is_mesh and info.closed)
        self.assertEqual((info.volume, info.area, info.vertices, info.triangles), (1, 6, 8, 12))
        self.assertEqual((info.min, info.max), ((0, 0, 0), (1, 1, 1)))
        inside_out = msq.Shape.from_mesh(CUBE, np.array(FACES)[:, ::-1], winding="positive")
        self.assertLess(inside_out.info.volume, 0)
        self.assertFalse(msq.Model(inside_out).contains(points).any())
        if msq.build_info().with_cgal:
            self.assertEqual(shape.self_intersections(), 0)
            twice = msq.Shape.from_mesh(np.concatenate((CUBE, np.array(CUBE) + 0.5)),
                                        np.concatenate((FACES, np.array(FACES) + 8)))
            self.assertGreater(twice.self_intersections(), 0)

    def test_jobs_of_constructors(self):
        obj = ("".join("v %.17g %d %d\n" % (v[0] * 300.123456789, v[1], v[2]) for v in CUBE)
               + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in FACES)).encode()
        job = msq.Job()
        shape = msq.Shape.from_memory(obj, "obj", job=job)
        self.assertEqual((shape.info.max, job.progress), ((300.123456789, 1, 1), 1))
        curve = [(-1, 0), (1, 1)]
        for step in (0, 0.5):
            msq.Field.shape_distance(shape, curve, step=step * 100, job=job)
            self.assertEqual(job.progress, 1)
        job.cancel()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "cube.obj")
            path.write_bytes(obj)
            self.assertEqual(msq.Shape.from_file(path).info, shape.info)
            for call in (lambda: msq.Shape.from_file(path, job=job),
                         lambda: msq.Shape.from_memory(obj, "obj", job=job),
                         lambda: msq.Field.shape_distance(shape, curve, job=job),
                         lambda: msq.Field.shape_distance(shape, curve, step=50, job=job)):
                self.assertRaises(msq.CancelledError, call)
        with self.assertRaisesRegex(OSError, "line 9"):
            msq.Shape.from_memory(obj[:obj.index(b"f")] + b"f one", "obj")

    def test_from_files_and_memory(self):
        if not msq.build_info().with_assimp:
            self.skipTest("a build without mesh files")
        bracket = SOURCE / "examples" / "parts" / "bracket.stl"
        shape = msq.Shape.from_file(bracket)
        data = bracket.read_bytes()
        for bytes_ in (data, bytearray(data), np.frombuffer(data, np.uint8), memoryview(data)):
            self.assertEqual(msq.Shape.from_memory(bytes_, "stl").info, shape.info)
        inches = msq.Shape.from_file(str(bracket), unit_mm=25.4)
        self.assertAlmostEqual(inches.info.max[0], 25.4 * shape.info.max[0])
        with self.assertRaises(msq.LimitError):
            msq.Shape.from_file(bracket, max_bytes=100)
        with tempfile.TemporaryDirectory() as folder:
            odd = pathlib.Path(folder, "gr\u00f6\u00dfe \u2713.off")
            odd.write_text("OFF\n8 12 0\n" + "".join("%d %d %d\n" % v for v in CUBE)
                           + "".join("3 %d %d %d\n" % f for f in FACES))
            self.assertEqual(msq.Shape.from_file(odd).info.volume, 1)


class Threads(unittest.TestCase):
    def test_share_objects(self):
        model, points = box_model(), random_points(20000)
        slicer = model.slicer(layer_height=0.25, pitch=0.125)
        expected, bits = model.contains(points), [layer.rows for layer in slicer]
        wrong = []

        def work():
            for _ in range(3):
                if not np.array_equal(model.contains(points), expected):
                    wrong.append("points")
                if any(not np.array_equal(a.rows, b) for a, b in zip(slicer, bits)):
                    wrong.append("layers")

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_run_while_another_is_in_c(self):
        model = slow_model()
        ticks = []
        job = msq.Job()
        thread = threading.Thread(target=lambda: self.assertRaises(
            msq.CancelledError, model.distance, slow_points(), job=job))
        thread.start()
        while len(ticks) < 20:  # would wait for the call if it held the interpreter's lock
            ticks.append(thread.is_alive())
            time.sleep(0.001)
        job.cancel()
        thread.join()
        self.assertTrue(all(ticks))


def slow_model():
    """For distances of slow_points(), which take seconds."""
    box = msq.Shape.box((0, 0, 0), (8, 6, 4), context=msq.Context(threads=1))
    return msq.Model(box, msq.Foam(cell_size=0.5, radius=0.1))


def slow_points():
    return np.random.RandomState(1).rand(1000000, 3).astype(np.float32) * np.float32(4)


class Jobs(unittest.TestCase):
    def test_progress_and_cancel(self):
        job = msq.Job()
        self.assertEqual(job.progress, 0)
        model = box_model()
        model.contains(random_points(1000), job=job)
        self.assertEqual(job.progress, 1)
        slicer = model.slicer(layer_height=0.25, pitch=0.25, slab_layers=4)

        def take(layer):
            if layer.index == 5:
                job.cancel()

        with self.assertRaises(msq.CancelledError):
            slicer.run(take, job=job)
        for call in (lambda: model.contains(random_points(100000), job=job),
                     lambda: slicer.layer(0, job=job), lambda: list(slicer.layers(job=job)),
                     lambda: model.distance(random_points(10), job=job)):
            with self.assertRaises(msq.CancelledError):
                call()
        self.assertGreater(model.slicer(layer_height=1, pitch=1)[0].width, 0)

    def test_cancel_from_another_thread(self):
        job = msq.Job()
        timer = threading.Timer(0.1, job.cancel)
        timer.start()
        with self.assertRaises(msq.CancelledError):
            slow_model().distance(slow_points(), job=job)
        timer.join()
        self.assertLess(job.progress, 1)

    def test_interrupt_cancels_a_set_query(self):
        job = msq.Job()
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            slow_model().distance(slow_points(), job=job)
        timer.join()
        self.assertLess(job.progress, 1)

    def test_interrupt_stops_a_loop_over_layers(self):
        slicer = box_model().slicer(layer_height=0.004, pitch=0.01, slab_layers=4)
        timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        seen = 0
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(20):
                for _ in slicer:
                    seen += 1
        timer.join()


    def test_interrupt_stops_a_run(self):
        """Also where it comes while C computes: it is not lost at the callback's beginning."""
        slicer = box_model().slicer(layer_height=0.004, pitch=0.01, slab_layers=4)
        before = signal.getsignal(signal.SIGINT)
        for allowed in (False, True):
            seen = []

            def take(layer, allowed=allowed, seen=seen):
                seen.append(layer.index)
                if allowed and len(seen) == 3:
                    os.kill(os.getpid(), signal.SIGINT)
                    for _ in range(1000):
                        pass
                    seen.append("not reached")

            timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
            if not allowed:
                timer.start()
            with self.assertRaises(KeyboardInterrupt):
                for _ in range(20):
                    slicer.run(take)
            if not allowed:
                timer.join()
            self.assertNotIn("not reached", seen)
            self.assertIs(signal.getsignal(signal.SIGINT), before)

    def test_signals_that_raise_nothing_are_handled_meanwhile(self):
        slicer = box_model().slicer(layer_height=0.25, pitch=0.25)
        handled = []
        before = signal.signal(signal.SIGUSR1, lambda *_: handled.append(1))
        self.addCleanup(signal.signal, signal.SIGUSR1, before)
        self.assertTrue(slicer.run(lambda layer: os.kill(os.getpid(), signal.SIGUSR1)))
        self.assertEqual(len(handled), 16)


if __name__ == "__main__":
    unittest.main()
