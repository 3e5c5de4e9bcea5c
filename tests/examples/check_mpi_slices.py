#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""mpi_slices writes the same file with one, two and three processes, and fails as a whole.

    python3 check_mpi_slices.py PROGRAM MPIEXEC [FLAG]

Exit status 77: there is no MPIEXEC, or it starts no process here.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

# Open MPI: as root, and with more processes than cores.
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1",
               "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}


def main() -> int:
    program, mpiexec, flag = (*sys.argv[1:], "-n")[:3]

    def run(processes, *command):
        return subprocess.run([mpiexec, flag or "-n", str(processes), *command], env=ENVIRONMENT,
                              capture_output=True, text=True, timeout=50, check=False)

    try:
        if run(2, "true").returncode != 0:
            raise OSError("it starts no process")
    except OSError as error:
        print(f"skipped: mpiexec is {mpiexec!r}: {error}")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        written = []
        for processes in (1, 2, 3):
            path = pathlib.Path(folder) / f"{processes}.raw"
            done = run(processes, program, str(path), "0.23")
            print(done.stdout + done.stderr, end="")
            said = re.match(r"(\d) processes: 87 layers of 174 x 131 pixels .*, (.*) % solid", done.stdout)
            if done.returncode != 0 or not said or int(said[1]) != processes:
                return 1
            written.append((path.read_bytes(), said[2]))
        if len(written[0][0]) != 87 * 131 * 24 or written[1:] != written[:1] * 2:
            print("the files differ")
            return 1
        solid = sum(bin(byte).count("1") for byte in written[0][0]) / (87 * 131 * 174)
        if f"{100 * solid:.2f}" != written[0][1]:
            print(f"{100 * solid:.2f} % of the pixels are solid")
            return 1
        failed = run(2, program, f"{folder}/none/layers.raw")
        if failed.returncode == 0 or "mpi_slices: process" not in failed.stderr:
            print(f"a file that cannot be written: {failed.returncode}, {failed.stderr}")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
