#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the sources of the documentation site: a page per symbol of msq.h and msq_io.h, and the documents.

    python3 docs/site/make_pages.py FOLDER

Sphinx makes HTML of them (scripts/docs). Links between the documents stay; names of symbols become
links to their pages; links to files of the repository lead to pages that show the file.
"""
import os
import pathlib
import re
import shutil
import sys
from typing import Dict, List

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import reference as header  # noqa: E402
import uses  # noqa: E402
from reference import ROOT, Reference, Symbol  # noqa: E402

KINDS = {"function": "Functions", "callback": "Callbacks", "struct": "Structs", "enum": "Enums",
         "handle": "Handles", "type": "Types", "macro": "Macros"}
# The documents outside of docs/, and their names in the site.
OTHERS = {"CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md",
          "SECURITY.md": "security.md", "README.md": "readme.md",
          "tests/coverage/README.md": "coverage.md",
          "bindings/README.md": "bindings.md",
          "bindings/python/README.md": "python.md",
          **{f"integrations/{host}/README.md": f"{host}.md" for host in ("freecad", "blender", "prusaslicer")}}
API_PAGES = {"msq.h": "api/index.md", "msq_io.h": "api/msq_io.md"}
RULES_PAGES = {"msq.h": "api/rules.md", "msq_io.h": "api/msq_io_rules.md"}
# Debian 12's Pygments does not know the private members of JavaScript.
LANGUAGES = {".c": "c", ".h": "c", ".cpp": "cpp", ".hpp": "cpp", ".py": "python", ".cmake": "cmake",
             ".json": "json", ".rs": "rust", ".js": "text", ".go": "go", ".lua": "lua", ".jl": "julia"}


# When a function fails, if its comment only names the status.
USUALLY = {
    "ARGUMENT": "an argument is NULL, not finite, out of range, or inconsistent with another",
    "MEMORY": "an allocation failed", "CANCELLED": "the job was cancelled",
    "HOST": "a callback returned a code, or a value that its definition excludes",
    "LIMIT": "a limit of docs/limits.md, or the memory limit of the context, would be exceeded",
    "IO": "the file cannot be opened or read, is truncated, or is malformed",
    "UNSUPPORTED": "this build lacks the feature", "MESH": "malformed mesh arrays",
    "INTERNAL": "a defect in msq"}
MAX_LINKS = 8


class Site:
    """The folder that is written, and what its pages may link to."""

    def __init__(self, folder: pathlib.Path, reference: Reference) -> None:
        self.folder = folder
        self.reference = reference
        self.page_of: Dict[str, str] = {}  # symbol or constant: symbol with a page
        for symbol in reference.symbols.values():
            self.page_of[symbol.name] = symbol.name
            if symbol.kind == "enum":
                for member in symbol.members:
                    self.page_of[member.names[0]] = symbol.name
        self.sources: Dict[str, str] = {}  # file of the repository: page
        self.in_documents = uses.by_symbol(uses.documents())
        self.in_examples = uses.by_symbol(uses.examples())

    def write(self, page: str, lines: List[str]) -> None:
        path = self.folder / page
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")

    def document_page(self, path: pathlib.Path) -> str:
        """The page of a document of the repository; "" if it is none."""
        name = path.relative_to(ROOT).as_posix()
        if name in OTHERS:
            return OTHERS[name]
        if name == "docs/site/index.md":
            return "index.md"
        if name.startswith("include/") and path.name in API_PAGES:
            return API_PAGES[path.name]
        return name[len("docs/"):] if name.startswith("docs/") and name.endswith(".md") else ""

    def source_page(self, path: pathlib.Path) -> str:
        """The page that shows a file or a folder of the repository."""
        name = path.relative_to(ROOT).as_posix()
        if name not in self.sources:
            self.sources[name] = "source/" + name.replace("/", "-") + ".md"
        return self.sources[name]

    def link_to(self, page: str, path: pathlib.Path) -> str:
        target = self.document_page(path) or self.source_page(path)
        return os.path.relpath(target, os.path.dirname(page) or ".")

    def symbol_link(self, page: str, word: str, code: bool = True) -> str:
        target = os.path.relpath(f"api/{self.page_of[word]}.md", os.path.dirname(page) or ".")
        return f"[`{word}`]({target})"


def capital(text: str) -> str:
    return text if re.match(r"(?:msq_|[a-z]\w*[\[_])", text) else text[:1].upper() + text[1:]


def escape(text: str) -> str:
    return re.sub(r"([\\`*_<>\[\]|#$~])", r"\\\1", text)


def prose(site: Site, page: str, text: str, names=()) -> str:
    """A comment's text in Markdown: symbols and documents become links, names of members code."""
    def word(match: "re.Match[str]") -> str:
        found = match.group(0)
        if found in site.page_of:
            name = site.page_of[found]
            return f"`{found}`" if f"api/{name}.md" == page else site.symbol_link(page, found)
        if found.startswith("docs/") and (ROOT / found).is_file():
            return f"[{found}]({site.link_to(page, ROOT / found)})"
        return f"`{found}`"

    identifiers = "|".join(sorted((re.escape(name) for name in names if "_" in name or len(name) > 3),
                                  key=len, reverse=True))
    pattern = r"docs/[\w/]+\.md|\b(?:msq|MSQ)_\w+\b|\b\w+\[[\w* +]+\]"
    if identifiers:
        pattern += rf"|\b(?:{identifiers})\b(?= NULL| receives?\b|\[|:)|\b(?:" + identifiers + r")\b(?<=_\w)"
    pieces, at = [], 0
    for match in re.finditer(pattern, text):
        pieces += [escape(text[at:match.start()]), word(match)]
        at = match.end()
    return "".join(pieces + [escape(text[at:])])


def paragraphs(site: Site, page: str, text: str, names=()) -> List[str]:
    lines: List[str] = []
    for paragraph in re.split(r"\n\s*\n", text):
        rows = paragraph.strip("\n").split("\n")
        if all(re.match(r"\s{2,}", row) for row in rows if row.strip()):  # a formula
            lines += ["```text", *(row.strip() for row in rows), "```", ""]
            continue
        if all(re.match(r"- ", row) for row in rows[:1]):
            lines += [("- " + prose(site, page, row[2:], names)) if row.startswith("- ")
                      else "  " + prose(site, page, row.strip(), names) for row in rows] + [""]
            continue
        items = re.split(r"\n(?=[A-Z]{4,}: )", paragraph.strip())
        for item in items:
            prefix = "- " if len(items) > 1 else ""
            lines += [prefix + prose(site, page, " ".join(item.split()), names)]
        lines.append("")
    return lines


def table(head: List[str], rows: List[List[str]]) -> List[str]:
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
            *("| " + " | ".join(row) + " |" for row in rows), ""]


def type_text(site: Site, page: str, declaration: str) -> str:
    """The type in a declaration, with links to its symbols."""
    return prose(site, page, declaration) if "msq_" in declaration else f"`{declaration}`"


def argument_note(site: Site, symbol: Symbol, argument: header.Member, texts: List[str]) -> str:
    """What the comment says of an argument; else what holds for all arguments of its type."""
    name = argument.names[0]
    word = re.escape(name)
    about = (rf"(?<!\w){word}(?: NULL|:|\[| receives?\b| must\b| may\b| should\b)|\*{word}\b|"
             rf"\b{word},? (?:and )?(?:\w+ )(?:receive|may)\b|\b(?:\w+)(?:,| and) {word}(?:: | may| receive)")
    if "_" in name:
        about += rf"|\b{word}\b"
    said = [sentence for text in texts for sentence in header.sentences(text)
            if re.search(about, sentence) and len(sentence) < 300]
    said = list(dict.fromkeys(said))[:3]
    if said:
        return " ".join(said)
    kind = argument.declaration
    base = re.sub(r"\bconst\b|\*|\w+(\[\d*\])?$", " ", kind).split()
    target = site.reference.symbols.get(base[0]) if base else None
    if re.search(r"msq_\w+\s*\*\*", kind) and target and target.kind == "handle":
        return "Receives the new handle, with one reference."
    if name == "job":
        return "Progress and cancellation. May be NULL."
    if name == "user":
        return "Passed to the callback as it is."
    if name == "size" and symbol.name.endswith("_init"):
        return "sizeof of the caller's struct."
    if name in ("def", "camera", "frame") and symbol.name.endswith("_init"):
        return "The struct to fill in."
    if target and target.kind == "struct" and name == "report":
        return "Receives the report. Set its struct_size first."
    if target and target.kind == "callback":
        return "The callback. Must not be NULL."
    if target and target.kind == "handle" and symbol.name.endswith(("_retain", "_release")):
        return "May be NULL: nothing happens."
    if target and target.kind == "handle":
        return "Must not be NULL."
    if target and target.kind == "struct" and "const" in kind:
        return f"See {base[0]}."
    if "*" in kind and "const" not in kind:
        return "Receives the result."
    if name.endswith("_count"):
        return "Number of elements of the array."
    near = [sentence for text in texts for sentence in header.sentences(text)
            if re.search(rf"(?<![\w.]){word}\b", sentence) and len(sentence) < 200]
    return near[0] if near else ""


def direction(site: Site, argument: header.Member) -> str:
    declaration = argument.declaration
    target = site.reference.symbols.get(declaration.split("*")[0].strip())
    if target and target.kind == "handle" and declaration.count("*") == 1:
        return "in"
    writes = ("*" in declaration or "[" in declaration) and "const" not in declaration.split("*")[0]
    return "out" if writes and not declaration.startswith("void* user") else "in"


def field_note(symbol: Symbol, member: header.Member) -> str:
    """What the header says of a field; else what holds for all fields of its name."""
    name = member.names[0]
    if member.comment:
        return " ".join(member.comment.split())
    init = symbol.name + "_init"
    if name == "struct_size":
        return "Size of the caller's struct. " + (
            "Set it before the call." if symbol.name.endswith("_report") else f"{init} sets it.")
    if name.startswith("reserved"):
        return "Not used. 0."
    if name == "user":
        return "Passed to the callbacks as it is."
    if name == "release":
        return "Called when the object is freed. May be NULL."
    if name.endswith("_count"):
        return "Number of elements of the array."
    if name.endswith("_stride"):
        return "Bytes from one element to the next. 0: tightly packed."
    return ""


def thread_note(symbol: Symbol, site: Site) -> str:
    callbacks = [a for a in symbol.members if site.reference.symbols.get(
        a.declaration.split()[0], Symbol("", "", "", "", "")).kind == "callback"]
    note = "Any thread may call it."
    if callbacks:
        note += " The callback runs on the calling thread."
    if any(argument.names == ["job"] for argument in symbol.members):
        note += " Another thread may cancel the call or read its progress through the job."
    return note


def use_lines(site: Site, page: str, names: List[str]) -> List[str]:
    """Links to the examples and documents that name the symbol."""
    lines = []
    for title, found in (("Examples", site.in_examples), ("Documents", site.in_documents)):
        paths = sorted({path for name in names for path in found.get(name, [])},
                       key=lambda path: (path.parent.name not in ("howto", "tutorials"), path))
        if paths:
            links = [f"[{path.relative_to(ROOT).as_posix()}]({site.link_to(page, path)})"
                     for path in paths[:MAX_LINKS]]
            rest = f" and {len(paths) - MAX_LINKS} more" if len(paths) > MAX_LINKS else ""
            lines += [f"**{title}:** " + ", ".join(links) + rest, ""]
    return lines


def users_of(site: Site, symbol: Symbol) -> List[str]:
    """Functions and structs whose declarations name the symbol."""
    word = re.compile(rf"\b{symbol.name}\b")
    return [other.name for other in site.reference.symbols.values()
            if other is not symbol and other.kind in ("function", "struct", "callback")
            and word.search(header.without_comments(other.declaration))]


def symbol_page(site: Site, symbol: Symbol) -> None:
    page = f"api/{symbol.name}.md"
    names = [name for member in symbol.members for name in member.names]
    text = header.parts(symbol.comment)
    other = header.inherited(symbol, site.reference)
    lines = [f"# {symbol.name}", "", f"```{{index}} single: {symbol.name}", "```", ""]
    declaration = re.sub(r"\n {4,}", "\n    ", header.without_comments(symbol.declaration)) \
        if symbol.kind in ("function", "callback") else \
        "\n".join(row for row in header.without_comments(symbol.declaration).split("\n") if row.strip())
    lines += ["```c", declaration, "```", "", *paragraphs(site, page, text.get("", ""), names)]
    if symbol.kind in ("function", "callback") and symbol.members:
        texts = [text.get("", "")] + ([header.parts(other.comment).get("", "")] if other else [])
        rows = [[f"`{a.names[0]}`", type_text(site, page, re.sub(r"\b" + a.names[0] + r"\b", "", a.declaration).strip()),
                 direction(site, a), prose(site, page, argument_note(site, symbol, a, texts), names)]
                for a in symbol.members]
        lines += ["## Parameters", "", *table(["name", "type", "use", "note"], rows)]
    if symbol.kind == "struct":
        rows = [[type_text(site, page, m.declaration), prose(site, page, field_note(symbol, m), names)]
                for m in symbol.members]
        lines += ["## Fields", "", *table(["field", "meaning"], rows)]
    if symbol.kind == "enum":
        rows = [[f"`{m.names[0]}`", str(m.value), prose(site, page, " ".join(m.comment.split()))]
                for m in symbol.members]
        lines += ["## Values", "", *table(["name", "value", "meaning"], rows)]
    if symbol.kind == "function":
        lines += error_lines(site, page, symbol, text, other)
    if symbol.kind == "function" and "Cost" not in text:
        text["Cost"] = f"As {other.name}." if other else "Constant time."
    for label in ("Limits", "Cost", "Memory"):
        if label in text:
            lines += [f"## {label}", "", prose(site, page, capital(text[label]), names), ""]
    if symbol.kind == "function":
        note = thread_note(symbol, site) + (" " + text["Threads"] if "Threads" in text else "")
        lines += ["## Threads", "", prose(site, page, note) +
                  f" See [threads]({os.path.relpath('howto/threads.md', 'api')}).", ""]
    if "Source" in text:
        lines += ["## Source", "", prose(site, page, capital(
            text["Source"].replace("paper, section", "Igouchkine and Liu, section"))), ""]
    lines += related_lines(site, page, symbol)
    lines += [f"Header: `{symbol.header}`, section [{symbol.section}]({pathlib.Path(API_PAGES[symbol.header]).name}). "
              f"Since version {header.since(symbol, site.reference)}."]
    site.write(page, lines)


def error_lines(site: Site, page: str, symbol: Symbol, text: Dict[str, str], other) -> List[str]:
    if symbol.returns != "msq_status":
        if symbol.name.endswith(("_retain", "_release")) or symbol.returns == "void":
            return []
        return ["## Errors", "", "None: this function cannot fail.", ""]
    found = header.errors(text.get("Errors", ""))
    lines = ["## Errors", ""]
    if other and (not found or text["Errors"].startswith("as ")):
        lines += [f"As {site.symbol_link(page, other.name)}" + (", and:" if found else "."), ""]
        if not found:
            found = header.errors(header.parts(other.comment).get("Errors", ""))
    rows = [[f"[`MSQ_E_{status}`](../howto/errors.md#causes-and-cures)",
             prose(site, page, reason(status, when))] for status, when in found]
    return lines + table(["status", "when"], rows)


def reason(status: str, when: str) -> str:
    """`also ...` in a comment adds to what the status usually means."""
    if not when:
        return USUALLY[status]
    return f"{USUALLY[status]}; {when}" if when.startswith("also") else when


def related_lines(site: Site, page: str, symbol: Symbol) -> List[str]:
    names = [symbol.name] + ([n for m in symbol.members for n in m.names] if symbol.kind == "enum" else [])
    lines = use_lines(site, page, names)
    if symbol.kind in ("struct", "handle", "callback", "enum"):
        users = users_of(site, symbol)
        if symbol.kind == "enum":
            users = [other.name for other in site.reference.symbols.values()
                     if re.search(rf"\b{symbol.name}\b", other.comment + other.declaration)
                     and other is not symbol]
        if users:
            lines += ["**Used by:** " + ", ".join(site.symbol_link(page, name) for name in users), ""]
    if symbol.kind == "function":
        related = [a.declaration for a in symbol.members] + [symbol.returns]
        types = dict.fromkeys(word for text in related for word in re.findall(r"\bmsq_\w+\b", text)
                              if word in site.page_of and word != "msq_status")
        if types:
            lines += ["**Types:** " + ", ".join(site.symbol_link(page, name) for name in types), ""]
    return ["## See also", "", *lines] if lines else []


def index_pages(site: Site) -> None:
    """For each header: the list of its declarations, and the rules that its file comment states."""
    for name, sections in site.reference.sections.items():
        page, rules = API_PAGES[name], RULES_PAGES[name]
        symbols = [s for s in site.reference.symbols.values() if s.header == name]
        lines = [f"# {'C reference' if name == 'msq.h' else name}", "",
                 f"Every declaration of `{name}`, in its order. These rules hold for all of them: "
                 f"[rules]({pathlib.Path(rules).name}).", ""]
        for section, note in sections.items():
            lines += [f"## {section}", "", *(paragraphs(site, page, note.strip()) if note.strip() else [])]
            for kind, title in KINDS.items():
                group = [s for s in symbols if s.section == section and s.kind == kind]
                if group:
                    rows = [[f"[`{s.name}`]({s.name}.md)", prose(site, page, first_sentence(s))] for s in group]
                    lines += table([title, ""], rows)
        lines += ["```{toctree}", ":hidden:", "", pathlib.Path(rules).stem, *(s.name for s in symbols), "```"]
        site.write(page, lines)
        title = "Rules of the C API" if name == "msq.h" else f"Rules of {name}"
        site.write(rules, [f"# {title}", "", *paragraphs(site, rules, site.reference.prefaces[name])])


def first_sentence(symbol: Symbol) -> str:
    found = header.sentences(header.parts(symbol.comment).get("", ""))
    return found[0] if found else ""


def document(site: Site, path: pathlib.Path) -> None:
    """A document with its links set for the site, and with links where it names symbols."""
    page = site.document_page(path)
    parts = re.split(r"^(\s*```.*?^\s*```)", path.read_text(encoding="utf-8"), flags=re.S | re.M)
    for i in range(0, len(parts), 2):  # outside of code; a link may run over the end of a line
        parts[i] = re.sub(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", lambda m: moved(site, page, path, m), parts[i])
    out, in_code = [], False
    for line in "".join(parts).split("\n"):
        if re.match(r"\s*```", line):
            in_code = not in_code
        elif not in_code:
            line = re.sub(r"(?<![\[`])`((?:msq|MSQ)_\w+)`(?!`|\])", lambda m: site.symbol_link(page, m.group(1))
                          if m.group(1) in site.page_of and not line.startswith("#") else m.group(0), line)
            line = re.sub(r"(?<![\[`(])`((?:examples|include|scripts|docs|src|tests|bindings|bench)/[\w./-]+)`(?!`|\])",
                          lambda m: f"[`{m.group(1)}`]({site.link_to(page, ROOT / m.group(1))})"
                          if (ROOT / m.group(1)).is_file() and not line.startswith("#") else m.group(0), line)
        out.append(line)
    text = "\n".join(out)
    text = re.sub(r"^<!-- (?:c|python)$.*?^-->\n", "", text, flags=re.S | re.M)  # what only the test sees
    site.write(page, text.split("\n"))


def moved(site: Site, page: str, path: pathlib.Path, match: "re.Match[str]") -> str:
    picture, text, target = match.groups()
    if re.match(r"\w+:|#", target):
        return match.group(0)
    name, _, anchor = target.partition("#")
    file = (path.parent / name).resolve()
    if not file.exists():
        sys.exit(f"{path}: {target} is not there")
    if file.suffix in (".png", ".svg", ".jpg"):
        inside = file.relative_to(ROOT / "docs").as_posix()
        return f"{picture}[{text}]({os.path.relpath(inside, os.path.dirname(page) or '.')})"
    return f"[{text}]({site.link_to(page, file)}{'#' + anchor if anchor else ''})"


def source_pages(site: Site) -> None:
    """Pages of the files that others link to, and an index of them."""
    for path in uses.examples():
        site.source_page(path)
    for name, page in sorted(site.sources.items()):
        path = ROOT / name
        if path.is_dir():
            files = sorted(p.relative_to(ROOT).as_posix() for p in path.rglob("*") if p.is_file())
            site.write(page, [f"# {name}/", "", *(f"- `{file}`" for file in files)])
            continue
        text = path.read_text(encoding="utf-8")
        language = LANGUAGES.get(path.suffix, "sh" if text.startswith("#!") else "text")
        if "python" in text[:30]:
            language = "python"
        if path.name == "CMakeLists.txt":
            language = "cmake"
        site.write(page, [f"# {name}", "", f"`````{language}", text.rstrip(), "`````"])
    site.write("source/index.md", [
        "# Files", "", "Files of the repository that the documentation names. The "
        "examples are whole programs, which the tests build and run.", "", "```{toctree}", ":maxdepth: 1", "",
        *(pathlib.Path(page).stem for _, page in sorted(site.sources.items())), "```"])


def main() -> int:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    shutil.rmtree(folder, ignore_errors=True)
    site = Site(folder, header.read())
    folder.mkdir(parents=True)
    shutil.copytree(ROOT / "docs" / "images", folder / "images")
    for path in [*sorted((ROOT / "docs").rglob("*.md")), *(ROOT / name for name in OTHERS)]:
        if path.parent != ROOT / "docs" / "site":
            document(site, path)
    decisions = sorted((ROOT / "docs" / "decisions").glob("*.md"))
    site.write("decisions/index.md", ["# Decisions", "", "What was decided, and why.", "", "```{toctree}",
                                      ":maxdepth: 1", "", *(path.stem for path in decisions), "```"])
    document(site, ROOT / "docs" / "site" / "index.md")
    shutil.copy(ROOT / "docs" / "site" / "conf.py", folder / "conf.py")
    for symbol in site.reference.symbols.values():
        symbol_page(site, symbol)
    index_pages(site)
    source_pages(site)
    print(f"{len(site.reference.symbols)} symbols, {len(site.sources)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
