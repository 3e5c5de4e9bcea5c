# SPDX-License-Identifier: Apache-2.0
"""The lines of docs/command.md run as they stand. The examples of the help are among them."""
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from command import BRACKET, PROGRAM, SOURCE, TIMEOUT, Case, run


def lines():
    text = (SOURCE / "docs/command.md").read_text(encoding="utf-8")
    for block in re.findall(r"^```sh\n(.*?)^```$", text, flags=re.S | re.M):
        yield from block.strip().split("\n")


def examples():
    """Of the help of all commands."""
    for command in re.findall(r"(?m)^  (\w+) +\w", run("--help").stdout):
        yield from re.findall(r"(?m)^  ((?:echo .*)?msq .*)", run(command, "--help").stdout)


class Lines(Case):
    def test_lines(self):
        shutil.copy(BRACKET, self.folder)
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        count = 0
        for line in lines():
            with self.subTest(line):
                done = subprocess.run(["bash", "-c", line], cwd=self.folder, capture_output=True,
                                      text=True, timeout=TIMEOUT, env={**os.environ, "PATH": path})
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                output = re.search(r" -o (\S+)", line)
                if output:
                    self.assertTrue((self.folder / output[1]).exists())
                else:
                    self.assertNotEqual(done.stdout, "")
                count += 1
        self.assertGreater(count, 12)
        self.assertEqual(set(examples()) - set(lines()), set())


if __name__ == "__main__":
    unittest.main()
