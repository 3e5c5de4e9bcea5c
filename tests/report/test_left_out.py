#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""left_out.py reports what two made-up builds ran and left out."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).with_name("left_out.py")


def case(name, status="run", inside=""):
    return f'<testcase name="{name}" status="{status}">{inside}</testcase>'


def output(text):
    return f"<system-out>{text}</system-out>"


FIRST = (case("api.hello") + case("bindings.cpp") + case("bindings.rust", "fail") + case("bindings.go", "disabled")
         + case("bindings.python_notebook", inside=output(
             "test_a (__main__.T.test_a)\nWhat it does. ... skipped 'no VTK'\n"
             "test_b (__main__.T.test_b) ... ok\ntest_c (__main__.T.test_c) ... skipped \"no 'x'\"\n"))
         + case("io.svg", "notrun", '<skipped message="SKIP_RETURN_CODE=77"/>' + output("skipped: no rsvg-convert\n"))
         + case("io.uv3dp", "notrun", '<skipped message="SKIP_RETURN_CODE=77"/>'))
SECOND = case("api.hello") + case("io.uv3dp")


class LeftOut(unittest.TestCase):
    def report(self, *builds):
        with tempfile.TemporaryDirectory() as folder:
            names = [pathlib.Path(folder) / str(i) for i in range(len(builds))]
            for name, (missing, cases) in zip(names, builds):
                name.mkdir()
                (name / "left_out.txt").write_text(missing, encoding="utf-8")
                (name / "tests.xml").write_text(f"<testsuite>{cases}</testsuite>", encoding="utf-8")
            done = subprocess.run([sys.executable, "-B", SCRIPT, *names, f"{folder}/none"], capture_output=True, text=True,
                                  check=False)
        return done.returncode, done.stdout.split("\n")

    def test_one_build(self):
        self.assertEqual(self.report(("Node: no koffi\n", FIRST)), (0, [
            "Languages tested: C, C++, Python, Rust", "Languages not tested: C#, Go, Julia, LuaJIT, Node, TypeScript",
            "Left out:", "  Node: no koffi", "  bindings.python_notebook, test_a: no VTK",
            "  bindings.python_notebook, test_c: no 'x'", "  io.svg: no rsvg-convert", "  io.uv3dp: SKIP_RETURN_CODE=77", ""]))

    def test_what_another_build_ran(self):
        status, lines = self.report(("Node: no koffi\nRust: no cargo\n", FIRST),
                                    ("Node: the library is static\nPython: the library is static\n", SECOND))
        self.assertEqual(status, 0)
        _, turned = self.report(("Node: the library is static\n", SECOND), ("Node: no koffi\n", SECOND))
        self.assertEqual(turned[2:], ["Left out:", "  Node: no koffi", ""])
        self.assertEqual(lines[2:], [
            "Left out:", "  Node: no koffi", "  bindings.python_notebook, test_a: no VTK",
            "  bindings.python_notebook, test_c: no 'x'", "  io.svg: no rsvg-convert", ""])

    def test_nothing(self):
        self.assertEqual(self.report(("\n", case("vectors.go")))[1][::2], ["Languages tested: Go", "Left out: nothing"])
        self.assertEqual(self.report(), (1, ["Languages tested: unknown, since no tests ran", ""]))


if __name__ == "__main__":
    unittest.main()
