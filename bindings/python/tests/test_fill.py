# SPDX-License-Identifier: Apache-2.0
"""Fill lines: arrays, rings, calibration."""
import gc
import unittest

import numpy as np

import msq

SQUARE = np.array([[0, 0], [30, 0], [30, 20], [0, 20]]) * 1_000_000
HOLE = np.array([[10, 5], [20, 5], [20, 15], [10, 15]]) * 1_000_000


def length_of(path, is_closed):
    path = path.astype(float)
    if is_closed:
        path = np.concatenate([path, path[:1]])
    return np.linalg.norm(np.diff(path, axis=0), axis=1).sum()


class GradedPeriod(unittest.TestCase):
    def test_lines_are_denser_where_cells_are_smaller(self):
        period = msq.Period(positions=(0, 30), cell_sizes=(2, 8), axis=0)
        graded = msq.Functional("gyroid", kind="sheet", thickness=0.2, cell_size=4, period=period)
        left, right = SQUARE // (3, 1), SQUARE // (3, 1) + (20_000_000, 0)
        lengths = [graded.fill_lines(part, 1.3, tolerance=0.01).length for part in (left, right)]
        self.assertGreater(lengths[0], 1.3 * lengths[1])

    def test_walls_of_foams_are_denser_where_cells_are_smaller(self):
        period = msq.Period(positions=(0, 30), cell_sizes=(2, 8), axis=0)
        graded = msq.Foam(wall_thickness=0.4, cell_size=4, period=period)
        left, right = SQUARE // (3, 1), SQUARE // (3, 1) + (20_000_000, 0)
        lengths = [graded.fill_lines(part, 1.3).length for part in (left, right)]
        self.assertGreater(lengths[0], 1.15 * lengths[1])
        points = np.random.default_rng(3).uniform((0, 0, 0), (30, 20, 4), (20000, 3))
        near = graded.onset(points) < 0.4
        self.assertGreater(near[points[:, 0] < 10].mean(), 1.1 * near[points[:, 0] > 20].mean())

    def test_one_position_is_a_grid(self):
        points = np.random.default_rng(1).uniform(-5, 5, (2000, 3))
        plain = msq.Functional("gyroid", level=0.2, cell_size=(2, 4, 4))
        graded = msq.Functional("gyroid", level=0.2, cell_size=4, period=msq.Period([3], [2], 0))
        np.testing.assert_array_equal(plain.onset(points) <= 0.2, graded.onset(points) <= 0.2)

    def test_cells_around_an_axis_close(self):
        angle = 2 * np.pi / 9
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                         [0, 0, 1]])
        points = np.random.default_rng(2).uniform(-3, 3, (2000, 3))
        for warp in msq.Warp(9, 0.5, 2.5), msq.Warp(9, 0.5, 2.5, count_polar=4):
            warped = msq.Functional("gyroid", level=0.2, warp=warp)
            here, there = warped.onset(points), warped.onset(points @ turn.T)
            self.assertGreater(np.isfinite(here).sum(), 100)
            np.testing.assert_allclose(here, there, atol=1e-10)
        with self.assertRaisesRegex(msq.ArgumentError, "warp.count is 0"):
            msq.Functional("gyroid", warp=msq.Warp(0))
        with self.assertRaisesRegex(msq.UnsupportedError, "both period and warp"):
            msq.Functional("gyroid", warp=msq.Warp(3), period=msq.Period([1], [1]))

    def test_refusals(self):
        with self.assertRaisesRegex(ValueError, r"positions of shape \(2,\)"):
            msq.Functional("gyroid", period=msq.Period([1, 2], [1]))
        with self.assertRaisesRegex(msq.ArgumentError, r"positions\[1\] is 1, not above"):
            msq.Functional("gyroid", period=msq.Period([1, 1], [1, 2]))
        with self.assertRaisesRegex(msq.ArgumentError, "period.axis is 3"):
            msq.Functional("gyroid", period=msq.Period([1], [1], axis=3))


class FillLines(unittest.TestCase):
    def test_paths_are_arrays(self):
        for structure in (msq.Foam(radius=0.1, cell_size=4), msq.Functional("gyroid", kind="sheet",
                                                                            level=0.1, cell_size=6)):
            fill = structure.fill_lines([SQUARE, HOLE], 1.3, tolerance=0.01)
            self.assertEqual(fill.points.dtype, np.int64)
            self.assertGreater(len(fill), 3)
            self.assertEqual(fill.starts[-1], len(fill.points))
            self.assertFalse(fill.points.flags.writeable)
            self.assertTrue((fill.points.min(axis=0) >= 0).all())
            self.assertTrue((fill.points <= (30_000_000, 20_000_000)).all())
            in_hole = ((fill.points > HOLE[0] + 1) & (fill.points < HOLE[2] - 1)).all(axis=1)
            self.assertFalse(in_hole.any())
            total = sum(length_of(path, closed) for path, closed in zip(fill.paths, fill.is_closed))
            self.assertAlmostEqual(total * 1e-6, fill.length, places=6)
            self.assertIn("paths", repr(fill))

    def test_arrays_outlive_the_fill(self):
        foam = msq.Foam(radius=0.1, cell_size=4)
        fill = foam.fill_lines(SQUARE, 1.3)
        points, copy = fill.points, fill.points.copy()
        fill.close()
        del fill, foam
        gc.collect()
        self.assertTrue((points == copy).all())

    def test_coordinates_of_the_host(self):
        foam = msq.Foam(radius=0.1, cell_size=4)
        fill = foam.fill_lines((SQUARE // 10_000).astype(np.int32), 1.3, scale=0.01)
        self.assertEqual(fill.points.dtype, np.int32)
        same = foam.fill_lines([[0, 0], [3000, 0], [3000, 2000], [0, 2000]], 1.3, scale=0.01)
        self.assertEqual(same.points.dtype, np.int64)
        self.assertTrue((same.points == fill.points).all())
        moved = foam.fill_lines([[100, 0], [3100, 0], [3100, 2000], [100, 2000]], 1.3, scale=0.01,
                                origin=(-1, 0))
        self.assertAlmostEqual(moved.length, fill.length, delta=0.01 * fill.length)
        self.assertEqual(len(foam.fill_lines(SQUARE, 1.3, min_length=1e9)), 0)
        self.assertLess(len(foam.fill_lines(SQUARE, 1.3, pair_distance=0.4)),
                        0.7 * len(foam.fill_lines(SQUARE, 1.3)))

    def test_density(self):
        cell = msq.Functional("gyroid", kind="sheet", level=0.1).fill_cell_size(0.45, 0.2)
        gyroid = msq.Functional("gyroid", kind="sheet", level=0.1, cell_size=cell)
        heights = (np.arange(40) + 0.5) / 40 * cell[2]
        side = 20 * cell[0]
        square = np.round(np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * side * 1e6).astype(np.int64)
        total = sum(gyroid.fill_lines(square, z).length for z in heights)
        self.assertAlmostEqual(total * 0.45 / (40 * side ** 2), 0.2, delta=0.004)

    def test_kinds_with_walls(self):
        foam = msq.Foam(radius=0, wall_thickness=0.3, cell_size=4)
        whole = foam.fill_lines(SQUARE, 1.3).length
        vented = msq.Foam(radius=0, wall_thickness=0.3, vent_radius=1, cell_size=4)
        struts = msq.Lattice("bcc", radius=0.8, cell_size=4)
        plates = msq.PlateLattice("cubic", thickness=0.2, cell_size=5)
        for less in vented, foam - struts, foam & struts:
            self.assertTrue(0 < less.fill_lines(SQUARE, 1.3).length < 0.95 * whole)
        # Planes 5 mm apart along both axes; those on two sides of the rectangle count.
        self.assertAlmostEqual(plates.fill_lines(SQUARE + 1_000_000, 1.3).length, 6 * 20 + 4 * 30,
                               places=5)
        both = (foam | plates).fill_lines(SQUARE + 1_000_000, 1.3).length
        self.assertAlmostEqual(both, foam.fill_lines(SQUARE + 1_000_000, 1.3).length + 240, places=3)
        for curved in (msq.Waves(6, kind="sheet", level=0.2),
                       msq.Functional("gyroid", kind="sheet", level=0.2, cell_size=5,
                                      warp=msq.Warp(12, 2, 25))):
            self.assertGreater(curved.fill_lines(SQUARE, 1.3).length, 100)

    def test_refusals(self):
        with self.assertRaisesRegex(msq.UnsupportedError, "contours"):
            msq.Lattice("bcc", radius=0.1).fill_lines(SQUARE, 1)
        with self.assertRaisesRegex(msq.UnsupportedError, "structure 1 of the union"):
            (msq.Foam(radius=0.1) | msq.Lattice("bcc", radius=0.1)).fill_lines(SQUARE, 1)
        foam = msq.Foam(radius=0.1)
        with self.assertRaisesRegex(msq.ArgumentError, "ring 0 has 2 points"):
            foam.fill_lines(SQUARE[:2], 1)
        with self.assertRaisesRegex(msq.ArgumentError, "the number of rings is 0"):
            foam.fill_lines([], 1)
        with self.assertRaises(ValueError):
            foam.fill_lines(SQUARE + 0.5, 1)
        with self.assertRaises(TypeError):
            msq.Fill()
        job = msq.Job()
        job.cancel()
        with self.assertRaises(msq.CancelledError):
            foam.fill_lines(SQUARE, 1, job=job)


if __name__ == "__main__":
    unittest.main()
