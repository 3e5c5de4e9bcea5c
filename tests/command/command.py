# SPDX-License-Identifier: Apache-2.0
"""What the tests of the command msq share."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["MSQ_COMMAND"]
BRACKET = SOURCE / "examples" / "parts" / "bracket.stl"
TIMEOUT = 120


def run(*arguments, **options):
    """Runs msq and returns what came of it. Output is text unless binary=True."""
    binary = options.pop("binary", False)
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, timeout=TIMEOUT,
                          text=not binary, **options)


class Case(unittest.TestCase):
    """A test in a folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="msq_command_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def msq(self, *arguments, **options):
        """Runs msq, which must succeed without a word on standard error."""
        done = run(*arguments, **options)
        self.assertEqual((done.returncode, done.stderr), (0, b"" if options.get("binary") else ""))
        return done.stdout

    def refuse(self, status, text, *arguments, **options):
        """Runs msq, which must fail with a line that has the text."""
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertTrue(done.stderr.startswith("msq: "), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(text, done.stderr)
        self.assertEqual(done.stdout, "")

    def names(self):
        """The files in the folder."""
        return sorted(path.relative_to(self.folder).as_posix() for path in self.folder.rglob("*"))
