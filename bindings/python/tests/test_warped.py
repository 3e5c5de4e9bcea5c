# SPDX-License-Identifier: Apache-2.0
"""Lattices in cells that vary in size or are bent."""
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

    def test_refusals(self):
        with self.assertRaisesRegex(msq.ArgumentError, "warp.count is 2"):
            msq.Lattice("bcc", radius=0.1, warp=msq.Warp(2))
        with self.assertRaisesRegex(msq.UnsupportedError, "a period and a warp"):
            msq.Lattice("bcc", radius=0.1, warp=msq.Warp(8), period=msq.Period([0], [1]))


if __name__ == "__main__":
    unittest.main()
