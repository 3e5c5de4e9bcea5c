# SPDX-License-Identifier: Apache-2.0
"""Model files: what options describe as a file, and commands that take the file in their place."""
import json
import shutil
import unittest

from command import BRACKET, Case

FOAM = ["--foam", "4", "--radius", "0.4", "--radius-top", "0.6", "--skin", "0.5"]
BOX = "box:8,6,4"


class Models(Case):
    def write(self, name="model.json", **settings):
        """The model file of a box with a foam."""
        path = self.folder / name
        self.msq("model", BOX, *FOAM, "--title", "a box", "-o", path)
        if settings:
            document = json.loads(path.read_text())
            document.update(settings)
            path.write_text(json.dumps(document))
        return path

    def info(self, *arguments):
        return json.loads(self.msq("info", "--json", *arguments))

    def test_the_same_model(self):
        path = self.write()
        found = self.info(path)
        self.assertEqual(found["model_hash"], self.info(BOX, *FOAM)["model_hash"])
        self.assertEqual((found["title"], found["has_slicing"]), ("a box", False))
        self.assertEqual(json.loads(self.msq("model", BOX, *FOAM, "--title", "a box")),
                         json.loads(path.read_text()))

    def test_files_are_found_from_the_model_file(self):
        parts = self.folder / "parts"
        parts.mkdir()
        shutil.copy(BRACKET, parts)
        options = [*FOAM, "--up", "y", "--unit", "cm"]
        wanted = self.info(BRACKET, *options)["model_hash"]
        self.msq("model", "bracket.stl", *options, "-o", "../model.json", cwd=parts)
        self.assertEqual(self.info(self.folder / "model.json")["model_hash"], wanted)
        self.folder.joinpath("model.json").rename(parts / "model.json")
        self.refuse(1, "parts/bracket.stl", "info", parts / "model.json")
        self.msq("model", "bracket.stl", *options, "-o", "here.json", cwd=parts)
        self.assertEqual(self.info(parts / "here.json")["model_hash"], wanted)
        # A file elsewhere is named by its whole path, which only --any-files allows.
        other = self.folder / "other"
        other.mkdir()
        arguments = ["model", "bracket.stl", *options, "-o", other / "model.json"]
        self.refuse(2, "parts/bracket.stl' is neither in the folder", *arguments, cwd=parts)
        self.assertEqual(list(other.iterdir()), [])
        self.msq(*arguments, "--any-files", cwd=parts)
        self.refuse(1, "bracket.stl", "info", other / "model.json")
        self.assertEqual(self.info(other / "model.json", "--any-files")["model_hash"], wanted)

    def test_what_is_written_is_read(self):
        """Files are named as they are spelled, where that can be read again, and not at all otherwise."""
        wanted = self.info(BRACKET)["model_hash"]
        for name in ("in", "in/sub", "out", "in/c:d", "in/b\\s"):
            (self.folder / name).mkdir()
        for name in ("in/part.stl", "in/sub/part.stl", "out/part.stl", "in/c:d/part.stl",
                     "in/b\\s/part.stl", "in/sub/a:b.stl"):
            shutil.copy(BRACKET, self.folder / name)
        (self.folder / "in/link.stl").symlink_to(self.folder / "out/part.stl")
        (self.folder / "in/linked").symlink_to(self.folder / "out")
        (self.folder / "way").symlink_to(self.folder / "in")
        (self.folder / "out/deep.stl").symlink_to(self.folder / "in/part.stl")
        for mesh, output, name in (
                ("in/part.stl", "in/model.json", "part.stl"),
                ("in/sub/part.stl", "in/model.json", "sub/part.stl"),
                ("in/sub/../part.stl", "in/model.json", "part.stl"),
                ("in/link.stl", "in/model.json", "link.stl"),
                ("in/linked/part.stl", "in/model.json", "linked/part.stl"),
                ("in/part.stl", "way/model.json", "part.stl"),
                ("way/part.stl", "in/model.json", "part.stl"),
                ("way/part.stl", "way/model.json", "part.stl"),
                ("out/deep.stl", "in/model.json", "part.stl"),
                ("in/part.stl", "-", "in/part.stl")):
            with self.subTest(mesh=mesh, output=output):
                text = self.msq("model", mesh, "-o", output, cwd=self.folder)
                path = self.folder / output
                if output == "-":
                    path = self.folder / "stdout.json"
                    path.write_text(text)
                shape, = json.loads(path.read_text())["scales"]
                self.assertEqual(shape["shape"]["file"]["file"], name)
                self.assertEqual(self.info(path)["model_hash"], wanted)
                path.unlink()
        for mesh, text in (("in/c:d/part.stl", "'c:d/part.stl' has a colon or a backslash"),
                           ("in/b\\s/part.stl", "'b\\s/part.stl' has a colon or a backslash"),
                           ("in/sub/a:b.stl", "'sub/a:b.stl' has a colon"),
                           ("out/part.stl", "out/part.stl' is neither in the folder")):
            with self.subTest(mesh=mesh):
                path = self.folder / "in/model.json"
                path.write_text("what was there")
                self.refuse(2, text, "model", mesh, "-o", path, cwd=self.folder)
                self.assertEqual(path.read_text(), "what was there")
                self.msq("model", mesh, "-o", path, "--any-files", cwd=self.folder)
                self.refuse(1, "must be relative", "info", path)
                self.assertEqual(self.info(path, "--any-files")["model_hash"], wanted)
        self.refuse(1, "none.stl", "model", "none.stl", "-o", path, cwd=self.folder)
        self.refuse(1, "none/model.json", "model", "in/part.stl", "-o", "none/model.json",
                    cwd=self.folder)
        self.refuse(2, "--any-files: is for model files", "model", BOX, "--any-files")

    def test_commands_take_it(self):
        path = self.write()
        for arguments, output in ((["slice", "-p", "0.25", "-l", "0.5"], "a.svg"),
                                  (["mesh", "-p", "0.5"], "a.stl"),
                                  (["render", "--size", "40,30", "--samples", "1"], "a.png")):
            command, *options = arguments
            self.msq(command, path, *options, "-o", self.folder / output)
            self.msq(command, BOX, *FOAM, *options, "-o", self.folder / f"b{output}")
            self.assertEqual((self.folder / output).read_bytes(),
                             (self.folder / f"b{output}").read_bytes(), command)
        points = "1,1,1\n4,3,2\n"
        self.assertEqual(self.msq("query", path, "-", input=points),
                         self.msq("query", BOX, "-", *FOAM, input=points))
        stats = [json.loads(self.msq("stats", *model, "--samples", "5000", "--json"))
                 for model in ([path], [BOX, *FOAM])]
        self.assertEqual(stats[0]["volume_fraction"], stats[1]["volume_fraction"])
        self.assertEqual(self.msq("struts", path), self.msq("struts", BOX, *FOAM))

    def test_structures_of_a_model_file(self):
        grid = {"grid": {"cell_size": 2}, "radius": 0.2}
        scales = [{"shape": {"box": {"min": [0, 0, 0], "max": [4, 4, 4]}}},
                  {"structure": {"lattice": {"unit_cell": "octet", **grid}}},
                  {"structure": {"foam": {**grid, "seed": 3}}}]
        solid, path = scales[:1], self.folder / "several.json"

        def write(**model):
            path.write_text(json.dumps({"msq_model": 1, **model}))

        options = {"1": ["--lattice", "octet", "--cell", "2", "--radius", "0.2"],
                   "2": ["--foam", "2", "--radius", "0.2", "--seed", "3"]}
        struts = {scale: self.msq("struts", "box:4,4,4", *given)
                  for scale, given in options.items()}
        fractions = {scale: json.loads(self.msq("calibrate", *given, "--fraction", "0.2", "--json"))
                     for scale, given in options.items()}

        def compare(scale, *chosen):
            self.assertEqual(self.msq("struts", path, *chosen), struts[scale])
            found = json.loads(self.msq("calibrate", path, *chosen, "--fraction", "0.2", "--json"))
            self.assertEqual(found["parameter"], fractions[scale]["radius"])
            self.assertEqual(found["samples"], fractions[scale]["samples"])

        write(scales=scales)
        for scale in options:
            compare(scale, "--scale", scale)
        write(regions=[{"scales": solid}, {"scales": scales[:2]}])
        compare("1")
        write(regions=[{"scales": scales[:2]}, {"scales": [solid[0], scales[2]]}])
        compare("2", "--region", "1")
        for command in (["struts", path], ["calibrate", path, "--fraction", "0.2"]):
            self.refuse(2, "has 2 structures", *command)
            self.refuse(2, "--foam: does not apply", *command, "--foam", "2")
            self.refuse(1, "region is 2; the model has 2", *command, "--region", "2")
            self.refuse(1, "scale is 2; region 1 has 2", *command, "--region", "1", "--scale", "2")
            self.refuse(2, "--scale: 0 is the coarse shape", *command, "--scale", "0")
        write(scales=solid)
        self.refuse(2, "has no structure", "struts", path)
        self.refuse(2, "--scale: is for model files", "struts", BOX, *FOAM, "--scale", "1")
        self.refuse(2, "is for model files", "calibrate", *options["1"], "-f", "0.2", "--any-files")
        self.refuse(2, "'box:4,4,4' is none", "calibrate", "box:4,4,4", "-f", "0.2")

    def test_its_settings_are_used_and_options_take_their_place(self):
        path = self.write(slicing={"pitch": [0.25, 0.25], "layer_height": 1, "output": "grey",
                                   "grey_samples": 2})
        plan = ["-p", "0.25", "-l", "1", "--grey", "2", "-q", "-o"]
        self.msq("slice", path, "-q", "-o", self.folder / "a")
        self.msq("slice", BOX, *FOAM, *plan, self.folder / "b")
        self.msq("slice", path, "-l", "0.5", "-q", "-o", self.folder / "c")
        files = [sorted(x.read_bytes() for x in (self.folder / name).iterdir()) for name in "abc"]
        self.assertEqual(files[0], files[1])
        self.assertEqual([len(found) for found in files], [4, 4, 8])
        view = self.write("view.json", view={"direction": [0, 1, 0], "width": 30, "height": 20})
        for options, size in (([], (30, 20)), (["--size", "8,9"], (8, 9))):
            self.msq("render", view, *options, "-o", self.folder / "a.png")
            head = (self.folder / "a.png").read_bytes()[16:24]
            self.assertEqual((int.from_bytes(head[:4], "big"), int.from_bytes(head[4:], "big")), size)

    def test_a_model_of_all_space_needs_a_region(self):
        path = self.folder / "all.json"

        def write(**settings):
            path.write_text(json.dumps({"msq_model": 1, **settings, "scales": [
                {"shape": {"all_space": {}}},
                {"structure": {"foam": {"grid": {"cell_size": 2}, "radius": 0.3}}}]}))

        write(slicing={"pitch": 0.5, "layer_height": 0.5})
        for output in ("layers/", "a.svg", "a.3mf"):
            self.refuse(2, "fills all space; msq slice needs a region of it, --box", "slice", path,
                        "-o", self.folder / output)
        self.refuse(2, "an SL1 archive needs a part with bounds", "slice", path, "-o",
                    self.folder / "a.sl1")
        commands = ([["mesh", "--pitch", "0.5"], "a.stl"], [["stats", "--samples", "1000"], "a.txt"],
                    [["struts"], "a.csv"], [["slice"], "a.svg"])
        for (command, *options), output in commands[:3]:
            self.refuse(2, f"fills all space; msq {command} needs a region of it, --box", command, path,
                        *options, "-o", self.folder / output)
        for options in ((), ("--size", "30,20"), ("--view", "0,0")):
            self.refuse(2, "needs a view with a camera", "render", path, *options, "-o",
                        self.folder / "a.png")
        self.assertEqual(self.names(), ["all.json"])
        for (command, *options), output in commands:
            self.msq(command, path, *options, "--box", "0,0,0,2,2,2", "-o", self.folder / output)
        write(slicing={"pitch": 0.5, "layer_height": 0.5,
                       "region": {"min": [0, 0, 0], "max": [2, 2, 2]}},
              view={"camera": {"eye": [0, 0, 9], "target": [0, 0, 0], "up": [0, 1, 0], "height": 8,
                               "clip_far": 9}, "width": 30, "height": 20})
        self.msq("slice", path, "-o", self.folder / "b.svg")
        self.assertEqual((self.folder / "a.svg").read_bytes(), (self.folder / "b.svg").read_bytes())
        for options in ((), ("--size", "60,40"), ("--plain",)):
            self.msq("render", path, *options, "-o", self.folder / "a.png")
        self.refuse(2, "without --view and --perspective", "render", path, "--view", "0,0", "-o",
                    self.folder / "a.png")

    def test_a_bad_file(self):
        path = self.folder / "bad.json"
        path.write_text('{"msq": 1,\n "shape": 7}')
        self.refuse(1, "bad.json", "info", path)
        self.refuse(1, "none.json", "info", self.folder / "none.json")


if __name__ == "__main__":
    unittest.main()
