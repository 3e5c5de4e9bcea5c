# SPDX-License-Identifier: Apache-2.0
"""msq.hpp reaches every function and definition of msq.h: usage: check_complete.py abi.json msq.hpp"""
import json
import re
import sys

abi, header = json.load(open(sys.argv[1])), open(sys.argv[2]).read()
names = set(re.findall(r"\bmsq_\w+", header))
missing = [one["name"] for one in abi["functions"] if one["name"] not in names]
missing += [one["name"] for one in abi["structs"] if one["name"].endswith("_def")
            and f'{one["name"]}_init' in {f["name"] for f in abi["functions"]}
            and one["name"] not in names]
if missing:
    sys.exit("msq.hpp lacks " + ", ".join(missing))
