# SPDX-License-Identifier: Apache-2.0
"""Levelsets of 3MF files, against an evaluator of their graphs that reads the XML on its own."""
import os
import struct
import tempfile
import unittest
import warnings

import numpy as np

import msq
from levelset_files import (BY_COMPONENT, HIGH, LOW, Compared, Graph, archive, document, mesh_object,
                            random_points)
from support import SANITIZED

COUNT = max(3000, int(20000 * float(os.environ.get("MSQ_TEST_SCALE", 1))))


class Nodes(Compared):
    """Each type of node alone, of scalars, vectors and matrices."""

    def inputs(self, graph):
        """Four ports of each type that take many values."""
        pos = ("vector", "inputs.pos")
        x, y, z = graph.parts(pos)
        turned = graph.node("composevector", [("vector", "result")], x=y, y=z, z=x)
        shifted = graph.op("addition", turned, graph.vector(0.3, -0.2, 0.45))
        mixed = graph.op("subtraction", graph.op("multiplication", pos, graph.vector(0.5, -0.7, 1.1)),
                         turned)
        curved = graph.op("multiplication", pos, shifted)
        vectors = [pos, shifted, mixed, curved]
        scalars = [x, y, graph.scalar_of(mixed), graph.scalar_of(curved)]
        matrices = [graph.node("matrixfromcolumns", [("matrix", "result")], A=vectors[i],
                               B=vectors[(i + 1) % 4], C=vectors[(i + 2) % 4], D=vectors[(i + 3) % 4])
                    for i in range(4)]
        for i, matrix in enumerate(matrices):  # the row of 0, 0, 0, 1 varies, too
            matrices[i] = graph.op("addition", matrix, graph.node(
                "matrixfromrows", [("matrix", "result")], A=graph.vector(0.1, 0.2, 0.3),
                B=vectors[i], C=graph.vector(-0.4, 0.5, 0.6), D=vectors[(i + 2) % 4]))
        return {"scalar": scalars, "vector": vectors, "matrix": matrices}

    def run_all(self, graph, channels, level=None, **more):
        model = document(graph.text(), [f'functionid="1" channel="{channel}" meshbboxonly="true" '
                                        + (level or "") for channel in channels])
        parts = msq.read_3mf_implicit(archive(model))
        self.assertEqual([part.channel for part in parts], channels)
        points = random_points(max(COUNT // 3, 1), 7)
        return [self.check(model, part, points, **more) for part in parts]

    def by_component(self, kinds):
        graph = Graph()
        ports = self.inputs(graph)
        channels = []
        for kind in kinds:
            names = {"clamp": ("A", "min", "max"), "select": "ABCD"}.get(
                kind, "AB" if BY_COMPONENT[kind] in TWO else "A")
            for of, given in ports.items():
                made = graph.op(kind, *given[:len(names)], names=names)
                channels.append(graph.output(f"{kind}_{of}", graph.scalar_of(made)))
        return self.run_all(graph, channels)

    def test_arithmetic(self):
        self.by_component(["addition", "subtraction", "multiplication", "division", "min", "max",
                           "abs", "select", "clamp"])

    def test_angles(self):
        self.by_component(["sin", "cos", "tan", "arcsin", "arccos", "arctan", "arctan2"])

    def test_powers(self):
        self.by_component(["pow", "sqrt", "exp", "log", "log2", "log10", "sinh", "cosh", "tanh"])

    def test_whole_numbers(self):
        self.by_component(["round", "ceil", "floor", "sign", "fract", "fmod", "mod"])

    def test_powers_of_constant_exponents(self):
        graph = Graph()
        x, y, _ = graph.parts(("vector", "inputs.pos"))
        channels = []
        for number, exponent in enumerate((0, 1, 2, 3, 7, -1, -2, 0.5, -0.5, 2.5, 70000, -70001)):
            made = graph.op("pow", x, graph.constant(exponent))
            channels.append(graph.output(f"p{number}", made))
        cube = graph.op("pow", graph.op("sin", x), graph.constant(3))
        channels.append(graph.output("square", graph.op("pow", cube, graph.constant(2))))
        minus = graph.op("subtraction", graph.constant(0), graph.op("sin", y))
        channels.append(graph.output("minus", graph.op("pow", minus, graph.constant(4))))
        # A whole exponent that is not constant, of bases below, at and above 0.
        whole = graph.op("round", y)
        base = graph.op("round", x)
        channels.append(graph.output("whole", graph.op("pow", base, whole)))
        self.run_all(graph, channels, most_left_out=0.05)

    def test_values_by_hand(self):
        """Where random points do not come: halves, zeros and the like."""
        nothing, infinite = np.nan, np.inf
        table = [("round", (-2.5,), -3), ("round", (-0.5,), -1), ("round", (0.5,), 1),
                 ("round", (2.5,), 3), ("round", (-2.25,), -2), ("sign", (0,), 0), ("sign", (-3,), -1),
                 ("fmod", (-7, 3), -1), ("fmod", (7, -3), 1), ("mod", (-7, 3), 2), ("mod", (7, -3), -2),
                 ("fmod", (1, 0), nothing), ("fract", (-0.25,), 0.75), ("ceil", (-0.5,), 0),
                 ("floor", (-0.5,), -1), ("pow", (0, 0), 1), ("pow", (-2, 3), -8), ("pow", (4, 0.5), 2),
                 ("pow", (-4, 0.5), nothing), ("pow", (0, -1), infinite), ("pow", (0, 0.5), 0),
                 ("arctan2", (0, -1), np.pi), ("arctan2", (0, 0), 0), ("arcsin", (1,), np.pi / 2),
                 ("arccos", (-1,), np.pi), ("arccos", (1.5,), nothing), ("log", (0,), -infinite),
                 ("sqrt", (-1,), nothing), ("division", (1, 0), infinite),
                 ("division", (0, 0), nothing), ("log2", (8,), 3), ("log10", (0.01,), -2),
                 ("tan", (np.pi / 4,), 1), ("abs", (-2,), 2), ("cosh", (1,), np.cosh(1)),
                 ("sinh", (-1e-9,), -1e-9)]
        graph = Graph()
        for number, (kind, given, _) in enumerate(table):
            graph.output(f"c{number}", graph.op(kind, *map(graph.constant, given)))
        graph.output("equal", graph.op("select", *map(graph.constant, (2, 2, 5, 6))))
        table.append(("select", (2, 2, 5, 6), 6))
        graph.output("crossed", graph.op("clamp", *map(graph.constant, (2, 7, 3)),
                                         names=("A", "min", "max")))
        table.append(("clamp", (2, 7, 3), 7))  # of a minimum above the maximum
        channels = [f"c{number}" for number in range(len(table) - 2)] + ["equal", "crossed"]
        model = document(graph.text(), [f'functionid="1" channel="{one}" fallbackvalue="1"'
                                        for one in channels])
        for part, (kind, given, expected) in zip(msq.read_3mf_implicit(archive(model)), table):
            found = part.structure.onset([0, 0, 0])
            if np.isnan(expected):
                expected = infinite  # as the onset says it
            self.assertTrue(found == expected or abs(found - expected) <= 1e-15 + 1e-15 * abs(expected),
                            f"{kind}{given} is {found}, not {expected}")

    def test_vectors_and_matrices(self):
        graph = Graph()
        ports = self.inputs(graph)
        vectors, scalars, matrices = ports["vector"], ports["scalar"], ports["matrix"]
        channels = []

        def take(name, port):
            channels.append(graph.output(name, graph.scalar_of(port)))

        take("dot", graph.node("dot", [("scalar", "result")], A=vectors[1], B=vectors[2]))
        take("cross", graph.op("cross", vectors[1], vectors[2]))
        take("length", graph.node("length", [("scalar", "result")], A=vectors[3]))
        take("vectorfromscalar", graph.node("vectorfromscalar", [("vector", "result")],
                                            A=scalars[2]))
        take("composevector", graph.node("composevector", [("vector", "result")], x=scalars[3],
                                         y=scalars[0], z=scalars[2]))
        for axis, port in zip("xyz", graph.parts(vectors[2])):
            take(f"decomposevector_{axis}", port)
        named = {f"m{row}{column}": scalars[(row + 3 * column) % 4] if row != column
                 else graph.constant(row + 0.5) for row in range(4) for column in range(4)}
        take("composematrix", graph.node("composematrix", [("matrix", "result")], **named))
        for kind in ("matrixfromcolumns", "matrixfromrows"):
            take(kind, graph.node(kind, [("matrix", "result")], A=vectors[0], B=vectors[1],
                                  C=vectors[2], D=vectors[3]))
        take("matvecmultiplication", graph.node(
            "matvecmultiplication", [("vector", "result")], A=matrices[1], B=vectors[2]))
        take("transpose", graph.op("transpose", matrices[2]))
        constant = graph.matrix([2, 0.5, 0, 0.25, -1, 3, 0.5, 0, 0, 0.75, 4, 0, 1, -2, 3, 1.5])
        take("constmat", graph.node("matvecmultiplication", [("vector", "result")], A=constant,
                                    B=vectors[3]))
        take("inverse", graph.node("matvecmultiplication", [("vector", "result")],
                                   A=graph.op("inverse", constant), B=vectors[3]))
        take("constvec", graph.op("multiplication", graph.vector(1e-3, "2.5E+1", ".5"), vectors[0]))
        self.run_all(graph, channels)


TWO = {np.add, np.subtract, np.multiply, np.divide, np.arctan2, np.minimum, np.maximum, np.fmod,
       np.power, BY_COMPONENT["mod"]}


def gyroid(graph, position):
    """sin x cos y + sin y cos z + sin z cos x"""
    x, y, z = graph.parts(position)
    turned = graph.node("composevector", [("vector", "result")], x=y, y=z, z=x)
    return graph.node("dot", [("scalar", "result")], A=graph.op("sin", position),
                      B=graph.op("cos", turned))


def sphere(number=2):
    """The example of the specification."""
    graph = Graph(number, (("vector", "pos"), ("scalar", "radius")))
    length = graph.node("length", [("scalar", "result")], A=("vector", "inputs.pos"))
    graph.output("shape", graph.op("subtraction", length, ("scalar", "inputs.radius")))
    return graph.text()


class Files(Compared):
    def one(self, functions, level_set='functionid="1" channel="shape"', **more):
        model = document(functions, [level_set], **more)
        part, = msq.read_3mf_implicit(archive(model))
        return model, part

    def test_a_gyroid_in_a_turned_box(self):
        graph = Graph()
        wave = gyroid(graph, graph.op("multiplication", ("vector", "inputs.pos"),
                                      graph.vector(4, 4, 4)))
        graph.output("shape", graph.op("subtraction", graph.op("abs", wave), graph.constant(0.3)))
        model, part = self.one(
            graph.text(), 'functionid="1" channel="shape" meshbboxonly="1" minfeaturesize="0.1" '
            'fallbackvalue="1" transform="0 2 0 -2 0 0 0 0 2 0.5 0.25 -1"', unit="inch",
            items='<item objectid="1000" transform="0.8 0.6 0 -0.6 0.8 0 0 0 1.5 10 20 30"/>')
        self.assertAlmostEqual(part.min_feature_size, 2.54)
        self.assertEqual((part.name, part.function_name, part.box_only, part.fallback),
                         ("part 0", "made", True, 1))
        low, high = np.array(part.min), np.array(part.max)
        # The corner of the mesh that is lowest along x, by hand.
        self.assertAlmostEqual(part.min[0], 25.4 * (-2 * 0.8 - 2.5 * 0.6 + 10))
        share = self.check(model, part, random_points(COUNT, 1, low, high))
        self.assertTrue(0.05 < share < 0.3, share)
        # A point of the object, where the object's coordinates are (1, 0.5, 0.25).
        at = np.array([1, 0.5, 0.25, 1]) @ np.vstack([part.transform])
        self.assertTrue(np.allclose(at, 25.4 * np.array([10.5, 21, 30.375])))
        to = np.append(at, 1) @ part.function_transform
        self.assertTrue(np.allclose(to, [2 * -0.5 + 0.5, 2 * 1 + 0.25, 2 * 0.25 - 1]))

    def test_a_warped_gyroid_by_calls(self):
        inner = Graph(1)
        inner.output("value", gyroid(inner, ("vector", "inputs.pos")))
        graph = Graph(3)
        pos = ("vector", "inputs.pos")
        bent = graph.op("addition", graph.op("multiplication", pos, graph.vector(5, 5, 5)),
                        graph.op("sin", graph.op("multiplication", pos, graph.vector(1, 2, 3))))
        wave = graph.call(1, ("scalar", "value"), pos=bent)
        ball = graph.call(2, ("scalar", "shape"), pos=pos, radius=graph.constant(1.25))
        graph.output("shape", graph.op("max", ball, wave))
        model, part = self.one(inner.text() + sphere() + graph.text(),
                               'functionid="3" channel="shape"')
        share = self.check(model, part, random_points(COUNT, 2))
        self.assertTrue(0.02 < share < 0.2, share)

    def test_spheres_united_cut_and_blended(self):
        """A union of 300 nests 9 deep, not 300."""
        generator = np.random.RandomState(5)
        graph = Graph()
        pos = ("vector", "inputs.pos")

        def ball(at, radius):
            moved = graph.op("subtraction", pos, graph.vector(*at))
            return graph.call(2, ("scalar", "shape"), pos=moved, radius=graph.constant(radius))

        union = ball((0, 0, 0), 0.5)
        for _ in range(299):
            union = graph.op("min", union, ball(generator.uniform(LOW, HIGH), 0.3))
        zero = graph.constant(0)
        cut = graph.op("max", union, graph.op("subtraction", zero, ball((0.5, 0.5, 0.5), 1)))
        # The polynomial smooth minimum.
        last = ball((0.5, 0.5, 0.5), 0.6)
        radius = graph.constant(0.4)
        near = graph.op("max", graph.op("subtraction", radius, graph.op(
            "abs", graph.op("subtraction", cut, last))), zero)
        fillet = graph.op("multiplication", graph.op("multiplication", near, near),
                          graph.constant(1 / 1.6))
        graph.output("shape", graph.op("subtraction", graph.op("min", cut, last), fillet))
        model, part = self.one(sphere() + graph.text())
        self.assertLess(len(part.expression), 40000)
        self.check(model, part, random_points(COUNT, 3))

    def test_matrices_transform_points_as_3mf_does(self):
        """The last four numbers shift: row vectors."""
        graph = Graph()
        moved = graph.node("matvecmultiplication", [("vector", "result")],
                           A=graph.matrix([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 1]),
                           B=("vector", "inputs.pos"))
        x, _, _ = graph.parts(moved)
        graph.output("shape", x)  # -y + 0.5
        _, part = self.one(graph.text())
        self.assertEqual(list(part.model().contains([[0, 0.51, 0], [0.0, 0.49, 0]])), [True, False])

    def test_points_without_a_value_take_the_fallback(self):
        graph = Graph()
        x, _, _ = graph.parts(("vector", "inputs.pos"))
        graph.output("shape", graph.op("subtraction", graph.op("sqrt", x), graph.constant(1)))
        points = random_points(COUNT, 4)
        shares = []
        for fallback in ("", 'fallbackvalue="-1"', 'fallbackvalue="0.25"'):
            model, part = self.one(graph.text(), f'functionid="1" channel="shape" {fallback}')
            shares.append(self.check(model, part, points))
            if msq.build_info().with_json:  # as a model file, too
                model = part.model()
                again = msq.Model.from_json(model.to_json())
                self.assertTrue((again.contains(points) == model.contains(points)).all())
        self.assertEqual(shares[0], shares[1])
        self.assertGreater(shares[0], shares[2] + 0.2)
        # A value of exactly 0 is solid, as everywhere.
        graph.output("flat", graph.op("max", graph.op("subtraction", graph.op("sqrt", x),
                                                      graph.constant(1)), graph.constant(0)))
        _, part = self.one(graph.text(), 'functionid="1" channel="flat"')
        self.assertEqual(list(part.model().contains([[-0.5, 0, 0], [0.5, 0, 0], [1.5, 0, 0]])),
                         [True, True, False])
        # 0 times what is undefined is undefined.
        graph.output("zero", graph.op("subtraction", graph.op(
            "multiplication", graph.constant(0), graph.op("sqrt", x)), graph.constant(1)))
        _, part = self.one(graph.text(), 'functionid="1" channel="zero" fallbackvalue="1"')
        self.assertEqual(list(part.model().contains([[-0.5, 0, 0], [0.5, 0, 0]])), [False, True])
        # A root of what is at least 0 always has a value: one function does.
        graph.output("whole", graph.op("sqrt", graph.op("multiplication", x, x)))
        _, part = self.one(graph.text(), 'functionid="1" channel="whole"')
        self.assertIsInstance(part.structure, msq.Functional)

    def test_a_mesh_bounds_a_levelset_and_components_place_it(self):
        tetrahedron = ('<object id="900" type="other"><mesh><vertices><vertex x="0" y="0" z="0"/>'
                       '<vertex x="2" y="0" z="0"/><vertex x="0" y="2" z="0"/>'
                       '<vertex x="0" y="0" z="2"/></vertices><triangles>'
                       '<triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>'
                       '<triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles>'
                       "</mesh></object>")
        graph = Graph()
        x, _, _ = graph.parts(("vector", "inputs.pos"))
        graph.output("shape", graph.op("subtraction", x, graph.constant(0.5)))
        pair = ('<object id="2000"><components><component objectid="1000"/>'
                '<component objectid="1000" transform="-1 0 0 0 1 0 0 0 1 0 0 10"/>'
                '<component objectid="901"/></components></object>')
        model = document(graph.text(), ['functionid="1" channel="shape"'],
                         mesh=tetrahedron + mesh_object(901),
                         more=pair, items='<item objectid="2000"/>')
        first, second, plain = msq.read_3mf_implicit(archive(model))
        self.assertEqual((second.min, second.max), ((-2, 0, 10), (0, 2, 12)))
        self.assertAlmostEqual(second.shape.info.volume, 8 / 6)  # mirrored, but not inside out
        self.assertEqual(list(first.model().contains([[0.4, 0.1, 0.1], [0.6, 0.1, 0.1],
                                                      [0.4, 1.5, 0.4]])), [True, False, False])
        self.assertEqual(list(second.model().contains([[-0.4, 0.1, 10.1], [-0.6, 0.1, 10.1],
                                                       [0.4, 0.1, 10.1]])), [True, False, False])
        self.assertIsNone(plain.structure)
        self.assertEqual(plain.object_id, 901)
        self.assertEqual(list(plain.model().contains([[2.9, 2.4, 1.9], [3.1, 0, 0]])), [True, False])
        for part in (first, second):
            self.check(model, part, random_points(COUNT // 10, 6, np.array(part.min),
                                                  np.array(part.max)))

    def test_files_are_opened_by_path(self):
        graph = Graph()
        graph.output("shape", graph.parts(("vector", "inputs.pos"))[0])
        data = archive(document(graph.text(), ['functionid="1" channel="shape"']))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "part.3mf")
            with self.assertRaises(FileNotFoundError):
                msq.read_3mf_implicit(path)
            with open(path, "wb") as file:
                file.write(data)
            self.assertEqual(len(msq.read_3mf_implicit(path)), 1)
            with self.assertRaisesRegex(msq.UnsupportedError, "volumetric"):
                msq.Shape.from_file(path)
            with open(path, "wb") as file:
                file.write(data[:200])
            with self.assertRaises(msq.FileError) as caught:
                msq.read_3mf_implicit(path)
            self.assertEqual(caught.exception.filename, path)
        with self.assertRaisesRegex(msq.LimitError, "the limit is 100"):
            msq.read_3mf_implicit(data, max_bytes=100)

    def test_required_properties_warn(self):
        graph = Graph()
        graph.output("shape", graph.parts(("vector", "inputs.pos"))[0])
        model = document(graph.text(), ['functionid="1" channel="shape" volumeid="50"'],
                         mesh='<v:volumedata id="50"><v:property functionid="1" channel="shape" '
                         'name="v:heat" required="true"/></v:volumedata>' + mesh_object(900))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            part, = msq.read_3mf_implicit(archive(model))
        self.assertEqual(part.volume_id, 50)
        self.assertIn("v:heat", str(caught[0].message))
        self.assertEqual(os.path.basename(caught[0].filename), os.path.basename(__file__))

    def test_lib3mf_takes_the_files_and_writes_the_same(self):
        try:
            import lib3mf
            wrapper = lib3mf.get_wrapper()
            version = wrapper.GetLibraryVersion()[:2]
        except (ImportError, AttributeError):
            self.skipTest("no Python package lib3mf")
        if tuple(version) < (2, 4):
            self.skipTest(f"lib3mf {version[0]}.{version[1]} does not know the Implicit extension")
        graph = Graph()
        wave = gyroid(graph, graph.op("multiplication", ("vector", "inputs.pos"),
                                      graph.vector(4, 4, 4)))
        angle = graph.op("atan2", graph.op("acos", graph.constant(0.5)), wave)
        ball = graph.call(2, ("scalar", "shape"), pos=("vector", "inputs.pos"),
                          radius=graph.constant(1.5))
        moved = graph.node("matvecmultiplication", [("vector", "result")],
                           A=graph.matrix([0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0.5, 0, 0, 1]),
                           B=("vector", "inputs.pos"))
        other = graph.op("min", graph.parts(moved)[1], angle)
        graph.output("shape", graph.op("max", ball, graph.op("min", wave, other)))
        data = archive(document(sphere() + graph.text(),
                                ['functionid="1" channel="shape" meshbboxonly="true" '
                                 'minfeaturesize="0.25" transform="1 0 0 0 1 0 0 0 1 0.5 0 0"']))
        model = wrapper.CreateModel()
        reader = model.QueryReader("3mf")
        reader.SetStrictModeActive(True)
        reader.ReadFromBuffer(data)
        written = bytes(model.QueryWriter("3mf").WriteToBuffer())
        ours, = msq.read_3mf_implicit(data)
        theirs, = msq.read_3mf_implicit(written)
        self.assertEqual(theirs.expression, ours.expression)
        self.assertEqual(theirs.parameters, ours.parameters)
        self.assertEqual((theirs.box_only, theirs.min_feature_size, theirs.min, theirs.max),
                         (ours.box_only, ours.min_feature_size, ours.min, ours.max))


class Refused(unittest.TestCase):
    def refused(self, kind, pattern, functions, level_set='functionid="1" channel="shape"', **more):
        with self.assertRaisesRegex(kind, pattern):
            msq.read_3mf_implicit(archive(document(functions, [level_set], **more)))

    def of(self, build):
        graph = Graph()
        graph.output("shape", build(graph))
        return graph.text()

    def test_nodes_without_meaning_are_named(self):
        pos = ("vector", "inputs.pos")
        for kind in ("mesh", "unsignedmesh", "beamlattice", "functiongradient", "normalizedistance",
                     "noise"):
            text = self.of(lambda g: g.node(kind, [("scalar", "distance")], pos=pos))
            self.refused(msq.UnsupportedError, rf"object 1000: function 1 'made', node 'n0' "
                         rf"\({kind}\)", text)
        self.refused(msq.UnsupportedError, "object 1000: function 1 is a functionfromimage3d",
                     '<v:functionfromimage3d id="1" image3did="7"/>')
        self.refused(msq.UnsupportedError, r"node 'n\d+' \(inverse\).*not constant",
                     self.of(lambda g: g.scalar_of(g.op("inverse", g.node(
                         "matrixfromrows", [("matrix", "result")], A=pos, B=pos, C=pos, D=pos)))))
        # What no channel needs may be there.
        graph = Graph()
        graph.node("mesh", [("scalar", "distance")], pos=pos)
        graph.output("shape", graph.parts(pos)[0])
        self.assertEqual(len(msq.read_3mf_implicit(archive(document(
            graph.text(), ['functionid="1" channel="shape"'])))), 1)

    def test_wrong_graphs(self):
        pos = ("vector", "inputs.pos")
        f = msq.FileError
        self.refused(f, "circle", self.of(lambda g: g.op("abs", g.op("sin", ("scalar", "n1.result")))))
        self.refused(f, "calls itself", self.of(lambda g: g.call(1, ("scalar", "shape"), pos=pos)))
        self.refused(f, r"function 2 'made' calls itself",
                     self.of(lambda g: g.call(2, ("scalar", "shape"), pos=pos))
                     + self.of(lambda g: g.call(1, ("scalar", "shape"), pos=pos)).replace(
                         'id="1"', 'id="2"').replace('value="2"', 'value="1"')
                     .replace('value="1"', 'value="2"'))
        self.refused(f, "there is no function 8",
                     self.of(lambda g: g.call(8, ("scalar", "shape"), pos=pos)))
        self.refused(f, "there is no function 4", "", 'functionid="4" channel="shape"')
        self.refused(f, "'n7.result', which does not exist",
                     self.of(lambda g: g.op("abs", ("scalar", "n7.result"))))
        self.refused(f, "'inputs.size', which has no value",
                     self.of(lambda g: g.op("abs", ("scalar", "inputs.size"))))
        self.refused(f, r"node 'n0' \(addition\) lacks input B",
                     self.of(lambda g: g.op("addition", pos)))
        self.refused(f, "input B has no reference",
                     self.of(lambda g: g.op("addition", pos, ("vector", ""))))
        self.refused(f, r"\(addition\) has inputs of the types scalar, vector",
                     self.of(lambda g: g.op("addition", pos, g.constant(1))))
        self.refused(f, "is a scalar and refers to 'inputs.pos', a vector",
                     self.of(lambda g: g.op("abs", ("scalar", "inputs.pos"))))
        self.refused(f, r"\(length\): input A is a scalar; it must be a vector",
                     self.of(lambda g: g.node("length", [("scalar", "result")], A=g.constant(1))))
        self.refused(f, "channel 'shape' of function 1 is a vector; it must be a scalar",
                     self.of(lambda g: g.op("abs", pos)))
        self.refused(f, "no output 'size'", self.of(lambda g: g.constant(1)),
                     'functionid="1" channel="size"')
        self.refused(f, "has no inverse", self.of(lambda g: g.scalar_of(g.op(
            "inverse", g.matrix([1] * 16)))))

    def test_wrong_numbers(self):
        for value in ("NaN", "inf", "1e999", "", "1_0", "0x10", "a" * 1000):
            self.refused(msq.FileError, r"object 1000: function 1 'made', node 'n0' \(constant\): "
                         "value is .*; it must be a finite number",
                         self.of(lambda g: g.constant(value)))
        text = self.of(lambda g: g.constant(1))
        level = 'functionid="1" channel="shape" '
        self.refused(msq.FileError, "fallbackvalue is 'NaN'", text, level + 'fallbackvalue="NaN"')
        self.refused(msq.FileError, "minfeaturesize is -1; it must be at least 0", text,
                     level + 'minfeaturesize="-1"')
        self.refused(msq.FileError, "object 1000.*bounding box .* is flat", text,
                     level + 'meshbboxonly="true"', mesh=mesh_object(900, LOW, (*HIGH[:2], LOW[2])))
        self.refused(msq.FileError, "transform has 11 numbers; it must have 12", text,
                     level + 'transform="1 0 0 0 1 0 0 0 1 0 0"')
        self.refused(msq.FileError, "determinant 0.0", text,
                     items='<item objectid="1000" transform="1 0 0 0 1 0 0 0 0 0 0 0"/>')
        self.refused(msq.FileError, "overflow", text, items=
                     '<item objectid="1000" transform="1e308 0 0 0 1e308 0 0 0 1e308 0 0 0"/>')
        self.refused(msq.FileError, "the unit is 'mile'", text, unit="mile")
        self.refused(msq.FileError, "meshid 900 is no object", text, level, mesh=mesh_object(77))
        self.refused(msq.FileError, "there is no object 5", text, items='<item objectid="5"/>')
        self.refused(msq.FileError, "component of itself", text, more='<object id="5"><components>'
                     '<component objectid="5"/></components></object>', items='<item objectid="5"/>')
        # Large numbers that the function itself allows are no error.
        graph = Graph()
        x, _, _ = graph.parts(("vector", "inputs.pos"))
        huge = graph.op("multiplication", x, graph.constant(1e200))
        graph.output("shape", graph.op("multiplication", huge, graph.op("abs", huge)))
        part, = msq.read_3mf_implicit(archive(document(graph.text(), [level])))
        self.assertEqual(list(part.model().contains([[-1.0, 0, 0], [1, 0, 0]])), [True, False])

    def test_graphs_that_are_too_large(self):
        def doubled(count):
            def build(graph):
                x = graph.parts(("vector", "inputs.pos"))[0]
                for _ in range(count):
                    x = graph.op("sin", graph.op("multiplication", graph.op("cos", x),
                                                 graph.op("sin", x)))
                return x
            return self.of(build)

        for count in (20, 2000):
            self.refused(msq.LimitError, "object 1000, function 1: its expression has [0-9]+ "
                         "characters or more.*; the limit is 65536", doubled(count))

        def nested(graph):
            x = graph.parts(("vector", "inputs.pos"))[0]
            for _ in range(3000):
                x = graph.op("sin", x)
            return x

        self.refused(msq.LimitError, "nests 300[0-9] deep; the limit is 100", self.of(nested))
        # Functions that call functions twice: 2^40 calls with other inputs each.
        functions = []
        for number in range(1, 41):
            graph = Graph(number)
            pos = ("vector", "inputs.pos")
            moved = graph.op("sin", pos)
            if number < 40:
                both = [graph.call(number + 1, ("scalar", "shape"), pos=one) for one in (pos, moved)]
                graph.output("shape", graph.op("addition", *both))
            else:
                graph.output("shape", graph.parts(pos)[0])
            functions.append(graph.text())
        self.refused(msq.LimitError, "more than|characters", "".join(functions))
        functions = [self.of(lambda g: g.call(number + 1, ("scalar", "shape"),
                                              pos=("vector", "inputs.pos"))).replace(
                         'implicitfunction id="1"', f'implicitfunction id="{number}"')
                     for number in range(1, 200)]
        self.refused(msq.LimitError, "deeper than 64", "".join(functions))

    def test_hostile_archives(self):
        f = msq.FileError
        for data, pattern in ((b"", "malformed ZIP"), (b"PK\x03\x04" + bytes(100), "malformed ZIP"),
                              (archive("<model"), "malformed XML"),
                              (archive("<a/>"), "not a 3MF model"),
                              (archive('<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>'),
                               "document type"),
                              (archive("\x00"), "malformed XML")):
            with self.assertRaisesRegex(f, pattern):
                msq.read_3mf_implicit(data)
        model = document(self.of(lambda g: g.constant(1)), ['functionid="1" channel="shape"'])
        # A bomb: 64 MiB of spaces in 64 KiB.
        bomb = archive(model.replace("<build>", " " * (1 << 26) + "<build>"))
        self.assertLess(len(bomb), 1 << 17)
        with self.assertRaisesRegex(msq.LimitError, "larger than 1000000 bytes"):
            msq.read_3mf_implicit(bomb, max_bytes=1000000)
        with self.assertRaisesRegex(msq.LimitError, "nests deeper than 64"):
            msq.read_3mf_implicit(archive(model.replace("<build>", "<a>" * 100 + "</a>" * 100
                                                        + "<build>")))
        with self.assertRaisesRegex(msq.LimitError, "comment of [0-9]+ bytes or more; the limit is 1048576"):
            msq.read_3mf_implicit(archive('<model a="' + "x" * 2_000_000 + '"/>'))
        with self.assertRaisesRegex(msq.FileError, "not a 3MF model"):  # text comes in pieces
            msq.read_3mf_implicit(archive("<model>" + "x" * 3_000_000 + "</model>"))
        with self.assertRaisesRegex(msq.LimitError, "more than 500000 elements"):
            msq.read_3mf_implicit(archive(model.replace("<build>", "<a/>" * 500001 + "<build>")))
        # 2^30 placed objects.
        tree = "".join(f'<object id="{2000 + i}"><components>'
                       + 2 * f'<component objectid="{2001 + i if i < 30 else 1000}"/>'
                       + "</components></object>" for i in range(31))
        with self.assertRaisesRegex(msq.LimitError, "more than 10000 objects"):
            msq.read_3mf_implicit(archive(model.replace("</resources>", tree + "</resources>").replace(
                '<item objectid="1000"', '<item objectid="2000"')))
        data = bytearray(archive(model))
        at = data.rindex(b"PK\x01\x02")
        data[at + 8:at + 10] = struct.pack("<H", 1)  # encrypted
        with self.assertRaises(msq.UnsupportedError):
            msq.read_3mf_implicit(bytes(data))
        # Damage: an answer or an error of msq, no other exception.
        whole = archive(model)
        generator = np.random.RandomState(8)
        for _ in range(30 if SANITIZED else 300):
            data = bytearray(whole)
            for at in generator.randint(0, len(data), 3):
                data[at] = generator.randint(256)
            try:
                msq.read_3mf_implicit(bytes(data))
            except msq.Error:
                pass
            text = bytearray(model, "utf-8")
            for at in generator.randint(0, len(text), 3):
                text[at] = generator.randint(32, 127)
            try:
                msq.read_3mf_implicit(archive(bytes(text)))
            except msq.Error:
                pass

    def test_extensions(self):
        model = document(self.of(lambda g: g.constant(1)), ['functionid="1" channel="shape"'])
        with self.assertRaisesRegex(msq.UnsupportedError, "extension 'http://s'"):
            msq.read_3mf_implicit(archive(model.replace(
                'requiredextensions="v i"', 'xmlns:s="http://s" requiredextensions="v s"')))
        with self.assertRaisesRegex(msq.UnsupportedError, "production"):
            msq.read_3mf_implicit(archive(model.replace(
                '<item ', '<item xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/'
                '2015/06" p:path="/b.model" ')))
        with self.assertRaisesRegex(msq.UnsupportedError, "object 900 has a beam lattice"):
            msq.read_3mf_implicit(archive(model.replace(
                "</triangles>", '</triangles><b:beamlattice xmlns:b="http://schemas.microsoft.com/'
                '3dmanufacturing/beamlattice/2017/02"/>')))


if __name__ == "__main__":
    unittest.main()
