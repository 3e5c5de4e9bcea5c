#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""slice_numpy.py --layers writes, range by range, the files of one run.

    python3 check_slice_ranges.py slice_numpy.py PART
"""
import pathlib
import subprocess
import sys
import tempfile


def main() -> int:
    program, part = sys.argv[1:]

    def run(folder, *options):
        return subprocess.run([sys.executable, "-B", program, part, "--layer", "2", "--pitch", "0.2", "-o",
                               str(folder), *options], capture_output=True, text=True, check=False)

    with tempfile.TemporaryDirectory() as name:
        one, many = pathlib.Path(name, "one"), pathlib.Path(name, "many")
        for done in (run(one), *(run(many, "--threads", "1", "--layers", layers)
                                 for layers in ("7:14", ":7", "14:99"))):
            print(done.stdout + done.stderr, end="")
            if done.returncode != 0:
                return 1
        (one / "shadow.png").unlink()
        files = [{path.name: path.read_bytes() for path in folder.iterdir()} for folder in (one, many)]
        if files[0] != files[1] or len(files[0]) != 20:
            print(f"{sorted(files[0])} and {sorted(files[1])} differ")
            return 1
        return 0 if run(many, "--layers", "5").returncode == 2 else 1


if __name__ == "__main__":
    sys.exit(main())
