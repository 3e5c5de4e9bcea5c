#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every function of msq.h that returns a status has a table of refusals in this folder.

usage: check_refused.py msq.h
"""
import pathlib
import re
import sys

here = pathlib.Path(__file__).resolve().parent
header = re.sub(r"/\*.*?\*/", " ", pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"), flags=re.S)
functions = re.findall(r"\bMSQ_API\s+msq_status\s+(\w+)\s*\(", header)
tables = "\n".join(file.read_text(encoding="utf-8") for file in here.glob("test_refusals_*.c"))
sizes = (here / "test_struct_sizes.c").read_text(encoding="utf-8")
refused = set(re.findall(r'\b(?:REFUSALS|wrong_segments)\("(\w+)"', tables))
refused |= {f"msq_{name}_init" for name in re.findall(r"\bDO\((\w+), ", sizes)}
missing = [name for name in functions if name not in refused]
if len(functions) < 50 or missing:
    sys.exit(f"{len(functions)} functions; without a table of refusals: {', '.join(missing)}")
