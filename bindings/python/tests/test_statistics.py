# SPDX-License-Identifier: Apache-2.0
"""Stratified samples, statistics, calibration, voxel images and the counters of jobs."""
import unittest

import numpy as np

import msq
from support import box_model, random_points


class Samples(unittest.TestCase):
    def test_points_are_those_that_queries_see(self):
        model = box_model()
        sets = (msq.PointGrid((0, 0, 0), (0.5, 0.25, 1), (7, 5, 4)),
                msq.Stratified((0, 0, 0), 0.5, (16, 12, 8), per_cell=3, seed=2**63 + 1),
                msq.Stratified((4, 0, 0), 0.5, (4, 5, 6), per_cell=2,
                               rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]]))
        for points in sets:
            coordinates = points.coordinates()
            self.assertEqual(coordinates.shape, (np.prod(points.shape), 3))
            for ask in (model.contains, model.distance):
                answers = ask(points)
                self.assertEqual(answers.shape, points.shape)
                self.assertTrue(np.array_equal(answers.ravel(), ask(coordinates)))
            part = np.zeros((9, 3))
            self.assertIs(points.coordinates(11, 9, out=part), part)
            self.assertTrue(np.array_equal(part, coordinates[11:20]))
        cells = np.floor(sets[1].coordinates().reshape(*sets[1].shape, 3) / 0.5).astype(int)
        z, y, x = np.meshgrid(np.arange(8), np.arange(12), np.arange(16), indexing="ij")
        self.assertTrue((cells == np.stack((x, y, z), axis=-1)[..., None, :]).all())
        self.assertFalse(np.array_equal(sets[1].coordinates(0, 9), msq.Stratified(
            (0, 0, 0), 0.5, (16, 12, 8), per_cell=3).coordinates(0, 9)))
        with self.assertRaises(msq.ArgumentError):
            sets[0].coordinates(139, 2)

    def test_methods_answer_the_same_and_are_counted(self):
        model, points, job = box_model(), random_points(30000), msq.Job()
        expected = model.contains(points)
        for method in ("auto", "point", "set"):
            for parts in (0, 4):
                self.assertTrue(np.array_equal(expected, model.contains(
                    points, method=method, critical_count=5, group_parts=parts, job=job)))
            self.assertEqual(job.info.points, len(points))
            if method == "point":
                self.assertEqual(job.info.by_set, 0)
            if method == "set":
                self.assertEqual(job.info.by_point, 0)
                self.assertGreater(job.info.groups, 0)
        with self.assertRaisesRegex(ValueError, "'auto', 'point', 'set'"):
            model.contains(points, method="fast")


class Numbers(unittest.TestCase):
    def setUp(self):
        self.box = msq.Model(msq.Shape.box((-8, -8, -8), (8, 8, 8)),
                             msq.Functional("gyroid", level=0.0, cell_size=1))
        self.sample = msq.Stratified((0, 0, 0), 0.125, (16, 16, 16), per_cell=4)

    def test_volume_fractions(self):
        solid = self.box.volume_fraction(self.sample)
        void = self.box.volume_fraction(self.sample, phase="void")
        self.assertAlmostEqual(solid.value, 0.5, delta=0.01)
        self.assertAlmostEqual(solid.value + void.value, 1)
        self.assertTrue(solid.low < solid.value < solid.high)
        self.assertEqual(solid.value, self.box.contains(self.sample).mean())
        self.assertEqual(self.box.volume_fraction(self.sample, length_scale=2).value, 1)
        with self.assertRaisesRegex(msq.ArgumentError, "per_cell"):
            self.box.volume_fraction(msq.Stratified((0, 0, 0), 1, (2, 2, 2)))

    def test_segments(self):
        lengths = [0, 0.1, 0.25, 1]
        pairs = self.box.two_point_correlation(self.sample, lengths, direction=(1, 0, 0))
        self.assertEqual(pairs.value.shape, (4,))
        self.assertAlmostEqual(pairs.value[0], self.box.volume_fraction(self.sample).value)
        self.assertAlmostEqual(pairs.value[3], pairs.value[0])  # one period on
        path = self.box.lineal_path(self.sample, lengths, direction=(1, 0, 0), step=0.01)
        self.assertTrue((path.value <= pairs.value + 1e-12).all())
        self.assertTrue((np.diff(path.value) <= 0).all())
        self.assertTrue(((pairs.low <= pairs.value) & (pairs.value <= pairs.high)).all())
        turned = self.box.two_point_correlation(self.sample, 0.25)
        self.assertEqual(turned.shape, (1,))

    def test_calibration(self):
        for structure in (msq.Lattice("octet", radius=0.01), msq.Functional("gyroid")):
            found = structure.calibrate(0.3, curve=65)
            self.assertAlmostEqual(found.fraction.value, 0.3, delta=0.01)
            self.assertEqual(len(found.parameters), 65)
            self.assertTrue((np.diff(found.parameters) >= 0).all())
            self.assertAlmostEqual(found.fractions[-1], found.max_fraction)
            self.assertAlmostEqual(np.interp(0.3, found.fractions, found.parameters),
                                   found.parameter, delta=0.02)
            self.assertEqual(len(structure.calibrate(0.3).parameters), 0)
        sample = msq.Stratified((0, 0, 0), 0.25, (4, 4, 4), per_cell=5)
        self.assertEqual(structure.calibrate(0.5, sample=sample).samples, 320)
        with self.assertRaises(msq.ArgumentError):
            structure.calibrate(2)


class Voxels(unittest.TestCase):
    def test_are_solid_by_a_threshold(self):
        z, y, x = np.meshgrid(np.arange(17), np.arange(19), np.arange(21), indexing="ij")
        distance = np.sqrt((x - 10.0) ** 2 + (y - 9) ** 2 + (z - 8) ** 2)
        points = np.random.RandomState(5).rand(20000, 3) * (20, 18, 16)
        expected = np.linalg.norm(points - (10, 9, 8), axis=1)
        clear = np.abs(expected - 6) > 0.2
        for values, threshold, solid in ((distance, 6, "below"), (-distance, -6, "above"),
                                         (np.round(10 * distance).astype(np.uint16), 60, "below")):
            answers = msq.Model(msq.Shape.voxels(values, threshold, solid=solid)).contains(points)
            self.assertTrue(np.array_equal(answers[clear], (expected <= 6)[clear]))
        moved = msq.Model(msq.Shape.voxels(distance, 6, solid="below", spacing=0.5,
                                           origin=(1, 2, 3)))
        self.assertTrue(np.array_equal(moved.contains(points * 0.5 + (1, 2, 3))[clear],
                                       (expected <= 6)[clear]))
        self.assertFalse(moved.closed)
        with self.assertRaises(msq.ArgumentError):
            msq.Shape.voxels(distance, 100)


if __name__ == "__main__":
    unittest.main()
