# SPDX-License-Identifier: Apache-2.0
"""Stacks of TIFF that other programs wrote are the images that they were: Pillow's files of several
pages in each compression that is read, and what tiffcp makes of them."""
import importlib.util
import json
import shutil
import subprocess
import unittest

from command import Case, run

if importlib.util.find_spec("PIL"):
    from PIL import Image

WIDTH, HEIGHT, PAGES = 13, 11, 5


def value(i, j, k):
    return (i * i + 3 * j + 11 * k) % 100


@unittest.skipUnless(importlib.util.find_spec("PIL"), "no Pillow (Debian: python3-pil)")
class Tiff(Case):
    def pages(self, mode, scale=1):
        made = []
        for k in range(PAGES):
            image = Image.new(mode, (WIDTH, HEIGHT))
            image.putdata([scale * value(i, j, k) for j in range(HEIGHT) for i in range(WIDTH)])
            made.append(image)
        return made

    def hash(self, image, threshold):
        path = self.folder / "model.json"
        grid = {"grid": {"cell_size": [0.5, 0.5, 2]}}
        path.write_text(json.dumps({"msq_model": 1, "scales": [
            {"shape": {"voxels": {"image": {**image, **grid}, "threshold": threshold}}}]}))
        done = run("info", path, "--json")
        if "MSQ_WITH_TIFF is off" in done.stderr:
            self.skipTest("a build without libtiff")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["model_hash"]

    def wanted(self, value_type, scale=1):
        values = [scale * value(i, j, k) for k in range(PAGES) for j in range(HEIGHT)
                  for i in range(WIDTH)]
        return self.hash({"values": values, "value_type": value_type,
                          "size": [WIDTH, HEIGHT, PAGES]}, 40 * scale)

    def save(self, name, pages, **options):
        pages[0].save(self.folder / name, save_all=True, append_images=pages[1:], **options)

    def test_compressions_of_8_and_16_bits(self):
        for mode, value_type, scale in (("L", "uint8", 1), ("I;16", "uint16", 500)):
            wanted = self.wanted(value_type, scale)
            for compression in (None, "tiff_lzw", "tiff_adobe_deflate", "packbits"):
                with self.subTest(f"{mode} {compression}"):
                    self.save("a.tif", self.pages(mode, scale), compression=compression)
                    self.assertEqual(self.hash({"file": "a.tif"}, 40 * scale), wanted)

    def test_a_list_of_files(self):
        wanted = self.wanted("uint8")
        pages = self.pages("L")
        for k, page in enumerate(pages):
            page.save(self.folder / f"slice{k}.tiff", compression="tiff_lzw")
        files = [f"slice{k}.tiff" for k in range(PAGES)]
        self.assertEqual(self.hash({"files": files}, 40), wanted)
        self.assertNotEqual(self.hash({"files": files[::-1]}, 40), wanted)

    @unittest.skipUnless(shutil.which("tiffcp"), "no tiffcp (Debian: libtiff-tools)")
    def test_what_tiffcp_writes(self):
        wanted = self.wanted("uint16", 500)
        self.save("a.tif", self.pages("I;16", 500))
        for options in (["-c", "lzw:2"], ["-c", "zip:2", "-r", "3"], ["-B"], ["-8", "-r", "1"]):
            with self.subTest(options):
                subprocess.run(["tiffcp", *options, "a.tif", "b.tif"], cwd=self.folder, check=True,
                               capture_output=True)
                self.assertEqual(self.hash({"file": "b.tif"}, 40 * 500), wanted)

    def test_what_is_no_grey_stack(self):
        model = self.folder / "model.json"
        for mode, options, text in (("RGB", {}, "page 1 has 3 samples per pixel"),
                                    ("1", {}, "page 1 has 1 bits per sample"),
                                    ("P", {}, "photometric interpretation 3"),
                                    ("F", {}, "page 1 has 32 bits per sample"),
                                    ("L", {"compression": "jpeg"}, "page 1 has compression 7")):
            Image.new(mode, (4, 4)).save(self.folder / "a.tif", **options)
            model.write_text(json.dumps({"msq_model": 1, "scales": [
                {"shape": {"voxels": {"image": {"file": "a.tif"}}}}]}))
            done = run("info", model)
            if "MSQ_WITH_TIFF is off" in done.stderr:
                self.skipTest("a build without libtiff")
            self.assertEqual(done.returncode, 1)
            self.assertIn(text, done.stderr)


if __name__ == "__main__":
    unittest.main()
