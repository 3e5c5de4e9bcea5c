# SPDX-License-Identifier: Apache-2.0
"""Shapes and fields that are functions of Python."""
import gc
import os
import signal
import subprocess
import sys
import threading
import unittest
from unittest import mock

import numpy as np

import msq
import msq.model
from msq import _host
from support import random_points

CENTER = np.array((4.0, 3.0, 2.0))


def in_ball(points):
    return ((points - CENTER) ** 2).sum(axis=1) <= 9


def ball(**keywords):
    return msq.Shape.host(in_ball, CENTER - 3, CENTER + 3, **keywords)


def along_x(points):
    return 0.2 + 0.05 * np.clip(points[:, 0], 0, 4)


class Shapes(unittest.TestCase):
    def test_are_what_the_function_says(self):
        points = random_points(50000)
        for context in (msq.Context(threads=1), msq.Context(threads=2)):
            for concurrent in (False, True):
                model = msq.Model(ball(concurrent=concurrent, context=context))
                self.assertTrue(np.array_equal(model.contains(points), in_ball(points)))
                self.assertTrue(np.array_equal(model.contains(points[:100]), in_ball(points[:100])))
                self.assertTrue(model.contains(CENTER))
                slicer = model.slicer(layer_height=0.25, pitch=0.25)
                z, y, x = np.meshgrid([slicer.z(k) for k in range(len(slicer))],
                                      slicer.origin[1] + 0.25 * np.arange(slicer.height),
                                      slicer.origin[0] + 0.25 * np.arange(slicer.width),
                                      indexing="ij")
                expected = in_ball(np.stack((x, y, z), axis=-1).reshape(-1, 3)).reshape(x.shape)
                self.assertTrue(np.array_equal([layer.pixels for layer in slicer], expected))
                self.assertTrue(np.array_equal(slicer[7].pixels, expected[7]))

    def test_distances(self):
        exact = msq.Model(ball(distance=lambda p: np.linalg.norm(p - CENTER, axis=1) - 3))
        points = random_points(500)
        np.testing.assert_allclose(exact.distance(points),
                                   np.linalg.norm(points - CENTER, axis=1) - 3, atol=1e-9)
        self.assertTrue(np.isnan(ball().info.volume))


class Fields(unittest.TestCase):
    def model(self, radius):
        return msq.Model(msq.Shape.box((0, 0, 0), (8, 6, 4)), msq.Lattice("bcc", cell_size=2,
                                                                          radius=radius))

    def test_are_what_the_function_says(self):
        points = random_points(40000)
        expected = self.model(msq.Field.gradient((0, 0, 0), 0.2, (4, 0, 0), 0.4)).contains(points)

        def bounds(low, high):
            return along_x(np.array([low]))[0] - 1e-9, along_x(np.array([high]))[0] + 1e-9

        for field in (msq.Field.host(along_x, 0.2, 0.4),
                      msq.Field.host(along_x, 0.2, 0.4, lipschitz=0.05),
                      msq.Field.host(along_x, 0.2, 0.4, range=bounds, concurrent=True)):
            answers = self.model(field).contains(points)
            self.assertLess((answers != expected).sum(), 5)  # rounding of the two formulas
            self.assertGreater(answers.sum(), 100)

    def test_of_other_kinds(self):
        points = random_points(20000)
        x = np.clip(points[:, 0], 0, 8)
        grid = msq.Field.grid(np.array([[[0.1, 0.5]]]), spacing=(8, 1, 1))
        radial = msq.Field.radial((0, 0, 0), 0, 0.1, 8, 0.5, axis=(0, 0, 1))
        linear = msq.Field.gradient((0, 0, 0), 0, (8, 0, 0), 1)
        mapped = linear.map([(0, 0.1), (1, 0.5)])
        answers = self.model(grid).contains(points)
        self.assertLess((answers != self.model(mapped).contains(points)).sum(), 5)
        self.assertGreater(answers[x > 4].sum(), 2 * answers[x < 4].sum())
        self.assertGreater(self.model(radial).contains(points).sum(), 100)
        self.assertGreater(self.model(msq.Field.radial((1, 1, 1), 0, 0.2, 5, 0.4)).contains(
            points).sum(), 100)

    def test_of_images_are_passed_as_they_lie(self):
        generator = np.random.RandomState(3)
        points = random_points(5000)
        for dtype in (np.uint8, np.int16, np.uint16, np.float32, np.float64):
            values = generator.randint(1, 60, (7, 9, 11)).astype(dtype)
            layouts = [values[1:6, 2:8, 3:9], values[::2, ::3, :6], values[:1, :, :1], values]
            for part in layouts:
                models = [self.model(msq.Field.grid(array, spacing=1.5, origin=(0, 0.5, 0)).map(
                    [(0, 0), (60, 0.5)])) for array in (part, part.copy())]
                self.assertTrue(np.array_equal(models[0].contains(points),
                                               models[1].contains(points)))
            for bad in (values[:, ::-1], values[:, :, ::2], values.T, values.astype(">i8"),
                        values[0]):
                with self.assertRaises((ValueError, TypeError)):
                    msq.Field.grid(bad)


    def test_by_expression_and_distance(self):
        points = random_points(20000)
        typed = msq.Field.expression("a + 0.05 * x", 0.2, 0.4, parameters={"a": 0.2})
        expected = self.model(msq.Field.gradient((0, 0, 0), 0.2, (4, 0, 0), 0.4)).contains(points)
        self.assertLess((self.model(typed).contains(points) != expected).sum(), 5)
        ball_of_msq = msq.Shape.sphere((4, 3, 2), 1)
        near = msq.Field.shape_distance(ball_of_msq, [(0, 0.5), (2, 0.1)])
        radial = msq.Field.radial((4, 3, 2), 1, 0.5, 3, 0.1)
        self.assertLess((self.model(near).contains(points)
                         != self.model(radial).contains(points)).sum(), 5)
        with self.assertRaisesRegex(msq.ArgumentError, "character"):
            msq.Field.expression("x +", 0, 1)


class Structures(unittest.TestCase):
    """Of the host: balls of radius 0.4 in the middle of cells of size 1."""

    def setUp(self):
        self.shape = msq.Shape.box((0, 0, 0), (8, 6, 4))
        self.points = random_points(40000)
        middle = np.floor(self.points) + 0.5
        self.expected = (((self.points - middle) ** 2).sum(axis=1) <= 0.16) & msq.Model(
            self.shape).contains(self.points)

    def check(self, structure, expected):
        model = msq.Model(self.shape, structure)
        self.assertTrue(np.array_equal(model.contains(self.points), expected))
        self.assertTrue(np.array_equal(model.contains(self.points[:300]), expected[:300]))
        self.assertEqual([model.contains(p) for p in self.points[:50]], expected[:50].tolist())
        for layer in model.slicer(layer_height=1, pitch=0.25):
            self.assertGreater(layer.inside_count, 0)
        return model

    def test_by_points(self):
        seen = []

        def inside(points):
            seen.append(points.cells.dtype)
            if not np.array_equal(points.cells + points.positions, points.points):
                np.testing.assert_allclose(points.cells + points.positions, points.points)
            return ((points.positions - 0.5) ** 2).sum(axis=1) <= 0.16

        def box(low, high):
            low, high = np.array(low), np.array(high)
            middle = np.floor(low) + 0.5
            if (np.floor(high) + 0.5 != middle).any():
                return None
            if np.linalg.norm(np.clip(middle, low, high) - middle) > 0.41:
                return False
            farthest = np.maximum(np.abs(low - middle), np.abs(high - middle))
            return True if np.linalg.norm(farthest) < 0.39 else None

        def distance(points):
            return np.abs(np.linalg.norm(points.positions - 0.5, axis=1) - 0.4)

        for concurrent in (False, True):
            model = self.check(msq.HostStructure(inside, box=box, distance=distance,
                                                 concurrent=concurrent), self.expected)
            found = model.distance(self.points[:300])
            self.assertTrue(np.array_equal(found <= 0, self.expected[:300]))
        self.assertEqual(set(seen), {np.dtype(np.int32)})

    def test_by_cells(self):
        def build(cell):
            return np.array(cell, np.float64) + 0.5

        def evaluate(middle, points):
            return ((points.points - middle) ** 2).sum(axis=1) <= 0.16

        gc.collect()
        before = _host.count()
        context = msq.Context()
        model = self.check(msq.HostStructure(build_cell=build, evaluate_cell=evaluate,
                                             context=context), self.expected)
        self.assertGreater(_host.count(), before + 1)
        del model
        gc.collect()
        context.clear_cache()
        self.assertEqual(_host.count(), before)

    def test_by_a_function_of_angles(self):
        named = msq.Model(self.shape, msq.Functional("schwarz_p", level=0.3))
        expected = named.contains(self.points)
        ours = msq.HostFunctional(lambda angles: np.cos(angles).sum(axis=1), lipschitz=2, level=0.3)
        model = msq.Model(self.shape, ours)
        self.assertLess((model.contains(self.points) != expected).sum(), 5)
        sheet = msq.Model(self.shape, msq.Functional("gyroid", kind="sheet", thickness=0.2))
        sample = msq.Stratified((0, 0, 0), 0.25, (4, 4, 4), per_cell=50)
        self.assertAlmostEqual(sheet.volume_fraction(sample).value, 0.2 * 3.09, delta=0.05)

    def test_failures(self):
        def fail(*_arguments):
            raise LookupError("of cells")

        def good(points):
            return points.positions[:, 0] > 0.5

        for structure in (msq.HostStructure(fail), msq.HostStructure(good, box=fail),
                          msq.HostStructure(build_cell=fail, evaluate_cell=fail),
                          msq.HostStructure(build_cell=lambda cell: cell, evaluate_cell=fail)):
            model = msq.Model(self.shape, structure)
            with self.assertRaisesRegex(LookupError, "of cells"):
                model.contains(self.points)
                list(model.slicer(layer_height=1, pitch=0.25))
        kept = []
        model = msq.Model(self.shape, msq.HostStructure(
            lambda points: kept.append(points.cells) or good(points)))
        with self.assertRaisesRegex(BufferError, "keep a copy"):
            model.contains(self.points)
        with self.assertRaises(msq.ArgumentError):
            msq.HostStructure(build_cell=fail)


class Failures(unittest.TestCase):
    def test_exceptions_are_raised_as_they_are(self):
        class Own(Exception):
            pass

        def fail(points):
            raise Own("of host")

        for count in (100, 40000):
            for concurrent in (False, True):
                model = msq.Model(msq.Shape.host(fail, (0, 0, 0), (8, 6, 4), concurrent=concurrent))
                for call in (lambda: model.contains(random_points(count)),
                             lambda: list(model.slicer(layer_height=1, pitch=0.5)),
                             lambda: model.slicer(layer_height=1, pitch=0.5)[0],
                             lambda: model.slicer(layer_height=1, pitch=0.5).run(print),
                             lambda: model.contains((1, 1, 1))):
                    with self.assertRaisesRegex(Own, "of host"):
                        call()

    def test_answers_that_cannot_be(self):
        box = ((0, 0, 0), (8, 6, 4))
        kept = []
        for inside, kind, text in (
                (lambda p: p, ValueError, "shape"), (lambda p: None, ValueError, "shape"),
                (lambda p: [True], ValueError, r"\(100,\)"),
                (lambda p: kept.append(p) or p[:, 0] > 1, BufferError, "keep a copy")):
            model = msq.Model(msq.Shape.host(inside, *box))
            with self.assertRaisesRegex(kind, text):
                model.contains(np.full((100, 3), 1.0))
        shape = msq.Shape.box(*box)
        for values in (np.nan, 0.9, -1):
            field = msq.Field.host(lambda p, values=values: np.full(len(p), values), 0.1, 0.4)
            with self.assertRaises(msq.HostError) as caught:
                msq.Model(shape, msq.Functional("gyroid", level=field)).contains(random_points(100))
            self.assertEqual(caught.exception.code, 0)
        with self.assertRaises(msq.ArgumentError):
            msq.Field.host(along_x, 1, 0)
        with self.assertRaises(TypeError):
            msq.Field.host(3, 0, 1)

    def test_interrupts_are_not_lost(self):
        def inside(points):
            if len(asked) == 5:
                os.kill(os.getpid(), signal.SIGINT)
            asked.append(len(points))
            return points[:, 0] > 1

        model = msq.Model(msq.Shape.host(inside, (0, 0, 0), (8, 6, 4)))
        for count in (20000, 100000):
            asked = []
            with self.assertRaises(KeyboardInterrupt):
                for _ in range(20):
                    model.contains(random_points(count))

        def in_c(*_arguments):
            os.kill(os.getpid(), signal.SIGINT)
            for _ in range(100):  # as if C called back: this is where the handler runs
                asked.append("went on")

        asked = []
        with mock.patch.object(msq.model.lib, "msq_set_membership", in_c):
            with self.assertRaises(KeyboardInterrupt):
                model.contains(random_points(100))
        self.assertEqual(len(asked), 100)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)


class Lifetimes(unittest.TestCase):
    def test_functions_live_as_long_as_what_is_built_of_them(self):
        gc.collect()
        before = _host.count()
        radius = msq.Field.host(along_x, 0.2, 0.4)
        model = msq.Model(ball(), msq.Lattice(radius=radius))
        del radius
        self.assertEqual(_host.count(), before + 2)
        gc.collect()
        self.assertTrue(model.contains((4, 3, 2)))
        del model
        gc.collect()
        self.assertEqual(_host.count(), before)
        with self.assertRaises(msq.ArgumentError):
            msq.Shape.host(in_ball, (0, 0, 0), (0, 0, 0))
        self.assertEqual(_host.count(), before)

    def test_answers_that_are_neither_bools_nor_numbers(self):
        for answers, error in (([None], TypeError), (["no"], TypeError), ([1j], TypeError),
                               ([np.nan], ValueError), ([np.inf], ValueError)):
            shape = msq.Shape.host(lambda points, given=answers: given * len(points), (0, 0, 0),
                                   (8, 6, 4))
            with self.assertRaisesRegex(error, "<lambda> answered by values"):
                msq.Model(shape).contains((1, 1, 1))
        for answers in ([True], [np.uint8(2)], [-1], [0.5]):
            shape = msq.Shape.host(lambda points, given=answers: given * len(points), (0, 0, 0),
                                   (8, 6, 4))
            self.assertTrue(msq.Model(shape).contains((1, 1, 1)))

    def test_threads_share_them(self):
        points = random_points(20000)
        expected, wrong = in_ball(points), []
        for concurrent in (False, True):
            model = msq.Model(ball(concurrent=concurrent))

            def work(model=model):
                for _ in range(3):
                    wrong.extend([1] * (not np.array_equal(model.contains(points), expected)))

            threads = [threading.Thread(target=work) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
        self.assertEqual(wrong, [])

    def test_an_interpreter_ends_with_them_alive(self):
        program = ("import msq\n"
                   "shape = msq.Shape.host(lambda p: p[:, 0] > 1, (0, 0, 0), (8, 6, 4))\n"
                   "model = msq.Model(shape)\n"
                   "print(model.contains((2, 2, 2)))\n"
                   "cycle = [model]; cycle.append(cycle)")
        ended = subprocess.run([sys.executable, "-B", "-c", program], text=True, check=False,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "True\n", ""))

    def test_a_program_ends_while_threads_call_back(self):
        calls = {
            "run": "model.slicer(layer_height=.05, pitch=.01).run(lambda layer: began.set())",
            "layers": "began.set(), *model.slicer(layer_height=.05, pitch=.01)",
            "mesh": "began.set(), model.mesh(.05)",
            "render": "model.render(width=500, height=500, first_step=16,"
                      " on_pass=lambda picture, step: began.set())",
            "host": "msq.Model(box, host(False)).contains(points)",
            "concurrent": "msq.Model(box, host(True)).contains(points)",
            "point": "began.set(), msq.Model(box, host(False)).contains(points[0])",
        }
        program = ("import msq, numpy, threading\n"
                   "began = threading.Event()\n"
                   "context = msq.Context(threads=2, beyond_cores=True)\n"
                   "box = msq.Shape.box((0, 0, 0), (10, 10, 10), context=context)\n"
                   "model = msq.Model(box, msq.Foam(radius=.1, context=context))\n"
                   "points = numpy.random.rand(200000, 3) * 10\n"
                   "def inside(points):\n"
                   "    began.set()\n"
                   "    return numpy.linalg.norm(points.positions - .5, axis=1) < .4\n"
                   "def host(concurrent):\n"
                   "    return msq.HostStructure(inside, concurrent=concurrent, context=context)\n"
                   "def work():\n"
                   "    while True: {}\n"
                   "threading.Thread(target=work, daemon=True).start()\n"
                   "began.wait()\n"
                   "print('end')")
        for name, call in calls.items():
            with self.subTest(name):
                ended = subprocess.run([sys.executable, "-B", "-c", program.format(call)], text=True,
                                       check=False, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.assertEqual((ended.returncode, ended.stdout), (0, "end\n"), ended.stderr)

    def test_calls_at_the_end_of_a_program(self):
        program = ("import atexit\n"
                   "def last():\n"
                   "    try: model.contains((2, 2, 2))\n"
                   "    except msq.CancelledError as error: print(error)\n"
                   "atexit.register(last)\n"
                   "import msq\n"
                   "atexit.register(lambda: print(model.contains((2, 2, 2))))\n"
                   "model = msq.Model(msq.Shape.host(lambda p: p[:, 0] > 1, (0, 0, 0), (8, 6, 4)))")
        ended = subprocess.run([sys.executable, "-B", "-c", program], text=True, check=False,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertRegex(ended.stdout, "^True\nthe program ends, ")


class Parts(unittest.TestCase):
    """Skins and unit cells."""

    def test_skins(self):
        shape = msq.Shape.box((0, 0, 0), (8, 6, 4))
        lattice = msq.Lattice(radius=0.1, cell_size=2)
        points = random_points(5000)
        depth = np.minimum(points, (8, 6, 4) - points).min(axis=1)
        model = msq.Model(shape, [msq.Scale(lattice, skin=0.5)])
        bare = msq.Model(shape, lattice).contains(points)
        skin = (depth >= 0) & (depth <= 0.5)
        self.assertTrue(np.array_equal(model.contains(points), bare | skin))
        graded = msq.Scale(lattice, msq.Field.gradient((0, 0, 0), 0, (8, 0, 0), 1))
        self.assertGreater(msq.Model(shape, graded).contains(points).sum(), bare.sum())
        with self.assertRaisesRegex(msq.ArgumentError, "skin"):
            msq.Model(shape, msq.Scale(lattice, skin=-1))

    def test_unit_cells(self):
        bcc = msq.UnitCell("bcc")
        self.assertTrue(bcc.info.is_periodic)
        nodes, struts = bcc.geometry()
        self.assertEqual((len(nodes), len(struts)), (bcc.info.node_count, bcc.info.strut_count))
        self.assertEqual(len(bcc.unmatched), 0)
        own = msq.UnitCell(nodes=nodes, struts=struts, strut_factors=[2.0] * len(struts))
        points = random_points(3000)
        box = msq.Shape.box((0, 0, 0), (4, 4, 4))
        thick = msq.Model(box, msq.Lattice("bcc", radius=0.2)).contains(points)
        for cell in (own, msq.UnitCell("bcc", strut_factors=np.full(len(struts), 2.0))):
            model = msq.Model(box, msq.Lattice(cell, radius=0.1))
            self.assertTrue(np.array_equal(model.contains(points), thick))
        odd = msq.UnitCell(nodes=[(0, 0.5, 0.5), (0.5, 0.5, 0.5)], struts=[(0, 1)])
        self.assertFalse(odd.info.is_periodic)
        self.assertEqual(odd.unmatched.tolist(), [0])
        with self.assertRaises(ValueError):
            msq.UnitCell(nodes=nodes, struts=struts, strut_factors=[1.0])
        with self.assertRaises(TypeError):
            msq.UnitCell("bcc", nodes=nodes, struts=struts)

    def test_libraries_of_unit_cells(self):
        choice = msq.Field.gradient((0, 0, 0), 0, (8, 0, 0), 1)
        lattice = msq.Lattice(["cubic", "bcc"], cell_choice=choice, radius=0.2, cell_size=1)
        found = lattice.faces((0, 0, 0), (8, 6, 4))
        self.assertEqual((found.cells, found.faces), (8 * 6 * 4, 6 * 4))
        self.assertEqual(found.unmatched == 0, found.axis == -1)
        box = msq.Shape.box((0, 0, 0), (8, 6, 4))
        points = random_points(5000)
        mixed = msq.Model(box, lattice).contains(points)
        for name, part in (("cubic", points[:, 0] < 3), ("bcc", points[:, 0] > 5)):
            alone = msq.Model(box, msq.Lattice(name, radius=0.2, cell_size=1)).contains(points)
            self.assertTrue(np.array_equal(mixed[part], alone[part]))


if __name__ == "__main__":
    unittest.main()
