#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints which languages the tests ran in, and what no build tested, with the reason.

    python3 tests/report/left_out.py BUILD...

BUILD is a build folder. left_out.txt in it is what CMake left out (cmake/left_out.cmake), tests.xml is what CTest ran
(--output-junit). A thing counts as left out if every one of the builds left it out.
"""
import pathlib
import re
import sys
import xml.etree.ElementTree as xml

# The tests of each language, by their names.
LANGUAGES = {"C": r"api\.", "C++": r"(bindings|vectors)\.cpp$", "C#": r"(bindings|vectors)\.csharp$",
             "Go": r"(bindings|vectors)\.go$", "Julia": r"(bindings|vectors)\.julia$",
             "LuaJIT": r"(bindings|vectors)\.luajit$",
             "Node": r"(bindings|vectors)\.node$", "TypeScript": r"bindings\.node_types$",
             "Python": r"(bindings\.python_|vectors\.python$)", "Rust": r"(bindings|vectors)\.rust$"}


def skipped_parts(output):
    """Tests that unittest skipped, and why, as it prints with -v: `name (class)`, maybe a sentence, ` ... skipped 'why'`."""
    test = ""
    for line in output.split("\n"):
        named = re.match(r"(\w+) \(", line)
        test = named.group(1) if named else test
        why = re.search(r" \.\.\. skipped (['\"])(.*)\1$", line)
        if why:
            yield test, why.group(2)


class Build:
    """What one build ran and left out; skipped maps a test, or a part of it, to the reason."""

    def __init__(self, folder):
        text = (folder / "left_out.txt").read_text(encoding="utf-8")
        self.missing = [line for line in text.split("\n") if line]
        self.ran, self.skipped = set(), {}
        for case in xml.parse(folder / "tests.xml").getroot().iter("testcase"):
            name, output = case.get("name"), case.findtext("system-out") or ""
            if case.get("status") == "disabled":
                continue
            if case.find("skipped") is not None:
                said = re.search(r"^skipped: (.*)", output, flags=re.M)
                self.skipped[name] = said.group(1) if said else case.find("skipped").get("message")
                continue
            self.ran.add(name)
            for test, reason in skipped_parts(output):
                self.skipped[f"{name}, {test}"] = reason


def lines(builds):
    ran = set().union(*(build.ran for build in builds))
    tested = [name for name, tests in LANGUAGES.items() if any(re.match(tests, test) for test in ran)]
    yield f"Languages tested: {', '.join(tested) or 'none'}"
    rest = [name for name in LANGUAGES if name not in tested]
    if rest:
        yield f"Languages not tested: {', '.join(rest)}"
    missing = []
    for line in builds[0].missing:
        whats = [[other for other in build.missing if other.split(": ")[0] == line.split(": ")[0]] for build in builds]
        if all(whats):  # a program that is missing says more than a static library
            missing.append(min((found[0] for found in whats), key=lambda one: ": the library is " in one))
    skipped = {}
    for build in builds:
        for name, reason in build.skipped.items():
            test = name.split(", ")[0]
            if all(name in other.skipped or test not in other.ran for other in builds):
                skipped[name] = reason
    left_out = missing + [f"{name}: {reason}" for name, reason in sorted(skipped.items())]
    yield "Left out:" if left_out else "Left out: nothing"
    yield from (f"  {line}" for line in left_out)


def main() -> int:
    folders = [pathlib.Path(name) for name in sys.argv[1:]]
    whole = [folder for folder in folders if all((folder / name).exists() for name in ("left_out.txt", "tests.xml"))]
    if not whole:
        print("Languages tested: unknown, since no tests ran")
        return 1
    try:
        print("\n".join(lines([Build(folder) for folder in whole])))
    except xml.ParseError as error:  # the tests have run; do not fail them
        print(f"Languages tested: unknown, since tests.xml cannot be read: {error}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
