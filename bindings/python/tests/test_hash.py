# SPDX-License-Identifier: Apache-2.0
"""Hashes of shapes, fields, structures, materials and models."""
import subprocess
import sys
import unittest

import numpy as np

import msq

MODEL = """
import msq
part = msq.Shape.box((0, 0, 0), (4, 4, 4))
foam = msq.Foam(cell_size=1, radius=0.15)
print(msq.Model(part, [msq.Scale(foam, skin=0.25)], material=msq.Material(7, density=2.5)).hash)
"""


def inside(points):
    return np.ones(len(points), bool)


@unittest.skipUnless(msq.build_info().with_xxhash, "this build has no hashes")
class Hash(unittest.TestCase):
    def assert_all_differ(self, objects):
        hashes = [made.hash for made in objects]
        for digits in hashes:
            self.assertRegex(digits, "^[0-9a-f]{32}$")
        self.assertEqual(len(set(hashes)), len(hashes))

    def test_equal_definitions_have_equal_hashes(self):
        box = ((0, 0, 0), (1, 2, 3))
        self.assertEqual(msq.Shape.box(*box).hash, msq.Shape.box(*box).hash)
        other = msq.Context(threads=1, cache_bytes=0)
        self.assertEqual(msq.Shape.box(*box).hash, msq.Shape.box(*box, context=other).hash)
        self.assertEqual(msq.Field.expression("x+1", 0, 1).hash,
                         msq.Field.expression(" x + a", 0, 1, parameters={"a": 1}).hash)
        self.assertEqual(msq.Foam(radius=0.1, method="direct").hash, msq.Foam(radius=0.1).hash)

    def test_all_kinds_of_objects_have_one(self):
        box, sphere = msq.Shape.box((0, 0, 0), (4, 4, 4)), msq.Shape.sphere((2, 2, 2), 2)
        foam, other = msq.Foam(radius=0.1), msq.Foam(radius=0.1, seed=1)
        field = msq.Field.gradient((0, 0, 0), 0.1, (0, 0, 1), 0.2)
        steel = msq.Material(1, density=7.8)
        one, two = msq.Model(box, foam), msq.Model(sphere, foam)
        self.assert_all_differ([
            box, sphere, box | sphere, box.placed(np.eye(4)), foam, other, msq.Foam(radius=field),
            field, field.map([(0, 0), (1, 1)]), steel, msq.Material(2, density=7.8),
            msq.Material(1, density=field), msq.Model(box), one, two, msq.Model(box, other),
            msq.Model(box, foam, material=steel), msq.Model(box, msq.Scale(foam, skin=0.1)),
            msq.Model.regions(one, two), msq.Model.regions(two, one)])

    def test_functions_of_python_have_that_of_their_key(self):
        def shape(key):
            return msq.Shape.host(inside, (0, 0, 0), (1, 1, 1), hash_key=key)

        self.assert_all_differ([shape(1), shape(2), shape((1 << 128) - 1), shape(1 << 64),
                                shape("a gear, version 2"), shape(b"a gear, version 3")])
        self.assertEqual(shape("a gear").hash, shape(b"a gear").hash)
        for wrong in (0, -1, 1 << 128):
            with self.assertRaisesRegex(ValueError, f"hash_key is {wrong};"):
                shape(wrong)
        with self.assertRaises(TypeError):
            shape(1.5)
        with self.assertRaisesRegex(msq.UnsupportedError, "hash_key"):
            _ = msq.Model(shape(None)).hash

    def test_all_functions_of_python_take_a_key(self):
        def values(points):
            return np.zeros(len(points))

        def none(points):
            return np.zeros(len(points.points), bool)

        self.assert_all_differ([
            msq.Field.host(values, 0, 1, hash_key=5), msq.HostStructure(none, hash_key=5),
            msq.HostFunctional(values, hash_key=5),
            msq.Shape.host(inside, (0, 0, 0), (1, 1, 1), hash_key=5)])

    def test_other_processes_have_the_same(self):
        made = subprocess.run([sys.executable, "-c", MODEL], check=True, text=True,
                              stdout=subprocess.PIPE)
        self.assertEqual(made.stdout.strip(), "ddc236b0bdebcbb47b2da4ff401de0b5")


if __name__ == "__main__":
    unittest.main()
