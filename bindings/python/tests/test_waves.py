# SPDX-License-Identifier: Apache-2.0
"""Sums of waves: the definition of docs/concepts.md written out in NumPy, and what is refused."""
import unittest

import numpy as np

import msq

MASK = (1 << 64) - 1
POINTS = (np.random.RandomState(3).rand(4000, 3) - 0.5) * 40


def output(stream, n):
    """SplitMix64 as a counter-based generator."""
    x = (stream + n * 0x9E3779B97F4A7C15) & MASK
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & MASK
    return x ^ (x >> 31)


def wave(stream, cones, tile):
    """Direction and phase."""
    def number(n):
        return (output(stream, n) >> 11) / 2.0**53
    cosines = [np.cos(np.radians(angle)) for angle in cones]
    areas = [1 - cosine if angle else 0.0 for cosine, angle in zip(cosines, cones)]
    attempt = 0
    while True:
        chosen, along, turn, last = (number(4 * attempt + i) for i in (1, 2, 3, 4))
        attempt += 1
        axis = int(np.searchsorted(np.cumsum(areas), chosen * sum(areas), side="right"))
        direction = np.zeros(3)
        direction[axis] = cosines[axis] + areas[axis] * along
        across = np.sqrt(1 - direction[axis]**2)
        direction[(axis + 1) % 3] = across * np.cos(2 * np.pi * turn)
        direction[(axis + 2) % 3] = across * np.sin(2 * np.pi * turn)
        holding = sum(1 for other in range(3) if other == axis or (
            cones[other] and abs(direction[other]) >= cosines[other]))
        if last * holding >= 1:
            continue
        for i, cells in enumerate(tile):
            if cells:
                direction[i] = np.floor(direction[i] * cells + 0.5) / cells
        if direction.any():
            return direction, number(0)


def sums(points, count, seed, wavelength, cones=(90, 0, 0), tile=(0, 0, 0)):
    stream = output(seed, 0x7761766573)
    waves = [wave(output(stream, i), cones, tile) for i in range(count)]
    directions = np.array([direction for direction, _ in waves])
    phases = np.array([phase for _, phase in waves])
    turns = points / np.asarray(wavelength) @ directions.T + phases
    return np.sqrt(2 / count) * np.cos(2 * np.pi * turns).sum(axis=1)


def contains(waves):
    return msq.Model(msq.Shape.box((-50, -50, -50), (50, 50, 50)), [waves]).contains(POINTS)


class Waves(unittest.TestCase):
    def assert_is(self, found, expected_sum, level):
        clear = np.abs(expected_sum - level) > 1e-9
        np.testing.assert_array_equal(found[clear], (expected_sum <= level)[clear])
        self.assertGreater(clear.mean(), 0.99)
        self.assertTrue(0.1 < found.mean() < 0.9)

    def test_hold_what_the_definition_says(self):
        for given in ({"cones": (90, 0, 0)}, {"cones": (0, 0, 15)}, {"cones": (70, 50, 0)},
                      {"cones": (90, 0, 0), "tile": (4, 0, 6)}):
            found = contains(msq.Waves((5, 6, 7), count=33, seed=2**63 + 5, level=0.25,
                                       cone_angles=given["cones"], tile=given.get("tile", (0, 0, 0))))
            self.assert_is(found, sums(POINTS, 33, 2**63 + 5, (5, 6, 7), **given), 0.25)

    def test_of_a_sheet_hold_small_magnitudes(self):
        found = contains(msq.Waves(5, count=20, kind="sheet", level=0.75))
        self.assert_is(found, np.abs(sums(POINTS, 20, 0, 5)), 0.75)

    def test_have_the_level_of_a_volume_fraction(self):
        found = contains(msq.Waves(5, count=20, volume_fraction=0.3))
        self.assert_is(found, sums(POINTS, 20, 0, 5), -0.52440051270804089)

    def test_take_a_field_of_levels(self):
        field = msq.Field.gradient((0, 0, -20), -1, (0, 0, 20), 1)
        found = contains(msq.Waves(5, count=20, level=field))
        self.assert_is(found, sums(POINTS, 20, 0, 5) - POINTS[:, 2] / 20, 0)

    def test_repeat_in_their_tile(self):
        waves = msq.Waves(5, count=20, tile=(4, 4, 4))
        model = msq.Model(msq.Shape.box((-50, -50, -50), (50, 50, 50)), [waves])
        np.testing.assert_array_equal(model.contains(POINTS), model.contains(POINTS + (20, -20, 20)))

    def test_refuse_what_makes_no_sense(self):
        for kind, text, given in (
                (ValueError, "count", {"count": -1}),
                (msq.ArgumentError, "count is 5000", {"count": 5000}),
                (ValueError, "three", {"tile": (1, 2)}),
                (msq.ArgumentError, "cone_angles are all 0", {"cone_angles": (0, 0, 0)}),
                (msq.ArgumentError, "volume_fraction is 1", {"volume_fraction": 1}),
                (msq.ArgumentError, "both", {"volume_fraction": 0.5, "level": 0.1})):
            with self.assertRaisesRegex(kind, text):
                msq.Waves(5, **given)


if __name__ == "__main__":
    unittest.main()
