# SPDX-License-Identifier: Apache-2.0
"""Lattices and foams in cells that vary in size or are bent."""
import unittest

import numpy as np

import msq


class WarpedLattices(unittest.TestCase):
    def test_one_position_is_a_grid(self):
        points = np.random.default_rng(2).uniform(-5, 5, (2000, 3))
        plain = msq.Lattice("octet", radius=0.2, cell_size=(2, 4, 4))
        graded = msq.Lattice("octet", radius=0.2, cell_size=4, period=msq.Period([3], [2], 0))
        np.testing.assert_array_equal(plain.onset(points) <= 0.2, graded.onset(points) <= 0.2)

    def test_cells_around_an_axis_repeat_around_it(self):
        warp = msq.Warp(12, inner_radius=2, outer_radius=6)
        tube = msq.Lattice("bcc", radius=0.2, cell_size=1, warp=warp)
        points = np.random.default_rng(3).uniform(-5, 5, (2000, 3))
        turned = points.copy()
        c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
        turned[:, 0] = c * points[:, 0] - s * points[:, 1]
        turned[:, 1] = s * points[:, 0] + c * points[:, 1]
        onsets = tube.onset(points), tube.onset(turned)
        self.assertGreater(np.isfinite(onsets[0]).sum(), 500)
        np.testing.assert_allclose(onsets[0], onsets[1], atol=1e-9)

    @staticmethod
    def fields(u, v, w):
        return (msq.Field.grid(values, spacing=0.5, origin=(-3, -3, -3)) for values in (u, v, w))

    def test_a_map_of_boxes_is_a_grid(self):
        z, y, x = np.meshgrid(*3 * [np.linspace(-3, 3, 13)], indexing="ij")
        points = np.random.default_rng(4).uniform(-1.45, 1.45, (2000, 3))
        warp = msq.SampledWarp(*self.fields(x / 2, y / 2, z / 2))
        for plain, mapped in (
                (msq.Functional("gyroid", level=0.2, cell_size=2),
                 msq.Functional("gyroid", level=0.2, warp=warp)),
                (msq.Lattice("cubic", radius=0.2, cell_size=2),
                 msq.Lattice("cubic", radius=0.2, warp=warp))):
            onsets = plain.onset(points), mapped.onset(points)
            near = np.minimum(*onsets) < 0.5  # struts that leave the box are farther away
            self.assertGreater(near.sum(), 100)
            np.testing.assert_allclose(onsets[0][near], onsets[1][near], atol=1e-9)

    def test_maps_that_fold_are_refused(self):
        z, y, x = np.meshgrid(*3 * [np.linspace(-3, 3, 13)], indexing="ij")
        with self.assertRaisesRegex(msq.ArgumentError, r"folds, or is flat, in voxel \(6, 0, 0\)"):
            msq.Lattice("bcc", radius=0.1, warp=msq.SampledWarp(*self.fields(x * x, y, z)))

    def test_refusals(self):
        with self.assertRaisesRegex(msq.ArgumentError, "warp.count is 2"):
            msq.Lattice("bcc", radius=0.1, warp=msq.Warp(2))
        with self.assertRaisesRegex(msq.UnsupportedError, "a period and a warp"):
            msq.Lattice("bcc", radius=0.1, warp=msq.Warp(8), period=msq.Period([0], [1]))


class WarpedFoams(unittest.TestCase):
    def test_nothing_is_beyond_the_shell(self):
        points = np.random.default_rng(5).uniform(-5, 5, (4000, 3))
        radius = np.hypot(points[:, 0], points[:, 1])
        for sizes in ({"radius": 0.2}, {"wall_thickness": 0.2}):
            for more in ({}, {"shear_along": 0.5}, {"count_polar": 10}):
                warp = msq.Warp(20, inner_radius=2, outer_radius=4.5, **more)
                onsets = msq.Foam(cell_size=1, warp=warp, **sizes).onset(points)
                r = np.linalg.norm(points, axis=1) if "count_polar" in more else radius
                np.testing.assert_array_equal(np.isfinite(onsets), (r >= 2) & (r <= 4.5))

    def test_nothing_is_beyond_the_samples(self):
        coordinates = [msq.Field.grid(np.indices((9, 8, 7))[2 - n] * 0.9) for n in range(3)]
        points = np.random.default_rng(6).uniform(-1, 9, (4000, 3))
        for sizes in ({"radius": 0.2}, {"wall_thickness": 0.2}):
            onsets = msq.Foam(warp=msq.SampledWarp(*coordinates), **sizes).onset(points)
            holds = ((points >= 0) & (points <= (6, 7, 8))).all(axis=1)
            np.testing.assert_array_equal(np.isfinite(onsets), holds)

    def test_refusals(self):
        axis = [msq.Field.grid(np.indices((3, 3, 3))[2 - n] * 1.0) for n in range(3)]
        with self.assertRaisesRegex(msq.LimitError, "radius reaches 1.01; the limit is 1 "):
            msq.Foam(radius=1.01, warp=msq.SampledWarp(*axis))
        with self.assertRaisesRegex(msq.ArgumentError, "warp.outer_radius is 0"):
            msq.Foam(radius=0.1, warp=msq.Warp(8, inner_radius=1))


if __name__ == "__main__":
    unittest.main()
