# SPDX-License-Identifier: Apache-2.0
"""Models in JSON: those of examples/models, and the schema, whose keys are those that msq knows."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import msq
from support import SOURCE

try:
    import jsonschema
except ImportError:
    jsonschema = None

MODELS = sorted((SOURCE / "examples" / "models").glob("*.json"))
SCHEMA = json.loads((SOURCE / "docs" / "model.schema.json").read_text(encoding="utf-8"))
BOX = {"box": {"min": [0, 0, 0], "max": [4, 4, 4]}}


def parts_of(schema, path=()):
    """Pairs of a path and the schema of an object with fixed keys: [] in a path is an element."""
    if "$ref" in schema or not isinstance(schema, dict):
        return
    if schema.get("additionalProperties") is False and path:
        yield path, schema
    for key, part in schema.get("properties", {}).items():
        yield from parts_of(part, (*path, key))
    for part in schema.get("oneOf", ()):
        yield from parts_of(part, path)
    if isinstance(schema.get("items"), dict):
        yield from parts_of(schema["items"], (*path, []))


@unittest.skipUnless(msq.build_info().with_json, "a build without nlohmann-json")
class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        parts = pathlib.Path(cls.folder.name) / "parts"
        parts.mkdir()
        if msq.build_info().with_assimp:
            parts.joinpath("bracket.stl").write_bytes(
                (SOURCE / "examples" / "parts" / "bracket.stl").read_bytes())
        subprocess.run([sys.executable, SOURCE / "examples" / "parts" / "make_bone.py",
                        parts / "bone.nrrd", "--step", "4"], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_parts_of_a_model(self):
        foam = {"structure": {"foam": {"grid": {"cell_size": 2}, "radius": 0.2}}}
        bcc = {"structure": {"lattice": {"radius": 0.3, "grid": {"cell_size": 2}}}}
        text = json.dumps({"msq_model": 1, "regions": [{"scales": [{"shape": BOX}, foam, bcc]},
                                                       {"scales": [{"shape": BOX}, bcc]}]})
        model = msq.Model.from_json(text)
        lattice = msq.Lattice("bcc", radius=0.3, cell_size=2)
        self.assertEqual(model.structure(2).hash, lattice.hash)
        self.assertEqual(model.structure(region=1).hash, lattice.hash)
        self.assertEqual(model.structure().hash, msq.Foam(radius=0.2, cell_size=2).hash)
        self.assertEqual(model.region_shape(1).hash, msq.Shape.box((0, 0, 0), (4, 4, 4)).hash)
        structure, fraction = model.structure(2), lattice.calibrate(0.2)
        del model  # the structure keeps what it needs
        self.assertEqual(structure.calibrate(0.2).parameter, fraction.parameter)
        with self.assertRaisesRegex(ValueError, "scale is 0"):
            structure = msq.Model.from_json(text).structure(0)
        with self.assertRaisesRegex(msq.ArgumentError, "scale is 2; region 1 has 2"):
            msq.Model.from_json(text).structure(2, region=1)

    def test_examples_are_read_and_written_again(self):
        self.assertGreaterEqual(len(MODELS), 7)
        for path in MODELS:
            text = path.read_text(encoding="utf-8")
            if "bracket.stl" in text and not msq.build_info().with_assimp:
                continue
            with self.subTest(path.name):
                document = msq.Document.from_json(text, base_directory=self.folder.name)
                self.assertTrue(document.title and document.has_slicing and document.has_view)
                self.assertEqual(document.files, text.count('"file": "'))
                model = document.model
                written = model.to_json(title="again", base_directory=self.folder.name)
                again = msq.Document.from_json(written, base_directory=self.folder.name)
                self.assertEqual(again.title, "again")
                if msq.build_info().with_xxhash:
                    self.assertEqual(again.model.hash, model.hash)
                self.assertGreater(document.slicer().layer_count, 10)
                self.assertGreater(document.camera.height, 0)

    @unittest.skipUnless(jsonschema, "python3-jsonschema is absent")
    def test_examples_and_what_is_written_are_valid_by_the_schema(self):
        jsonschema.Draft7Validator.check_schema(SCHEMA)
        validator = jsonschema.Draft7Validator(SCHEMA)
        for path in MODELS:
            with self.subTest(path.name):
                text = path.read_text(encoding="utf-8")
                validator.validate(json.loads(text))
                if "bracket.stl" in text and not msq.build_info().with_assimp:
                    continue
                model = msq.Model.from_json(text, base_directory=self.folder.name)
                validator.validate(json.loads(model.to_json(base_directory=self.folder.name)))
        bad = {"msq_model": 1, "scales": [{"shape": {"box": {"min": [0, 0, 0], "mix": 1}}}]}
        self.assertFalse(validator.is_valid(bad))

    @unittest.skipUnless(jsonschema, "python3-jsonschema is absent")
    def test_the_schema_and_msq_agree_about_numbers(self):
        validator = jsonschema.Draft7Validator(SCHEMA)
        foam = {"grid": {"cell_size": 2}, "radius": 0.2}
        image = {"values": [1] * 8, "value_type": "uint8"}

        def document(seed="3", voxels=None, version=1, width=9):
            shape = {"voxels": {"image": {**image, "size": voxels}}} if voxels else {"box": {
                "min": [0, 0, 0], "max": [4, 4, 4]}}
            view = {"direction": [0, 0, 1], "width": width, "height": 9}
            made = {"msq_model": version, "scales": [{"shape": shape},
                                                     {"structure": {"foam": {**foam, "seed": 3}}}],
                    "view": view}
            return json.dumps(made).replace('"seed": 3', f'"seed": {seed}')

        def is_read(text):
            try:
                return msq.Document.from_json(text).model
            except msq.Error:
                return None

        right = [document(), document("3.0"), document("0.3e1"), document("1e19"), document("-0"),
                 document("-0.0"), document(version=1.0), document(width=9.0),
                 document(voxels=[2, 2, 2]), document(voxels=[2.0, 2, 2])]
        wrong = [document("3.5"), document("-1.0"), document('"3"'), document(version=1.5),
                 document(width=0), document(voxels=[1, 1, 8]), document(voxels=[2, 1, 4]),
                 document(voxels=[2.5, 2, 2])]
        for expected, texts in ((True, right), (False, wrong)):
            for text in texts:
                with self.subTest(text):
                    self.assertEqual(validator.is_valid(json.loads(text)), expected)
                    self.assertEqual(is_read(text) is not None, expected)
        if msq.build_info().with_xxhash:
            self.assertEqual({is_read(text).hash for text in right[:3]}, {is_read(right[0]).hash})
            grid = {"grid": {"image": {"values": [1], "value_type": "uint8", "size": [1, 1, 1]}}}
            plain = json.dumps({"msq_model": 1, "fields": {"a": grid}, "scales": [{"shape": BOX}]})
            self.assertTrue(validator.is_valid(json.loads(plain)))
            self.assertIsNotNone(is_read(plain))

    def keys_of(self, document, path):
        """The keys that msq names when it finds one that it does not know at a path."""
        at = document
        for key in path:
            at = at[0] if key == [] else at[key]
        at["no such key"] = 0
        with self.assertRaises(msq.Error) as caught:
            msq.Document.from_json(json.dumps(document))
        message = str(caught.exception)
        self.assertIn("no such key: unknown key", message)
        _, _, keys = message.partition("the keys here are ")
        return set(keys.split(", ")) if keys else set()

    def test_the_schema_has_the_keys_that_msq_knows(self):
        ground = {"msq_model": 1, "scales": [{"shape": BOX}]}
        names = {"shape": "shapes", "field": "fields", "structure": "structures",
                 "material": "materials"}
        image = {"values": [1, 1], "value_type": "uint8", "size": [1, 1, 2]}
        count = 0
        for name, section in names.items():
            for option in SCHEMA["definitions"][name]["oneOf"][1:]:
                (kind, part), = option["properties"].items()
                for path, within in parts_of(part, (kind,)):
                    value = {}
                    for key in reversed(path[1:]):
                        value = [value] if key == [] else {key: value}
                    if kind in ("file", "voxels", "grid"):  # what they miss is found first
                        value = {"file": "a.stl"} if kind == "file" else {"image": dict(image)}
                    if kind == "file":
                        continue
                    with self.subTest(kind=kind, path=path):
                        document = json.loads(json.dumps({**ground, section: {"d": {kind: value}}}))
                        self.assertEqual(self.keys_of(document, (section, "d", *path)),
                                         set(within["properties"]))
                        count += 1
        for name in ("slicing", "view"):
            for path, within in parts_of(SCHEMA["definitions"][name], (name,)):
                value = {}
                for key in reversed(path[1:]):
                    value = [value] if key == [] else {key: value}
                with self.subTest(path=path):
                    document = json.loads(json.dumps({**ground, name: value}))
                    self.assertEqual(self.keys_of(document, path), set(within["properties"]))
                    count += 1
        self.assertEqual(self.keys_of({**ground, "shapes": {"d": {"voxels": {"image": image}}}},
                                      ("shapes", "d", "voxels", "image")),
                         set(SCHEMA["definitions"]["image"]["properties"]))
        self.assertEqual(self.keys_of(json.loads(json.dumps(ground)), ("scales", [])),
                         set(SCHEMA["definitions"]["scale"]["properties"]))
        self.assertEqual(self.keys_of(json.loads(json.dumps(ground)), ()),
                         set(SCHEMA["properties"]))
        self.assertGreater(count, 30)

    def test_settings_are_used(self):
        document = msq.Document.from_json(json.dumps({
            "msq_model": 1, "scales": [{"shape": BOX}],
            "slicing": {"pitch": 0.5, "layer_height": 1,
                        "outputs": [{"output": "bits"}, {"output": "grey"}]},
            "view": {"direction": [0, 0, -1], "width": 16, "height": 8}}))
        slicer = document.slicer()
        self.assertEqual((slicer.width, slicer.height, slicer.layer_count), (8, 8, 4))
        self.assertEqual(slicer.output, ("bits", "grey"))
        self.assertEqual(slicer.layer(0).inside_count, 64)
        self.assertEqual(document.render().rgba.shape, (8, 16, 4))
        self.assertEqual(document.camera.projection, "orthographic")

    def test_errors_say_where(self):
        with self.assertRaisesRegex(msq.ArgumentError, r"2:2: scales\[0\]\.shape\.box"):
            msq.Model.from_json('{"msq_model": 1, "scales": [{"shape":\n{"box": {}}}]}')
        with self.assertRaises(FileNotFoundError):
            msq.Document.from_file("no such file.json")
        with self.assertRaisesRegex(TypeError, "text is of type dict; it must be str or bytes"):
            msq.Model.from_json({"msq_model": 1})


if __name__ == "__main__":
    unittest.main()
