# SPDX-License-Identifier: Apache-2.0
"""The structs, constants and functions in Julia are those of abi.json, which the test bindings.layout compares with the
C compiler's: usage: check_layout.py ABI_JSON PROGRAM [ARGUMENT ...]"""
import json
import subprocess
import sys

SIZES = {"char": 1, "int8_t": 1, "uint8_t": 1, "int16_t": 2, "uint16_t": 2, "int32_t": 4, "uint32_t": 4,
         "int64_t": 8, "uint64_t": 8, "size_t": 8, "float": 4, "double": 8, "msq_status": 4}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        abi = json.load(file)
    sizes = {**SIZES, **{one["name"]: one["size"] for one in abi["structs"]},
             **{one["name"]: 8 for one in abi["callbacks"]}}

    def size(kind):
        return 8 if kind.get("pointers") else sizes[kind["name"]] * kind.get("length", 1)

    wanted = {f"struct {one['name']} {one['size']}" for one in abi["structs"]}
    wanted |= {f"field {one['name']} {field['name']} {field['offset']} {size(field['type'])}"
               for one in abi["structs"] for field in one["fields"]}
    wanted |= {f"constant {name} {value}" for name, value in abi["versions"].items()}
    wanted |= {f"constant {value['name']} {value['value']}" for enum in abi["enums"] for value in enum["values"]}
    wanted |= {f"function {one['name']} {len(one['arguments'])}" for one in abi["functions"]}
    found = set(subprocess.run(sys.argv[2:], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines())
    for line in sorted(wanted ^ found):
        print(f"{'msq.h' if line in wanted else 'Julia'} has: {line}")
    print(f"{len(found)} declarations compared")
    return 0 if wanted == found and len(found) > 1000 else 1


if __name__ == "__main__":
    sys.exit(main())
