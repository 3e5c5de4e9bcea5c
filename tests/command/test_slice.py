# SPDX-License-Identifier: Apache-2.0
"""Layers are those of the library, whole or in windows; pictures show the part."""
import json
import re
import sys
import unittest
import zipfile

import msq
import numpy as np
from command import SOURCE, Case

sys.path.insert(0, str(SOURCE / "tests" / "examples"))
import png_pixels  # noqa: E402

CONTEXT = msq.Context(threads=2)
MODEL = msq.Model(msq.Shape.box((0, 0, 0), (8, 6, 4), context=CONTEXT),
                  [msq.Foam(cell_size=2, radius=0.3, context=CONTEXT)])
FOAM = ["box:8,6,4", "--foam", "2", "--radius", "0.3"]
PLAN = [*FOAM, "--pitch", "0.125", "--layer-height", "0.25"]


def pixels(path):
    return np.array(png_pixels.read(path)[2])[:, :, 0]


class Layers(Case):
    def test_bits(self):
        self.msq("slice", *PLAN, "-o", self.folder / "layers")
        slicer = MODEL.slicer(pitch=0.125, layer_height=0.25)
        self.assertEqual(self.names(), ["layers"] +
                         [f"layers/layer{i:05}.png" for i in range(len(slicer))])
        for i in (0, 7, 15):
            found = pixels(self.folder / f"layers/layer{i:05}.png")
            self.assertTrue((found[::-1] == slicer.layer(i).pixels).all())

    def test_grey_and_mirrors(self):
        slicer = MODEL.slicer(pitch=0.125, layer_height=2, output="grey", grey_samples=2)
        layer = slicer.layer(1).data[:, :64]
        for axes, wanted in (("none", layer[::-1]), ("x", layer[::-1, ::-1]), ("y", layer),
                             ("xy", layer[:, ::-1])):
            self.msq("slice", *FOAM, "--pitch", "0.125", "--layer-height", "2", "--grey", "2",
                     "--mirror", axes, "-q", "-o", self.folder / axes)
            self.assertTrue((pixels(self.folder / axes / "layer00001.png") == wanted).all(), axes)

    def test_windows_are_parts_of_the_whole(self):
        for format in ("png", "svg"):
            plan = [*PLAN, "--format", format, "-o"]
            self.msq("slice", *plan, self.folder / "whole")
            for window in ("0:5", "5:6", "6:8", "8:99" if format == "png" else "8:"):
                self.msq("slice", *plan, f"{self.folder}/parts/", "--layers", window)
            whole = {path.name: path.read_bytes() for path in (self.folder / "whole").iterdir()}
            parts = {path.name: path.read_bytes() for path in (self.folder / "parts").iterdir()}
            self.assertEqual(len(whole), 16 if format == "png" else 32)
            self.assertEqual(whole, parts)
        for window in ("3:3", "4:2", "16:20"):
            self.refuse(1, f"--layers: {window} is no window of the 16 layers", "slice", *PLAN,
                        "--layers", window, "-o", self.folder / "none")
        for window in ("3", "a:b", "1:2:3", "-1:2"):
            self.refuse(2, f"--layers: '{window}' is not FIRST:END", "slice", *PLAN,
                        f"--layers={window}", "-o", self.folder / "none")
        self.assertFalse((self.folder / "none").exists())

    def test_svg_has_the_contours(self):
        path = self.folder / "stack.svg"
        self.msq("slice", *PLAN, "--tolerance", "0.02", "-o", path)
        text = path.read_text()
        self.assertEqual(len(re.findall("<g ", text)), 16)
        rings = len(MODEL.contours(2.125, 0.02, pitch=0.125))
        group = re.findall(r"<g .*?</g>", text, flags=re.S)[8]
        self.assertEqual(len(re.findall("<polygon", group)), rings)

    def test_3mf_has_the_contours(self):
        path = self.folder / "stack.3mf"
        self.msq("slice", *PLAN, "--tolerance", "0.02", "-o", path)
        with zipfile.ZipFile(path) as archive:
            text = archive.read("3D/3dmodel.model").decode()
        slices = re.findall(r"<s:slice ztop[^>]*?(?:/>|>.*?</s:slice>)", text, flags=re.S)
        self.assertEqual(len(slices), 16)
        contours = MODEL.contours(2.125, 0.02, pitch=0.125)
        self.assertEqual(len(re.findall("<s:polygon", slices[8])), len(contours))

    def test_an_archive_for_a_printer(self):
        path = self.folder / "part.sl1"
        self.msq("slice", *FOAM, "--layer-height", "0.5", "--panel", "160,120", "--panel-size",
                 "10,7.5", "--landscape", "--mirror", "none", "--exposure", "3", "-o", path)
        with zipfile.ZipFile(path) as archive:
            self.assertIsNone(archive.testzip())
            names = archive.namelist()
            config = archive.read("config.ini").decode()
            images = sorted(name for name in names if re.fullmatch(r"[^/]*\d+\.png", name))
            archive.extract(images[4], self.folder)
        self.assertEqual(len(images), 8)
        self.assertEqual(len([name for name in names if name.startswith("thumbnail/")]), 2)
        self.assertRegex(config, r"(?m)^expTime = 3$")
        found = pixels(self.folder / images[4])
        self.assertEqual(found.shape, (120, 160))
        share = found.mean() / 255 * 75 / 48
        self.assertAlmostEqual(share, MODEL.slicer(pitch=0.0625, layer_height=0.5).layer(4)
                               .pixels.mean(), delta=0.01)
        window = self.folder / "window.sl1"
        self.msq("slice", *FOAM, "--layer-height", "0.5", "--panel", "160,120", "--panel-size",
                 "10,7.5", "--no-thumbnails", "--layers", "2:5", "-o", window)
        with zipfile.ZipFile(window) as archive:
            self.assertEqual(len([n for n in archive.namelist() if n.endswith(".png")]), 3)

        flat = self.folder / "flat.sl1"
        self.msq("slice", "box:8,6,4", "--layer-height", "4", "--panel", "160,120", "--panel-size",
                 "10,7.5", "--no-thumbnails", "-o", flat)
        with zipfile.ZipFile(flat) as archive:
            self.assertRegex(archive.read("config.ini").decode(), r"(?m)^layerHeight = 4$")

    def test_options_of_other_formats(self):
        folder = self.folder / "layers"
        for text, options in (("--panel: is for .sl1 files", ["--panel", "9,9", "-o", folder]),
                              ("--pitch: follows from the panel", ["-o", f"{folder}.sl1"]),
                              ("--grey: is for pixels", ["--grey", "4", "-o", f"{folder}.svg"]),
                              ("--grey: 3 is none of 2, 4", ["--grey", "3", "-o", folder]),
                              ("--tolerance: is for SVG", ["--tolerance", "1", "-o", folder]),
                              ("--format: is for a folder",
                               ["--format", "png", "-o", f"{folder}.svg"]),
                              ("is no folder, and ends in none of", ["-o", f"{folder}.ctb"])):
            self.refuse(2, text, "slice", *PLAN, *options)
        self.refuse(2, "needs --layer-height", "slice", *FOAM, "-p", "1", "-o", folder)
        self.refuse(2, "needs --pitch", "slice", *FOAM, "-l", "1", "-o", folder)
        self.assertEqual(self.names(), [])


class Pictures(Case):
    def draw(self, *options):
        path = self.folder / "picture.png"
        self.msq("render", "box:8,6,4", "--size", "60,40", "--samples", "1", *options, "-o", path)
        return path

    def test_a_picture(self):
        lattice = ["--lattice", "cubic", "--cell", "2", "--radius", "0.3"]
        staged = np.array(png_pixels.read(self.draw(*lattice))[2], int)
        self.assertEqual(staged.shape, (40, 60, 3))
        drawn = np.abs(staged - staged[0, 0]).max(axis=2) > 40
        y, x = np.nonzero(drawn)
        self.assertTrue(abs(x.mean() - 30) < 4 and abs(y.mean() - 20) < 4)
        again = np.array(png_pixels.read(self.draw(*lattice, "--threads", "1"))[2], int)
        self.assertTrue((again == staged).all())
        nearer = np.array(png_pixels.read(self.draw(*lattice, "--zoom", "3"))[2], int)
        self.assertGreater((np.abs(nearer - staged[0, 0]).max(axis=2) > 40).mean(), drawn.mean())
        glass = np.array(png_pixels.read(self.draw(*lattice, "--glass"))[2], int)
        self.assertFalse((glass == staged).all())
        # The shadow is on the ground, beside the part.
        plain = np.array(png_pixels.read(self.draw(*lattice, "--plain"))[2], int)
        shadow = (np.abs(staged - staged[0, 0]).max(axis=2) > 8) & (plain[..., 3] == 0)
        self.assertGreater(shadow.mean(), 0.02)
        # Of 26 bytes of IHDR the colour type, 6: with opacity.
        self.assertEqual(self.draw("--plain", "--perspective", "40", "--view", "-30,-20", "--at",
                                   "4,3,2").read_bytes()[25], 6)

    def test_nested_scales_and_a_cut(self):
        cell = {"grid": {"cell_size": 4}}
        scales = [{"shape": {"box": {"max": [8, 6, 4]}}},
                  {"structure": {"lattice": {"unit_cell": "cubic", "radius": 1, **cell}}},
                  {"structure": {"functional": {"function": "gyroid", "grid": {"cell_size": 0.8}}}},
                  {"structure": {"functional": {"function": "expression", "expression": "pi-y",
                                                "grid": {"cell_size": 80,
                                                         "origin": [-40, -37, -40]}}}}]
        shares = []
        for count in (2, 3, 4):
            path = self.folder / "model.json"
            path.write_text(json.dumps({"msq_model": 1, "scales": scales[:count]}))
            out = self.folder / "nested.png"
            self.msq("render", path, "--plain", "--size", "60,40", "--samples", "1", "-o", out)
            shares.append((np.array(png_pixels.read(out)[2])[..., 3] > 0).mean())
        self.assertGreater(shares[0], shares[1])  # holes
        self.assertGreater(0.9 * shares[1], shares[2])
        self.assertGreater(shares[2], 0.05)


if __name__ == "__main__":
    unittest.main()
