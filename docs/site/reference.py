#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the declarations of msq.h and msq_io.h with their comments.

Reads the C that they are written in, as bindings/abi/header.py does, and keeps what that drops: comments
and sections. An error names the declaration that it does not understand.
"""
import pathlib
import re
from dataclasses import dataclass, field
from typing import Dict, List, Optional, Sequence, Tuple

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEADER = ROOT / "include" / "msq.h"
HEADERS = (HEADER, ROOT / "include" / "msq_io.h")

STATUSES = ("ARGUMENT", "MEMORY", "CANCELLED", "HOST", "IO", "UNSUPPORTED", "MESH", "LIMIT", "INTERNAL")
LABELS = ("Errors", "Cost", "Additional cost", "Memory", "Limits", "Limit", "Source", "Threads", "Since")


@dataclass
class Member:
    """A field of a struct, an enumerator, or an argument."""
    names: List[str]
    declaration: str
    comment: str
    value: Optional[int] = None


@dataclass
class Symbol:
    kind: str  # function, struct, enum, callback, handle, type, macro
    name: str
    section: str
    comment: str
    declaration: str
    returns: str = ""
    members: List[Member] = field(default_factory=list)
    header: str = ""  # the name of its file


@dataclass
class Reference:
    symbols: Dict[str, Symbol] = field(default_factory=dict)
    sections: Dict[str, Dict[str, str]] = field(default_factory=dict)  # header: title: the comment under it
    prefaces: Dict[str, str] = field(default_factory=dict)  # header: the comment of the file


class ReferenceError_(Exception):
    """The header has C that this does not read."""


def text_of(comment: str) -> str:
    """A comment without its frame. Paragraphs are separated by empty lines."""
    body = re.sub(r"^/\*\*?|\*/$", "", comment.strip())
    lines = [re.sub(r"^\s*\* ?", "", line) if index else line.strip()
             for index, line in enumerate(body.split("\n"))]
    return "\n".join(line.rstrip() for line in lines).strip()


def split_outside(text: str, separator: str) -> List[str]:
    """The parts of text between separators that no parenthesis encloses."""
    parts, depth, part = [], 0, ""
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        if character == separator and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += character
    return parts + [part]


def without_comments(text: str) -> str:
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


def flat(text: str) -> str:
    return " ".join(without_comments(text).split())


def names_of(declaration: str) -> List[str]:
    """a, b of `const double *a, b[3]`."""
    names = []
    for part in split_outside(declaration, ","):
        match = re.search(r"(\w+)\s*(?:\[\d*\]\s*)*$", part.strip())
        if match is None:
            raise ReferenceError_(f"declaration {declaration!r}")
        names.append(match.group(1))
    return names


def commented(body: str, end: str) -> List[Tuple[str, str]]:
    """(comment, declaration) of each member of a body; members end with the character end."""
    found, comment, at = [], "", 0
    while at < len(body):
        if body[at].isspace():
            at += 1
        elif body.startswith("/*", at):
            stop = body.index("*/", at) + 2
            comment = text_of(body[at:stop])
            at = stop
        else:
            stop = body.find(end, at)
            stop = len(body) if stop < 0 else stop
            found.append((comment, flat(body[at:stop])))
            comment, at = "", stop + 1
    return found


def read_arguments(text: str) -> List[Member]:
    if text.strip() == "void":
        return []
    return [Member(names_of(part), flat(part), "") for part in split_outside(text, ",")]


def read_statement(statement: str, comment: str, section: str) -> Optional[Symbol]:
    declaration = statement.strip() + ";"
    plain = flat(statement)
    match = re.match(r"(?:typedef\s+)?enum\s+(\w*)", plain)
    if match:
        body = statement[statement.index("{") + 1:statement.rindex("}")]
        name = match.group(1) or statement[statement.rindex("}") + 1:].strip()
        symbol = Symbol("enum", name, section, comment, declaration)
        value = -1
        for note, entry in commented(body, ","):
            label, _, number = (part.strip() for part in entry.partition("="))
            value = int(number, 0) if number else value + 1
            symbol.members.append(Member([label], entry, note, value))
        return symbol
    match = re.match(r"typedef\s+struct\s+(\w+)\s*\{", plain)
    if match:
        body = statement[statement.index("{") + 1:statement.rindex("}")]
        members = [Member(names_of(entry), entry, note) for note, entry in commented(body, ";")]
        return Symbol("struct", match.group(1), section, comment, declaration, members=members)
    match = re.fullmatch(r"typedef\s+struct\s+(\w+)\s+\1", plain)
    if match:
        return Symbol("handle", match.group(1), section, comment, declaration)
    match = re.fullmatch(r"typedef\s+(.+?)\(\s*\*\s*(\w+)\s*\)\s*\((.*)\)", plain)
    if match:
        return Symbol("callback", match.group(2), section, comment, declaration, match.group(1).strip(),
                      read_arguments(match.group(3)))
    match = re.fullmatch(r"MSQ_(?:IO_)?API\s+(.+?[\s*])(\w+)\s*\((.*)\)", plain)
    if match:
        return Symbol("function", match.group(2), section, comment,
                      re.sub(r"^MSQ_(IO_)?API ", "", declaration), match.group(1).strip(),
                      read_arguments(match.group(3)))
    match = re.fullmatch(r"typedef\s+\w+\s+(\w+)", plain)
    if match:
        return Symbol("type", match.group(1), section, comment, declaration)
    raise ReferenceError_(f"statement {plain[:120]!r}")


def statement_end(text: str, at: int) -> int:
    depth = 0
    while True:
        if text.startswith("/*", at):
            at = text.index("*/", at) + 2
            continue
        depth += (text[at] in "({") - (text[at] in ")}")
        if text[at] == ";" and depth == 0:
            return at
        at += 1


def read(paths: Sequence[pathlib.Path] = HEADERS) -> Reference:
    reference = Reference()
    for path in paths:
        read_header(path, reference)
    return reference


def read_header(path: pathlib.Path, reference: Reference) -> None:
    text = path.read_text(encoding="utf-8")
    sections = reference.sections.setdefault(path.name, {})
    section, comment, at = "", "", 0
    while at < len(text):
        if text[at].isspace():
            at += 1
        elif text.startswith("/*", at):
            stop = text.index("*/", at) + 2
            block, at = text[at:stop], stop
            title = re.match(r"/\* -+ (.*?) -+ \*/", block)
            if title:
                section, comment = title.group(1), ""
                sections[section] = ""
            elif block.startswith("/** @file"):
                reference.prefaces[path.name] = text_of(block.replace("@file\n", "", 1))
            elif block.startswith("/**"):
                comment = text_of(block)
            elif section:
                sections[section] += "\n\n" + text_of(block)
        elif text[at] == "#":
            stop = text.index("\n", at)
            while text[stop - 1] == "\\":
                stop = text.index("\n", stop + 1)
            macro = re.match(r"#define (MSQ_\w+) (\d+)$", text[at:stop])
            if macro:
                reference.symbols[macro.group(1)] = Symbol(
                    "macro", macro.group(1), section, comment, text[at:stop], header=path.name)
            comment, at = "", stop
        elif text.startswith('extern "C" {', at) or text[at] == "}":
            at += 12 if text[at] == "e" else 1
        else:
            stop = statement_end(text, at)
            symbol = read_statement(text[at:stop], comment, section)
            if symbol.name in reference.symbols:
                raise ReferenceError_(f"{symbol.name} is declared twice")
            symbol.header = path.name
            reference.symbols[symbol.name] = symbol
            comment, at = "", stop + 1


def parts(comment: str) -> Dict[str, str]:
    """A comment by its labels: "" for the description, Errors, Cost, Source ... for the others.

    A label begins a sentence, and what it labels ends with the next label or the paragraph.
    """
    found: Dict[str, str] = {}
    label_at = re.compile(r"(?:^|(?<=[.)]\s)|(?<=[.)]\n)|(?<=\n))(" + "|".join(LABELS) + r"):\s")
    for paragraph in re.split(r"\n\s*\n", comment):
        pieces = label_at.split(paragraph)
        if pieces[0].strip():
            found[""] = (found.get("", "") + "\n\n" + pieces[0].rstrip()).strip("\n")
        for label, piece in zip(pieces[1::2], pieces[2::2]):
            label = {"Limit": "Limits", "Additional cost": "Cost"}.get(label, label)
            found[label] = (found.get(label, "") + " " + " ".join(piece.split())).strip()
    return found


def sentences(text: str) -> List[str]:
    found, depth, start = [], 0, 0
    for index, character in enumerate(text):
        depth += (character in "([") - (character in ")]")
        if character == "." and depth <= 0 and (index + 1 == len(text) or text[index + 1].isspace()):
            found.append(" ".join(text[start:index + 1].split()))
            start = index + 1
    rest = " ".join(text[start:].split())
    return found + ([rest] if rest else [])


def errors(text: str) -> List[Tuple[str, str]]:
    """(status, when) of the text after `Errors:`; a status may have several entries."""
    found: List[Tuple[str, str]] = []
    for sentence in sentences(text):
        lead = re.match(r"(Calls that use the [\w ]+): (.*)", sentence)
        where = ""
        if lead:
            where, sentence = lead.group(1)[0].lower() + lead.group(1)[1:], lead.group(2)
        for item in split_outside(sentence.rstrip("."), ","):
            for entry in split_outside(item, ";"):
                entry = entry.strip()
                word = re.match(r"(?:MSQ_E_)?([A-Z]+)\b\s*(.*)$", entry, flags=re.S)
                if word and word.group(1) in STATUSES:
                    when = word.group(2).strip()
                    when = when[1:-1] if when.startswith("(") and when.endswith(")") else when
                    found.append((word.group(1), when or where))
                elif found and entry:
                    status, when = found[-1]
                    found[-1] = (status, (when + ", " if when else "") + entry)
    return found


def inherited(symbol: Symbol, reference: Reference) -> Optional[Symbol]:
    """The function whose comment holds for this one too, by `See X.` or `Arguments as in X.`"""
    match = re.search(r"(?:(?:^|\.\s+)See|[Aa]rguments as in|[Ee]rrors(?:: as| as of| as in))\s+(msq_\w+)",
                      symbol.comment)
    other = reference.symbols.get(match.group(1)) if match else None
    return other if other and other.kind == "function" and other is not symbol else None


def since(symbol: Symbol, reference: Reference) -> str:
    """The version that a comment names, or that the comment of the file does for all."""
    match = re.search(r"[Ss]ince(?: version)?:? (\d+\.\d+)", symbol.comment) or \
        re.search(r"exists since version (\d+\.\d+)", reference.prefaces[symbol.header])
    return match.group(1)
