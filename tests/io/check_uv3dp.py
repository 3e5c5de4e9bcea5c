#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""uv3dp (github.com/ezrec/uv3dp) reads the SL1 archives: the same pixels in its own SL1, and a CTB.

usage: check_uv3dp.py write_samples uv3dp
"""
import pathlib
import subprocess
import sys
import tempfile
import zipfile

import png_rows


def layers(path):
    archive = zipfile.ZipFile(path)
    names = sorted(name for name in archive.namelist() if name.endswith(".png") and "/" not in name)
    return [png_rows.read(archive.read(name))[0] for name in names]


def main():
    program, converter = sys.argv[1:]
    if converter.endswith("NOTFOUND"):
        print("skipped: no uv3dp")
        return 77
    for orientation in ("landscape", "portrait"):
        for mirrors in (("0", "0"), ("1", "1")):
            with tempfile.TemporaryDirectory() as folder:
                folder = pathlib.Path(folder)
                subprocess.run([program, "sl1", folder, orientation, *mirrors], check=True,
                               stdout=subprocess.DEVNULL)
                sample = folder / "sample.sl1"
                said = subprocess.run([converter, sample, "info"], check=True, capture_output=True,
                                      text=True).stdout
                subprocess.run([converter, sample, folder / "again.sl1"], check=True)
                own, again = layers(sample), layers(folder / "again.sl1")
                assert len(own) == len(again) == 20 and f"{len(own)}" in said, said
                assert own == again, orientation
                if orientation == "portrait":  # uv3dp takes every panel for one of these
                    subprocess.run([converter, sample, folder / "out.ctb"], check=True)
                    assert (folder / "out.ctb").stat().st_size > 1000
    print(said)
    return 0


sys.exit(main())
