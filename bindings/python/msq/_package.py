# SPDX-License-Identifier: Apache-2.0
"""The XML of 3MF files, with limits on what a hostile file costs."""
from __future__ import annotations

import io
import math
import os
import posixpath
import re
import zipfile
import zlib
from array import array
from typing import Any, Dict, List, Optional, Tuple, Union
from xml.parsers import expat

import numpy as np

from .errors import Error, FileError, LimitError, UnsupportedError, with_path

CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
VOLUMETRIC = "http://schemas.3mf.io/3dmanufacturing/volumetric/2022/01"
IMPLICIT = "http://schemas.3mf.io/3dmanufacturing/implicit/2023/12"
BEAMS = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
PRODUCTION = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"
RELATIONS = "http://schemas.openxmlformats.org/package/2006/relationships"
_MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
# Those that do not change a solid, or whose elements are looked at where they stand.
_KNOWN = {CORE, VOLUMETRIC, IMPLICIT, BEAMS, PRODUCTION,
          "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
          "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"}
_MILLIMETRES = {"micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4,
                "foot": 304.8, "meter": 1000.0}
_NUMBER = re.compile(r"[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][-+]?[0-9]+)?")
_IDENTIFIER = re.compile(r"[0-9]{1,10}")

MOST_ELEMENTS = 500_000  #: besides vertices and triangles
MOST_DEPTH = 64
MOST_ITEMS = 10_000  #: placed objects
MOST_TAG_BYTES = 1 << 20  #: of a tag or comment: the parser looks through one anew with each chunk
_CHUNK = 1 << 16
_IDENTITY = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]])


def number_of(text: str, what: str) -> float:
    """A finite number."""
    value = float(text) if _NUMBER.fullmatch(text.strip()) else math.nan
    if not math.isfinite(value):
        raise FileError(None, f"{what} is '{text[:40]}'; it must be a finite number")
    return value


def numbers_of(text: str, count: int, what: str) -> List[float]:
    """Some finite numbers with spaces between."""
    words = text.split()
    if len(words) != count:
        raise FileError(None, f"{what} has {len(words)} numbers; it must have {count}")
    return [number_of(word, what) for word in words]


def identifier_of(text: Optional[str], what: str) -> int:
    """The number of a resource."""
    if text is None or not _IDENTIFIER.fullmatch(text.strip()):
        raise FileError(None, f"{what} is {'missing' if text is None else repr(text[:40])}; it must "
                              "be the identifier of a resource")
    return int(text)


def _truth(text: str, what: str) -> bool:
    if text.strip() not in ("true", "false", "0", "1"):
        raise FileError(None, f"{what} is '{text[:40]}'; it must be true or false")
    return text.strip() in ("true", "1")


def _transform(text: Optional[str], what: str) -> np.ndarray:
    """A row (x, y, z, 1) times this matrix of 4 x 3 is the place of the point (x, y, z)."""
    return _IDENTITY if text is None else np.array(numbers_of(text, 12, what)).reshape(4, 3)


class Element:
    """An element that the reader keeps: `name` without its namespace, attributes, and children."""

    __slots__ = ("space", "name", "attributes", "children")

    def __init__(self, space: str, name: str, attributes: Dict[str, str]) -> None:
        self.space = space
        self.name = name
        self.attributes = attributes
        self.children: List[Element] = []

    def all(self, name: str) -> List[Element]:
        """The children of a name."""
        return [child for child in self.children if child.name == name]

    def text(self, name: str, what: str) -> str:
        """An attribute that must be there."""
        value = self.attributes.get(name)
        if value is None:
            raise FileError(None, f"{what} has no {name}")
        return value


class _Xml:
    """Builds the elements of a part. Entities do not exist: a document type is refused."""

    def __init__(self) -> None:
        self.root: Optional[Element] = None
        self.spaces: Dict[str, str] = {}  #: namespaces by prefix
        self._open: List[Element] = []
        self._count = 0
        self._mesh: Optional[Mesh] = None
        self.meshes: Dict[int, Mesh] = {}  #: by the id() of their elements
        self._parser = expat.ParserCreate(namespace_separator=" ")
        if hasattr(self._parser, "SetReparseDeferralEnabled"):
            self._parser.SetReparseDeferralEnabled(False)  # else it lags behind what was fed
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.StartNamespaceDeclHandler = self._space
        self._parser.StartDoctypeDeclHandler = self._document_type
        self._size = 0  # bytes fed

    def feed(self, data: bytes, is_last: bool = False) -> None:
        self._size += len(data)
        try:
            self._parser.Parse(data, is_last)
        except (expat.ExpatError, LookupError) as error:  # of the second kind: unknown encodings
            raise FileError(None, f"malformed XML: {error}") from None
        unread = self._size - self._parser.CurrentByteIndex
        if unread > MOST_TAG_BYTES:
            raise LimitError(f"the XML has a tag or comment of {unread} bytes or more; the limit is "
                             f"{MOST_TAG_BYTES}")

    def _document_type(self, *_: Any) -> None:
        raise FileError(None, "the XML declares a document type; 3MF allows none")

    def _space(self, prefix: Optional[str], name: str) -> None:
        if len(self.spaces) < 1000:
            self.spaces.setdefault(prefix or "", name)

    def _start(self, tag: str, attributes: Dict[str, str]) -> None:
        space, _, name = tag.rpartition(" ")
        if space == CORE and self._mesh is not None and name in ("vertex", "triangle"):
            self._mesh.take(name, attributes)
            self._open.append(_SKIPPED)
            return
        self._count += 1
        if self._count > MOST_ELEMENTS:
            raise LimitError(f"the XML has more than {MOST_ELEMENTS} elements besides vertices and "
                             "triangles")
        if len(self._open) >= MOST_DEPTH:
            raise LimitError(f"the XML nests deeper than {MOST_DEPTH} elements")
        element = Element(space, name, attributes)
        if self._open:
            self._open[-1].children.append(element)
        elif self.root is None:
            self.root = element
        self._open.append(element)
        if space == CORE and name == "mesh":
            self._mesh = self.meshes[id(element)] = Mesh()

    def _end(self, tag: str) -> None:
        element = self._open.pop()
        if element is not _SKIPPED and element.space == CORE and element.name == "mesh":
            self._mesh = None


_SKIPPED = Element("", "", {})


class Mesh:
    """A mesh as it is read."""

    def __init__(self) -> None:
        self._vertices = array("d")
        self._triangles = array("q")

    def take(self, name: str, attributes: Dict[str, str]) -> None:
        if name == "vertex":
            for axis in "xyz":
                self._vertices.append(number_of(attributes.get(axis, "missing"), f"{axis} of a vertex"))
            return
        for corner in ("v1", "v2", "v3"):
            self._triangles.append(identifier_of(attributes.get(corner), f"{corner} of a triangle"))

    def arrays(self, what: str) -> Tuple[np.ndarray, np.ndarray]:
        """Vertices (n, 3) and triangles (m, 3)."""
        vertices = np.array(self._vertices, np.float64).reshape(-1, 3)
        triangles = np.array(self._triangles, np.int64).reshape(-1, 3)
        if not len(vertices) or not len(triangles):
            raise FileError(None, f"{what} has a mesh without "
                                  f"{'triangles' if len(vertices) else 'vertices'}")
        if int(triangles.max()) >= len(vertices):
            raise FileError(None, f"{what}: a triangle has vertex {int(triangles.max())} of "
                                  f"{len(vertices)}")
        return vertices, triangles.astype(np.uint32)


class LevelSet:
    """What a <levelset> says, in the file's unit."""

    def __init__(self, element: Element, what: str) -> None:
        given = element.attributes
        self.function = identifier_of(given.get("functionid"), f"{what}: functionid")
        self.mesh = identifier_of(given.get("meshid"), f"{what}: meshid")
        self.channel = element.text("channel", f"{what}: the levelset")
        self.transform = _transform(given.get("transform"), f"{what}: the levelset's transform")
        self.min_feature_size = number_of(given.get("minfeaturesize", "0"),
                                          f"{what}: minfeaturesize")
        if self.min_feature_size < 0:
            raise FileError(None, f"{what}: minfeaturesize is {self.min_feature_size:g}; it must be at "
                                  "least 0")
        self.box_only = _truth(given.get("meshbboxonly", "false"), f"{what}: meshbboxonly")
        self.fallback = number_of(given.get("fallbackvalue", "0"), f"{what}: fallbackvalue")
        volume = given.get("volumeid")
        self.volume = None if volume is None else identifier_of(volume, f"{what}: volumeid")


class Object:
    """An object: a mesh, a levelset, or components."""

    def __init__(self, element: Element, xml: _Xml) -> None:
        given = element.attributes
        self.number = identifier_of(given.get("id"), "the id of an object")
        self.what = f"object {self.number}"
        self.name = given.get("name", "")
        self.type = given.get("type", "model")
        self.mesh: Optional[Mesh] = None
        self.level_set: Optional[LevelSet] = None
        self.components: List[Tuple[int, np.ndarray]] = []
        self.has_beams = False
        for child in element.children:
            if child.space == CORE and child.name == "mesh":
                self.mesh = xml.meshes[id(child)]
                self.has_beams = any(one.name == "beamlattice" for one in child.children)
            elif child.space == VOLUMETRIC and child.name == "levelset":
                self.level_set = LevelSet(child, self.what)
            elif child.space == CORE and child.name == "components":
                for one in child.all("component"):
                    refuse_path(one, self.what)
                    self.components.append((
                        identifier_of(one.attributes.get("objectid"), f"{self.what}: a component"),
                        _transform(one.attributes.get("transform"),
                                   f"{self.what}: a component's transform")))
        if sum((self.mesh is not None, self.level_set is not None, bool(self.components))) != 1:
            raise FileError(None, f"{self.what} must have a mesh, a levelset or components, and one "
                                  "of them")


def refuse_path(element: Element, what: str) -> None:
    """Objects of other parts of the package are not read."""
    for name in element.attributes:
        space, _, local = name.rpartition(" ")
        if space == PRODUCTION and local == "path":
            raise UnsupportedError(f"{what}: an object in a model part of its own (the production "
                                   "extension's path) is not read")


class Package:
    """The model of a 3MF file."""

    def __init__(self, source: Union[str, "os.PathLike[str]", bytes], max_bytes: int) -> None:
        if isinstance(source, (bytes, bytearray, memoryview)):
            self._read(io.BytesIO(source), len(source), max_bytes)
            return
        try:
            with open(source, "rb") as file:
                self._read(file, os.fstat(file.fileno()).st_size, max_bytes)
        except Error as error:
            raise with_path(error, source) if isinstance(error, FileError) else error from None
        except OSError as error:
            raise with_path(FileError(None, f"cannot read the file: {error.strerror}"),
                            source) from None

    def _read(self, file: Any, size: int, max_bytes: int) -> None:
        if size > max_bytes:
            raise LimitError(f"the file has {size} bytes; the limit is {max_bytes}")
        try:
            with zipfile.ZipFile(file) as package:
                xml = self._part(package, self._model_name(package, max_bytes), max_bytes)
        except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError,
                UnicodeDecodeError, ValueError) as error:
            if isinstance(error, Error):
                raise
            raise FileError(None, f"malformed ZIP archive: {error}") from None
        except RuntimeError as error:  # an encrypted entry
            if isinstance(error, Error):
                raise
            raise UnsupportedError(f"the ZIP archive is not readable: {error}") from None
        self._take(xml)

    @staticmethod
    def _model_name(package: zipfile.ZipFile, max_bytes: int) -> str:
        names = {name.lower(): name for name in package.namelist()}
        if "_rels/.rels" in names:
            root = Package._part(package, names["_rels/.rels"], min(max_bytes, 1 << 20)).root
            for relation in root.children if root else []:
                if relation.space == RELATIONS and relation.attributes.get("Type") == _MODEL_TYPE:
                    target = posixpath.normpath(relation.attributes.get("Target", "")).lstrip("/")
                    if target.lower() in names:
                        return names[target.lower()]
        if "3d/3dmodel.model" in names:
            return names["3d/3dmodel.model"]
        raise FileError(None, "the archive has no 3MF model")

    @staticmethod
    def _part(package: zipfile.ZipFile, name: str, max_bytes: int) -> _Xml:
        xml = _Xml()
        size = 0
        with package.open(name) as stream:
            for data in iter(lambda: stream.read(_CHUNK), b""):
                size += len(data)
                if size > max_bytes:
                    raise LimitError(f"'{name[:40]}' is larger than {max_bytes} bytes")
                xml.feed(data)
        xml.feed(b"", True)
        return xml

    def _take(self, xml: _Xml) -> None:
        root = xml.root
        if root is None or root.space != CORE or root.name != "model":
            raise FileError(None, "the XML is not a 3MF model")
        for prefix in root.attributes.get("requiredextensions", "").split():
            space = xml.spaces.get(prefix, prefix)
            if space not in _KNOWN:
                raise UnsupportedError(f"the file needs the extension '{space[:100]}', which is not "
                                       "read")
        unit = root.attributes.get("unit", "millimeter")
        if unit not in _MILLIMETRES:
            raise FileError(None, f"the unit is '{unit[:40]}'; it must be one of "
                                  f"{', '.join(_MILLIMETRES)}")
        self.millimetres = _MILLIMETRES[unit]
        self.objects: Dict[int, Object] = {}
        self.functions: Dict[int, Element] = {}
        self.items: List[Tuple[int, np.ndarray]] = []
        self.required_properties: Dict[int, List[str]] = {}  #: by the identifier of volume data
        for child in root.children:
            if child.space == CORE and child.name == "resources":
                for resource in child.children:
                    self._resource(resource, xml)
            elif child.space == CORE and child.name == "build":
                for item in child.all("item"):
                    refuse_path(item, "the build")
                    self.items.append((
                        identifier_of(item.attributes.get("objectid"), "objectid of an item"),
                        _transform(item.attributes.get("transform"), "the transform of an item")))

    def _resource(self, element: Element, xml: _Xml) -> None:
        if element.space == CORE and element.name == "object":
            made = Object(element, xml)
            if made.number in self.objects:
                raise FileError(None, f"two objects have the id {made.number}")
            self.objects[made.number] = made
        elif element.name in ("implicitfunction", "function", "functionfromimage3d",
                              "privateextensionfunction"):
            number = identifier_of(element.attributes.get("id"), "the id of a function")
            if number in self.functions:
                raise FileError(None, f"two functions have the id {number}")
            self.functions[number] = element
        elif element.space == VOLUMETRIC and element.name == "volumedata":
            number = identifier_of(element.attributes.get("id"), "the id of volume data")
            self.required_properties[number] = [
                one.attributes.get("name", "") for one in element.all("property")
                if _truth(one.attributes.get("required", "false"), "required of a property")]

    def placed(self) -> List[Tuple[Object, np.ndarray]]:
        """The objects of the build that are no components, with their transforms to the build."""
        made: List[Tuple[Object, np.ndarray]] = []
        for number, transform in self.items:
            self._place(number, transform, [], made)
        return made

    def _place(self, number: int, transform: np.ndarray, path: List[int],
               made: List[Tuple[Object, np.ndarray]]) -> None:
        if number not in self.objects:
            raise FileError(None, f"there is no object {number}")
        if number in path:
            raise FileError(None, f"object {number} is a component of itself")
        if len(path) >= MOST_DEPTH:
            raise LimitError(f"components nest deeper than {MOST_DEPTH}")
        one = self.objects[number]
        if not one.components:
            made.append((one, transform))
            if len(made) > MOST_ITEMS:
                raise LimitError(f"the build places more than {MOST_ITEMS} objects")
        for inner, own in one.components:
            self._place(inner, joined(own, transform), [*path, number], made)


def joined(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """The transform that does one and then another."""
    made = first @ second[:3]
    made[3] += second[3]
    return made
