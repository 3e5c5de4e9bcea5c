# SPDX-License-Identifier: Apache-2.0
"""Materials of scales, skins and blends, and sets of points asked for them."""
import gc
import math
import unittest

import numpy as np

import msq
from support import random_points

# On a strut, in a void, in the skin, outside: of the models below.
POINTS = [(1.5, 1.5, 1.5), (1.5, 2, 1.5), (0.1, 2, 1.5), (4.5, 1, 1)]


def material(number, **channels):
    return msq.Material(number, density=100.0 * number, modulus=number, **channels)


def filled(coarse=None, fine=None, skin=None, thickness=0.25):
    """A box from 0 to 4, filled with a lattice of cell size 1 that leaves a skin."""
    lattice = msq.Lattice("bcc", radius=0.125)
    return msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)),
                     msq.Scale(lattice, skin=thickness, material=fine, skin_material=skin),
                     material=coarse)


class Materials(unittest.TestCase):
    def check(self, model, ids, **keywords):
        self.assertEqual(model.material(POINTS, **keywords)[0].tolist(), ids)
        self.assertEqual([model.material(point, **keywords)[0] for point in POINTS], ids)

    def test_are_those_of_scales_and_skins(self):
        one, two, three = material(1), material(2), material(3)
        self.check(filled(one, two, three), [2, 0, 3, 0])
        self.check(filled(one, two), [2, 0, 2, 0])
        self.check(filled(one), [1, 0, 1, 0])
        self.check(filled(one, None, three), [1, 0, 3, 0])
        self.check(filled(None, two), [2, 0, 2, 0])
        self.check(filled(one, two, three), [1, 1, 1, 0], length_scale=1.5)
        self.check(msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)), material=two), [2, 2, 2, 0])
        self.assertEqual((one.id, two.id), (1, 2))

    def test_channels_come_in_the_order_of_their_names(self):
        model = filled(material(1, colour=7), material(2), material(3))
        ids, values = model.material(POINTS, channels=["modulus", "density"])
        self.assertEqual((ids.dtype, values.dtype), (np.uint32, np.float64))
        self.assertEqual(values.tolist(), [[2, 200], [0, 0], [3, 300], [0, 0]])
        ids, values = model.material(POINTS[:1], channels=("colour",))
        self.assertEqual((ids.tolist(), values.tolist()), ([2], [[0]]))
        self.assertEqual(model.material(POINTS)[1].shape, (4, 0))
        odd = msq.Material(2**32 - 1, **{"Young's modulus": 210, "id": 5, "d\u00e9": -1.5})
        ids, values = filled(odd).material(POINTS[0], channels=["d\u00e9", "id", "Young's modulus"])
        self.assertEqual((ids, values.tolist()), (2**32 - 1, [-1.5, 5, 210]))
        self.assertIsInstance(ids, int)

    def test_have_the_shape_of_the_points(self):
        model = filled(material(1), material(2), thickness=0.0)
        grid = msq.PointGrid((0, 0, 0), (0.5, 0.25, 1), (9, 5, 4))
        ids, values = model.material(grid, channels=["density"])
        self.assertEqual((ids.shape, values.shape), ((4, 5, 9), (4, 5, 9, 1)))
        points = grid.coordinates().reshape(4, 5, 9, 3)
        self.assertTrue(np.array_equal(ids, model.material(points)[0]))
        self.assertTrue(np.array_equal(ids != 0, model.contains(points)))
        self.assertTrue(np.array_equal(values[..., 0], 100.0 * ids))
        self.assertTrue(0 < np.count_nonzero(ids) < ids.size)
        many = random_points(40000)  # enough for a thread of their own
        job = msq.Job()
        ids = model.material(many, job=job)[0]
        self.assertTrue(np.array_equal(ids[:500], [model.material(p)[0] for p in many[:500]]))
        self.assertTrue(np.array_equal(ids != 0, model.contains(many)))
        self.assertEqual(job.progress, 1)
        self.assertEqual(model.material(np.empty((0, 3)), channels=["density"])[1].shape, (0, 1))

    def test_channels_may_be_fields(self):
        graded = msq.Field.gradient((0, 0, 0), 1, (4, 0, 0), 5)
        called = msq.Field.host(lambda points: points[:, 1] * 2, 0, 8, lipschitz=2)
        model = msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)),
                          material=msq.Material(1, graded=graded, called=called))
        graded.close()
        del graded, called
        gc.collect()
        points = np.random.RandomState(2).rand(500, 3) * 4
        values = model.material(points, channels=["graded", "called"])[1]
        np.testing.assert_allclose(values[:, 0], points[:, 0] + 1, rtol=1e-14)
        self.assertTrue(np.array_equal(values[:, 1], points[:, 1] * 2))
        self.assertTrue(np.array_equal(model.material(points[3], channels=["called", "graded"])[1],
                                       values[3, ::-1]))

        def fail(_points):
            raise ZeroDivisionError("as it is in Python")

        failing = msq.Material(1, x=msq.Field.host(fail, 0, 1, lipschitz=1))
        model = msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)), material=failing)
        for asked in (points, points[0]):
            with self.assertRaisesRegex(ZeroDivisionError, "in Python"):
                model.material(asked, channels=["x"])

    def test_blends_grade_one_into_the_other(self):
        across = msq.Field.gradient((0, 0, 0), 0, (4, 0, 0), 1)
        a, b = msq.Material(1, density=2, modulus=10), msq.Material(2, modulus=30, density=6)
        blend = msq.Material.blend(9, a, b, across)
        a.close()
        points = np.random.RandomState(3).rand(500, 3) * 4
        model = msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)), material=blend)
        ids, values = model.material(points, channels=["density", "modulus"])
        self.assertEqual((set(ids.tolist()), blend.id), ({9}, 9))
        np.testing.assert_allclose(values[:, 0], 2 + points[:, 0], rtol=1e-14)
        np.testing.assert_allclose(values[:, 1], 10 + 5 * points[:, 0], rtol=1e-14)
        half = msq.Material.blend(3, blend, b, 0.5)
        values = filled(half).material(POINTS[0], channels=["density"])[1]
        self.assertAlmostEqual(values[0], (2 + 1.5 + 6) / 2, 14)
        self.assertIs(half.context, blend.context)

    def test_are_written_where_the_caller_says(self):
        model = filled(material(1), material(2), material(3))
        ids, values = np.full(4, 9, np.uint32), np.full((4, 1), 9.0)
        answers = model.material(POINTS, channels=["density"], out=(ids, values))
        self.assertIs(answers[0], ids)
        self.assertIs(answers[1], values)
        self.assertEqual((ids.tolist(), values.ravel().tolist()), ([2, 0, 3, 0], [200, 0, 300, 0]))
        self.assertIs(model.material(POINTS, channels=["modulus"], out=(None, values))[1], values)
        self.assertEqual(values.ravel().tolist(), [2, 0, 3, 0])
        one, row = np.zeros((), np.uint32), np.zeros(1)
        self.assertIs(model.material(POINTS[2], out=(one, None))[0], one)
        self.assertEqual(one, 3)
        self.assertIs(model.material(POINTS[2], channels=["density"], out=(None, row))[1], row)
        self.assertEqual(row, 300)
        shared = np.zeros(4)
        for out, problem in (((np.zeros(4, np.int64), None), TypeError), ((ids[:3], None),
                             ValueError), ((None, values.ravel()), ValueError),
                             ((shared.view(np.uint32)[:4], shared.reshape(4, 1)), ValueError)):
            with self.assertRaisesRegex(problem, "out "):
                model.material(POINTS, channels=["density"], out=out)

    def test_errors_say_what_is_wrong(self):
        one, other = material(1), msq.Material(2, colour=1)
        model, bare = filled(one), filled()
        across = msq.Field.gradient((0, 0, 0), 0, (4, 0, 0), 1.5)
        for kind, text, call in (
                (msq.ArgumentError, "id is 0", lambda: msq.Material(0)),
                (ValueError, "id is -1", lambda: msq.Material(-1)),
                (msq.ArgumentError, "finite", lambda: msq.Material(1, density=math.nan)),
                (TypeError, "", lambda: msq.Material(1, density="heavy")),
                (ValueError, "null", lambda: msq.Material(1, **{"a\0b": 1})),
                (msq.ArgumentError, "channel", lambda: msq.Material(1, **{"": 1})),
                (msq.ArgumentError, "257", lambda: msq.Material(
                    1, **{f"c{i}": i for i in range(257)})),
                (msq.ArgumentError, "id is 0", lambda: msq.Material.blend(0, one, one, 0.5)),
                (msq.ArgumentError, "1.5", lambda: msq.Material.blend(3, one, one, across)),
                (msq.ArgumentError, "only one", lambda: msq.Material.blend(3, one, other, 0.5)),
                (TypeError, "b is a float", lambda: msq.Material.blend(3, one, 0.5, 0.5)),
                (TypeError, "skin_material is a int", lambda: filled(one, one, 3)),
                (TypeError, "material is a Field", lambda: filled(across)),
                (msq.ArgumentError, "colour", lambda: model.material(POINTS, channels=["colour"])),
                (TypeError, "sequence", lambda: model.material(POINTS, channels="density")),
                (TypeError, "str", lambda: model.material(POINTS, channels=[1])),
                (msq.ArgumentError, "no resolved scale", lambda: bare.material(POINTS)),
                (msq.ArgumentError, "no resolved scale", lambda: bare.material(POINTS[0])),
                (msq.ArgumentError, "point 1",
                 lambda: model.material([(0, 0, 0), (0, 0, math.inf)])),
                (msq.ArgumentError, "finite", lambda: model.material((0, 0, math.inf)))):
            with self.assertRaisesRegex(kind, text):
                call()
        one.close()
        with self.assertRaisesRegex(ValueError, "this Material is closed"):
            filled(one)


if __name__ == "__main__":
    unittest.main()
