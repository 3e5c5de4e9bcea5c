#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A program returns the results of all vectors.

usage: check_vectors.py [--no-hashes] PROGRAM [ARGUMENT ...]

--no-hashes: the library was built without them.
"""
import json
import sys

sys.dont_write_bytecode = True
import protocol  # noqa: E402


def main():
    command = sys.argv[1:]
    has_hashes = command[:1] != ["--no-hashes"]
    command = command if has_hashes else command[1:]
    if not command:
        sys.exit(__doc__)
    paths = sorted(protocol.HERE.glob("*.json"))
    if not paths:
        sys.exit(f"no vectors in {protocol.HERE}")
    vectors = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    failures = 0
    for path, vector, found in zip(paths, vectors, protocol.run(command, vectors)):
        expected = dict(vector["expected"])
        if not has_hashes and "hash" in expected:
            expected["hash"] = "-"
        for key in {**expected, **found}:
            if not protocol.same(expected.get(key), found.get(key)):
                failures += 1
                print(f"{path.name}: {key} is {str(found.get(key))[:200]}, expected "
                      f"{str(expected.get(key))[:200]}")
    if failures == 0:
        print(f"{len(vectors)} vectors, all as expected")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
