#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the Python of a document: its blocks marked ```python, one after the other.

    python3 tests/docs/run_python.py page.md

They run in a new folder, which holds examples/parts/bracket.stl. A block whose first line is a comment such as
`# part.py` is also written to that file, so that later blocks can import it. What readers need not see stands in a
comment of Markdown: a line `<!-- python`, code, a line `-->`. Such code may set `replace`, a dictionary: in later
blocks its keys are replaced by its values, such as a grid that is too large for a test by a small one.

Exit status 77: a module is missing that msq does not need.
"""
import os
import pathlib
import re
import shutil
import sys
import tempfile

PART = pathlib.Path(__file__).resolve().parent.parent.parent / "examples" / "parts" / "bracket.stl"
BLOCK = re.compile(r"^(?:```|<!-- )python\n(.*?)^(?:```|-->)$", flags=re.S | re.M)
OPTIONAL = {"dask", "distributed", "zarr"}


def run(page):
    text = page.read_text(encoding="utf-8")
    names = {"__name__": "__main__", "replace": {}}
    for block in BLOCK.finditer(text):
        code = block.group(1)
        for shown, used in names["replace"].items():
            code = code.replace(shown, used)
        file = re.match(r"# (\w+\.py)\b", code)
        if file:
            pathlib.Path(file.group(1)).write_text(code, encoding="utf-8")
        line = text.count("\n", 0, block.start(1))
        exec(compile("\n" * line + code, str(page), "exec"), names)


def main() -> int:
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    page = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(PART, folder)
        os.chdir(folder)
        sys.path.insert(0, folder)
        try:
            run(page)
        except ModuleNotFoundError as error:
            if error.name not in OPTIONAL:
                raise
            print(f"skipped: no module {error.name}")
            return 77
        finally:
            os.chdir("/")
    return 0


if __name__ == "__main__":
    sys.exit(main())
