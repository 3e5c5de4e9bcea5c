# SPDX-License-Identifier: Apache-2.0
"""What a user's type checker sees: mypy --strict, where it is found."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent


WRONG = """import msq
msq.Foam(radius='thin')
msq.Foam(radius=0.2).radius.shape
x: int = msq.Model(msq.Shape.sphere((0, 0, 0), 1)).slicer()[1:2]
msq.Shape.sphere((0, 0, 0))
"""


class Types(unittest.TestCase):
    def test_a_program_of_a_user_is_clean_and_wrong_types_are_found(self):
        if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode:
            self.skipTest("no mypy")
        with tempfile.TemporaryDirectory() as folder:
            wrong = pathlib.Path(folder, "wrong.py")
            wrong.write_text(WRONG)
            cache = os.environ.get("MSQ_MYPY_CACHE", os.devnull)
            done = subprocess.run(
                [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", cache,
                 str(HERE / "typed_sample.py"), str(wrong)], stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, text=True,
                env={**os.environ, "MYPYPATH": str(HERE.parent), "LD_PRELOAD": ""})
        self.assertEqual(done.returncode, 1, done.stdout)
        errors = [line for line in done.stdout.splitlines() if ": error:" in line]
        elsewhere = [line for line in errors if not line.split(":")[0].endswith("wrong.py")]
        self.assertEqual(elsewhere, [])
        self.assertEqual({int(line.split(":")[1]) for line in errors}, {2, 3, 4, 5}, done.stdout)

    def test_the_sample_runs(self):
        done = subprocess.run([sys.executable, "-B", str(HERE / "typed_sample.py")],
                              stdout=subprocess.PIPE, text=True, check=True)
        self.assertRegex(done.stdout, r"\(\d+, \d")


if __name__ == "__main__":
    unittest.main()
