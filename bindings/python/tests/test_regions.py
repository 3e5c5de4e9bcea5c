# SPDX-License-Identifier: Apache-2.0
"""Shapes made of shapes, grids moved with them, and models of regions."""
import unittest

import numpy as np

import msq
from support import random_points

TURN = [(0, -2, 0, 8), (2, 0, 0, -3), (0, 0, 2, 5)]


class ShapesOfShapes(unittest.TestCase):
    def setUp(self):
        self.points = random_points(5000)
        self.box = msq.Shape.box((0, 0, 0), (8, 6, 4))
        self.ball = msq.Shape.sphere((4, 3, 4), 3)
        self.in_box = msq.Model(self.box).contains(self.points)
        self.in_ball = msq.Model(self.ball).contains(self.points)

    def contains(self, shape):
        return msq.Model(shape).contains(self.points)

    def test_booleans(self):
        for shape, wanted in ((self.box | self.ball, self.in_box | self.in_ball),
                              (self.box & self.ball, self.in_box & self.in_ball),
                              (self.box - self.ball, self.in_box & ~self.in_ball),
                              (msq.Shape.union(self.box), self.in_box)):
            np.testing.assert_array_equal(self.contains(shape), wanted)
            self.assertIs(shape.context, self.box.context)
        with self.assertRaisesRegex(TypeError, "int"):
            self.box | 3
        with self.assertRaisesRegex(ValueError, "no shapes"):
            msq.Shape.union()
        with self.assertRaisesRegex(msq.ArgumentError, "do not meet"):
            self.box & msq.Shape.box((9, 9, 9), (10, 10, 10))

    def test_placed(self):
        matrix = np.array(TURN)
        placed = msq.Model(self.box.placed(matrix))
        at = self.points @ matrix[:, :3].T + matrix[:, 3]
        distance = msq.Model(self.box).distance(self.points)
        np.testing.assert_allclose(placed.distance(at), 2 * distance, atol=1e-9)
        four = np.vstack([matrix, (0, 0, 0, 1)])
        self.assertEqual(self.box.placed(four).info.min, self.box.placed(matrix).info.min)
        for wrong in (np.eye(3), np.ones((4, 4))):
            with self.assertRaisesRegex(ValueError, "matrix"):
                self.box.placed(wrong)
        with self.assertRaisesRegex(msq.ArgumentError, "singular"):
            self.box.placed(np.zeros((3, 4)))

    def test_offset(self):
        distance = msq.Model(self.box).distance(self.points)
        far = np.abs(distance - 0.5) > 1e-9
        np.testing.assert_array_equal(self.contains(self.box.offset(0.5))[far],
                                      (distance < 0.5)[far])
        with self.assertRaises(msq.UnsupportedError):
            (self.box | self.ball).offset(-0.5)

    def test_grids_move_along(self):
        grid = msq.Grid(2, origin=(1, 0, 0))
        moved = grid.placed(TURN)
        self.assertEqual(moved.cell_size, (4, 4, 4))
        self.assertEqual(moved.origin, (8, -1, 5))
        here = msq.Model(self.box, msq.Foam(radius=0.25, **dict(cell_size=2, origin=(1, 0, 0))))
        there = msq.Model(self.box.placed(TURN), msq.Foam(radius=0.5, **moved._asdict()))
        at = self.points @ np.array(TURN)[:, :3].T + np.array(TURN)[:, 3]
        distance = here.distance(self.points)
        np.testing.assert_allclose(there.distance(at), 2 * distance, atol=1e-6)
        with self.assertRaisesRegex(msq.ArgumentError, "mirrors"):
            grid.placed([(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, -1, 0)])


class StructuresOfStructures(unittest.TestCase):
    def setUp(self):
        self.points = random_points(5000)
        self.lattice = msq.Lattice("bcc", cell_size=2, radius=0.3)
        self.gyroid = msq.Functional("gyroid", cell_size=3, level=0.2)

    def contains(self, structure):
        return msq.Model(msq.Shape.all_space(), structure).contains(self.points)

    def test_booleans(self):
        a, b = self.contains(self.lattice), self.contains(self.gyroid)
        for structure, wanted in ((self.lattice | self.gyroid, a | b),
                                  (self.lattice & self.gyroid, a & b),
                                  (self.lattice - self.gyroid, a & ~b),
                                  (self.lattice | self.gyroid - self.lattice, a | b),
                                  (msq.Structure.union(self.lattice), a)):
            np.testing.assert_array_equal(self.contains(structure), wanted)
            self.assertIs(structure.context, self.lattice.context)
        with self.assertRaisesRegex(TypeError, "int"):
            self.lattice | 3
        with self.assertRaisesRegex(ValueError, "no structures"):
            msq.Structure.union()
        with self.assertRaisesRegex(msq.UnsupportedError, "no onset"):
            (self.lattice | self.gyroid).onset((0, 0, 0))
        foam = msq.Foam(cell_size=2, radius=0.2)
        np.testing.assert_array_equal(
            (self.lattice | foam).onset(self.points),
            np.minimum(self.lattice.onset(self.points), foam.onset(self.points)))


    def test_blend(self):
        a, b = self.contains(self.lattice), self.contains(self.gyroid)
        rising = msq.Field.gradient((2, 0, 0), 0, (6, 0, 0), 1)
        found = self.contains(msq.Structure.blend(self.lattice, self.gyroid, rising))
        x = self.points[:, 0]
        np.testing.assert_array_equal(found[x <= 2], a[x <= 2])
        np.testing.assert_array_equal(found[x >= 6], b[x >= 6])
        self.assertTrue(np.all(found[a & b]) and not np.any(found[~(a | b)]))
        self.assertTrue(np.any(found[a & ~b]) and np.any(~found[a & ~b]))
        with self.assertRaisesRegex(TypeError, "b is a int"):
            msq.Structure.blend(self.lattice, 3, 0.5)
        with self.assertRaisesRegex(msq.ArgumentError, "fraction"):
            msq.Structure.blend(self.lattice, self.gyroid, 1.5)

    def test_smooth(self):
        a, b = self.contains(self.lattice), self.contains(self.gyroid)
        x = self.points[:, 0]
        for made, plain in ((msq.Structure.smooth_union, a | b),
                            (msq.Structure.smooth_intersection, a & b),
                            (msq.Structure.smooth_difference, a & ~b)):
            np.testing.assert_array_equal(self.contains(made(self.lattice, self.gyroid, 0)), plain)
            rising = msq.Field.gradient((2, 0, 0), 0, (6, 0, 0), 1)
            found = self.contains(made(self.lattice, self.gyroid, rising))
            np.testing.assert_array_equal(found[x <= 2], plain[x <= 2])
            changed = found != plain
            self.assertTrue(np.any(changed))
            self.assertTrue(np.all(found[changed] == (made == msq.Structure.smooth_union)))
        with self.assertRaisesRegex(TypeError, "a is a int"):
            msq.Structure.smooth_union(3, self.lattice, 0.5)
        with self.assertRaisesRegex(msq.ArgumentError, "radius"):
            msq.Structure.smooth_union(self.lattice, self.gyroid, -1)


class Regions(unittest.TestCase):
    def test_first_shape_decides(self):
        points = random_points(5000)
        ball = msq.Model(msq.Shape.sphere((4, 3, 4), 3), msq.Foam(cell_size=2, radius=0.3))
        box = msq.Model(msq.Shape.box((0, 0, 0), (8, 6, 4)))
        plate = msq.Model.regions(ball, box)
        in_ball = msq.Model(msq.Shape.sphere((4, 3, 4), 3)).contains(points)
        in_box = box.contains(points)
        regions = plate.region(points)
        self.assertEqual(regions.dtype, np.int32)
        np.testing.assert_array_equal(regions, np.where(in_ball, 0, np.where(in_box, 1, -1)))
        np.testing.assert_array_equal(plate.contains(points),
                                      np.where(in_ball, ball.contains(points), in_box))
        self.assertEqual(plate.region((4, 3, 6.5)), 0)
        self.assertEqual(plate.region((4, 3, 9)), -1)
        layer = plate.slicer(layer_height=0.5, pitch=0.25).layer(9).pixels
        self.assertTrue(layer.any() and not layer.all())
        hits = plate.cast([(0.5, 0.5, 9), (50, 50, 9)], [(0.0, 0, -1)] * 2)
        self.assertAlmostEqual(hits.t[0], 5)
        self.assertEqual(hits.scale[1], -1)
        with self.assertRaisesRegex(TypeError, "Shape"):
            msq.Model.regions(msq.Shape.sphere((0, 0, 0), 1))
        with self.assertRaisesRegex(ValueError, "no regions"):
            msq.Model.regions()


if __name__ == "__main__":
    unittest.main()
