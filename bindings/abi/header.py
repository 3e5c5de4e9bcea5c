# SPDX-License-Identifier: Apache-2.0
"""Reads msq.h, or msq_io.h, into the description that all bindings are made from.

It reads the C that they are written in, and no other: enums of plain numbers, structs and callbacks
by typedef, functions that begin with MSQ_API or MSQ_IO_API. Whatever it does not understand is an error. Comments
are read by docs/site/reference.py, as for the pages of the reference.
"""
import pathlib
import re
import sys
from dataclasses import dataclass, field
from typing import Dict, List, Optional, Union

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "docs" / "site"))
import reference  # noqa: E402

SCALARS = ("char", "int8_t", "uint8_t", "int16_t", "uint16_t", "int32_t", "uint32_t", "int64_t",
           "uint64_t", "size_t", "float", "double", "msq_status")


class HeaderError(Exception):
    """The header has C that this does not read."""


@dataclass
class Type:
    """`const double*` is double with is_const and pointers 1; `double min[3]` has length 3."""
    name: str
    is_const: bool = False
    pointers: int = 0
    length: int = 0


@dataclass
class Member:
    """A field of a struct, or an argument of a function or callback."""
    name: str
    type: Type
    doc: str = ""
    direction: str = ""  # of arguments: in, out, inout
    nullable: bool = False  # of arguments: a job, query or user, or the comment gives NULL a meaning
    count: str = ""  # of arrays: the name of the member with the number of elements


@dataclass
class Enum:
    name: str
    values: Dict[str, int]
    docs: Dict[str, str]
    doc: str = ""


@dataclass
class Struct:
    name: str
    fields: List[Member]
    doc: str = ""
    # On 64-bit machines, in bytes.
    size: int = 0
    alignment: int = 1
    offsets: List[int] = field(default_factory=list)


@dataclass
class Function:
    """A function of the library or a type of callbacks."""
    name: str
    result: Type
    arguments: List[Member]
    doc: str = ""
    errors: List[str] = field(default_factory=list)


@dataclass
class Header:
    versions: Dict[str, int] = field(default_factory=dict)  # MSQ_VERSION and its parts
    enums: List[Enum] = field(default_factory=list)
    handles: Dict[str, str] = field(default_factory=dict)  # opaque types and their comments
    types: List[Union[Struct, Function]] = field(default_factory=list)  # structs, callbacks, in order
    functions: List[Function] = field(default_factory=list)
    base: Optional["Header"] = None  # of which this one uses types

    @property
    def structs(self) -> List[Struct]:
        return [one for one in self.types if isinstance(one, Struct)]

    @property
    def callbacks(self) -> List[Function]:
        return [one for one in self.types if isinstance(one, Function)]

    def has_type(self, name: str) -> bool:
        own = name in self.handles or any(one.name == name for one in self.types)
        return own or (self.base is not None and self.base.has_type(name))

    def is_handle(self, name: str) -> bool:
        return name in self.handles or (self.base is not None and self.base.is_handle(name))

    def struct(self, name: str) -> Optional[Struct]:
        own = next((one for one in self.structs if one.name == name), None)
        return own or (self.base.struct(name) if self.base else None)


def constants_of(header: Header) -> Dict[str, int]:
    found = dict(header.versions)
    for enum in header.enums:
        found.update(enum.values)
    return found


def _type(c: str, header: Header, length: int = 0) -> Type:
    words = [word for word in c.replace("*", " ").split() if word not in ("const", "struct")]
    pointers = c.count("*")
    if len(words) != 1:
        raise HeaderError(f"type {c!r}")
    name = words[0]
    if name != "void" and name not in SCALARS and not header.has_type(name):
        raise HeaderError(f"unknown type {name}")
    if header.is_handle(name) and not pointers:
        raise HeaderError(f"{name} by value")
    return Type(name, bool(re.match(r"\s*const\b", c)), pointers, length)


def _declarators(text: str, header: Header) -> List[Member]:
    """The names in `const double *a, *b` or `double min[3], max[3]`."""
    first, *others = [part.strip() for part in text.split(",")]
    match = re.fullmatch(r"(.*?[\s*])(\w+)\s*(?:\[(\d+)\])?", first, flags=re.S)
    if match is None:
        raise HeaderError(f"declaration {text!r}")
    base = match.group(1)
    found = [Member(match.group(2), _type(base, header, int(match.group(3) or 0)))]
    for other in others:
        match = re.fullmatch(r"(\**)\s*(\w+)\s*(?:\[(\d+)\])?", other)
        if match is None:
            raise HeaderError(f"declaration {text!r}")
        kind = _type(base.replace("*", "") + match.group(1), header, int(match.group(3) or 0))
        found.append(Member(match.group(2), kind))
    return found


def _singular(name: str) -> str:
    for plural, one in (("vertices", "vertex"), ("radii", "radius"), ("distances", "distance"),
                        ("ies", "y"), ("s", "")):
        if name.endswith(plural):
            return name[:-len(plural)] + one
    return name


def _set_counts(members: List[Member]) -> None:
    """Names the counts of arrays: vertices and vertex_count, points and count."""
    names = {one.name for one in members}
    for index, one in enumerate(members):
        if not one.type.pointers or one.type.name in ("char",) and one.type.pointers == 1:
            continue
        following = members[index + 1].name if index + 1 < len(members) else ""
        for count in (f"{_singular(one.name)}_count", f"{one.name}_count"):
            if count in names:
                one.count = count
        if not one.count and following in ("count", "size", "bytes"):
            one.count = following


def _arguments(text: str, header: Header, owner: str) -> List[Member]:
    if text.strip() == "void":
        return []
    found = []
    for argument in text.split(","):
        argument = " ".join(argument.split())
        array = re.fullmatch(r"(.*\w)\s*\[(\d*)\]", argument)
        if array:  # an array argument is a pointer
            argument = re.sub(r"(\w+)$", r"*\1", array.group(1))
        (one,) = _declarators(argument, header)
        if array:
            one.type.length = int(array.group(2) or 0)
        found.append(one)
    _set_counts(found)
    for one in found:
        kind = one.type
        one.direction = "in"
        if kind.pointers and not kind.is_const and kind.name not in ("void",):
            struct = header.struct(kind.name)
            if header.is_handle(kind.name):
                one.direction = "in" if kind.pointers == 1 else "out"
            elif struct and struct.fields[0].name == "struct_size" and not owner.endswith("_init"):
                one.direction = "inout"
            else:
                one.direction = "out"
    return found


def _enum(name: str, body: str) -> Enum:
    values, value = {}, -1
    for entry in filter(None, (part.strip() for part in body.split(","))):
        label, _, number = (part.strip() for part in entry.partition("="))
        if not re.fullmatch(r"MSQ_\w+", label) or (number and not re.fullmatch(r"-?\d+", number)):
            raise HeaderError(f"enumerator {entry!r}")
        value = int(number) if number else value + 1
        values[label] = value
    return Enum(name, values, dict.fromkeys(values, ""))


SIZES = {"char": 1, "int8_t": 1, "uint8_t": 1, "int16_t": 2, "uint16_t": 2, "int32_t": 4,
         "uint32_t": 4, "int64_t": 8, "uint64_t": 8, "size_t": 8, "float": 4, "double": 8,
         "msq_status": 4}


def _set_layout(struct: Struct, header: Header) -> None:
    """The layout of C on 64-bit machines: each field at a multiple of its alignment."""
    at = 0
    for one in struct.fields:
        inner = header.struct(one.type.name)
        if one.type.pointers or one.type.name not in SIZES and not inner:  # also callbacks
            size = alignment = 8
        elif inner:
            size, alignment = inner.size, inner.alignment
        else:
            size = alignment = SIZES[one.type.name]
        at = -(-at // alignment) * alignment
        struct.offsets.append(at)
        struct.alignment = max(struct.alignment, alignment)
        at += size * max(one.type.length, 1)
    struct.size = -(-at // struct.alignment) * struct.alignment


def _struct(name: str, body: str, header: Header) -> Struct:
    fields = []
    for declaration in filter(None, (part.strip() for part in body.split(";"))):
        fields += _declarators(declaration, header)
    _set_counts(fields)
    struct = Struct(name, fields)
    _set_layout(struct, header)
    return struct


def _plain(comment: str) -> str:
    """A comment with a line per paragraph."""
    return "\n\n".join(" ".join(part.split()) for part in re.split(r"\n\s*\n", comment) if part)


def _read_comments(header: Header, path: pathlib.Path) -> None:
    """Sets comments, and what they say of errors and of NULL."""
    found = reference.read([path])

    def comment_of(name: str) -> str:
        return _plain(found.symbols[name].comment)

    for name in header.handles:
        header.handles[name] = comment_of(name)
    for one in [*header.enums, *header.types, *header.functions]:
        one.doc = comment_of(one.name)
        comments = {name: _plain(member.comment) for member in found.symbols[one.name].members
                    for name in member.names}
        if isinstance(one, Enum):
            one.docs.update(comments)
        elif isinstance(one, Struct):
            for member in one.fields:
                member.doc = comments[member.name]
        else:
            for argument in one.arguments:
                argument.nullable = _is_nullable(argument, one, header)
    for function in header.functions:
        symbol = found.symbols[function.name]
        listed = reference.errors(reference.parts(symbol.comment).get("Errors", ""))
        other = reference.inherited(symbol, found)
        if not listed and other:
            listed = reference.errors(reference.parts(other.comment).get("Errors", ""))
        function.errors = [f"MSQ_E_{status}" for status in dict.fromkeys(one for one, _ in listed)]


def _is_nullable(argument: Member, function: Function, header: Header) -> bool:
    kind = argument.type
    if not kind.pointers and not _is_callback(argument, header):
        return False
    if kind.name in ("msq_job", "msq_query_def"):
        return not function.name.startswith(("msq_job_", "msq_query_"))
    if argument.name == "user":  # a rule of the header; a callback of msq_io is a plain function
        return function in header.callbacks or any(_is_callback(one, header)
                                                   for one in function.arguments)
    return bool(re.search(rf"\b{argument.name}(?: and \w+)?(?: (?:may|must) be)? NULL\b",
                          function.doc))


def _is_callback(argument: Member, header: Header) -> bool:
    return any(call.name == argument.type.name for call in header.callbacks)


STATEMENT = re.compile(r"""\s*(?:
    enum\s+(?P<enum>\w+)\s*\{(?P<values>[^}]*)\}\s*
  | typedef\s+struct\s+(?P<struct>\w+)\s*\{(?P<body>[^}]*)\}\s*(?P=struct)\s*
  | typedef\s+struct\s+(?P<opaque>\w+)\s+(?P=opaque)\s*
  | typedef\s+(?P<result>[\w\s*]+?)\(\s*\*\s*(?P<callback>\w+)\s*\)
             \s*\((?P<arguments>[^)]*)\)\s*
  | typedef\s+int32_t\s+msq_status\s*
  | MSQ_(?:IO_)?API\s+(?P<returned>[\w\s*]+?[\s*])(?P<function>\w+)\s*\((?P<parameters>[^)]*)\)\s*
);""", re.X)


def read_header(path: pathlib.Path, base: Optional[Header] = None) -> Header:
    header = Header(base=base)
    text = re.sub(r"/\*.*?\*/", " ", path.read_text(encoding="utf-8"), flags=re.S)
    for name, number in re.findall(r"^#define (MSQ_VERSION\w*) (\d+)\s*$", text, flags=re.M):
        header.versions[name] = int(number)
    text = re.sub(r"^[ \t]*#(?:.*\\\n)*.*$", "", text, flags=re.M)
    text = text.replace('extern "C" {', "").strip()
    if text.endswith("}"):  # of extern "C"
        text = text[:-1]
    at = 0
    while text[at:].strip():
        match = STATEMENT.match(text, at)
        if match is None:
            raise HeaderError(f"statement {' '.join(text[at:at + 120].split())!r}")
        at = match.end()
        found = match.groupdict()
        if found["enum"]:
            header.enums.append(_enum(found["enum"], found["values"]))
        elif found["struct"]:
            header.types.append(_struct(found["struct"], found["body"], header))
        elif found["opaque"]:
            header.handles[found["opaque"]] = ""
        elif found["callback"]:
            header.types.append(Function(
                found["callback"], _type(found["result"], header),
                _arguments(found["arguments"], header, found["callback"])))
        elif found["function"]:
            header.functions.append(Function(
                found["function"], _type(found["returned"], header),
                _arguments(found["parameters"], header, found["function"])))
    if not header.functions:
        raise HeaderError("no functions")
    _read_comments(header, path)
    return header
