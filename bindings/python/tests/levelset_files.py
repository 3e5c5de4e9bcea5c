# SPDX-License-Identifier: Apache-2.0
"""3MF files with levelsets, an evaluator of their graphs that reads the XML on its own, and tests
that compare both."""
import io
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile

import numpy as np

import msq

SPACES = ('xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
          'xmlns:v="http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01" '
          'xmlns:i="http://schemas.3mf.io/3dmanufacturing/implicit/2023/12"')
LOW, HIGH = np.array([-2.0, -1.5, -1.0]), np.array([3.0, 2.5, 2.0])


# Writing files


def archive(model):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as package:
        package.writestr("[Content_Types].xml", '<?xml version="1.0"?><Types xmlns="http://schemas.'
                         'openxmlformats.org/package/2006/content-types"><Default Extension="rels" '
                         'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
                         '<Default Extension="model" ContentType='
                         '"application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>')
        package.writestr("_rels/.rels", '<?xml version="1.0"?><Relationships xmlns="http://schemas.'
                         'openxmlformats.org/package/2006/relationships"><Relationship Type="http://'
                         'schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/a.model"'
                         ' Id="r"/></Relationships>')
        package.writestr("3D/a.model", model)
    return file.getvalue()


def mesh_object(number, low=LOW, high=HIGH):
    corners = [(x, y, z) for z in (low[2], high[2]) for y in (low[1], high[1])
               for x in (low[0], high[0])]
    faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3),
             (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    return (f'<object id="{number}"><mesh><vertices>'
            + "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in corners)
            + "</vertices><triangles>"
            + "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces)
            + "</triangles></mesh></object>")


def document(functions, level_sets, *, mesh=None, unit="millimeter", items=None, more=""):
    """A model; level_sets are attributes, of objects from 1000 on. The mesh is object 900."""
    objects = "".join(f'<object id="{1000 + i}" name="part {i}"><v:levelset meshid="900" {one}/>'
                      "</object>" for i, one in enumerate(level_sets))
    if items is None:
        items = "".join(f'<item objectid="{1000 + i}"/>' for i in range(len(level_sets)))
    return (f'<?xml version="1.0" encoding="utf-8"?><model {SPACES} unit="{unit}" '
            f'requiredextensions="v i"><resources>{functions}{mesh or mesh_object(900)}{objects}'
            f"{more}</resources><build>{items}</build></model>")


class Graph:
    """The body of a function. Ports are pairs of a type and a reference."""

    def __init__(self, number=1, inputs=(("vector", "pos"),)):
        self.number = number
        self.inputs = "".join(f'<i:{kind} identifier="{name}"/>' for kind, name in inputs)
        self.nodes = []
        self.outputs = []

    def node(self, kind, outputs, attributes="", **inputs):
        name = f"n{len(self.nodes)}"
        given = "".join(f'<i:{port[0]}ref identifier="{label}" ref="{port[1]}"/>'
                        for label, port in inputs.items())
        made = "".join(f'<i:{of} identifier="{label}"/>' for of, label in outputs)
        self.nodes.append(f'<i:{kind} identifier="{name}" {attributes}>'
                          + (f"<i:in>{given}</i:in>" if given else "")
                          + f"<i:out>{made}</i:out></i:{kind}>")
        ports = [(of.replace("resourceid", "resource"), f"{name}.{label}") for of, label in outputs]
        return ports[0] if len(ports) == 1 else ports

    def constant(self, value):
        return self.node("constant", [("scalar", "value")], f'value="{value}"')

    def vector(self, x, y, z):
        return self.node("constvec", [("vector", "vector")], f'x="{x}" y="{y}" z="{z}"')

    def matrix(self, numbers):
        return self.node("constmat", [("matrix", "matrix")],
                         f'matrix="{" ".join(map(repr, numbers))}"')

    def call(self, number, output, **inputs):
        called = self.node("constresourceid", [("resourceid", "value")], f'value="{number}"')
        return self.node("functioncall", [output], functionID=called, **inputs)

    def op(self, kind, *of, names="ABCD", result="result"):
        """A node of the type of its inputs."""
        return self.node(kind, [(of[0][0], result)], **dict(zip(names, of)))

    def parts(self, vector):
        return self.node("decomposevector", [("scalar", axis) for axis in "xyz"], A=vector)

    def scalar_of(self, port):
        """A number that depends on every component."""
        if port[0] == "matrix":
            port = self.node("matvecmultiplication", [("vector", "result")], A=port,
                             B=self.vector(0.9, -1.3, 0.4))
        if port[0] == "vector":
            port = self.node("dot", [("scalar", "result")], A=port, B=self.vector(1, 0.7, -0.6))
        return port

    def output(self, name, port):
        self.outputs.append(f'<i:{port[0]}ref identifier="{name}" ref="{port[1]}"/>')
        return name

    def text(self):
        return (f'<i:implicitfunction id="{self.number}" displayname="made"><i:in>{self.inputs}'
                f'</i:in>{"".join(self.nodes)}<i:out>{"".join(self.outputs)}</i:out>'
                "</i:implicitfunction>")


# The independent evaluator: values are arrays (n,), (n, 3) and (n, 4, 4)


def up(function):
    def of_all(*arguments):
        with np.errstate(all="ignore"):
            return function(*arguments)
    return of_all


BY_COMPONENT = {
    "addition": np.add, "subtraction": np.subtract, "multiplication": np.multiply,
    "division": np.divide, "sin": np.sin, "cos": np.cos, "tan": np.tan, "arcsin": np.arcsin,
    "arccos": np.arccos, "arctan": np.arctan, "arctan2": np.arctan2, "min": np.minimum,
    "max": np.maximum, "abs": np.abs, "fmod": np.fmod, "mod": lambda a, b: a - b * np.floor(a / b),
    "pow": np.power, "sqrt": np.sqrt, "exp": np.exp, "log": np.log, "log2": np.log2,
    "log10": np.log10, "sinh": np.sinh, "cosh": np.cosh, "tanh": np.tanh,
    "round": lambda a: np.copysign(np.floor(np.abs(a) + 0.5), a), "ceil": np.ceil,
    "floor": np.floor, "sign": np.sign, "fract": lambda a: a - np.floor(a),
    "select": lambda a, b, c, d: np.where(np.isnan(a) | np.isnan(b), np.nan, np.where(a < b, c, d)),
    "clamp": lambda a, low, high: np.maximum(low, np.minimum(a, high))}


class Oracle:
    def __init__(self, model):
        root = ElementTree.fromstring(model)
        self.functions = {int(one.get("id")): one for one in root.iter()
                          if one.tag.endswith("}implicitfunction")}

    def values(self, number, inputs, channel):
        function = self.functions[number]
        nodes = {one.get("identifier"): one for one in function}
        known = {f"inputs.{name}": value for name, value in inputs.items()}
        count = len(next(value for value in inputs.values() if isinstance(value, np.ndarray)))

        def of(reference):
            if reference not in known:
                name = reference.split(".")[0]
                known.update({f"{name}.{label}": value for label, value
                              in self.evaluate(nodes[name], of, count).items()})
            return known[reference]

        for port in function[-1]:
            if port.get("identifier") == channel:
                return of(port.get("ref"))
        raise KeyError(channel)

    def evaluate(self, node, of, count):
        kind = node.tag.split("}")[1]
        given = {port.get("identifier"): of(port.get("ref")) for side in node
                 if side.tag.endswith("}in") for port in side}
        with np.errstate(all="ignore"):
            if kind in BY_COMPONENT:
                return {"result": BY_COMPONENT[kind](*given.values())}
            if kind == "functioncall":
                number = given.pop("functionID")
                names = [port.get("identifier") for port in node[-1]]
                return {name: self.values(number, given, name) for name in names}
            return getattr(self, kind)(node, count, **given)

    @staticmethod
    def constant(node, count):
        return {"value": np.full(count, float(node.get("value")))}

    @staticmethod
    def constvec(node, count):
        return {"vector": np.tile([float(node.get(axis)) for axis in "xyz"], (count, 1))}

    @staticmethod
    def constmat(node, count):
        numbers = np.array(node.get("matrix").split(), float).reshape(4, 4)
        return {"matrix": np.tile(numbers, (count, 1, 1))}

    @staticmethod
    def constresourceid(node, count):
        return {"value": int(node.get("value"))}

    @staticmethod
    def composevector(node, count, x, y, z):
        return {"result": np.stack([x, y, z], axis=1)}

    @staticmethod
    def vectorfromscalar(node, count, A):
        return {"result": np.stack([A, A, A], axis=1)}

    @staticmethod
    def decomposevector(node, count, A):
        return dict(zip("xyz", A.T))

    @staticmethod
    def composematrix(node, count, **given):
        rows = [[given[f"m{row}{column}"] for column in range(4)] for row in range(4)]
        return {"result": np.moveaxis(np.array(rows), 2, 0)}

    @staticmethod
    def matrixfromrows(node, count, **given):
        made = np.zeros((count, 4, 4))
        for row, name in enumerate("ABCD"):
            made[:, row, :3] = given[name]
        made[:, 3, 3] = 1
        return {"result": made}

    @staticmethod
    def matrixfromcolumns(node, count, **given):
        return {"result": Oracle.matrixfromrows(node, count, **given)["result"].swapaxes(1, 2)}

    @staticmethod
    def transpose(node, count, A):
        return {"result": A.swapaxes(1, 2)}

    @staticmethod
    def inverse(node, count, A):
        return {"result": np.linalg.inv(A)}

    @staticmethod
    def dot(node, count, A, B):
        return {"result": (A * B).sum(axis=1)}

    @staticmethod
    def cross(node, count, A, B):
        return {"result": np.cross(A, B)}

    @staticmethod
    def length(node, count, A):
        return {"result": np.linalg.norm(A, axis=1)}

    @staticmethod
    def matvecmultiplication(node, count, A, B):
        row = np.concatenate([B, np.ones((count, 1))], axis=1)
        return {"result": np.einsum("ni,nij->nj", row, A)[:, :3]}


# Comparing


class Compared(unittest.TestCase):
    """Tests that compare parts with the oracle."""

    def check(self, model, part, points, *, most_left_out=0.02):
        """All points away from rounding: the function's value, and whether a point is inside.
        Returns the part of the points that are."""
        oracle = Oracle(model)

        def values(at):
            positions = at @ part.function_transform[:3] + part.function_transform[3]
            return oracle.values(part.function_id, {"pos": positions}, part.channel)

        expected = values(points)
        other = values(points * (1 + 1e-12) + 1e-12), values(points * (1 - 1e-12) - 1e-12)
        with np.errstate(all="ignore"):
            tolerance = 1e-9 * (1 + np.abs(expected))
            sure = np.ones(len(points), bool)
            for one in other:  # no jump or pole is near
                sure &= ((np.abs(one - expected) <= 1e-3 * tolerance ** 0.5)
                         | (np.isnan(one) & np.isnan(expected)) | (one == expected))
        self.assertLess(1 - sure.mean(), most_left_out, part.channel)
        function = msq.Functional(expression=part.expression, parameters=part.parameters,
                                  cell_size=part.cell_size, origin=part.origin)
        found = function.onset(points)
        undefined = np.isnan(expected)
        with np.errstate(all="ignore"):
            good = ((np.abs(found - expected) <= tolerance)
                    | (undefined & np.isinf(found)) | (found == expected))
        wrong = np.flatnonzero(sure & ~good)
        self.assertEqual(len(wrong), 0, f"{part.channel}: at {points[wrong[:3]]} {found[wrong[:3]]}, "
                                        f"not {expected[wrong[:3]]}")
        with np.errstate(all="ignore"):
            inside = np.where(undefined, part.fallback, expected) <= 0
            clear = sure & (undefined | (np.abs(expected) > tolerance))
        inside &= msq.Model(part.shape).contains(points)
        answers = part.model().contains(points)
        self.assertEqual(int((answers != inside)[clear].sum()), 0, part.channel)
        return inside.mean()


def random_points(count, seed, low=LOW, high=HIGH):
    generator = np.random.RandomState(seed)
    margin = (high - low).max() / 20  # within the cell of the structure
    return generator.uniform(low - margin, high + margin, (count, 3))
