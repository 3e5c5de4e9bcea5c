#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the Python of a document: its blocks marked ```python, one after the other.

    python3 tests/docs/run_python.py page.md
"""
import pathlib
import re
import sys

if len(sys.argv) != 2:
    sys.exit(__doc__)
page = pathlib.Path(sys.argv[1])
text = page.read_text(encoding="utf-8")
names = {"__name__": "__main__"}
for block in re.finditer(r"^```python\n(.*?)^```$", text, flags=re.S | re.M):
    line = text.count("\n", 0, block.start(1))
    exec(compile("\n" * line + block.group(1), str(page), "exec"), names)
