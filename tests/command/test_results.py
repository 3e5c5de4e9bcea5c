# SPDX-License-Identifier: Apache-2.0
"""Sub-commands print what the library computes, as its Python package returns it."""
import io
import json
import os
import unittest

import msq
import numpy as np
from command import BRACKET, Case, run

CONTEXT = msq.Context(threads=2)
BOX = "box:8,6,4"
SHAPE = msq.Shape.box((0, 0, 0), (8, 6, 4), context=CONTEXT)


def model_of(structure, **options):
    return msq.Model(SHAPE, [msq.Scale(structure, **options)] if options else [structure])


FOAM = ["--foam", "2", "--radius", "0.3", "--seed", "7", "--jitter", "0.5"]
FOAM_MODEL = model_of(msq.Foam(cell_size=2, radius=0.3, seed=7, jitter=0.5, context=CONTEXT))


class Structures(Case):
    """Options make the structures that they name: their hashes are equal."""

    def hash(self, *options):
        return json.loads(self.msq("info", BOX, "--json", *options))["model_hash"]

    def test_options(self):
        radius = msq.Field.gradient((0, 0, 0), 0.2, (0, 0, 4), 0.5, context=CONTEXT)
        cell = {"cell_size": (2, 3, 4), "context": CONTEXT}
        for structure, options in (
                (msq.Foam(cell_size=2, radius=0.3, context=CONTEXT), ["--foam", "2", "-r", "0.3"]),
                (msq.Foam(cell_size=(2, 3, 4), radius=radius, density=3, jitter=0.5, seed=9,
                          context=CONTEXT),
                 ["--foam=2,3,4", "--radius=0.2", "--radius-top=0.5", "--density=3", "--jitter=0.5",
                  "--seed=9"]),
                (msq.Foam(cell_size=2, wall_thickness=0.2, vent_radius=0.1, context=CONTEXT),
                 ["--foam", "2", "--thickness", "0.2", "--vent", "0.1"]),
                (msq.Foam(cell_size=2, radius=0.2, stretch=(1, 1, 2.5), context=CONTEXT),
                 ["--foam", "2", "--radius", "0.2", "--stretch", "1,1,2.5"]),
                (msq.Foam(cell_size=2, radius=0.2, weight=1.5, context=CONTEXT),
                 ["--foam", "2", "--radius", "0.2", "--weight", "1.5"]),
                (msq.Lattice("octet", radius=0.2, **cell),
                 ["--lattice", "octet", "--cell", "2,3,4", "--radius", "0.2"]),
                (msq.Functional("gyroid", **cell), ["--function", "gyroid", "--cell", "2,3,4"]),
                (msq.Functional("split_p", level=0.2, **cell),
                 ["--function", "split-p", "--cell", "2,3,4", "--level", "0.2"]),
                (msq.Functional("diamond", kind="sheet", thickness=0.2, **cell),
                 ["--function", "diamond", "--cell", "2,3,4", "--thickness", "0.2"]),
                (msq.Functional("i_wp", level=0.2, kind="sheet", **cell),
                 ["--function", "i-wp", "--cell", "2,3,4", "--level", "0.2", "--sheet"]),
                (msq.Functional(expression="sin(x)+cos(y)*z", **cell),
                 ["--expression", "sin(x)+cos(y)*z", "--cell", "2,3,4"]),
                (msq.Waves((2, 3, 4), volume_fraction=0.3, count=20, context=CONTEXT),
                 ["--waves", "2,3,4", "--volume-fraction", "0.3", "--count", "20"]),
                (msq.Waves(2, level=0.5, kind="sheet", seed=3, cone_angles=(0, 0, 15),
                           context=CONTEXT),
                 ["--waves", "2", "--level", "0.5", "--sheet", "--seed", "3", "--cones", "0,0,15"]),
        ):
            self.assertEqual(self.hash(*options), model_of(structure).hash, options)

    def test_skin(self):
        model = model_of(msq.Foam(cell_size=2, radius=0.3, context=CONTEXT), skin=0.5)
        self.assertEqual(self.hash("--foam", "2", "--radius", "0.3", "--skin", "0.5"), model.hash)

    def test_the_order_of_names_is_that_of_the_library(self):
        for name in ("cubic", "bcc", "octet", "fcc", "kelvin", "diamond", "dodecahedron",
                     "reentrant"):
            lattice = msq.Lattice({"dodecahedron": "rhombic_dodecahedron"}.get(name, name),
                                  radius=0.2, cell_size=2, context=CONTEXT)
            self.assertEqual(self.hash("--lattice", name, "--cell", "2", "--radius", "0.2"),
                             model_of(lattice).hash)
        for name in ("gyroid", "schwarz-p", "diamond", "i-wp", "neovius", "f-rd", "lidinoid",
                     "split-p", "fischer-koch-s", "c-y", "c-plus-minus-y", "karcher-k", "g-prime",
                     "double-gyroid", "double-diamond", "double-p", "honeycomb", "rods"):
            surface = msq.Functional(name.replace("-", "_"), cell_size=2, context=CONTEXT)
            self.assertEqual(self.hash("--function", name, "--cell", "2"), model_of(surface).hash)


class Info(Case):
    def test_a_mesh(self):
        shape = msq.Shape.from_file(BRACKET, unit_mm=25.4, context=CONTEXT)
        found = json.loads(self.msq("info", BRACKET, "--unit", "in", "--json",
                                    "--self-intersections"))
        self.assertEqual(found["part_hash"], shape.hash)
        self.assertEqual(found["max"], list(shape.info.max))
        self.assertEqual(found["volume"], shape.info.volume)
        self.assertEqual(found["mesh"]["triangles"], shape.info.triangles)
        self.assertEqual(found["mesh"]["closed"], True)
        self.assertEqual(found["mesh"]["self_intersections"], 0)
        text = self.msq("info", BRACKET)
        self.assertIn("triangles", text)
        self.assertIn("closed", text)

    def test_up_turns_the_part(self):
        bounds = {"z": (8, 6, 4), "x": (6, 4, 8), "-x": (4, 6, 8), "y": (8, 4, 6), "-y": (8, 4, 6),
                  "-z": (8, 6, 4)}
        vertices = np.array([(0, 0, 0), (8, 0, 0), (0, 6, 0), (0, 0, 4)], float)
        path = self.folder / "corner.off"
        path.write_text("OFF\n4 4 0\n" + "\n".join(" ".join(map(str, v)) for v in vertices) +
                        "\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        for up, size in bounds.items():
            found = json.loads(self.msq("info", path, "--json", "--up", up))
            np.testing.assert_allclose(found["size"], size, rtol=1e-12, err_msg=up)
            self.assertGreater(found["volume"], 0, f"{up}: mirrored")
            # What was the highest point along the axis is on top.
            axis = "xyz".index(up[-1])
            top = vertices[np.argmax(vertices[:, axis] * (-1 if "-" in up else 1))]
            height = top[axis] * (-1 if "-" in up else 1)
            self.assertAlmostEqual(found["max"][2], height, places=9, msg=up)

    def test_the_build(self):
        found = json.loads(self.msq("info", "--json"))
        self.assertEqual(self.msq("--version"), f"msq {found['version']}\n")
        self.assertIn("licence", self.msq("info"))


class Query(Case):
    def setUp(self):
        super().setUp()
        self.points = np.random.RandomState(1).rand(3000, 3) * (9, 7, 5) - 0.5
        self.inside = FOAM_MODEL.contains(self.points)
        self.distance = FOAM_MODEL.distance(self.points)

    def test_names_of_channels_in_utf_8(self):
        names = ["Härte", "密度", "plain"]
        channels = [{"name": name, "value": i + 1} for i, name in enumerate(names)]
        path, out = self.folder / "model.json", self.folder / "values.npy"
        path.write_text(json.dumps({"msq_model": 1, "scales": [
            {"shape": {"box": {"max": [1, 1, 1]}},
             "material": {"plain": {"id": 7, "channels": channels}}}]}))
        points = "0.5,0.5,0.5\n3,0,0\n"
        for count in (3, 1):
            wanted = ["query", path, "-", "-w", "material", "--channels", ",".join(names[-count:])]
            self.msq(*wanted, "-o", out, input=points)
            found = np.load(out)
            self.assertEqual(found.dtype.names, ("material", *names[-count:]))
            self.assertEqual(out.read_bytes()[6], 3 if count == 3 else 1)
            self.assertEqual(found["material"].tolist(), [7, 0])
            self.assertEqual(found["plain"][0], 3)
        self.assertEqual(found.dtype["plain"], np.dtype("<f8"))
        text = self.msq(*wanted[:-1], ",".join(names), input=points)
        self.assertTrue(text.startswith("x,y,z,material,Härte,密度,plain\n0.5,0.5,0.5,7,1,2,3\n"), text)
        for name in (b"\xff", b"\xe4b", b"\xc0\x80", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"a\xe5\xaf"):
            done = run(*wanted[:-1], os.fsdecode(name), "-o", out, input=b"", binary=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(b"is not UTF-8", done.stderr)

    def test_an_array_needs_a_plain_file(self):
        pipe = self.folder / "pipe.npy"
        os.mkfifo(pipe)
        self.refuse(1, "pipe.npy: no plain file; an array begins with the number of points", "query",
                    BOX, "-", "-o", pipe, input="1,1,1\n")

    def test_csv_and_npy(self):
        csv, npy = self.folder / "points.csv", self.folder / "points.npy"
        np.savetxt(csv, self.points, delimiter=",", fmt="%.17g", header="x,y,z", comments="")
        np.save(npy, self.points)
        what = ["--what", "distance,membership,region"]
        for source in (csv, npy):
            table = self.msq("query", BOX, source, *what, *FOAM)
            self.assertEqual(table.split("\n")[0], "x,y,z,distance,membership,region")
            rows = np.loadtxt(io.StringIO(table), delimiter=",", skiprows=1)
            self.assertTrue((rows[:, :3] == self.points).all())
            self.assertTrue((rows[:, 3] == self.distance).all())
            self.assertTrue((rows[:, 4] == self.inside).all())
            self.assertTrue((rows[:, 5] == FOAM_MODEL.region(self.points)).all())
            out = self.folder / "values.npy"
            self.msq("query", BOX, source, *what, *FOAM, "-o", out)
            found = np.load(out)
            self.assertEqual(found.dtype.names, ("distance", "membership", "region"))
            self.assertTrue((found["distance"] == self.distance).all())
            self.assertTrue((found["membership"] == self.inside).all())
        self.msq("query", BOX, npy, *FOAM, "-o", self.folder / "inside.npy")
        found = np.load(self.folder / "inside.npy")
        self.assertEqual((found.dtype, found.shape), (np.uint8, (3000,)))
        self.assertTrue((found == self.inside).all())

    def test_float32_and_standard_input(self):
        npy = self.folder / "points.npy"
        points = self.points.astype(np.float32)
        np.save(npy, points)
        self.msq("query", BOX, npy, *FOAM, "-o", self.folder / "out.npy")
        self.assertTrue((np.load(self.folder / "out.npy") == FOAM_MODEL.contains(points)).all())
        text = self.msq("query", BOX, "-", *FOAM, input="# a remark\n\n1,1,1\n +2 ,2,2\n")
        self.assertEqual(text.split("\n")[1][:5], "1,1,1")
        self.assertEqual(len(text.split("\n")), 4)
        self.assertEqual(self.msq("query", BOX, "-", input=""), "x,y,z,membership\n")

    def test_length_scale(self):
        text = self.msq("query", BOX, "-", *FOAM, "--length-scale", "3", input="1,1,1\n4,3,2\n9,1,1\n")
        self.assertEqual([row[-1] for row in text.split()], ["p", "1", "1", "0"])

    def test_bad_points(self):
        for text, given in (("line 2: 'a' is not a finite number", "1,2,3\na,2,3\n"),
                            ("line 1: 'nan' is not a finite number", "nan,2,3\n1,2,3\n"),
                            ("line 1: 'b' is not a finite number", "1,b,3\n1,2,3\n"),
                            ("line 1: 2 columns, and a point has 3", "1,2\n"),
                            ("line 1: 6 columns, and a point has 3; more need", "1,5,2,0,3,1\n"),
                            ("line 1: '\"1\"' is not a finite number", '"1","2","3"\n'),
                            ("line 3: 'inf' is not a finite number", "x,y,z\n1,2,3\n1,inf,3\n"),
                            ("line 1: more than 65536 bytes long", "1" * 200000)):
            self.refuse_points(text, given)
        path = self.folder / "points.npy"
        self.assertEqual(self.msq("query", BOX, "-", input="x,y,z,name\n1,1,1,a\n").count("\n"), 2)
        for text, array in (("the type of its numbers is not <f4 or <f8 but '<i8'\n",
                             np.zeros((3, 3), "<i8")),
                            ("shape is not (n, 3) but (3, 2)", np.zeros((3, 2))),
                            ("Fortran", np.asfortranarray(np.zeros((3, 3)))),
                            ("point 1: nan", np.array([(0, 0, 0), (0, np.nan, 0)], float))):
            np.save(path, array)
            self.refuse(1, text, "query", BOX, path, "-o", self.folder / "out.npy")
        np.save(path, np.zeros((9, 3)))
        path.write_bytes(path.read_bytes()[:-8])
        self.refuse(1, "ends before", "query", BOX, path, "-o", self.folder / "out.npy")
        path.write_bytes(b"PK\3\4 no numbers")
        self.refuse(1, "is no NPY file", "query", BOX, path, "-o", self.folder / "out.npy")
        self.assertEqual(self.names(), ["points.npy"])

    def refuse_points(self, text, given):
        """Of what went before, CSV on standard output may be there."""
        done = run("query", BOX, "-", input=given)
        self.assertEqual(done.returncode, 1)
        self.assertIn(text, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)


class Measures(Case):
    def test_statistics(self):
        found = json.loads(self.msq("stats", BOX, *FOAM, "--json", "--samples", "24000",
                                    "--two-point", "0,0.5", "--lineal-path", "0:0.5:2",
                                    "--direction", "1,0,0", "--surface", "0.5"))
        side = (8 * 6 * 4 * 2 / 24000) ** (1 / 3)
        counts = [round(size / side) for size in (8, 6, 4)]
        sample = msq.Stratified((0, 0, 0), [size / n for size, n in zip((8, 6, 4), counts)], counts,
                                per_cell=2)
        fraction = FOAM_MODEL.volume_fraction(sample)
        self.assertEqual(found["samples"], 2 * counts[0] * counts[1] * counts[2])
        self.assertEqual(found["volume_fraction"]["value"], fraction.value)
        self.assertEqual(found["volume_fraction"]["standard_error"], fraction.standard_error)
        self.assertEqual(found["relative_density"], fraction.value)
        self.assertAlmostEqual(found["part_volume"], 192)
        pairs = FOAM_MODEL.two_point_correlation(sample, [0, 0.5], direction=(1, 0, 0))
        self.assertEqual([row["value"] for row in found["two_point"]], [e.value for e in pairs])
        paths = FOAM_MODEL.lineal_path(sample, [0, 0.5], direction=(1, 0, 0))
        self.assertEqual([row["value"] for row in found["lineal_path"]], [e.value for e in paths])
        mesh = FOAM_MODEL.mesh(0.5)
        corners = mesh.vertices[mesh.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = np.linalg.norm(normals, axis=1).sum() / 2
        volume = (normals * corners[:, 0]).sum() / 6
        self.assertAlmostEqual(found["surface"]["area"] / area, 1, places=12)
        self.assertAlmostEqual(found["surface"]["volume"] / volume, 1, places=9)
        for height in (1e-4, 1e-6, 5):  # a cross-section has as many points
            thin = json.loads(self.msq("stats", BOX, "--json", "--samples", "24000",
                                       f"--box=0,0,1,8,6,{1 + height}"))
            self.assertLess(abs(thin["samples"] - 24000), 2400)
        void = json.loads(self.msq("stats", BOX, *FOAM, "--json", "--samples", "24000", "--phase",
                                   "void"))
        self.assertAlmostEqual(void["volume_fraction"]["value"], 1 - fraction.value)
        self.assertEqual(void["relative_density"], fraction.value)

    def test_calibration(self):
        lattice = msq.Lattice("bcc", radius=0.1, cell_size=2, context=CONTEXT)
        wanted = lattice.calibrate(0.25, curve=3)
        found = json.loads(self.msq("calibrate", "--lattice", "bcc", "--cell", "2", "--fraction",
                                    "0.25", "--curve", "3", "--json"))
        self.assertEqual(found["radius"], wanted.parameter)
        self.assertEqual(found["volume_fraction"], wanted.fraction.value)
        self.assertEqual([row["radius"] for row in found["curve"]], wanted.parameters.tolist())
        sheet = msq.Functional("gyroid", level=0.1, kind="sheet", cell_size=2, context=CONTEXT)
        found = json.loads(self.msq("calibrate", "--function", "gyroid", "--sheet", "--cell", "2",
                                    "--fraction", "0.3", "--json"))
        self.assertEqual(found["level"], sheet.calibrate(0.3).parameter)
        # What it replaces is neither used nor shown.
        gyroid = ["--function", "gyroid", "--cell", "2"]
        for options, structure in (
                ([*gyroid, "--sheet", "--level", "0.5"], "function gyroid, cell 2, sheet"),
                ([*gyroid, "--thickness", "0.5"], "function gyroid, cell 2, sheet"),
                (["--foam", "2", "--seed", "3", "--radius", "0.5"], "foam 2, seed 3"),
                (["--foam", "2", "--seed", "3", "--thickness", "0.5"], "foam 2, seed 3"),
                (["--waves", "2", "--volume-fraction", "0.5"], "waves 2")):
            again = json.loads(self.msq("calibrate", *options, "--fraction", "0.3", "--json"))
            self.assertEqual(again["structure"], structure)
            self.assertAlmostEqual(again["volume_fraction"], 0.3, delta=1e-3)
            if "gyroid" in options:
                self.assertEqual(again["level"], found["level"])
            self.assertEqual("thickness" in again, "foam" in structure and "--thickness" in options)
        waves = msq.Waves(2, count=16, level=0.1, kind="sheet", context=CONTEXT)
        found = json.loads(self.msq("calibrate", "--waves", "2", "--count", "16", "--sheet",
                                    "--fraction", "0.3", "--json"))
        self.assertEqual(found["level"], waves.calibrate(0.3).parameter)

    def test_struts_without_a_volume(self):
        path = self.folder / "struts.3mf"
        options = ["--lattice", "cubic", "--cell", "2", "--radius", "0.3", "--radius-top", "0"]
        self.msq("struts", "box:6,4,6", *options, "-o", path)
        radii = msq.BeamFile.open(path).lattices[0].radii
        self.assertTrue((radii.max(axis=1) > 0).all())
        self.assertTrue((radii == 0).any())

    def test_struts(self):
        foam = msq.Foam(cell_size=2, radius=0.3, seed=7, jitter=0.5, context=CONTEXT)
        for options, shape in ((FOAM, SHAPE), ([*FOAM, "--whole"], None)):
            graph = foam.strut_graph((0, 0, 0), (8, 6, 4), near=True, shape=shape)
            rows = np.loadtxt(io.StringIO(self.msq("struts", BOX, *options)), delimiter=",",
                              skiprows=1)
            self.assertEqual(len(rows), len(graph))
            self.assertTrue((rows[:, 1:3] == graph.struts).all())
            self.assertTrue((rows[:, 3:6] == graph.nodes[graph.struts[:, 0]]).all())
            self.assertTrue((rows[:, 6:9] == graph.nodes[graph.struts[:, 1]]).all())
            self.assertTrue((rows[:, 9:11] == graph.radii).all())
            self.assertTrue((rows[:, 11:13] == graph.cuts).all())
            self.assertTrue((rows[:, 13:] == graph.cells).all())
            path = self.folder / "struts.jsonl"
            self.msq("struts", BOX, *options, "-o", path)
            lines = [json.loads(line) for line in path.read_text().splitlines()]
            nodes = np.array([line["at"] for line in lines if "node" in line])
            self.assertTrue((nodes == graph.nodes).all())
            struts = [line for line in lines if "strut" in line]
            self.assertTrue(([line["nodes"] for line in struts] == graph.struts).all())
            self.assertTrue(([line["radii"] for line in struts] == graph.radii).all())
            path = self.folder / "struts.3mf"
            self.msq("struts", BOX, *options, "-o", path)
            lattice = msq.BeamFile.open(path, context=CONTEXT).lattices[0]
            self.assertEqual(len(lattice.beams), len(graph))
            ends = lattice.nodes[lattice.beams]
            self.assertTrue((ends == graph.nodes[graph.struts]).all())

    def test_meshes(self):
        for name in ("a.stl", "a.ply"):
            FOAM_MODEL.save_mesh(self.folder / name, 0.5)
            self.msq("mesh", BOX, *FOAM, "--pitch", "0.5", "-o", self.folder / ("b" + name[1:]))
            self.assertEqual((self.folder / name).read_bytes(),
                             (self.folder / ("b" + name[1:])).read_bytes())
        self.msq("mesh", BOX, *FOAM, "-p", "0.5", "--box", "1,1,1,3,3,3", "-o", self.folder / "c.stl")
        FOAM_MODEL.save_mesh(self.folder / "a.stl", 0.5, box=((1, 1, 1), (3, 3, 3)))
        self.assertEqual((self.folder / "a.stl").read_bytes(), (self.folder / "c.stl").read_bytes())


if __name__ == "__main__":
    unittest.main()
