# SPDX-License-Identifier: Apache-2.0
"""Files of printers: the layers that msq computes, as programs of others or plain code read them."""
import ctypes
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
import zipfile
import zlib

import numpy as np

import msq
from msq import _abi
from support import box_model

if "MSQ_IO_LIBRARY" not in os.environ:
    print("skipped: msq_io is not built (MSQ_BUILD_TOOLS)")
    sys.exit(77)

import msq.io
from msq import _io_abi


def read_png(data):
    """The pixels of a PNG of one channel, by zlib and the filters of the format."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, pixels = 8, b""
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        body, (crc,) = data[at + 8:at + 8 + size], struct.unpack(">I", data[at + 8 + size:at + 12 + size])
        assert zlib.crc32(name + body) == crc
        if name == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        if name == b"IDAT":
            pixels += body
        at += 12 + size
    channels = {0: 1, 2: 3, 6: 4}[colour]
    width_bytes = (width * depth * channels + 7) // 8
    rows = np.frombuffer(zlib.decompress(pixels), np.uint8).reshape(height, width_bytes + 1)
    out = np.zeros((height, width_bytes), np.uint8)
    for y, row in enumerate(rows):
        left = channels if depth == 8 else 1
        above = out[y - 1] if y else np.zeros(width_bytes, np.uint8)
        if row[0] == 0:
            out[y] = row[1:]
        elif row[0] == 2:
            out[y] = row[1:] + above
        else:  # the others, byte by byte
            for i in range(width_bytes):
                a = int(out[y, i - left]) if i >= left else 0
                c = int(above[i - left]) if i >= left else 0
                b = int(above[i])
                p = a + b - c
                paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
                out[y, i] = (int(row[1 + i]) + {1: a, 3: (a + b) // 2, 4: paeth}[row[0]]) % 256
    return out if depth == 1 else out.reshape((height, width, channels)).squeeze(2) \
        if channels == 1 else out.reshape((height, width, channels))


class Io(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.model = box_model()

    def names(self):
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.rglob("*"))

    def test_errors_are_those_of_python(self):
        (self.folder / "there.stl").write_text("old")
        for kind, name in ((FileNotFoundError, "no_folder/a.stl"), (FileExistsError, "there.stl")):
            with self.assertRaises(kind) as caught:
                msq.io.save_mesh(self.model, self.folder / name, 1)
            self.assertIsInstance(caught.exception, msq.FileError)
            self.assertEqual(caught.exception.filename, str(self.folder / name))
            self.assertIsNotNone(caught.exception.errno)

        def fail(_points):
            raise ZeroDivisionError("mine")

        shape = msq.Shape.box((0, 0, 0), (4, 4, 4))
        model = msq.Model(shape, [msq.Foam(radius=msq.Field.host(fail, 0.1, 0.3))])
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            msq.io.save_mesh(model, self.folder / "a.stl", 1)
        for text, call in (("null", lambda: msq.io.save_mesh(model, "a.stl\0.ply", 1, format="stl")),
                           ("level", lambda: msq.io.save_png(
                               self.model.slicer(layer_height=1, pitch=1), self.folder / "a", level=2**32))):
            with self.assertRaisesRegex(ValueError, text):
                call()

    def test_png(self):
        for output in ("bits", "bytes", "grey"):
            for level in (0, 1, 6):
                slicer = self.model.slicer(layer_height=0.5, pitch=0.1, output=output)
                path = self.folder / f"{output}{level}"
                made = msq.io.save_png(slicer, path, level=level, threads=2, prefix="a", digits=3)
                files = sorted(path.iterdir())
                self.assertEqual([file.name for file in files], [f"a{i:03}.png" for i in range(8)])
                self.assertEqual(made.layers, 8)
                self.assertEqual(made.bytes, sum(file.stat().st_size for file in files))
                for layer, file in zip(slicer, files):
                    np.testing.assert_array_equal(read_png(file.read_bytes()), layer.data)

    def test_parts_of_a_stack(self):
        slicer = self.model.slicer(layer_height=0.5, pitch=0.1)
        msq.io.save_png(slicer, self.folder / "whole")
        for first, count in ((0, 3), (3, 4), (7, None)):
            msq.io.save_png(slicer, self.folder / "parts", first=first, count=count)
        whole, parts = ({path.name: path.read_bytes() for path in (self.folder / name).iterdir()}
                        for name in ("whole", "parts"))
        self.assertEqual(whole, parts)

    def test_failures_leave_nothing(self):
        slicer = self.model.slicer(layer_height=0.5, pitch=0.1)
        existing = self.folder / "a.svg"
        existing.write_text("mine")
        contours = self.model.slicer(layer_height=0.5, pitch=0.1,
                                     output=[msq.Output("contours", tolerance=0.01)])
        with self.assertRaisesRegex(msq.FileError, "replace"):
            msq.io.save_svg(contours, existing)
        with self.assertRaisesRegex(msq.ArgumentError, "the output of the layers is 1"):
            msq.io.save_svg(slicer, self.folder / "b.svg")
        with self.assertRaisesRegex(msq.FileError, "none"):
            msq.io.save_png(slicer, self.folder / "none" / "layers")
        with self.assertRaisesRegex(msq.ArgumentError, "level is 10"):
            msq.io.save_png(slicer, self.folder / "layers", level=10)
        job = msq.Job()
        job.cancel()
        with self.assertRaises(msq.CancelledError):
            msq.io.save_png(slicer, self.folder / "layers", job=job)

        def fail(points):
            raise ZeroDivisionError("of the host")

        host = msq.Model(msq.Shape.box((0, 0, 0), (4, 4, 4)),
                         [msq.Foam(cell_size=2, radius=msq.Field.host(fail, low=0.1, high=0.2))])
        with self.assertRaisesRegex(ZeroDivisionError, "of the host"):
            msq.io.save_png(host.slicer(layer_height=1, pitch=0.5), self.folder / "layers")
        for wrong in (self.model, None):
            with self.assertRaisesRegex(TypeError, "must be a Slicer"):
                msq.io.save_png(wrong, self.folder / "layers")
        self.assertEqual(self.names(), ["a.svg"])
        self.assertEqual(existing.read_text(), "mine")
        msq.io.save_svg(contours, existing, replace=True)
        self.assertIn("<svg", existing.read_text())

    @unittest.skipUnless(sys.platform == "linux" and os.path.exists("/dev/full"), "no /dev/full")
    def test_a_limit_of_the_size_of_files(self):
        program = ("import msq, msq.io, resource, signal, sys\n"
                   "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
                   "resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))\n"
                   "model = msq.Model(msq.Shape.sphere((0, 0, 0), 9), [msq.Foam(cell_size=2, radius=0.3)])\n"
                   "try:\n"
                   "    msq.io.save_png(model.slicer(layer_height=1, pitch=0.02), 'layers')\n"
                   "except msq.FileError as error:\n"
                   "    sys.exit(0 if 'layer' in str(error) else 1)\n"
                   "sys.exit(2)\n")
        done = subprocess.run([sys.executable, "-B", "-c", program], cwd=self.folder, check=False)
        self.assertEqual(done.returncode, 0)
        self.assertEqual(self.names(), [])

    def test_sl1(self):
        panel = msq.io.Panel(pixels=(96, 64), size=(9.6, 6.4), portrait=False, mirror=(False, True))
        slicer = msq.io.panel_slicer(self.model, layer_height=0.5, panel=panel, grey_samples=2)
        self.assertEqual((slicer.width, slicer.height, slicer.layer_count), (96, 64, 8))
        path = self.folder / "part.sl1"
        made = msq.io.save_sl1(slicer, path, panel=panel, name="box", exposure_time=7.5,
                               thumbnail=self.model, material="resin", settings="my_key = 1\n")
        self.assertEqual((made.layers, made.bytes), (8, path.stat().st_size))
        with zipfile.ZipFile(path) as archive:
            self.assertIsNone(archive.testzip())
            config = archive.read("config.ini").decode()
            self.assertIn("expTime = 7.5", config)
            self.assertIn("jobDir = box", config)
            self.assertIn("my_key = 1", archive.read("prusaslicer.ini").decode())
            for layer in slicer:
                pixels = read_png(archive.read(f"box{layer.index:05}.png"))
                np.testing.assert_array_equal(pixels, layer.data)
            self.assertEqual(sum("thumbnail" in name for name in archive.namelist()), 2)

    def test_panel_of_listed_heights(self):
        heights = [1.25, 1.75, 2.25]
        slicer = msq.io.panel_slicer(self.model, layer_z=heights)
        self.assertEqual([slicer.z(i) for i in range(len(slicer))], heights)
        with self.assertRaisesRegex(msq.ArgumentError, "layer_height"):
            msq.io.panel_slicer(self.model)
        uneven = msq.io.panel_slicer(self.model, layer_z=[1, 2, 4])
        with self.assertRaisesRegex(msq.ArgumentError, "apart"):
            msq.io.save_sl1(uneven, self.folder / "part.sl1")

    def test_contours(self):
        slicer = self.model.slicer(layer_height=0.5, pitch=0.1, output=[
            msq.Output("bits"), msq.Output("contours", tolerance=0.01)])
        rings = sum(len(layer.contours()) for layer in slicer)
        msq.io.save_svg(slicer, self.folder / "a.svg", output=1)
        root = xml.etree.ElementTree.parse(self.folder / "a.svg").getroot()
        space = "{http://www.w3.org/2000/svg}"
        self.assertEqual(len(root.findall(f"{space}g")), 8)
        self.assertEqual(len(root.findall(f".//{space}polygon")), rings)
        msq.io.save_svg(slicer, self.folder / "files", output=1, layout="files", decimals=2)
        self.assertEqual(len(list((self.folder / "files").iterdir())), 8)
        msq.io.save_slices(slicer, self.folder / "a.3mf", output=1)
        with zipfile.ZipFile(self.folder / "a.3mf") as archive:
            text = archive.read("3D/3dmodel.model").decode()
        self.assertEqual((text.count("<s:slice "), text.count("<s:polygon ")), (8, rings))
        with self.assertRaisesRegex(ValueError, "layout is 'one'"):
            msq.io.save_svg(slicer, self.folder / "b.svg", layout="one")

    def test_meshes(self):
        for name in ("a.stl", "a.ply"):
            self.model.save_mesh(self.folder / name, 0.5)
            msq.io.save_mesh(self.model, self.folder / f"io_{name}", 0.5)
            self.assertEqual((self.folder / name).read_bytes(),
                             (self.folder / f"io_{name}").read_bytes())
        with self.assertRaisesRegex(ValueError, "format is 'obj'"):
            msq.io.save_mesh(self.model, self.folder / "a.obj", 0.5)

    def test_beams(self):
        graph = msq.Lattice("octet", radius=0.2, cell_size=2).strut_graph((0, 0, 0), (4, 4, 4))
        corners = np.array([(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4)], np.float32)
        triangles = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        msq.io.save_beams(graph, self.folder / "a.3mf", vertices=corners, triangles=triangles,
                          clipping="inside")
        if msq.build_info().with_assimp:  # which reads 3MF
            file = msq.BeamFile.open(self.folder / "a.3mf")
            self.assertEqual(len(file.lattices[0].beams), len(graph))
        with self.assertRaisesRegex(ValueError, "go together"):
            msq.io.save_beams(graph, self.folder / "b.3mf", vertices=corners)

    def test_pictures(self):
        for shape in ((5, 7), (5, 7, 3), (5, 7, 4)):
            pixels = np.random.RandomState(1).randint(0, 256, shape).astype(np.uint8)
            msq.io.save_picture(self.folder / "a.png", pixels[:, ::-1], replace=True)
            np.testing.assert_array_equal(read_png((self.folder / "a.png").read_bytes()),
                                          pixels[:, ::-1])
        with self.assertRaisesRegex(ValueError, "float64"):
            msq.io.save_picture(self.folder / "b.png", np.zeros((3, 3)))


class Complete(unittest.TestCase):
    def test_every_function_is_bound(self):
        text = pathlib.Path(msq.io.__file__).read_text(encoding="utf-8")
        missing = [name for name in _io_abi.FUNCTIONS
                   if not re.search(rf"\b(?:_io|library)\.{name}\b", text)
                   and not name.startswith("msq_io_file_")
                   and not (name.endswith("_init") and f"_io_abi.{name[:-5]})" in text)]
        self.assertEqual(missing, [])
        for name, kind in vars(_io_abi).items():
            if name.endswith("_def") and name not in vars(_abi):
                for label, _ in kind._fields_:
                    if label not in ("struct_size", "reserved"):
                        self.assertRegex(text, rf"\.{label}\b|\"{label}\"", f"{name}.{label}")

    def test_layout(self):
        self.assertEqual(ctypes.sizeof(_io_abi.msq_io_writer_def), 40)
        for name in ("msq_io_writer_def", "msq_io_png_def", "msq_io_sl1_def", "msq_io_svg_def",
                     "msq_io_panel_def", "msq_io_beams_def", "msq_io_slices_def"):
            made = msq.io._defaults(getattr(_io_abi, name))  # which the library refuses of another size
            self.assertEqual(made.struct_size, ctypes.sizeof(made))


if __name__ == "__main__":
    unittest.main()
