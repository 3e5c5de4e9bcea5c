# SPDX-License-Identifier: Apache-2.0
"""The declarations in C# have the layout, values and signatures of abi.json, which the test bindings.layout
compares with the C compiler's: usage: check_layout.py ABI_JSON PROGRAM [ARGUMENT ...]"""
import json
import subprocess
import sys

SIZES = {"char": 1, "int8_t": 1, "uint8_t": 1, "int16_t": 2, "uint16_t": 2, "int32_t": 4, "uint32_t": 4,
         "int64_t": 8, "uint64_t": 8, "size_t": 8, "float": 4, "double": 8, "msq_status": 4}
NAMES = {"char": "Byte", "int8_t": "SByte", "uint8_t": "Byte", "int16_t": "Int16", "uint16_t": "UInt16",
         "int32_t": "Int32", "uint32_t": "UInt32", "int64_t": "Int64", "uint64_t": "UInt64", "size_t": "UIntPtr",
         "float": "Single", "double": "Double", "void": "Void", "msq_status": "Int32"}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        abi = json.load(file)
    callbacks = {one["name"] for one in abi["callbacks"]}
    structs = {one["name"]: one["size"] for one in abi["structs"]}

    def size(kind):
        if kind.get("pointers") or kind["name"] in callbacks:
            return 8
        return {**SIZES, **structs}[kind["name"]] * kind.get("length", 1)

    def name(kind):
        if kind["name"] in callbacks:
            return "IntPtr"
        return NAMES.get(kind["name"], kind["name"]) + "*" * kind.get("pointers", 0)

    def signature(one):
        return " ".join(name(kind) for kind in [one["result"], *(each["type"] for each in one["arguments"])])

    wanted = [f"struct {each} {bytes_}" for each, bytes_ in structs.items()]
    wanted += [f"field {one['name']} {field['name']} {field['offset']} {size(field['type'])}"
               for one in abi["structs"] for field in one["fields"]]
    wanted += [f"constant {each} {value}" for each, value in abi["versions"].items()]
    wanted += [f"constant {value['name']} {value['value']}" for enum in abi["enums"] for value in enum["values"]]
    wanted += [f"callback {one['name']} {signature(one)}" for one in abi["callbacks"]]
    wanted += [f"function {one['name']} {signature(one)}" for one in abi["functions"]]
    done = subprocess.run(sys.argv[2:], stdout=subprocess.PIPE, text=True, check=True)
    lines = done.stdout.splitlines()
    found = [line for line in lines if not line.startswith("enum ")]
    for line in sorted(set(wanted) - set(found)):
        print(f"msq.h has: {line}")
    for line in sorted(set(found) - set(wanted)):
        print(f"C# has: {line}")
    # Of enums the names are those of C#: the values are compared, enum by enum.
    enums = {}
    for line in lines:
        if line.startswith("enum "):
            _, enum, _, value = line.split()
            enums.setdefault(enum.lower(), []).append(int(value))
    wrong_enums = [enum["name"] for enum in abi["enums"]
                   if sorted(enums.get(enum["name"][4:].replace("_", ""), []))
                   != sorted(value["value"] for value in enum["values"])]
    for enum in wrong_enums:
        print(f"values of {enum} differ")
    print(f"{len(found)} declarations and {len(enums)} enums compared")
    return 0 if sorted(wanted) == sorted(found) and not wrong_enums and len(found) > 300 else 1


if __name__ == "__main__":
    sys.exit(main())
