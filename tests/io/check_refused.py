#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every function of msq_io.h that returns a status has a table of refusals in this folder.

usage: check_refused.py msq_io.h
"""
import pathlib
import re
import sys

here = pathlib.Path(__file__).resolve().parent
header = re.sub(r"/\*.*?\*/", " ", pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"), flags=re.S)
functions = re.findall(r"\bMSQ_IO_API\s+msq_status\s+(\w+)\s*\(", header)
tables = "\n".join(file.read_text(encoding="utf-8") for file in here.glob("test_refusals_*.c"))
refused = set(re.findall(r'\bREFUSALS\("(\w+)"', tables))
refused |= {f"msq_io_{name}_init" for name in re.findall(r"\bDO\((\w+)\)", tables)}
missing = [name for name in functions if name not in refused]
if len(functions) < 15 or missing:
    sys.exit(f"{len(functions)} functions; without a table of refusals: {', '.join(missing)}")
