# SPDX-License-Identifier: Apache-2.0
"""Sets of points: the answers of C, out of and into the arrays of the caller."""
import ctypes
import dataclasses
import os
import subprocess
import unittest
from unittest import mock

import numpy as np

import msq
import msq.model
from msq._arrays import triples
from support import box_model, random_points, reference_model


class Answers(unittest.TestCase):
    def test_are_those_of_c(self):
        points = random_points(40000)
        printed = subprocess.run([os.environ["MSQ_REFERENCE"], str(len(points))], check=True,
                                 input=points.tobytes(), stdout=subprocess.PIPE).stdout
        inside = np.frombuffer(printed[:len(points)], np.bool_)
        distance = np.frombuffer(printed[len(points):], np.float64)
        model = reference_model()
        self.assertTrue(np.array_equal(model.contains(points), inside))
        self.assertTrue(np.array_equal(model.distance(points), distance))
        self.assertTrue(200 < inside.sum() < 20000, inside.sum())
        for i in range(0, len(points), 1000):
            self.assertIs(model.contains(points[i]), bool(inside[i]))
            self.assertEqual(model.distance(tuple(points[i])), distance[i])

    def test_are_those_of_closed_forms(self):
        points = random_points(5000)
        center, radius = np.array((1.0, 2.0, 3.0)), 4.0
        ball = msq.Model(msq.Shape.sphere(center, radius))
        expected = np.linalg.norm(points - center, axis=1) - radius
        clear = np.abs(expected) > 1e-9
        self.assertTrue(np.array_equal(ball.contains(points)[clear], expected[clear] <= 0))
        np.testing.assert_allclose(ball.distance(points), expected, atol=1e-9)
        box = box_model(foam=False)
        self.assertTrue(np.array_equal(box.contains(points),
                                       ((points >= 0) & (points <= (8, 6, 4))).all(axis=1)))

    def test_have_the_shape_of_the_points(self):
        model = box_model()
        points = random_points(240).reshape(2, 4, 30, 3)
        flat = model.contains(points.reshape(-1, 3))
        self.assertEqual(model.contains(points).shape, (2, 4, 30))
        self.assertTrue(np.array_equal(model.contains(points).ravel(), flat))
        self.assertEqual(model.contains(points[:, :0]).shape, (2, 0, 30))
        self.assertEqual(model.distance(np.empty((0, 3))).shape, (0,))
        self.assertEqual(model.contains([(1, 1, 1), (9, 9, 9)]).tolist()[1], False)
        self.assertIsInstance(model.contains((1, 1, 1)), bool)
        self.assertIsInstance(model.distance((1, 1, 1)), float)
        self.assertEqual(model.contains(np.ones((1, 1, 3))).shape, (1, 1))

    def test_of_grids_are_those_of_their_points(self):
        model = reference_model()
        grid = msq.PointGrid(origin=(-6, -5, 0.125), spacing=(0.5, 0.75, 1), counts=(25, 17, 9))
        z, y, x = np.meshgrid(np.arange(9), np.arange(17), np.arange(25), indexing="ij")
        points = np.array(grid.origin) + np.stack((x, y, z), axis=-1) * np.array(grid.spacing)
        for ask in (model.contains, model.distance):
            answers = ask(grid)
            self.assertEqual(answers.shape, (9, 17, 25))
            self.assertTrue(np.array_equal(answers, ask(points)))
        self.assertTrue(model.contains(grid).any())
        small = msq.PointGrid((0, 0, 0), 0.5, (3, 4, 5))
        self.assertEqual(model.contains(small).T.shape, small.counts)

    def test_of_windows_are_those_of_the_grid(self):
        model = reference_model()
        grid = msq.PointGrid(origin=(-6.1, -5.1, 0.1), spacing=0.1, counts=(125, 101, 90))
        whole = model.contains(grid)
        self.assertTrue(whole.any() and not whole.all())
        part = dataclasses.replace(grid, window=((17, 3, 41), (100, 98, 7)))
        there = np.s_[41:48, 3:101, 17:117]
        self.assertEqual(part.shape, (7, 98, 100))
        self.assertTrue(np.array_equal(model.contains(part), whole[there]))
        self.assertTrue(np.array_equal(part.coordinates().reshape(7, 98, 100, 3),
                                       grid.coordinates().reshape(90, 101, 125, 3)[there]))
        for window in (((17, 3, 41), (109, 1, 1)), ((0, 0, 90), (1, 1, 1)), ((0, 0, 1), (1, 1, 0))):
            with self.assertRaisesRegex(msq.ArgumentError, "window"):
                dataclasses.replace(grid, window=window).coordinates(0, 1)
        for window in (((0, 0), (1, 1)), ((0, 0, 0), (0, 0, 0)), ((-1, 0, 0), (1, 1, 1))):
            with self.assertRaises((ValueError, OverflowError)):
                dataclasses.replace(grid, window=window).coordinates(0, 1)
        with self.assertRaisesRegex(ValueError, "window has 6 parts; it must have 2"):
            dataclasses.replace(grid, window=(0, 0, 0, 1, 1, 1)).coordinates(0, 1)
        with self.assertRaisesRegex(ValueError, "counts has 2 numbers; it must have 3"):
            msq.PointGrid((0, 0, 0), 0.5, (3, 4)).coordinates(0, 1)

    def test_parameters_are_numbers_or_fields(self):
        for wrong, text in (("0.5", "radius is a str; it must be a number or a Field$"),
                            (None, "radius is a NoneType"), (lambda p: 0.3, "Field.host")):
            with self.assertRaisesRegex(TypeError, text):
                msq.Lattice("bcc", cell_size=4, radius=wrong)
        foam = msq.Foam(cell_size=4, radius=0.5)
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        plain = msq.Material(1, red=1)
        for name, make in (
                ("cell_choice", lambda: msq.Lattice(["bcc", "octet"], cell_size=4, radius=1,
                                                    cell_choice="x")),
                ("thickness", lambda: msq.PlateLattice("bcc", cell_size=4, thickness="x")),
                ("radius", lambda: msq.PlateLattice("bcc", cell_size=4, thickness=1, radius="x")),
                ("radius", lambda: msq.Foam(cell_size=4, radius="x")),
                ("density", lambda: msq.Foam(cell_size=4, radius=0.5, density="x")),
                ("wall_thickness", lambda: msq.Foam(cell_size=4, radius=0.5, wall_thickness="x")),
                ("vent_radius", lambda: msq.Foam(cell_size=4, radius=0.5, vent_radius="x")),
                ("level", lambda: msq.Functional("gyroid", cell_size=4, level="x")),
                ("thickness", lambda: msq.Functional("gyroid", cell_size=4, thickness="x")),
                ("level", lambda: msq.Waves(level="x")),
                ("level", lambda: msq.HostFunctional(lambda p: p[:, 0], level="x")),
                ("fraction", lambda: msq.Structure.blend(foam, foam, "x")),
                ("radius", lambda: msq.Structure.smooth_union(foam, foam, "x")),
                ("skin", lambda: msq.Model(box, msq.Scale(foam, skin="x"))),
                ("green", lambda: msq.Material(1, red=1, green="x")),
                ("fraction", lambda: msq.Material.blend(1, plain, plain, "x"))):
            with self.assertRaisesRegex(TypeError, f"^{name} is a str; it must be a number"):
                make()
        for number in (0.5, 1, np.float32(0.5), np.array(0.5)):
            msq.Lattice("bcc", cell_size=4, radius=number).close()

    def test_of_values_are_those_of_closed_forms(self):
        points = random_points(2000).reshape(40, 50, 3)
        rise = msq.Field.gradient((0, 0, 0), 0.1, (0, 0, 100), 0.4)
        expected = np.clip(0.1 + 0.003 * points[..., 2], 0.1, 0.4)
        np.testing.assert_allclose(rise.evaluate(points), expected, atol=1e-14)
        self.assertIsInstance(rise.evaluate((1, 2, 3)), float)
        lattice = msq.Lattice(unit_cell="cubic", cell_size=2, radius=rise)
        offset = np.abs(points - 2 * np.round(points / 2))
        distance = np.sqrt((offset**2).sum(axis=-1) - offset.max(axis=-1)**2)
        onsets, slopes = lattice.onset(points, gradient=True)
        np.testing.assert_allclose(onsets, distance, atol=1e-7)
        self.assertEqual(slopes.shape, (40, 50, 3))
        self.assertLess(np.linalg.norm(slopes, axis=-1).max(), 1 + 1e-6)
        signed = lattice.onset(points, signed=True)
        np.testing.assert_array_equal(signed, onsets - rise.evaluate(points))
        space = msq.Model(msq.Shape.all_space(), lattice)
        clear = np.abs(signed) > 1e-9
        np.testing.assert_array_equal(space.contains(points)[clear], signed[clear] <= 0)
        with self.assertRaises(msq.UnsupportedError):
            msq.Beams([[0, 0, 0], [1, 1, 1]], [[0, 1]], radius=0.1).onset(points)

    def test_of_all_space_are_those_of_the_structure(self):
        foam = msq.Foam(cell_size=2, radius=0.3)
        space = msq.Model(msq.Shape.all_space(), foam)
        boxed = msq.Model(msq.Shape.box((-500,) * 3, (500,) * 3), foam)
        points = random_points(3000)
        self.assertTrue(np.array_equal(space.contains(points), boxed.contains(points)))
        self.assertTrue(np.array_equal(space.distance(points), boxed.distance(points)))
        self.assertEqual(space.bounds, ((-np.inf,) * 3, (np.inf,) * 3))
        with self.assertRaisesRegex(msq.LimitError, "scale 1"):
            space.contains((1e9, 0, 0))
        with self.assertRaisesRegex(msq.ArgumentError, "region"):
            space.slicer(layer_height=0.1, pitch=0.1)
        self.assertEqual(len(space.slicer(layer_height=0.5, pitch=0.1,
                                          region=((0, 0, 0), (4, 4, 4)))), 8)
        with self.assertRaisesRegex(msq.ArgumentError, "t_max"):
            space.cast((0, 0, 0), (1, 0, 0))
        self.assertEqual(space.cast((0, 0, 0), (1, 2, 3), t_max=20.0).scale, 1)

    def test_follow_the_length_scale(self):
        model, coarse = box_model(), box_model(foam=False)
        points = random_points(3000)
        self.assertTrue(np.array_equal(model.contains(points, length_scale=float("inf")),
                                       coarse.contains(points)))
        self.assertTrue(np.array_equal(model.distance(points, length_scale=2.5),
                                       coarse.distance(points)))
        self.assertEqual(model.scale_length(1), 2)
        self.assertEqual(model.bounds, ((0, 0, 0), (8, 6, 4)))

    def test_of_fields_and_rotations(self):
        model = msq.Model(msq.Shape.box((0, 0, 0), (8, 6, 4)), [
            msq.Functional("gyroid", cell_size=2,
                           level=msq.Field.gradient((0, 0, 0), -1, (8, 0, 0), 1)),
            msq.Lattice("octet", radius=0.05, cell_size=0.5,
                        rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]])])
        points = random_points(20000)
        inside = model.contains(points)
        self.assertLess(inside[points[:, 0] < 2].sum(), inside[points[:, 0] > 6].sum())
        self.assertTrue((model.contains(points, length_scale=1) >= inside).all())

    def test_of_own_unit_cells_and_expressions(self):
        shape = msq.Shape.box((0, 0, 0), (4, 4, 4))
        points = random_points(5000)
        own = msq.Lattice(([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1), (0, 2), (0, 3)]),
                          radius=0.2)
        self.assertTrue(np.array_equal(msq.Model(shape, own).contains(points), msq.Model(
            shape, msq.Lattice("cubic", radius=0.2)).contains(points)))
        typed = msq.Functional(expression="a * cos(x) + cos(y) + cos(z)", parameters={"a": 1})
        named = msq.Functional("Schwarz P")
        self.assertTrue(np.array_equal(msq.Model(shape, typed).contains(points),
                                       msq.Model(shape, named).contains(points)))


class NoCopies(unittest.TestCase):
    """Whatever C can be told of is passed where it lies; the rest is refused."""

    def setUp(self):
        self.model = box_model()

    def passed(self, points, **keywords):
        """The definition of points and the output's address as msq_set_membership gets them."""
        seen = {}
        real = msq.model.lib.msq_set_membership

        def spy(model, definition, query, inside, count, job):
            of = definition._obj
            seen.update(address=of.coordinates, count=of.count, stride=of.stride,
                        type=of.coordinate_type, out=ctypes.cast(inside, ctypes.c_void_p).value)
            return real(model, definition, query, inside, count, job)

        with mock.patch.object(msq.model.lib, "msq_set_membership", spy):
            seen["answers"] = self.model.contains(points, **keywords)
        return seen

    def check_passed(self, points, stride):
        seen = self.passed(points)
        self.assertEqual(seen["address"], points.ctypes.data)
        self.assertEqual(seen["count"], points.size // 3)
        self.assertEqual(seen["stride"], stride)
        self.assertEqual(seen["out"], seen["answers"].ctypes.data)
        self.assertEqual(seen["answers"].dtype, np.bool_)
        plain = np.array(points, np.float64, order="C", copy=True)
        self.assertTrue(np.array_equal(seen["answers"], self.model.contains(plain)))

    def test_layouts_are_passed_as_they_are(self):
        for dtype in (np.float32, np.float64):
            size = np.dtype(dtype).itemsize
            base = random_points(480, dtype=dtype)
            self.check_passed(base, 3 * size)
            self.check_passed(base[::2], 6 * size)
            self.check_passed(base.reshape(4, 120, 3)[1:3], 3 * size)
            self.check_passed(base.reshape(40, 12, 3)[:, ::4], 12 * size)
            self.check_passed(base.reshape(-1, 6)[:, 2:5], 6 * size)
            self.check_passed(base.reshape(4, 1, 120, 3)[:, :, 5:6], 360 * size)
            self.check_passed(base[7:8][::-1], 3 * size)
        record = np.zeros(100, np.dtype([("tag", np.uint8), ("at", np.float32, 3)]))
        record["at"] = random_points(100, dtype=np.float32)
        self.check_passed(record["at"], 13)  # unaligned
        read_only = random_points(10)
        read_only.flags.writeable = False
        self.check_passed(read_only, 24)
        self.assertEqual(self.passed(memoryview(read_only))["address"], read_only.ctypes.data)

    def test_other_layouts_are_refused(self):
        base = random_points(480)
        layouts = {"columns": np.asfortranarray(base), "backwards": base[::-1],
                   "turned": base[:, ::-1], "gaps": base.reshape(-1, 6)[:, ::2],
                   "varying": base.reshape(4, 120, 3)[:, :60],
                   "one point many times": np.broadcast_to(base[0], (5, 3)),
                   "overlapping": np.lib.stride_tricks.as_strided(base, (100, 3), (8, 8))}
        for name, points in layouts.items():
            with self.assertRaisesRegex(ValueError, "without a copy.*ascontiguousarray", msg=name):
                self.model.contains(points)
            answers = self.model.contains(np.ascontiguousarray(points))
            self.assertEqual(answers.shape, points.shape[:-1])
        for points in (base.astype(">f8"), base.astype(np.float16), base.astype(np.int64),
                       base.astype(np.complex128)):
            with self.assertRaisesRegex(TypeError, "float32 or float64"):
                self.model.contains(points)
        for points in (base.ravel()[:8], np.zeros((3, 2)), np.float64(1), base.T):
            with self.assertRaisesRegex(ValueError, "shape"):
                self.model.contains(points)

    def test_answers_go_to_the_given_array(self):
        points = random_points(500)
        expected = self.model.contains(points)
        for dtype in (np.bool_, np.uint8):
            out = np.full(500, 1, dtype)
            seen = self.passed(points, out=out)
            self.assertIs(seen["answers"], out)
            self.assertEqual(seen["out"], out.ctypes.data)
            self.assertTrue(np.array_equal(out.astype(bool), expected))
        whole = np.zeros((3, 500))
        self.assertEqual(self.model.distance(points, out=whole[1]).base is whole, True)
        self.assertTrue(np.array_equal(whole[1], self.model.distance(points)))
        self.assertFalse(whole[0].any() or whole[2].any())
        single = np.zeros((), np.bool_)
        self.assertIs(self.model.contains((1, 1, 1), out=single), single)

    def test_other_outputs_are_refused(self):
        points = random_points(10)
        read_only = np.zeros(10, np.bool_)
        read_only.flags.writeable = False
        for out, problem in ((np.zeros(10), TypeError), ([0] * 10, TypeError),
                             (np.zeros(11, np.bool_), ValueError),
                             (np.zeros((10, 1), np.bool_), ValueError),
                             (np.zeros(20, np.bool_)[::2], ValueError), (read_only, ValueError)):
            with self.assertRaisesRegex(problem, "out "):
                self.model.contains(points, out=out)
        with self.assertRaisesRegex(TypeError, "out "):
            self.model.distance(points, out=np.zeros(10, np.float32))
        with self.assertRaisesRegex(ValueError, "memory of the points"):
            self.model.distance(points, out=points.reshape(-1)[:10])

    def test_strides_are_exact(self):
        self.assertEqual(triples(np.zeros((1, 5, 1, 3))[:, ::2]).stride, 48)
        self.assertEqual(triples(np.zeros((0, 3))).count, 0)


class Rays(unittest.TestCase):
    def setUp(self):
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        self.model = msq.Model(box, msq.Lattice(unit_cell="cubic", radius=0.125))

    def test_hits_where_the_solid_begins(self):
        origins = np.array([[[-1, 0, 0.5], [-1, 0.5, 0.5]]], dtype=np.float32)
        directions = np.array([[[2, 0, 0], [1, 0, 0]]], dtype=np.float32)
        hits = self.model.cast(origins, directions)
        self.assertEqual(hits.shape, (1, 2))
        self.assertAlmostEqual(hits.t[0, 0], 0.5, places=10)
        self.assertEqual(tuple(hits.normal[0, 0]), (-1, 0, 0))
        self.assertEqual(hits.scale.tolist(), [[0, -1]])
        self.assertTrue(np.isinf(hits.t[0, 1]))
        beyond = self.model.cast(origins, directions, t_max=[[0.25, 9]])
        self.assertEqual(beyond.scale.tolist(), [[-1, -1]])
        within = self.model.cast(origins, directions, t_min=0.53125)
        self.assertEqual(within.starts_inside.tolist(), [[1, 0]])
        self.assertEqual(within.t[0, 0], 0.53125)

    def test_refuses_what_does_not_fit(self):
        with self.assertRaisesRegex(ValueError, "one shape"):
            self.model.cast(np.zeros((2, 3)), np.ones((3, 3)))
        with self.assertRaisesRegex(msq.ArgumentError, "direction of ray 1"):
            self.model.cast(np.zeros((2, 3)), np.array([[1.0, 0, 0], [0, 0, 0]]))


if __name__ == "__main__":
    unittest.main()
