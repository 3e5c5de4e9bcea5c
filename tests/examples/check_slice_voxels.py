#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""slice_voxels gives the same picture of the same image in every form it reads, and says what is
wrong with the others.

usage: check_slice_voxels.py SLICE_VOXELS MAKE_BONE
"""
import array
import pathlib
import subprocess
import sys
import tempfile

program, make_bone = sys.argv[1:]
temporary = tempfile.TemporaryDirectory()
folder = pathlib.Path(temporary.name)
problems = []


def run(name, *options):
    out = folder / "out"
    done = subprocess.run([program, str(folder / name), "250", "-p", "2", "-o", str(out), *options],
                          capture_output=True, text=True, timeout=120)
    sheet = out / "sheet.png"
    return done, sheet.read_bytes() if sheet.exists() else None


def expect_same(name, wanted, *options):
    done, sheet = run(name, *options)
    if done.returncode != 0 or (done.stdout, sheet) != wanted:
        problems.append(f"{name}: {done.returncode}, {done.stdout}{done.stderr}")


def expect_refused(name, data, text, *options):
    (folder / name).write_bytes(data)
    done, _ = run(name, *options)
    if done.returncode != 1 or text not in done.stderr:
        problems.append(f"{name}: {done.returncode}, not refused with \"{text}\": {done.stderr}")


subprocess.run([sys.executable, make_bone, str(folder / "bone.nrrd"), "--step", "4"], check=True)
subprocess.run([sys.executable, make_bone, str(folder / "bone.nhdr"), "--step", "4"], check=True)
attached = (folder / "bone.nrrd").read_bytes()
header, _, values = attached.partition(b"\n\n")
header += b"\n"
done, sheet = run("bone.nrrd")
wanted = done.stdout, sheet
if done.returncode != 0 or "% of" not in done.stdout or not sheet:
    sys.exit(f"bone.nrrd: {done.returncode}, {done.stdout}{done.stderr}")

# Detached, with lines that say nothing, big-endian, as numbers of other types, with bytes to skip.
expect_same("bone.nhdr", wanted)
numbers = array.array("h", values)
if sys.byteorder == "big":
    numbers.byteswap()
swapped = array.array("h", numbers)
swapped.byteswap()
(folder / "big.nrrd").write_bytes(
    header.replace(b"endian: little", b"# nothing\r\nendian: big\nkey:=value\ncontent: bone") + b"\n" +
    swapped.tobytes() if sys.byteorder == "little" else header + b"\n" + values)
expect_same("big.nrrd", wanted)
for name, code in ("float", "f"), ("double", "d"):
    (folder / "other.nrrd").write_bytes(header.replace(b"short", name.encode()) + b"\n" +
                                        array.array(code, numbers).tobytes())
    if sys.byteorder == "little":
        expect_same("other.nrrd", wanted)
(folder / "skip.nrrd").write_bytes(header + b"byte skip: 5\n\n" + b"12345" + values)
expect_same("skip.nrrd", wanted)

# A raw file lies at the origin: another picture, the same amounts.
done, _ = run("bone.raw", "--raw", "short,15,10,18,4")
if done.returncode != 0 or done.stdout.split("of ")[-1].split()[0] != wanted[0].split("of ")[-1].split()[0]:
    problems.append(f"bone.raw: {done.stdout}{done.stderr}")

expect_refused("no.nrrd", b"PNG\n", "is no NRRD")
expect_refused("gzip.nrrd", header.replace(b"raw", b"gzip") + b"\n", "encoding is gzip; only raw")
expect_refused("flat.nrrd", header.replace(b"dimension: 3", b"dimension: 2") + b"\n", "dimension is 2")
expect_refused("int.nrrd", header.replace(b"short", b"int") + b"\n", "type is int")
expect_refused("few.nrrd", header.replace(b"sizes: 15 10 18", b"sizes: 15 10") + b"\n", "sizes are 15 10")
expect_refused("none.nrrd", header.replace(b"sizes: 15 10 18", b"sizes: 15 0 18") + b"\n", "must be 1 to")
expect_refused("untyped.nrrd", header.replace(b"type: short\n", b"") + b"\n", "names no type")
expect_refused("short.nrrd", attached[:-1], "ends after 2699 of 2700 values")
expect_refused("long.nrrd", attached + b"x", "more bytes than its 2700 values")
expect_refused("list.nrrd", header + b"data file: LIST\n", "values in one file")
expect_refused("lost.nrrd", header + b"data file: lost.raw\n", "lost.raw: No such file")
expect_refused("line.nrrd", header + b"line skip: 2\n\n" + values, "line skip is 2")
expect_refused("odd.nrrd", header + b"nonsense\n\n" + values, "no field: nonsense")
# What the reader takes, and msq does not.
expect_refused("skew.nrrd", attached.replace(b"(0,4.0,0)", b"(1,4.0,0)"), "rotation")
expect_refused("mirror.nrrd", attached.replace(b"(0,4.0,0)", b"(0,-4.0,0)"), "mirrors")
expect_refused("dark.nrrd", header + b"\n" + bytes(2 * 2700), "no value of the image is solid")
done, _ = run("absent.nrrd")
if done.returncode != 1 or "No such file" not in done.stderr:
    problems.append(f"absent.nrrd: {done.stderr}")

if problems:
    sys.exit("\n".join(problems))
print("slice_voxels reads what it should, and no more")
