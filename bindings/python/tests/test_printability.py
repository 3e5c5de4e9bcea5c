# SPDX-License-Identifier: Apache-2.0
"""Printability, and warnings of contexts."""
import unittest

import numpy as np

import msq


class PrintabilityTest(unittest.TestCase):
    def setUp(self):
        block = msq.Shape.box((0, 0, 0), (8, 8, 8))
        self.hollow = msq.Model(block - msq.Shape.box((2, 2, 2), (5, 5, 5)))

    def test_a_hollow(self):
        slicer = self.hollow.slicer(layer_height=0.25, pitch=0.25)
        found = slicer.printability()
        self.assertEqual((found.island_count, found.loose_count, found.void_count), (0, 0, 1))
        self.assertEqual(found.layer_count, 32)
        self.assertAlmostEqual(found.void_volume, 27)
        self.assertAlmostEqual(found.solid_volume, 512 - 27)
        voids = found.findings_of("void")
        self.assertEqual(len(voids), 1)
        np.testing.assert_allclose(voids[0]["min"], (2, 2, 2))
        np.testing.assert_allclose(voids[0]["max"], (5, 5, 5))
        np.testing.assert_allclose(voids[0]["point"], (2.125, 2.125, 2.125))
        self.assertEqual(voids[0]["first_layer"], 8)
        self.assertEqual(len(found.findings_of("island")), 0)

    def test_options(self):
        slicer = self.hollow.slicer(layer_height=0.25, pitch=0.25)
        found = slicer.printability(kinds=["void", "thin"], width=4)
        self.assertEqual(found.thin_count, 1)
        self.assertEqual(set(found.findings["kind"]), {4, 8})
        self.assertEqual(slicer.printability(min_volume=28).void_count, 0)
        self.assertEqual(slicer.printability("loose", has_plate=False).loose_count, 0)

    def test_cups_and_overhangs(self):
        block = msq.Shape.box((0, 0, 0), (8, 8, 8))
        pot = msq.Model(block - msq.Shape.box((2, 2, 2), (5, 5, 8)))
        found = pot.slicer(layer_height=0.25, pitch=0.25).printability(["cup", "void"])
        self.assertEqual((found.cup_count, found.void_count), (1, 0))
        self.assertAlmostEqual(found.cup_volume, 9 * 6)
        slicer = self.hollow.slicer(layer_height=0.25, pitch=0.25)
        found = slicer.printability(["overhang", "cup"], overhang=0.5)
        self.assertEqual((found.overhang_count, found.cup_count), (1, 0))
        places = found.findings_of("overhang")
        np.testing.assert_allclose(places[0]["min"], (2.5, 2.5, 5))
        np.testing.assert_allclose(places[0]["max"], (4.5, 4.5, 5.25))

    def test_refusals(self):
        slicer = self.hollow.slicer(layer_height=0.25, pitch=0.25)
        with self.assertRaisesRegex(msq.ArgumentError, "width is 0"):
            slicer.printability(kinds=["thin"])
        with self.assertRaisesRegex(ValueError, "'bubble'"):
            slicer.printability(kinds=["bubble"])
        job = msq.Job()
        job.cancel()
        with self.assertRaises(msq.CancelledError):
            slicer.printability(job=job)


class WarningsTest(unittest.TestCase):
    def test_coarse_pitch(self):
        warnings = []
        context = msq.Context(on_warning=lambda kind, message: warnings.append((kind, message)))
        model = msq.Model(msq.Shape.box((0, 0, 0), (8, 8, 8), context=context),
                          [msq.Lattice("bcc", cell_size=2, radius=0.3, context=context)],
                          context=context)
        model.slicer(layer_height=0.1, pitch=0.1)
        self.assertEqual(warnings, [])
        model.slicer(layer_height=0.1, pitch=1)
        self.assertEqual([kind for kind, _ in warnings], ["coarse_pitch"])
        self.assertIn("2 pixels along x", warnings[0][1])

    def test_a_context_that_is_gone(self):
        warnings = []
        context = msq.Context(on_warning=lambda kind, message: warnings.append(kind))
        model = msq.Model(msq.Shape.box((0, 0, 0), (8, 8, 8), context=context),
                          [msq.Lattice("bcc", cell_size=2, radius=0.3, context=context)],
                          context=context)
        context.close()
        del context
        model.slicer(layer_height=0.1, pitch=1)
        self.assertLessEqual(len(warnings), 1)

    def test_what_is_no_function(self):
        with self.assertRaises(TypeError):
            msq.Context(on_warning=3)


if __name__ == "__main__":
    unittest.main()
