#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every function that msq.h declares is called in the scenarios of this folder.

usage: check_covered.py msq.h
"""
import pathlib
import re
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "header"))
from declared import declared_functions  # noqa: E402

text = "\n".join(file.read_text(encoding="utf-8")
                 for pattern in ("scenarios*.cpp", "world.*", "kinds.*", "stage.*")
                 for file in here.glob(pattern))
text = re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)  # names of scenarios are no calls
missing = [name for name in declared_functions(sys.argv[1])
           if not re.search(rf"\b{name}\b", text)]
if missing:
    sys.exit("in no scenario: " + ", ".join(missing))
