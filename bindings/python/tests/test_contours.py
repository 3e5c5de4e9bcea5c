# SPDX-License-Identifier: Apache-2.0
"""Contours as arrays."""
import gc
import unittest

import numpy as np

import msq


def area(ring):
    u, v = ring[:, 0].astype(float), ring[:, 1].astype(float)
    return 0.5 * float(np.sum(u * np.roll(v, -1) - np.roll(u, -1) * v))


class ContoursTest(unittest.TestCase):
    def setUp(self):
        self.ball = msq.Model(msq.Shape.sphere((1, 2, 3), 2))

    def test_a_disc(self):
        contours = self.ball.contours(3.0, 0.01)
        self.assertEqual(len(contours), 1)
        self.assertEqual(contours[0].shape[1], 2)
        self.assertEqual(contours[0].dtype, np.float64)
        self.assertAlmostEqual(area(contours[0]), 4 * np.pi, delta=4 * np.pi * 0.01)
        far = np.hypot(contours[-1][:, 0] - 1, contours[-1][:, 1] - 2)
        self.assertTrue(np.all(np.abs(far - 2) < 0.01))
        self.assertEqual(contours.parents.tolist(), [-1])
        self.assertEqual(contours.holes.tolist(), [False])
        self.assertEqual(contours.starts.tolist(), [0, len(contours.points)])
        self.assertIn("1 rings", repr(contours))
        with self.assertRaises(IndexError):
            contours[1]

    def test_views_keep_the_memory(self):
        ring = self.ball.contours(3.0, 0.01, type="int64", units=1e6)[0]
        before = ring.copy()
        gc.collect()
        self.ball.contours(2.0, 0.01, type="int64", units=1e6)
        np.testing.assert_array_equal(ring, before)
        self.assertEqual(ring.dtype, np.int64)
        with self.assertRaises(ValueError):
            ring[0, 0] = 1

    def test_topology(self):
        foam = msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)), [msq.Foam(cell_size=1, radius=0.1)])
        plain = foam.contours(2.0, 0.2)
        self.assertGreater(len(plain), 3)
        for part in (slice(0, 2), slice(None, None, -1), slice(-2, None), slice(99, None)):
            rings, expected = plain[part], list(plain)[part]
            self.assertEqual(len(rings), len(expected))
            for ring, other in zip(rings, expected):
                np.testing.assert_array_equal(ring, other)
        self.assertIsNone(plain.topology_count)
        counted = foam.contours(2.0, 0.2, topology_samples=8)
        self.assertGreater(counted.topology_count, 0)
        np.testing.assert_array_equal(counted.points, plain.points)
        self.assertEqual(self.ball.contours(3.0, 0.01, topology_samples=4).topology_count, 0)
        with self.assertRaisesRegex(ValueError, "topology_samples is 3"):
            foam.contours(2.0, 0.2, topology_samples=3)

    def test_windows_and_axes(self):
        half = self.ball.contours(1.0, 0.01, axis=0, window=((0, 0), (2, 10)), pitch=0.1)
        self.assertAlmostEqual(area(half[0]), 2 * np.pi, delta=0.2)
        self.assertEqual(half[0][:, 0].max(), 2)
        self.assertEqual(half.pitch, 0.09375)
        self.assertEqual(len(self.ball.contours(9.0, 0.01)), 0)

    def test_layers_of_a_slicer(self):
        slicer = self.ball.slicer(layer_height=0.5, pitch=0.1)
        ring = slicer.contours(3, 0.02, type="int32", units=1e5)[0]
        z = slicer.z(3) - 3
        self.assertAlmostEqual(area(ring) * 1e-10, np.pi * (4 - z * z), delta=0.2)

    def test_refusals(self):
        with self.assertRaisesRegex(msq.ArgumentError, "tolerance is 0"):
            self.ball.contours(3.0, 0.0)
        with self.assertRaisesRegex(ValueError, "type is 'int16'"):
            self.ball.contours(3.0, 0.1, type="int16")
        with self.assertRaisesRegex(ValueError, "two pairs"):
            self.ball.contours(3.0, 0.1, window=((0,), (1,)))
        with self.assertRaisesRegex(msq.LimitError, "units"):
            self.ball.contours(3.0, 0.1, type="int32", units=1e10)


if __name__ == "__main__":
    unittest.main()
