#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""abi.json says of some functions which arguments may be NULL, as msq.h does.

usage: check_nullable.py ABI_JSON
"""
import json
import pathlib
import sys

NULLABLE = {
    "msq_document_from_file": ["def", "job"],
    "msq_layer_fn": ["user"],
    "msq_printability": ["def", "fn", "user", "job"],
    "msq_render": ["query", "fn", "user", "job"],
    "msq_shape_from_box": [],
    "msq_slicer_run": ["user", "job"],
    "msq_structure_calibrate": ["sample", "parameters", "fractions", "report", "job"],
    "msq_structure_struts": ["user", "job"],
    "msq_surface_file": ["user", "job"],
    "msq_surface_mesh": ["user", "job"],
}


def main():
    abi = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    found = {one["name"]: [argument["name"] for argument in one["arguments"]
                           if argument.get("nullable")]
             for one in abi["functions"] + abi["callbacks"]}
    errors = [f"{name}: {found[name]} may be NULL, not {expected}"
              for name, expected in NULLABLE.items() if found[name] != expected]
    if errors:
        sys.exit("\n".join(errors))


main()
