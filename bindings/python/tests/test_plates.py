# SPDX-License-Identifier: Apache-2.0
"""Plate lattices: planes written out in NumPy, own triangles and struts, and what is refused."""
import unittest

import numpy as np

import msq

POINTS = (np.random.RandomState(4).rand(3000, 3) - 0.5) * 20
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
FLOOR = [(0, 1, 3), (0, 3, 2)]


def contains(structure):
    return msq.Model(msq.Shape.box((-50, -50, -50), (50, 50, 50)), [structure]).contains(POINTS)


def to_planes(size):
    """Distances along each axis to the nearest plane n * size."""
    cells = POINTS / size
    return np.abs(cells - np.round(cells)) * size


class Plates(unittest.TestCase):
    def test_cubic(self):
        size = np.array((3.0, 4.0, 2.5))
        found = contains(msq.PlateLattice(cell_size=size, thickness=0.5))
        np.testing.assert_array_equal(found, (to_planes(size) <= 0.25).any(axis=1))
        found = contains(msq.PlateLattice(cell_size=size, thickness=0.5,
                                          face_factors=(2, 2, 1, 1, 0.5, 0.5)))
        halves = np.array((0.5, 0.25, 0.125))
        np.testing.assert_array_equal(found, (to_planes(size) <= halves).any(axis=1))

    def test_own_triangles_and_struts(self):
        """Floors, and columns from floor to floor through nodes of another list."""
        column = msq.UnitCell(nodes=[(0.5, 0.5, 0), (0.5, 0.5, 1)], struts=[(0, 1)])
        found = contains(msq.PlateLattice((CORNERS, FLOOR), cell_size=4, thickness=0.6,
                                          unit_cell=column, radius=0.9))
        floors = to_planes(4.0)[:, 2] <= 0.3
        columns = np.hypot(*(POINTS[:, :2] - 4 * np.floor(POINTS[:, :2] / 4) - 2).T) <= 0.9
        np.testing.assert_array_equal(found, floors | columns)
        lattice = contains(msq.Lattice(column, radius=0.9, cell_size=4))
        np.testing.assert_array_equal(lattice, columns)

    def test_thickness_by_a_field(self):
        field = msq.Field.gradient((-10, 0, 0), 0.0, (10, 0, 0), 2.0)
        found = contains(msq.PlateLattice((CORNERS, FLOOR), cell_size=4, thickness=field))
        wanted = to_planes(4.0)[:, 2] <= 0.5 * (POINTS[:, 0] + 10) / 10
        self.assertLessEqual(np.count_nonzero(found != wanted), 0)

    def test_refused(self):
        for given, text in (({"thickness": 0}, "thickness is 0"),
                            ({"thickness": 1, "plate_cell": "octet"}, "plate_cell"),
                            ({"thickness": 1, "face_factors": (1, 2)}, "number of faces is 2"),
                            ({"thickness": 1, "plate_cell": (CORNERS, FLOOR),
                              "face_factors": (1,)}, "1 face_factors"),
                            ({"thickness": 1, "plate_cell": (CORNERS, [(0, 1, 9)])}, "node"),
                            ({"thickness": 1, "radius": -1}, "radius is -1")):
            with self.assertRaisesRegex(Exception, text):
                msq.PlateLattice(**given)


if __name__ == "__main__":
    unittest.main()
