#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""slice_voxels fills the bone that make_bone.py makes, and refuses files of another size.

usage: check_slice_voxels.py SLICE_VOXELS MAKE_BONE
"""
import pathlib
import re
import subprocess
import sys
import tempfile

program, make_bone = sys.argv[1:]
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    subprocess.run([sys.executable, make_bone, str(folder / "bone.nhdr"), "--step", "4"], check=True)

    def run(size, threshold="250"):
        return subprocess.run([program, str(folder / "bone.raw"), size, "4", threshold, str(folder / "layer")],
                              capture_output=True, text=True, timeout=240)

    done = run("15,10,18")
    found = re.fullmatch(r"([\d.]+) % of ([\d.]+) cm3 filled\n", done.stdout)
    if done.returncode != 0 or not found:
        sys.exit(f"{done.returncode}: {done.stdout}{done.stderr}")
    # The bone of 1 mm voxels has 18 cm3; these are coarse.
    if not (10 < float(found[1]) < 90 and 12 < float(found[2]) < 25):
        sys.exit(done.stdout)
    pictures = sorted(folder.glob("layer*.pbm"))
    if len(pictures) < 20 or not all(path.read_bytes().startswith(b"P4\n") for path in pictures):
        sys.exit(f"{len(pictures)} pictures")
    for size, threshold, code, text in (("15,10,17", "250", 1, "cannot read 15,10,17 values"),
                                        ("15,10,19", "250", 1, "cannot read 15,10,19 values"),
                                        ("0,10,18", "250", 1, "cannot read 0,10,18 values"),
                                        ("15,10", "250", 2, "usage"),
                                        ("15,10,18", "9999", 1, "no value of the image is solid")):
        done = run(size, threshold)
        if done.returncode != code or text not in done.stderr:
            sys.exit(f"{size}, {threshold}: {done.returncode}, {done.stderr}")
print("slice_voxels fills what it should")
