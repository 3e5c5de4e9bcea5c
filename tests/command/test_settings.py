# SPDX-License-Identifier: Apache-2.0
"""Settings of a model file hold unless an option takes their place."""
import json
import re
import sys
import unittest
import zipfile

from command import SOURCE, Case

sys.path.insert(0, str(SOURCE / "tests" / "examples"))
import png_pixels  # noqa: E402


class Settings(Case):
    def write(self, low, high, more=(), **settings):
        """A model file of a box."""
        path = self.folder / "model.json"
        scales = [{"shape": {"box": {"min": low, "max": high}}}, *more]
        path.write_text(json.dumps({"msq_model": 1, "scales": scales, **settings}))
        return path

    def area_of_first_layer(self, path):
        """Of the polygons of an SVG stack; holes count as they turn."""
        group = re.search(r"<g .*?</g>", path.read_text(), flags=re.S)[0]
        area = 0
        for kind, text in re.findall(r'slic3r:type="(\w+)" points="([^"]*)"', group):
            points = [tuple(map(float, point.split(","))) for point in text.split()]
            twice = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(points, points[1:] + points[:1]))
            area += (-1 if kind == "hole" else 1) * abs(twice) / 2
        return area

    def test_units_of_contours(self):
        for units in (1, 1000):
            contours = {"type": "int64" if units > 1 else "float64", "units": units, "tolerance": 0.02,
                        "pitch": 0.1}
            model = self.write([1, 2, 3], [11, 8, 7], slicing={
                "pitch": 0.1, "layer_height": 1,
                "outputs": [{"output": "contours", "contours": contours}]})
            self.msq("slice", model, "-o", self.folder / "stack.svg")
            self.assertAlmostEqual(self.area_of_first_layer(self.folder / "stack.svg"), 60, delta=0.1)

    def test_pitch_and_box_replace_those_of_contours(self):
        walls = {"structure": {"functional": {"grid": {"cell_size": 4}, "kind": "sheet", "thickness": 0.1}}}
        contours = {"tolerance": 0.5, "pitch": 1, "window": {"min": [0, 0], "max": [5, 5]}}
        model = self.write([0, 0, 0], [20, 20, 4], [walls], slicing={
            "pitch": 1, "layer_height": 1, "outputs": [{"output": "contours", "contours": contours}]})
        path = self.folder / "stack.svg"
        self.msq("slice", model, "--pitch", "0.05", "--tolerance", "0.005", "-o", path)
        corner = self.area_of_first_layer(path)
        self.assertGreater(corner, 2)
        self.msq("slice", model, "--pitch", "0.05", "--tolerance", "0.005", "--box", "0,0,0,20,20,4",
                 "-o", path)
        self.assertAlmostEqual(self.area_of_first_layer(path), 47.5, delta=0.5)

    def layers(self, name, *arguments):
        """The pixels of all layers."""
        self.msq("slice", *arguments, "-o", self.folder / name, "-q")
        return [[[pixel[0] for pixel in row] for row in png_pixels.read(path)[2]]
                for path in sorted((self.folder / name).iterdir())]

    def test_mirrors_replace_those_of_a_model(self):
        def model(*orientation):
            cylinder = {"cylinder": {"from": [0, 0, 0], "to": [8, 5, 3], "radius": 1}}
            path = self.folder / "model.json"
            path.write_text(json.dumps({"msq_model": 1, "scales": [{"shape": cylinder}], "slicing": {
                "pitch": 0.25, "layer_height": 1, "orientation": orientation}}))
            return path

        up = self.layers("up", model())[1]  # y upwards
        ways = {"none": up, "x": [row[::-1] for row in up], "y": up[::-1],
                "xy": [row[::-1] for row in up[::-1]]}
        self.assertEqual(len({str(rows) for rows in ways.values()}), 4)
        for own in ((), ("mirror_x",), ("mirror_y",), ("mirror_x", "mirror_y")):
            for axes, rows in ways.items():
                self.assertEqual(self.layers("a", model(*own), "--mirror", axes)[1], rows, (own, axes))
        transposed = self.layers("a", model("mirror_x", "transpose"), "--mirror", "none")[1]
        self.assertEqual(transposed, [list(column) for column in zip(*up[::-1])][::-1])
        # Without the option, the layers are those of the model's slicer.
        self.assertEqual(self.layers("a", model("mirror_x"))[1], ways["xy"])

    def test_a_box_replaces_what_counts_its_pixels_and_layers(self):
        box = ["--box", "0,0,0,4,4,3"]
        for settings in ({"resolution": [4, 4], "layer_count": 1}, {"window": {"first": [1, 1, 1]}},
                         {"resolution": [4, 4], "window": {"first": [1, 1, 0], "count": [2, 2, 1]}}):
            model = self.write([0, 0, 0], [4, 4, 3], slicing={
                "pitch": 0.25, "layer_height": 1, **settings,
                "region": {"min": [0, 0, 0], "max": [1, 1, 2]}})
            layers = self.layers("layers", model, *box)
            self.assertEqual(len(layers), 3)
            for rows in layers:
                self.assertEqual(rows, [[1] * 16] * 16)
            for path in (self.folder / "layers").iterdir():
                path.unlink()

    def test_values_below_0_are_refused(self):
        contours = {"output": "contours", "contours": {"pitch": -0.5, "tolerance": 0.1}}
        dense = {"output": "contours", "contours": {"pitch": 0.5, "tolerance": -0.1}}
        panel = ["--panel", "100,80", "--panel-size", "50,40"]
        pixels, lines = ["layers"], ["stack.svg", "stack.3mf"]
        for text, names, slicing in (
                ("pitch is -0.25; it must be finite and not negative", pixels + lines,
                 {"pitch": -0.25, "layer_height": 1}),
                ("pitch is -2; it must be finite and not negative", pixels + lines,
                 {"pitch": [0.5, -2], "layer_height": 1}),
                ("is -3; it must be positive and finite", pixels + lines + ["part.sl1"],
                 {"pitch": 0.5, "layer_height": -3}),
                ("pitch is -0.5; it must be positive and finite", lines,
                 {"pitch": 0.5, "layer_height": 1, "outputs": [contours]}),
                ("tolerance is -0.1; it must be positive and finite", lines,
                 {"pitch": 0.5, "layer_height": 1, "outputs": [dense]})):
            model = self.write([0, 0, 0], [10, 8, 4], slicing=slicing)
            for name in names:
                options = panel if name.endswith(".sl1") else []
                self.refuse(1, text, "slice", model, "-o", self.folder / name, *options)
                self.assertEqual(self.names(), ["model.json"])

    def test_fine_contours_keep_their_digits(self):
        path = self.folder / "stack.svg"
        self.msq("slice", "box:0.01,0.01,0.0004", "-p", "0.00005", "-l", "0.00004", "-o", path)
        heights = re.findall(r'slic3r:z="([^"]*)"', path.read_text())
        self.assertEqual(len(set(heights)), 10)
        self.assertAlmostEqual(self.area_of_first_layer(path), 1e-4, delta=1e-8)

    def test_a_panel_in_a_frame(self):
        turned = {"axes": [0, 1, 0, 0, 0, 1, 1, 0, 0]}
        for origin, axes, layers in (([0, 0, 0], turned, 40), ([100, -7, 3], turned, 40),
                                     ([100, -7, 3], {}, 8)):
            model = self.write([0, 0, 0], [20, 6, 4], slicing={
                "layer_height": 0.5, "pitch": 0.5, "frame": {"origin": origin, **axes}})
            path = self.folder / "part.sl1"
            self.msq("slice", model, "-o", path, "--panel", "100,80", "--panel-size", "50,40")
            with zipfile.ZipFile(path) as archive:
                config = archive.read("config.ini").decode()
                images = [name for name in archive.namelist() if re.fullmatch(r"[^/]*\d+\.png", name)]
            self.assertEqual(len(images), layers)
            self.assertAlmostEqual(float(re.search("usedMaterial = (.*)", config)[1]), 0.48, places=6)

    def test_a_view_stays_where_options_leave_it(self):
        model = self.write([0, 0, 0], [10, 5, 6], view={
            "direction": [0, 1, 0], "width": 60, "height": 40, "background": [1, 1, 1, 1]})
        for options, aspect in (((), 10 / 6), (("--perspective", "20"), 10 / 6),
                                (("-s", "40,80"), 10 / 6)):
            path = self.folder / "picture.png"
            self.msq("render", model, "-o", path, "--plain", *options)
            width, height, rows = png_pixels.read(path)
            seen = [(x, y) for y, row in enumerate(rows) for x, pixel in enumerate(row) if pixel[3]]
            sides = [1 + max(at[axis] for at in seen) - min(at[axis] for at in seen) for axis in (0, 1)]
            self.assertLess(sides[0], width + 1)
            self.assertAlmostEqual(sides[0] / sides[1], aspect, delta=0.12, msg=str(options))
            self.assertLess(len(seen), 0.95 * width * height)


if __name__ == "__main__":
    unittest.main()
