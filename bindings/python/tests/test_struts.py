# SPDX-License-Identifier: Apache-2.0
"""Struts as arrays."""
import gc
import unittest

import numpy as np

import msq


class Struts(unittest.TestCase):
    def test_a_lattice_is_a_beam_model(self):
        graph = msq.Lattice("cubic", radius=0.125).strut_graph((0, 0, 0), (4, 4, 4))
        self.assertEqual(len(graph), 192)
        self.assertEqual(graph.nodes.shape, (112, 3))
        ends = graph.nodes[graph.struts]
        lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        self.assertTrue((lengths == 1).all())
        self.assertTrue((graph.radii == 0.125).all())
        self.assertFalse(graph.cuts.any())
        self.assertFalse(graph.nodes.flags.writeable)
        self.assertIn("192 struts", repr(graph))

    def test_tiles_have_the_struts_of_the_whole(self):
        foam = msq.Foam(radius=0.1, cell_size=2)
        whole = foam.strut_graph((0, 0, 0), (6, 6, 6))
        tiles = [foam.strut_graph((0, 0, z), (6, 6, z + 2)) for z in (0, 2, 4)]
        ids = np.concatenate([tile.strut_ids for tile in tiles])
        self.assertEqual(set(map(tuple, ids.tolist())), set(map(tuple, whole.strut_ids.tolist())))
        self.assertEqual(len(ids), len(whole))
        near = foam.strut_graph((0, 0, 0), (6, 6, 6), near=True)
        self.assertGreater(len(near), len(whole))

    def test_struts_are_cut(self):
        ball = msq.Shape.sphere((2, 2, 2), 1.75)
        lattice = msq.Lattice("octet", radius=0.05)
        graph = lattice.strut_graph((0, 0, 0), (4, 4, 4), near=True, shape=ball)
        self.assertTrue(graph.cuts.any())
        away = np.linalg.norm(graph.nodes - 2, axis=1)
        self.assertLess(away.max(), 1.75 + 1e-12)

    def test_arrays_outlive_the_graph(self):
        graph = msq.Lattice("bcc", radius=0.1).strut_graph((0, 0, 0), (2, 2, 2))
        nodes, copy = graph.nodes, graph.nodes.copy()
        graph.close()
        del graph
        gc.collect()
        self.assertTrue((nodes == copy).all())

    def test_functional_structures_have_none(self):
        with self.assertRaises(msq.UnsupportedError):
            msq.Functional("gyroid").strut_graph((0, 0, 0), (1, 1, 1))


if __name__ == "__main__":
    unittest.main()
