#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes *.json, the vectors that the bindings of all languages run through.

usage: make_vectors.py [--check] PROGRAM [ARGUMENT ...]

The program computes the results (protocol.py): vectors.c, which calls msq.h itself. With --check
nothing is written, and a file that is not what the script makes, or that it does not make, is an
error.
"""
import json
import pathlib
import sys

sys.dont_write_bytecode = True
import cases  # noqa: E402
import protocol  # noqa: E402


def text_of(name, vector):
    """Points and layers stand on lines of their own."""
    parts = [f' "about": {json.dumps("Made by make_vectors.py. See protocol.py.")}',
             f' "name": {json.dumps(name)}',
             f' "model": {json.dumps(vector["model"], ensure_ascii=False)}',
             f' "points": {rows(vector["points"])}']
    expected = ",\n".join(
        f'  "{key}": {rows(value) if key == "layers" else json.dumps(value, ensure_ascii=False)}'
        for key, value in vector["expected"].items())
    return "{\n" + ",\n".join([*parts, f' "expected": {{\n{expected}\n }}']) + "\n}\n"


def rows(values):
    return "[\n   " + ",\n   ".join(json.dumps(value) for value in values) + "]"


def main():
    arguments = sys.argv[1:]
    check = arguments[:1] == ["--check"]
    program = arguments[1:] if check else arguments
    if not program:
        sys.exit(__doc__)
    given = [{"model": model, "points": cases.points()} for model in cases.CASES.values()]
    made = {f"{name}.json": text_of(name, {**vector, "expected": result})
            for name, vector, result in zip(cases.CASES, given, protocol.run(program, given))}
    failed = False
    if check:
        present = {path.name for path in protocol.HERE.glob("*.json")}
        for name in sorted(set(made) | present):
            path = protocol.HERE / name
            if name not in made or name not in present:
                print(f"{name} is {'missing' if name in made else 'not made by make_vectors.py'}")
                failed = True
            elif path.read_text(encoding="utf-8") != made[name]:
                print(f"{name} is not what make_vectors.py makes")
                failed = True
    else:
        for name, text in made.items():
            (protocol.HERE / name).write_text(text, encoding="utf-8")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
