# SPDX-License-Identifier: Apache-2.0
"""What notebooks and the programs about them take: PNG, slices of slicers, bars, meshes."""
import io
import threading
import unittest

import numpy as np

import msq
from support import box_model

try:
    from PIL import Image
except ImportError:
    Image = None


class Png(unittest.TestCase):
    @unittest.skipIf(Image is None, "no Pillow to read PNG with")
    def test_pictures_are_what_pillow_reads(self):
        picture = box_model().render(width=31, height=17)
        read = np.asarray(Image.open(io.BytesIO(picture._repr_png_())))
        np.testing.assert_array_equal(read, picture.rgba)
        self.assertIsNone(box_model().render(width=3, height=2, outputs=("depth",))._repr_png_())

    @unittest.skipIf(Image is None, "no Pillow to read PNG with")
    def test_layers_are_upright(self):
        for output in ("bits", "bytes", "grey", "distance"):
            layer = box_model().slicer(layer_height=1, pitch=0.3, output=output)[1]
            read = np.asarray(Image.open(io.BytesIO(layer._repr_png_())))
            expected = layer.data if output == "grey" else 255 * layer.pixels.astype(np.uint8)
            np.testing.assert_array_equal(read, expected[::-1], output)
            self.assertGreater(read.max(), 0)


class Slices(unittest.TestCase):
    def test_slices_are_lists_of_layers(self):
        slicer = box_model().slicer(layer_height=0.5, pitch=0.25)
        whole = [layer.rows.tobytes() for layer in slicer]
        for part in (slice(2, 4), slice(None, None, -1), slice(-2, None), slice(6, 1, -2),
                     slice(0, 99), slice(3, 3), slice(5, 4)):
            layers = slicer[part]
            self.assertEqual([layer.index for layer in layers], list(range(8))[part])
            self.assertEqual([layer.rows.tobytes() for layer in layers], whole[part])
        with self.assertRaises(TypeError):
            slicer["2"]

    def test_extent_is_that_of_the_pixels(self):
        model = box_model()
        slicer = model.slicer(layer_height=0.5, pitch=0.5)
        np.testing.assert_allclose(slicer.extent, (0, 8, 0, 6), atol=1e-12)
        part = model.slicer(layer_height=0.5, pitch=0.5, window=((2, 4, 0), (6, 5, 1)))
        np.testing.assert_allclose(part.extent, (1, 4, 2, 4.5), atol=1e-12)
        with self.assertRaisesRegex(ValueError, "mirrored or transposed"):
            model.slicer(layer_height=0.5, pitch=0.5, mirror="x").extent


class Bar:
    def __init__(self, total):
        self.total, self.n, self.threads = total, 0, set()

    def update(self, amount):
        self.n += amount
        self.threads.add(threading.get_ident())


class Progress(unittest.TestCase):
    def test_the_bar_ends_at_its_total(self):
        bar = Bar(50)
        with msq.progress(bar, interval=0.001) as job:
            mesh = box_model().mesh(0.1, job=job)
        self.assertGreater(len(mesh.triangles), 1000)
        self.assertAlmostEqual(bar.n, 50)

    def test_the_bar_moves_meanwhile(self):
        bar, seen = Bar(1.0), []

        def stop_half_way(layer):
            seen.append(bar.n)
            while layer.index == 6 and bar.n < job.progress:
                pass
            return True

        with msq.progress(bar, interval=0.001) as job:
            box_model().slicer(layer_height=0.5, pitch=0.1).run(stop_half_way, job=job)
        self.assertGreater(seen[-1], 0)
        self.assertNotEqual(bar.threads, {threading.get_ident()})

    def test_the_job_cancels_and_the_thread_ends(self):
        bar, before = Bar(1.0), threading.active_count()
        with self.assertRaises(msq.CancelledError):
            with msq.progress(bar) as job:
                job.cancel()
                box_model().mesh(0.1, job=job)
        self.assertEqual(threading.active_count(), before)

    def test_a_bar_without_total_is_refused(self):
        with self.assertRaisesRegex(ValueError, "total is None"):
            with msq.progress(Bar(None)):
                pass

    def test_tqdm(self):
        try:
            from tqdm import tqdm
        except ImportError:
            self.skipTest("no tqdm")
        slicer = box_model().slicer(layer_height=0.5, pitch=0.5)
        with tqdm(slicer, file=io.StringIO()) as bar:
            self.assertEqual(bar.total, 8)
            self.assertEqual(sum(1 for _ in bar), 8)
        with tqdm(total=100, file=io.StringIO()) as bar:
            with msq.progress(bar) as job:
                box_model().mesh(0.2, job=job)
            self.assertAlmostEqual(bar.n, 100)


class Conventions(unittest.TestCase):
    def setUp(self):
        self.mesh = box_model(foam=False).mesh(0.5)

    def test_cells_of_vtk(self):
        cells = self.mesh.vtk_cells.reshape(-1, 4)
        self.assertEqual(cells.dtype, np.int64)
        self.assertTrue((cells[:, 0] == 3).all())
        np.testing.assert_array_equal(cells[:, 1:], self.mesh.triangles)
        graph = msq.Lattice("bcc", radius=0.2, cell_size=2).strut_graph((0, 0, 0), (4, 4, 4))
        lines = graph.vtk_lines.reshape(-1, 3)
        self.assertTrue((lines[:, 0] == 2).all())
        np.testing.assert_array_equal(lines[:, 1:], graph.struts)

    def test_vtk(self):
        try:
            from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
            from vtkmodules.vtkCommonCore import vtkPoints
            from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
            from vtkmodules.vtkFiltersCore import vtkMassProperties
        except ImportError:
            self.skipTest("no VTK")
        cells, points, data, mass = vtkCellArray(), vtkPoints(), vtkPolyData(), vtkMassProperties()
        cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(self.mesh.vtk_cells, deep=True))
        points.SetData(numpy_to_vtk(self.mesh.vertices, deep=True))
        data.SetPoints(points)
        data.SetPolys(cells)
        mass.SetInputData(data)
        self.assertAlmostEqual(mass.GetVolume(), 192, delta=0.5)

    def test_trimesh(self):
        try:
            import trimesh
        except ImportError:
            self.skipTest("no trimesh")
        made = trimesh.Trimesh(**self.mesh.trimesh_arguments)
        self.assertTrue(made.is_watertight)
        self.assertEqual(len(made.vertices), len(self.mesh.vertices))
        self.assertAlmostEqual(made.volume, 192, delta=0.5)

    def test_matplotlib(self):
        try:
            import matplotlib
            matplotlib.use("Agg")
            import matplotlib.pyplot as plt
        except ImportError:
            self.skipTest("no matplotlib")
        figure = plt.figure()
        drawn = figure.add_subplot(projection="3d").plot_trisurf(*self.mesh.vertices.T,
                                                                 triangles=self.mesh.triangles)
        self.assertEqual(len(drawn._vec[0]) // 3, len(self.mesh.triangles))
        slicer = box_model().slicer(layer_height=1, pitch=0.5)
        image = plt.imshow(slicer[1].pixels, origin="lower", extent=slicer.extent)
        np.testing.assert_allclose(image.get_extent(), (0, 8, 0, 6), atol=1e-12)
        plt.close(figure)


if __name__ == "__main__":
    unittest.main()
