#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shell commands of README and docs name what is there: scripts and their options, presets, options
of CMake, and programs of this repository. Runs none of them.

    python3 tests/docs/check_shell.py
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "bindings/python/README.md",
         ROOT / "integrations/freecad/README.md", ROOT / "integrations/blender/README.md", ROOT / "bindings/README.md",
         ROOT / "integrations/prusaslicer/README.md",
         *sorted((ROOT / "docs").glob("*.md")), *sorted((ROOT / "docs").glob("*/*.md"))]


def commands(page):
    """(line number, command) of each line in a block marked sh, with continued lines joined."""
    text = page.read_text(encoding="utf-8")
    for block in re.finditer(r"^```sh\n(.*?)^```$", text, flags=re.S | re.M):
        number = text.count("\n", 0, block.start(1)) + 1
        for line in block.group(1).replace("\\\n", "  ").split("\n"):
            yield number, line.split(" #")[0].split("   #")[0]
            number += 1


def presets():
    read = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
    return {preset["name"] for preset in read["configurePresets"]}


def options():
    text = "\n".join(path.read_text(encoding="utf-8") for path in
                     [ROOT / "CMakeLists.txt", *(ROOT / "cmake").glob("*.cmake")])
    return set(re.findall(r"\boption\((\w+)", text))


def has_program(path):
    """build/NAME/examples/c/render is made of examples/c/render.c; a test of tests/FOLDER/test_X."""
    folder, name = path.rsplit("/", 1)
    if folder == "tests":
        return "<" in name or any(ROOT.glob(f"tests/*/{name.split('_', 1)[1]}.c*"))
    return any((ROOT / folder).glob(f"{name}.c*"))


def problems(command, known_presets, known_options):
    for script in re.findall(r"(?:^|[\s;&])(?:\./)?(scripts/\w+)((?:\s+--[\w-]+)*)", command):
        path = ROOT / script[0]
        if not path.is_file():
            yield f"there is no {script[0]}"
            continue
        text = path.read_text(encoding="utf-8")
        for flag in script[1].split():
            if flag not in text:
                yield f"{script[0]} has no {flag}"
    for name in re.findall(r"--preset[ =](\w+)", command):
        if name not in known_presets:
            yield f"there is no preset {name}"
    for name in re.findall(r"-D(MSQ_\w+)=", command):
        if name not in known_options:
            yield f"there is no option {name}"
    for path in re.findall(r"\bbuild/\w+/((?:examples|bench|tests)[\w/<>]*/[\w<>]+)", command):
        if not has_program(path):
            yield f"no source makes {path}"
    for path in re.findall(r"(?:^|\s)((?:examples|bindings|docs)/[\w/.-]+)", command):
        if not (ROOT / path).exists():
            yield f"there is no {path}"


def main() -> int:
    found, count = [], 0
    known = presets(), options()
    for page in PAGES:
        for line, command in commands(page):
            count += bool(command.strip())
            found += [f"{page.relative_to(ROOT)}:{line}: {problem}"
                      for problem in problems(command, *known)]
    print("\n".join(found) if found else f"{count} commands")
    return 1 if found or not count else 0


if __name__ == "__main__":
    sys.exit(main())
