# SPDX-License-Identifier: Apache-2.0
"""Preview meshes as arrays and files."""
import io
import os
import pathlib
import tempfile
import unittest

import numpy as np

import msq


def volume(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    return float(np.sum(np.einsum("ij,ij->i", a, np.cross(b, c)))) / 6


class SurfaceTest(unittest.TestCase):
    def setUp(self):
        self.ball = msq.Model(msq.Shape.sphere((1, 2, 3), 2))

    def test_a_ball(self):
        mesh = self.ball.mesh(0.2)
        self.assertEqual(mesh.vertices.dtype, np.float64)
        self.assertEqual(mesh.normals.dtype, np.float32)
        self.assertEqual(mesh.triangles.dtype, np.uint32)
        out = (mesh.vertices - (1, 2, 3)) / 2
        self.assertLess(np.abs(np.linalg.norm(out, axis=1) - 1).max(), 1e-4)
        self.assertLess(np.abs(mesh.normals - out).max(), 1e-4)
        self.assertAlmostEqual(volume(mesh), 32 * np.pi / 3, delta=0.3)
        edges = np.sort(mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        self.assertTrue((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())

    def test_slabs_and_boxes(self):
        whole = self.ball.mesh(0.25)
        slabs = self.ball.mesh(0.25, slab_layers=2)
        for one, other in zip(whole, slabs):
            np.testing.assert_array_equal(one, other)
        half = self.ball.mesh(0.25, box=((-9, -9, -9), (1, 9, 9)))
        self.assertEqual(half.vertices[:, 0].max(), 1)
        self.assertAlmostEqual(volume(half), 16 * np.pi / 3, delta=0.3)
        nothing = self.ball.mesh(0.25, box=((8, 8, 8), (9, 9, 9)))
        self.assertEqual([len(array) for array in nothing], [0, 0, 0])

    def test_files(self):
        mesh = self.ball.mesh(0.25)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "ball.ply")
            self.ball.save_mesh(path, 0.25)
            read = msq.Shape.from_file(path).info
            self.assertEqual(read.triangles, len(mesh.triangles))
            self.assertEqual(read.vertices, len(mesh.vertices))
            self.assertTrue(read.closed)
        stl = io.BytesIO()
        self.ball.save_mesh(stl, 0.25, format="stl", slab_layers=1)
        self.assertEqual(len(stl.getvalue()), 84 + 50 * len(mesh.triangles))

    def test_failures_leave_files_as_they_are(self):
        def fails(points):
            if points.points[:, 2].max() > 3:
                raise OSError("in the middle")
            return np.ones(len(points.points), bool)

        broken = msq.Model(msq.Shape.sphere((1, 2, 3), 2), msq.HostStructure(fails))
        job = msq.Job()
        job.cancel()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "ball.stl")
            for has_file in (False, True):
                if has_file:
                    path.write_text("precious")
                for error, call in ((msq.ArgumentError, lambda: self.ball.save_mesh(path, -1)),
                                    (msq.CancelledError, lambda: self.ball.save_mesh(path, 1, job=job)),
                                    (OSError, lambda: broken.save_mesh(path, 0.25, slab_layers=1))):
                    with self.assertRaises(error):
                        call()
                    self.assertEqual(os.listdir(folder), ["ball.stl"] if has_file else [])
                    self.assertTrue(not has_file or path.read_text() == "precious")
            path.chmod(0o640)
            link = pathlib.Path(folder, "link.stl")
            link.symlink_to(path.name)
            self.ball.save_mesh(link, 1)
            self.assertTrue(link.is_symlink())
            self.assertEqual(path.stat().st_mode & 0o777, 0o640)
            self.assertTrue(msq.Shape.from_file(path).info.closed)
            new = pathlib.Path(folder, "new.stl")
            self.ball.save_mesh(new, 1)
            pathlib.Path(folder, "by_open").touch()
            self.assertEqual(new.stat().st_mode, pathlib.Path(folder, "by_open").stat().st_mode)
            with self.assertRaises(FileNotFoundError) as caught:
                self.ball.save_mesh(pathlib.Path(folder, "none", "a.stl"), 1)
            self.assertEqual(caught.exception.filename, os.path.join(folder, "none", "a.stl"))
        self.ball.save_mesh("/dev/null", 1, format="stl")

    def test_wrong_arguments(self):
        with self.assertRaises(msq.ArgumentError):
            self.ball.mesh(0)
        with self.assertRaises(ValueError):
            self.ball.mesh(1, box=((0, 0), (1, 1)))
        with self.assertRaises(ValueError):
            self.ball.save_mesh("ball.obj", 1)
        with self.assertRaises(ValueError):
            self.ball.save_mesh(io.BytesIO(), 1)

        class Full(io.BytesIO):
            def write(self, _):
                raise OSError("full")

        with self.assertRaisesRegex(OSError, "full"):
            self.ball.save_mesh(Full(), 0.5, format="stl")


if __name__ == "__main__":
    unittest.main()
