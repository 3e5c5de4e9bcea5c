# SPDX-License-Identifier: Apache-2.0
"""Layers at the heights that a model file lists."""
import json
import re
import unittest
import zipfile

from command import Case

UNEVEN = [0.5, 1, 3, 3.25, 9]


class Heights(Case):
    def write(self, heights, **more):
        """A model file of a ball with these layers."""
        path = self.folder / "model.json"
        slicing = {"pitch": 0.5, "layer_z": heights, **more}
        scales = [{"shape": {"sphere": {"center": [5, 5, 5], "radius": 5}}}]
        path.write_text(json.dumps({"msq_model": 1, "scales": scales, "slicing": slicing}))
        return path

    def slices(self, *arguments):
        """The heights at which slices begin and end, and the z of the box around them."""
        path = self.folder / "stack.3mf"
        self.msq("slice", *arguments, "-o", path)
        with zipfile.ZipFile(path) as archive:
            text = archive.read("3D/3dmodel.model").decode()
        ends = [float(z) for z in re.findall(r'(?:zbottom|ztop)="([^"]*)"', text)]
        box = {float(z) for z in re.findall(r'<vertex [^>]* z="([^"]*)"', text)}
        self.assertEqual(box, {ends[0], ends[-1]})
        return ends

    def test_slices_end_halfway_between_layers(self):
        model = self.write(UNEVEN)
        ends = [0.25, 0.75, 2, 3.125, 6.125, 11.875]
        self.assertEqual(self.slices(model), ends)
        # Those of a part of the stack are those of the whole.
        for first, end in ((0, 2), (1, 4), (2, 3), (4, 5)):
            self.assertEqual(self.slices(model, "--layers", f"{first}:{end}"),
                             ends[first:end + 1])
        # A layer_height beside listed heights has no meaning.
        self.assertEqual(self.slices(self.write(UNEVEN, layer_height=0.1)), ends)

    def test_slices_of_one_layer(self):
        ball = self.write([5])
        self.refuse(1, "slicing.layer_z lists one layer; .3mf needs its height", "slice", ball, "-o",
                    self.folder / "stack.3mf")
        self.assertEqual(self.slices(self.write([5], layer_height=0.5)), [4.75, 5.25])
        self.assertEqual(self.slices("box:2,2,2", "-p", "1", "-l", "0.5", "--layers", "2:3"), [1, 1.5])

    def test_layers_without_a_height(self):
        model = self.write([1, 1 + 2 ** -52, 1 + 2 ** -51])
        self.refuse(1, "layer 0 at z = 1 would be a slice from 1 to 1", "slice", model, "-o",
                    self.folder / "stack.3mf")
        self.assertEqual(self.names(), ["model.json"])

    def archive(self, *arguments):
        path = self.folder / "part.sl1"
        self.msq("slice", *arguments, "--no-thumbnails", "--panel", "64,48", "--panel-size", "16,12",
                 "-o", path)
        with zipfile.ZipFile(path) as archive:
            config = archive.read("config.ini").decode()
            images = [archive.read(name) for name in sorted(archive.namelist())
                      if name.endswith(".png")]
        return float(re.search(r"(?m)^layerHeight = (.*)$", config)[1]), images

    def test_evenly_spaced_layers_make_an_archive(self):
        middles = [0.125 + 0.25 * i for i in range(40)]
        wanted = self.archive(self.write(middles))
        self.assertEqual(wanted[0], 0.25)
        model = self.write(middles[:1], layer_height=0.25)
        self.assertEqual(self.archive(model), (0.25, wanted[1][:1]))
        for more in ({}, {"layer_height": 0.5}):
            model = self.write(middles, **more)
            self.assertEqual(self.archive(model), wanted)
            self.assertEqual(self.archive(model, "--layers", "7:8"), (0.25, wanted[1][7:8]))
        self.assertEqual(self.archive(model, "--layer-height", "0.25"), wanted)
        self.assertEqual(self.archive(self.write(middles[3:7])), (0.25, wanted[1][3:7]))

    def test_uneven_layers_make_none(self):
        out = ["-o", self.folder / "part.sl1"]
        model = self.write(UNEVEN)
        for layers in ([], ["--layers", "0:2"], ["--layers", "2:3"]):
            self.refuse(1, "layer 1 is at z = 1; an SL1 archive needs evenly spaced layers, here 2.125 "
                        "apart with this one at 2.625", "slice", model, *layers, *out)
        self.refuse(1, "slicing.layer_z lists one layer; .sl1 needs its height", "slice",
                    self.write([5]), *out)
        self.assertEqual(self.names(), ["model.json"])

    def test_close_layers_have_unlike_heights_in_svg(self):
        path = self.folder / "stack.svg"
        heights = [5, 5.000001, 5.000003]
        self.msq("slice", self.write(heights), "-o", path)
        self.assertEqual([float(z) for z in re.findall(r'slic3r:z="([^"]*)"', path.read_text())],
                         heights)


if __name__ == "__main__":
    unittest.main()
