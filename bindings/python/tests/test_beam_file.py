# SPDX-License-Identifier: Apache-2.0
"""Beam lattices of 3MF files."""
import gc
import io
import os
import tempfile
import unittest
import zipfile

import numpy as np

import msq

MODEL = """<?xml version="1.0"?><model unit="centimeter" requiredextensions="b"
 xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
 xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"><resources>
<object id="1"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="4" y="0" z="0"/>
<vertex x="0" y="4" z="0"/><vertex x="0" y="0" z="4"/></vertices><triangles>
<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/>
<triangle v1="0" v2="3" v3="2"/></triangles></mesh></object>
<object id="2"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="4" y="0" z="0"/></vertices>
<b:beamlattice minlength="0.1" radius="0.5" cap="butt" clippingmode="inside" clippingmesh="1">
<b:beams><b:beam v1="0" v2="1" r1="0.5" r2="0.25"/></b:beams></b:beamlattice></mesh></object>
</resources><build><item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 8"/><item objectid="2"/>
</build></model>"""


def archive(model):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as package:
        package.writestr("3D/3dmodel.model", model)
    return file.getvalue()


@unittest.skipUnless(msq.build_info().with_assimp, "this build reads no 3MF")
class BeamFiles(unittest.TestCase):
    def test_lattices_are_arrays_in_millimetres(self):
        file = msq.BeamFile.from_memory(archive(MODEL))
        self.assertEqual(file.mesh_triangles, 4)
        lattice, = file.lattices
        self.assertEqual(lattice.clipping, "inside")
        self.assertTrue((lattice.nodes == [[0, 0, 0], [40, 0, 0]]).all())
        self.assertTrue((lattice.radii == [[5, 2.5]]).all())
        self.assertTrue((lattice.caps == 2).all())
        self.assertEqual(len(lattice.balls), 0)
        self.assertEqual(lattice.max, (42.5, 5, 5))
        self.assertFalse(lattice.nodes.flags.writeable)
        nodes = lattice.nodes
        model = msq.Model(lattice.clipping_shape(), [lattice.structure()])
        self.assertAlmostEqual(file.mesh().info.min[2], 80)
        self.assertIn("1 beams", repr(file))
        file.close()
        del file, lattice
        gc.collect()
        self.assertEqual(nodes[1, 0], 40)  # the array keeps the file
        self.assertEqual(list(model.contains([[20.0, 1, 1], [20, -1, 1], [20, 4, 1]])),
                         [True, False, False])

    def test_files_are_opened_by_path(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "beams.3mf")
            with self.assertRaises(FileNotFoundError):
                msq.BeamFile.open(path)
            with open(path, "wb") as file:
                file.write(archive(MODEL))
            self.assertEqual(len(msq.BeamFile.open(path).lattices), 1)
            with self.assertRaisesRegex(msq.UnsupportedError, "msq_beam_file_open"):
                msq.Shape.from_file(path)
        with self.assertRaises(msq.LimitError):
            msq.BeamFile.from_memory(archive(MODEL), max_bytes=100)
        with self.assertRaises(TypeError):
            msq.BeamFile()


if __name__ == "__main__":
    unittest.main()
