# SPDX-License-Identifier: Apache-2.0
"""Levelsets of 3MF files: the Volumetric and Implicit extensions."""
from __future__ import annotations

import dataclasses
import math
import os
import warnings
from typing import Dict, List, Mapping, Optional, Sequence, Set, Tuple, Union

import numpy as np

from ._formula import TURN, Formula
from ._implicit_nodes import COMPONENTWISE, Terms
from ._package import (IMPLICIT, Element, LevelSet, Object, Package, identifier_of, joined, number_of,
                       numbers_of)
from .context import Context, context_of, unsigned
from .errors import FileError, LimitError, UnsupportedError, with_path
from .model import Model
from .shape import Shape
from .structure import Functional, Structure

_Vector = Tuple[float, float, float]
#: A value of the graph: its type, and 1, 3 or 16 terms by rows, or the identifier of a resource.
_Value = Tuple[str, Terms]

_COUNTS = {"scalar": 1, "vector": 3, "matrix": 16, "resourceid": 1}
_REFERENCES = {"scalarref": "scalar", "vectorref": "vector", "matrixref": "matrix",
               "resourceref": "resourceid"}
_MOST_CALLS = 64  # of functions in functions
_MOST_STEPS = 500_000
_LEAST = 5e-324  # the smallest number above 0

# Names that lib3mf writes, or that the specification uses in examples, for those of its schema.
_OTHER_NAMES = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2",
                "matrixvectormultiplication": "matvecmultiplication"}

_MATRIX_NAMES = tuple(f"m{row}{column}" for row in range(4) for column in range(4))
# Other nodes: the names and types of the inputs, and of the outputs.
_OTHERS: Dict[str, Tuple[Dict[str, str], Dict[str, str]]] = {
    "constant": ({}, {"value": "scalar"}),
    "constvec": ({}, {"vector": "vector"}),
    "constmat": ({}, {"matrix": "matrix"}),
    "constresourceid": ({}, {"value": "resourceid"}),
    "composevector": (dict.fromkeys("xyz", "scalar"), {"result": "vector"}),
    "vectorfromscalar": ({"A": "scalar"}, {"result": "vector"}),
    "decomposevector": ({"A": "vector"}, dict.fromkeys("xyz", "scalar")),
    "composematrix": (dict.fromkeys(_MATRIX_NAMES, "scalar"), {"result": "matrix"}),
    "matrixfromcolumns": (dict.fromkeys("ABCD", "vector"), {"result": "matrix"}),
    "matrixfromrows": (dict.fromkeys("ABCD", "vector"), {"result": "matrix"}),
    "dot": (dict.fromkeys("AB", "vector"), {"result": "scalar"}),
    "cross": (dict.fromkeys("AB", "vector"), {"result": "vector"}),
    "matvecmultiplication": ({"A": "matrix", "B": "vector"}, {"result": "vector"}),
    "transpose": ({"A": "matrix"}, {"result": "matrix"}),
    "inverse": ({"A": "matrix"}, {"result": "matrix"}),
    "length": ({"A": "vector"}, {"result": "scalar"}),
}
_REFUSED = {
    "mesh": "the signed distance to a mesh",
    "unsignedmesh": "the distance to a mesh",
    "beamlattice": "the distance to a beam lattice",
    "functiongradient": "the gradient of a function",
    "normalizedistance": "a distance by the gradient of a function",
}


class _Function:
    """A function of the file, its references checked."""

    def __init__(self, element: Element, number: int) -> None:
        name = element.attributes.get("displayname", "")
        self.what = f"function {number}" + (f" '{name[:60]}'" if name else "")
        if element.name == "functionfromimage3d":
            raise UnsupportedError(f"{self.what} is a functionfromimage3d, an image, which is not "
                                   "read")
        if element.space != IMPLICIT or element.name == "privateextensionfunction":
            raise UnsupportedError(f"{self.what} is a {element.name} of '{element.space[:100]}', "
                                   "which is not read")
        self.nodes: Dict[str, Element] = {}
        self.inputs: Dict[str, str] = {}  #: types by name
        self.outputs: Dict[str, Tuple[str, str]] = {}  #: types and references by name
        for child in element.children:
            if child.name == "in":
                for port in child.children:
                    self.inputs[self._identifier(port)] = port.name
            elif child.name == "out":
                self.outputs.update(self._references(child, self.what))
            else:
                identifier = self._identifier(child)
                if identifier in self.nodes or identifier in ("inputs", "outputs"):
                    raise FileError(None, f"{self.what}: two nodes are named '{identifier}'")
                self.nodes[identifier] = child
        self.given: Dict[str, Dict[str, Tuple[str, str]]] = {}
        for identifier, node in self.nodes.items():
            self.given[identifier] = {}
            for child in node.all("in"):
                self.given[identifier].update(self._references(child, self.node(identifier)))
        self._check()

    def node(self, identifier: str) -> str:
        """A node, for messages."""
        return f"{self.what}, node '{identifier[:60]}' ({self.nodes[identifier].name})"

    def _identifier(self, element: Element) -> str:
        return element.text("identifier", f"{self.what}: a <{element.name[:60]}>")

    def _references(self, element: Element, what: str) -> Dict[str, Tuple[str, str]]:
        """Types and references by name. lib3mf writes empty references of inputs that constants do
        not have."""
        found = {}
        for port in element.children:
            if port.name not in _REFERENCES:
                raise FileError(None, f"{what}: a <{port.name[:60]}> is no reference")
            found[port.text("identifier", f"{what}: a <{port.name}>")] = (
                _REFERENCES[port.name], port.attributes.get("ref", "").strip())
        return found

    def source(self, reference: str, what: str) -> Tuple[str, str]:
        """The node and the output of a reference."""
        node, dot, output = reference.partition(".")
        if not dot or (node != "inputs" and node not in self.nodes):
            raise FileError(None, f"{what} refers to '{reference[:100]}', which does not exist")
        return node, output

    def _check(self) -> None:
        """Refuses references to nothing, and circles."""
        after: Dict[str, List[str]] = {identifier: [] for identifier in self.nodes}
        waits = dict.fromkeys(self.nodes, 0)
        for identifier, given in self.given.items():
            for name, (_, reference) in given.items():
                if not reference:
                    continue
                node, _ = self.source(reference, f"{self.node(identifier)}: input {name[:60]}")
                if node != "inputs":
                    after[node].append(identifier)
                    waits[identifier] += 1
        self.order: List[str] = [identifier for identifier, count in waits.items() if not count]
        for identifier in self.order:  # grows
            for later in after[identifier]:
                waits[later] -= 1
                if not waits[later]:
                    self.order.append(later)
        if len(self.order) < len(self.nodes):
            stuck = next(identifier for identifier, count in waits.items() if count)
            raise FileError(None, f"{self.node(stuck)} is in or behind a circle of references")


class _Translator:
    """The functions of a file as terms of one formula."""

    def __init__(self, elements: Mapping[int, Element], formula: Formula) -> None:
        self._elements = elements
        self._functions: Dict[int, _Function] = {}
        self._formula = formula
        self._calls: List[int] = []
        self._known: Dict[Tuple[int, Tuple[Tuple[str, _Value], ...], str], _Value] = {}
        self._steps = 0

    def function(self, number: int, what: str) -> _Function:
        if number not in self._functions:
            if number not in self._elements:
                raise FileError(None, f"{what}: there is no function {number}")
            self._functions[number] = _Function(self._elements[number], number)
        return self._functions[number]

    def call(self, number: int, given: Mapping[str, _Value], outputs: Sequence[str],
             what: str) -> Dict[str, _Value]:
        """The outputs of a function for its inputs."""
        function = self.function(number, what)
        if number in self._calls:
            raise FileError(None, f"{function.what} calls itself")
        if len(self._calls) >= _MOST_CALLS:
            raise LimitError(f"{what}: functions call functions deeper than {_MOST_CALLS}")
        key = tuple(sorted(given.items()))
        missing = [name for name in outputs if (number, key, name) not in self._known]
        if missing:
            self._calls.append(number)
            try:
                for name, value in self._run(function, given, missing, what).items():
                    self._known[number, key, name] = value
            finally:
                self._calls.pop()
        return {name: self._known[number, key, name] for name in outputs}

    def _run(self, function: _Function, given: Mapping[str, _Value], outputs: Sequence[str],
             what: str) -> Dict[str, _Value]:
        self._steps += len(function.nodes)
        if self._steps > _MOST_STEPS:
            raise LimitError(f"{function.what}: more than {_MOST_STEPS} nodes, with those of functions "
                             "at each call")
        for name, (kind, _) in given.items():
            if function.inputs.get(name, kind) != kind:
                raise FileError(None, f"{what}: input {name[:60]} is a {kind}; {function.what} takes "
                                      f"a {function.inputs[name][:60]}")
        for name in outputs:
            if name not in function.outputs:
                raise FileError(None, f"{what}: {function.what} has no output '{name[:60]}'")
        # Which outputs of which nodes are needed, from the end to the beginning.
        needed: Dict[str, Set[str]] = {}

        def need(reference: str, where: str) -> None:
            if not reference:
                raise FileError(None, f"{where} has no reference")
            node, output = function.source(reference, where)
            if node != "inputs":
                needed.setdefault(node, set()).add(output)

        for name in outputs:
            need(function.outputs[name][1], f"{function.what}: output {name[:60]}")
        for identifier in reversed(function.order):
            if identifier in needed:
                for name in self._inputs(function, identifier):
                    if name not in function.given[identifier]:
                        raise FileError(None, f"{function.node(identifier)} lacks input {name}")
                    need(function.given[identifier][name][1],
                         f"{function.node(identifier)}: input {name[:60]}")
        values: Dict[Tuple[str, str], _Value] = {
            ("inputs", name): value for name, value in given.items()}

        def value_of(reference: Tuple[str, str], where: str) -> _Value:
            kind, text = reference
            node, output = function.source(text, where)
            found = values.get((node, output))
            if found is None:
                raise FileError(None, f"{where} refers to '{text[:100]}', which has no value")
            if found[0] != kind:
                raise FileError(None, f"{where} is a {kind} and refers to '{text[:100]}', a "
                                      f"{found[0]}")
            return found

        for identifier in function.order:
            if identifier not in needed:
                continue
            where = function.node(identifier)
            inputs = {name: value_of(function.given[identifier][name],
                                     f"{where}: input {name[:60]}")
                      for name in self._inputs(function, identifier)}
            for name, value in self._node(function, identifier, inputs,
                                          sorted(needed[identifier])).items():
                values[identifier, name] = value
        return {name: value_of(function.outputs[name], f"{function.what}: output {name[:60]}")
                for name in outputs}

    @staticmethod
    def _kind(function: _Function, identifier: str) -> str:
        """The name of a node's type, if it is one that is translated."""
        name = function.nodes[identifier].name
        name = _OTHER_NAMES.get(name, name)
        if name in _REFUSED:
            raise UnsupportedError(f"{function.node(identifier)} is {_REFUSED[name]}, which is not "
                                   "read")
        if name not in COMPONENTWISE and name not in _OTHERS and name != "functioncall":
            raise UnsupportedError(f"{function.node(identifier)} is of an unknown type")
        return name

    def _inputs(self, function: _Function, identifier: str) -> Sequence[str]:
        kind = self._kind(function, identifier)
        if kind == "functioncall":
            given = function.given[identifier]
            return ["functionID", *(name for name, (_, reference) in given.items()
                                    if name != "functionID" and reference)]
        if kind in _OTHERS:
            return list(_OTHERS[kind][0])
        return COMPONENTWISE[kind][0]

    def _node(self, function: _Function, identifier: str, inputs: Dict[str, _Value],
              outputs: Sequence[str]) -> Dict[str, _Value]:
        kind = self._kind(function, identifier)
        where = function.node(identifier)
        if kind == "functioncall":
            called = inputs.pop("functionID")
            if called[0] != "resourceid":
                raise FileError(None, f"{where}: functionID is a {called[0]}")
            return self.call(called[1][0], inputs, outputs, where)
        if kind in COMPONENTWISE:
            types = {value[0] for value in inputs.values()}
            if len(types) != 1 or "resourceid" in types:
                raise FileError(None, f"{where} has inputs of the types {', '.join(sorted(types))}; "
                                      "all must be scalars, vectors or matrices")
            names, form = COMPONENTWISE[kind]
            of = zip(*(inputs[name][1] for name in names))
            made = {"result": (types.pop(), tuple(form(self._formula, terms) for terms in of))}
        else:
            for name, expected in _OTHERS[kind][0].items():
                if inputs[name][0] != expected:
                    raise FileError(None, f"{where}: input {name} is a {inputs[name][0]}; it must be "
                                          f"a {expected}")
            values = self._other(kind, function.nodes[identifier],
                                 {name: value[1] for name, value in inputs.items()}, where)
            made = {name: (expected, value) for (name, expected), value
                    in zip(_OTHERS[kind][1].items(), values)}
        if len(made) == 1:  # its name is of no account: files have several
            value = next(iter(made.values()))
            declared = {port.attributes.get("identifier") for child
                        in function.nodes[identifier].all("out") for port in child.children}
            made.update((name, value) for name in outputs if name in declared)
        return made

    def _other(self, kind: str, element: Element, given: Dict[str, Terms],
               where: str) -> List[Terms]:
        """The outputs of a node that is not componentwise."""
        f = self._formula
        if kind == "constant":
            return [(f.number(number_of(element.text("value", where), f"{where}: value")),)]
        if kind == "constvec":
            return [tuple(f.number(number_of(element.text(axis, where), f"{where}: {axis}"))
                          for axis in "xyz")]
        if kind == "constmat":
            numbers = numbers_of(element.text("matrix", where), 16, f"{where}: matrix")
            return [tuple(map(f.number, numbers))]
        if kind == "constresourceid":
            own = element.attributes
            return [(identifier_of(own.get("value", own.get("resourceid")), f"{where}: value"),)]
        if kind == "composevector":
            return [(given["x"][0], given["y"][0], given["z"][0])]
        if kind == "vectorfromscalar":
            return [given["A"] * 3]
        if kind == "decomposevector":
            return [(term,) for term in given["A"]]
        if kind == "composematrix":
            return [tuple(given[name][0] for name in _MATRIX_NAMES)]
        if kind in ("matrixfromcolumns", "matrixfromrows"):
            last = [f.number(0.0)] * 3 + [f.number(1.0)]
            rows = tuple(term for name, end in zip("ABCD", last) for term in (*given[name], end))
            return [rows if kind == "matrixfromrows" else _transposed(rows)]
        if kind == "transpose":
            return [_transposed(given["A"])]
        if kind == "inverse":
            return [self._inverse(given["A"], where)]
        a = given["A"]
        if kind == "length":
            return [(f.call("sqrt", self._dot(a, a)),)]
        b = given["B"]
        if kind == "dot":
            return [(self._dot(a, b),)]
        if kind == "cross":
            return [tuple(f.subtract(f.multiply(a[i], b[j]), f.multiply(a[j], b[i]))
                          for i, j in ((1, 2), (2, 0), (0, 1)))]
        # The row (x, y, z, 1) times the matrix, as 3MF transforms points.
        return [tuple(f.add(self._dot(b, (a[column], a[4 + column], a[8 + column])),
                            a[12 + column]) for column in range(3))]

    def _dot(self, a: Terms, b: Terms) -> int:
        f = self._formula
        products = [f.multiply(one, other) for one, other in zip(a, b)]
        return f.add(f.add(products[0], products[1]), products[2])

    def _inverse(self, terms: Terms, where: str) -> Terms:
        values = np.array([self._formula.value(term) for term in terms]).reshape(4, 4)
        if np.isnan(values).any():
            raise UnsupportedError(f"{where} inverts a matrix that is not constant, which is not "
                                   "read")
        try:
            with np.errstate(all="ignore"):
                inverse = np.linalg.inv(values)
        except np.linalg.LinAlgError:
            inverse = np.full((4, 4), math.nan)
        if not np.isfinite(inverse).all():
            raise FileError(None, f"{where} inverts a matrix that has no inverse")
        return tuple(self._formula.number(float(value)) for value in inverse.flat)


def _transposed(terms: Terms) -> Terms:
    return tuple(terms[4 * row + column] for column in range(4) for row in range(4))


@dataclasses.dataclass(frozen=True, eq=False)
class ImplicitPart:
    """An object of a 3MF file where the build places it: its coarse shape, and of a levelset the
    structure that cuts it. All in millimetres and in the coordinates of the build."""

    shape: Shape  #: the levelset's mesh or, of meshbboxonly, the box of it; other objects: the mesh
    structure: Optional[Structure]  #: where the levelset's function is at most 0; None: a plain mesh
    object_id: int  #: of the file
    name: str  #: of the object, "" if it has none
    min: _Vector  #: of the shape, as max
    max: _Vector
    transform: np.ndarray  #: 4 x 3: (x, y, z, 1) of the object times this is the place in the build
    function_id: int = 0  #: of a levelset, as all below; 0 of a plain mesh
    function_name: str = ""
    channel: str = ""  #: the function's output
    function_transform: Optional[np.ndarray] = None  #: 4 x 3: from the build to the function
    box_only: bool = False  #: meshbboxonly
    min_feature_size: float = 0.0  #: in the object's coordinates, times the file's unit
    fallback: float = 0.0  #: the value where the function has none
    volume_id: Optional[int] = None  #: volume data, which are passed over
    expression: str = ""  #: of the function, in angles over one cell, as Functional takes it
    parameters: Mapping[str, float] = dataclasses.field(default_factory=dict)
    cell_size: _Vector = (0.0, 0.0, 0.0)
    origin: _Vector = (0.0, 0.0, 0.0)

    def model(self) -> Model:
        """The part, solid where its shape and its structure are."""
        return Model(self.shape, () if self.structure is None else self.structure)


def read_3mf_implicit(source: Union[str, "os.PathLike[str]", bytes], *, max_bytes: int = 0,
                      context: Optional[Context] = None) -> List[ImplicitPart]:
    """Reads the levelsets of a 3MF file, or of the bytes of one, and its meshes: one part for each
    object that the build places.

    Functions of the Implicit extension become expressions. What is read and what is refused:
    docs/howto/implicit_3mf.md. max_bytes limits the file, and the XML in it; 0: 256 MiB. Errors:
    FileError for malformed files, UnsupportedError for what is not read, with the function and the
    node, LimitError for expressions beyond the limits of msq_structure_functional.
    """
    context = context_of(context)
    package = Package(source, unsigned(max_bytes, 64, "max_bytes") or 1 << 28)
    try:
        parts = []
        for one, transform in package.placed():
            if one.type in ("model", "solidsupport"):
                parts.append(_part(package, one, transform, context))
        return parts
    except FileError as error:
        if isinstance(source, (bytes, bytearray, memoryview)):
            raise
        raise with_path(error, source) from None


def _part(package: Package, one: Object, transform: np.ndarray, context: Context) -> ImplicitPart:
    level_set = one.level_set
    domain = one if level_set is None else package.objects.get(level_set.mesh)
    if domain is None or domain.mesh is None:
        assert level_set is not None
        raise FileError(None, f"{one.what}: meshid {level_set.mesh} is no object with a mesh")
    if domain.has_beams:
        raise UnsupportedError(f"{domain.what} has a beam lattice, which is not read here; "
                               "msq.BeamFile reads files of them")
    vertices, triangles = domain.mesh.arrays(domain.what)
    if level_set is not None and level_set.box_only:
        vertices, triangles = _box(vertices)
    placed = transform * package.millimetres
    with np.errstate(all="ignore"):
        corners = vertices @ placed[:3] + placed[3]
        volume = float(np.linalg.det(transform[:3]))
    if not np.isfinite(corners).all():
        raise FileError(None, f"{one.what}: the coordinates overflow")
    if volume == 0 or not math.isfinite(volume):
        raise FileError(None, f"{one.what}: a transform has the determinant {volume}; it must be "
                              "finite and not 0")
    low, high = _triple(corners.min(axis=0)), _triple(corners.max(axis=0))
    is_box = level_set is not None and level_set.box_only
    if is_box and not (corners.min(axis=0) < corners.max(axis=0)).all():
        raise FileError(None, f"{one.what}: the bounding box of its mesh, {low} to {high}, is flat")
    if is_box and (np.count_nonzero(transform[:3], axis=0) == 1).all():
        shape = Shape.box(low, high, context=context)
    else:
        if volume < 0:
            triangles = triangles[:, ::-1]
        shape = Shape.from_mesh(corners, np.ascontiguousarray(triangles), context=context)
    if level_set is None:
        return ImplicitPart(shape, None, one.number, one.name, low, high, placed)
    required = package.required_properties.get(level_set.volume or 0, [])
    if required:
        warnings.warn(f"{one.what}: msq passes over the property '{required[0][:60]}', which the file "
                      "marks as required", stacklevel=3)
    return _level_set(package, one, level_set, shape, low, high, placed, context)


def _level_set(package: Package, one: Object, level_set: LevelSet, shape: Shape, low: _Vector,
               high: _Vector, placed: np.ndarray, context: Context) -> ImplicitPart:
    # A cell of the structure holds the box and a margin: the function does not repeat within it.
    margin = max(b - a for a, b in zip(low, high)) / 16 or 1.0
    origin = _triple([a - margin for a in low])
    cell = _triple([b - a + 2 * margin for a, b in zip(low, high)])
    with np.errstate(all="ignore"):
        try:
            inverse = np.linalg.inv(placed[:3])
            to_object = np.vstack([inverse, -placed[3] @ inverse])
        except np.linalg.LinAlgError:
            to_object = np.full((4, 3), math.nan)
        to_function = joined(to_object, level_set.transform)
        scaled = to_function[:3] * (np.array(cell)[:, None] / TURN)
        shift = np.array(origin) @ to_function[:3] + to_function[3]
    if not np.isfinite(scaled).all() or not np.isfinite(shift).all():
        raise FileError(None, f"{one.what}: the transforms to the function overflow")
    formula = Formula()
    position = tuple(formula.affine((float(scaled[0, i]), float(scaled[1, i]), float(scaled[2, i]),
                                     float(shift[i]))) for i in range(3))
    translator = _Translator(package.functions, formula)
    try:
        name = package.functions[level_set.function].attributes.get("displayname", "") \
            if level_set.function in package.functions else ""
        value = translator.call(level_set.function, {"pos": ("vector", position)},
                                [level_set.channel], "the levelset")[level_set.channel]
        if value[0] != "scalar":
            raise FileError(None, f"channel '{level_set.channel[:60]}' of function "
                                  f"{level_set.function} is a {value[0]}; it must be a scalar")
        root = value[1][0]
        expression, parameters = formula.text(root)
        structure: Structure = Functional(expression=expression, parameters=parameters,
                                          cell_size=cell, origin=origin, context=context)
        if not formula.defined[root] and level_set.fallback <= 0:
            # Points without a value are solid: all points but those where the function is above 0.
            above = Functional(expression=f"-({expression})", parameters=parameters, level=-_LEAST,
                               cell_size=cell, origin=origin, context=context)
            everything = Functional(expression="-1", cell_size=cell, origin=origin, context=context)
            structure = everything - above
    except FileError as error:
        raise FileError(None, f"{one.what}: {error}") from None
    except (LimitError, UnsupportedError) as error:
        raise type(error)(f"{one.what}, function {level_set.function}: {error}"
                          if isinstance(error, LimitError) else f"{one.what}: {error}") from None
    return ImplicitPart(
        shape, structure, one.number, one.name, low, high, placed, level_set.function, name,
        level_set.channel, to_function, level_set.box_only,
        level_set.min_feature_size * package.millimetres, level_set.fallback, level_set.volume,
        expression, parameters, cell, origin)


def _triple(values: Sequence[float]) -> _Vector:
    return float(values[0]), float(values[1]), float(values[2])


def _box(vertices: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The box of points as a mesh of 12 triangles."""
    ends = vertices.min(axis=0), vertices.max(axis=0)
    corners = np.array([[ends[i & 1][0], ends[i >> 1 & 1][1], ends[i >> 2][2]] for i in range(8)])
    triangles = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
                          [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]],
                         np.uint32)
    return corners, triangles
