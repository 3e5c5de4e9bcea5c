# SPDX-License-Identifier: Apache-2.0
"""The table of options: help, manual page, completions, refusals."""
import os
import re
import shutil
import subprocess
import unittest

from command import SOURCE, Case, run

COMMANDS = ["slice", "mesh", "render", "model", "info", "stats", "query", "struts", "calibrate"]


def options_of(command):
    return set(re.findall(r"^ +(?:-\w, )?(--[\w-]+)", run(command, "--help").stdout, re.M))


class Texts(Case):
    def test_files_in_the_tree_are_what_the_program_prints(self):
        for arguments, path in ((["--man"], "docs/man/msq.1"),
                                (["--completion", "bash"], "tools/command/completion/msq.bash"),
                                (["--completion=zsh"], "tools/command/completion/_msq")):
            self.assertEqual(self.msq(*arguments), (SOURCE / path).read_text(encoding="utf-8"),
                             f"{path} is stale: msq {' '.join(arguments)} > {path}")

    def test_help_names_everything(self):
        text = self.msq("--help")
        for command in COMMANDS:
            self.assertRegex(text, rf"(?m)^  {command} +\w")
            self.assertIn(f"usage: msq {command}", self.msq(command, "--help"))
            self.assertIn("--threads", options_of(command))
            for line in self.msq(command, "-h").split("\n"):
                if " msq " not in line:  # an example
                    self.assertLessEqual(len(line), 80, line)
        self.assertRegex(self.msq("--version"), r"^msq \d+\.\d+\.\d+\n$")
        self.assertEqual(self.msq("-V"), self.msq("--version"))

    def test_the_manual_page_has_all_options(self):
        page = (SOURCE / "docs/man/msq.1").read_text(encoding="utf-8").replace("\\-", "-")
        for command in COMMANDS:
            self.assertIn(f".SS msq {command}", page)
            for option in options_of(command):
                self.assertIn(f"\\fB{option}\\fR", page)

    @unittest.skipUnless(shutil.which("groff"), "no groff")
    def test_the_manual_page_is_sound(self):
        # Leaks of groff are not ours, so it runs without the sanitizer.
        alone = {name: value for name, value in os.environ.items() if name != "LD_PRELOAD"}
        done = subprocess.run(["groff", "-man", "-ww", "-Tutf8", SOURCE / "docs/man/msq.1"],
                              capture_output=True, text=True, timeout=60, env=alone)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("calibrate", done.stdout)

    def test_documents_name_only_options_that_there_are(self):
        text = (SOURCE / "docs/command.md").read_text(encoding="utf-8")
        known = set().union(*map(options_of, COMMANDS), {"--man", "--completion", "--version"})
        self.assertEqual(set(re.findall(r"(?<![\w-])--[a-z][\w-]+", text)) - known, set())


class Completion(Case):
    def complete(self, *words):
        script = (f". {SOURCE}/tools/command/completion/msq.bash; COMP_WORDS=(\"$@\"); "
                  "COMP_CWORD=$(($# - 1)); _msq; printf '%s\\n' \"${COMPREPLY[@]}\"")
        done = subprocess.run(["bash", "-c", script, "bash", *words], capture_output=True, text=True,
                              timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.split()

    def test_bash(self):
        self.assertEqual(self.complete("msq", "s"), ["slice", "stats", "struts"])
        self.assertEqual(self.complete("msq", "calibrate", "--fra"), ["--fraction"])
        self.assertEqual(self.complete("msq", "mesh", "x.stl", "--lattice", "k"), ["kelvin"])
        self.assertEqual(self.complete("msq", "mesh", "x.stl", "--up", "-"), ["-x", "-y", "-z"])
        self.assertEqual(self.complete("msq", "mesh", "x.stl", "--radius", ""), [])
        for command in COMMANDS:
            self.assertEqual(set(self.complete("msq", command, "--")), options_of(command))

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh_reads_its_completion(self):
        done = subprocess.run(["zsh", "-n", SOURCE / "tools/command/completion/_msq"],
                              capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Refusals(Case):
    def test_usage(self):
        box = "box:4,4,4"
        out = ["--pitch", "1", "-o", self.folder / "x.stl"]
        for text, arguments in (
                ("a command is missing", []),
                ("'frob' is no command", ["frob"]),
                ("'--frob' is no option", ["--frob"]),
                ("'fish' is none of bash, zsh", ["--completion", "fish"]),
                ("MODEL", ["mesh"]),
                ("--frob", ["mesh", box, "--frob", *out]),
                ("extra", ["mesh", box, "extra", *out]),
                ("needs --output", ["mesh", box, "--pitch", "1"]),
                ("needs --pitch", ["mesh", box, "-o", "x.stl"]),
                ("--pitch: 'x1' is not a number", ["mesh", box, "--pitch", "x1", "-o", "x.stl"]),
                ("--pitch: '1e999' is not a number",
                 ["mesh", box, "--pitch", "1e999", "-o", "x.stl"]),
                ("--pitch: 'nan' is not a number", ["mesh", box, "--pitch", "nan", "-o", "x.stl"]),
                ("--pitch: '1,5' is not a number", ["mesh", box, "--pitch", "1,5", "-o", "x.stl"]),
                ("--output: 'x.obj' ends neither", ["mesh", box, "--pitch", "1", "-o", "x.obj"]),
                ("'box:1,2' is no box", ["mesh", "box:1,2", *out]),
                ("'box:1,-2,3' is no box", ["mesh", "box:1,-2,3", *out]),
                ("--unit: does not apply to a box", ["mesh", box, "--unit", "mm", *out]),
                ("--unit: 'mile' is none of um, mm", ["info", "x.stl", "--unit", "mile"]),
                ("--up: 'w' is none of x, -x, y", ["info", "x.stl", "--up", "w"]),
                ("--threads: '-1' is not a whole number from 0 to 1024",
                 ["mesh", box, "--threads", "-1", *out]),
                ("--threads: '5000' is not a whole number from 0 to 1024",
                 ["mesh", box, "--threads", "5000", *out]),
                ("--memory: '4X' is not a size", ["mesh", box, "--memory", "4X", *out]),
                ("--box: '1,2' has 2 numbers, and must have 6",
                 ["mesh", box, "--box", "1,2", *out]),
                ("along y 5 is not below 4", ["mesh", box, "--box", "0,5,0,4,4,4", *out]),
                ("--lattice: 'cheese' is none of cubic", ["mesh", box, "--lattice", "cheese", *out]),
                ("--lattice: needs --cell", ["mesh", box, "--lattice", "bcc", *out]),
                ("--lattice: needs --radius", ["mesh", box, "--lattice", "bcc", "--cell", "2", *out]),
                ("--foam: needs --radius", ["mesh", box, "--foam", "2", *out]),
                ("--lattice: does not go with --foam",
                 ["mesh", box, "--foam", "2", "--lattice", "bcc", *out]),
                ("--level: does not go with --foam",
                 ["mesh", box, "--foam", "2", "--level", "1", *out]),
                ("--radius: needs a structure", ["mesh", box, "--radius", "2", *out]),
                ("--thickness: does not go with --level",
                 ["mesh", box, "--function", "gyroid", "--cell", "2", "--level", "1",
                  "--thickness", "1", *out]),
                ("--cell: does not go with --waves",
                 ["mesh", box, "--waves", "2", "--cell", "2", *out]),
                ("--volume-fraction: does not go with --level",
                 ["mesh", box, "--waves", "2", "--level", "1", "--volume-fraction", "0.5", *out]),
                ("--sheet: needs --level or --volume-fraction",
                 ["mesh", box, "--waves", "2", "--sheet", *out]),
                ("--volume-fraction: 0 is not above 0",
                 ["mesh", box, "--waves", "2", "--volume-fraction", "0", *out]),
                ("--cones: '1,2' has 2 numbers, and must have 3",
                 ["mesh", box, "--waves", "2", "--cones", "1,2", *out]),
                ("--what: 'colour' is none of", ["query", box, "-", "--what", "colour"]),
                ("--channels: needs --what material", ["query", box, "-", "--channels", "a"]),
                ("--channels: has 'a' twice",
                 ["query", box, "-", "--what", "material", "--channels", "a,b,a"]),
                ("--channels: 'material' is the name of another column",
                 ["query", box, "-", "--what", "material", "--channels", "a,material"]),
                ("--channels: 'x' is the name of another column",
                 ["query", box, "-", "--what", "material", "--channels", "x"]),
                ("--direction: needs --two-point", ["stats", box, "--direction", "1,0,0"]),
                ("--direction: '0,0,-0' has no direction",
                 ["stats", box, "--direction", "0,0,-0", "--two-point", "1"]),
                ("MODEL: '' is no name of a file", ["info", ""]),
                ("MODEL: '' is no name of a file", ["calibrate", "", "-f", "0.1"]),
                ("POINTS: '' is no name of a file", ["query", box, ""]),
                ("--output: '' is no name of a file", ["slice", box, "-p", "1", "-l", "1", "-o", ""]),
                ("--pitch: the value behind = is missing", ["mesh", box, "--pitch=", "1", *out]),
                ("--box: the value behind = is missing", ["stats", box, "--box="]),
                ("--density: 0 is below 1 seed in a cell",
                 ["mesh", box, "--foam", "2", "--radius", "0.2", "--density", "0", *out]),
                ("--density: 0.5 is below 1",
                 ["calibrate", "--foam", "2", "--density", "0.5", "-f", "0.2"]),
                ("--pitch: '1,0' is not above 0",
                 ["slice", box, "-p", "1,0", "-l", "1", "-o", "layers/"]),
                ("--output: layers do not go to standard output",
                 ["slice", box, "-p", "1", "-l", "1", "-o", "-"]),
                ("--thickness: does not go with --radius here",
                 ["calibrate", "--foam", "2", "--radius", "1", "--thickness", "1", "-f", "0.2"]),
                ("--channels: 'a?' is no name",
                 ["query", box, "-", "--what", "material", "--channels", "a\t"]),
                ("--self-intersections: needs a file", ["info", box, "--self-intersections"]),
                ("--count: '99999999999' is not a whole number from 0 to 4294967295",
                 ["mesh", box, "--waves", "2", "--count", "99999999999", *out]),
                ("'--completionx' is no option", ["--completionx", "bash"]),
                ("'x.txt' ends neither in .csv nor in .npy", ["query", box, "x.txt"]),
                ("--samples: '1' is not a whole number from 2 to 1000000000000",
                 ["stats", box, "--samples", "1"]),
                ("--samples: '17' is not a whole number from 1 to 16",
                 ["render", box, "-o", "x.png", "--samples", "17"]),
                ("--fade: '4294967296' is not a whole number from 0 to 4294967295",
                 ["slice", box, "-l", "1", "-o", "x.sl1", "--panel", "9,9", "--panel-size", "9,9",
                  "--fade", "4294967296"]),
                ("--region: '4097' is not a whole number from 0 to 4096",
                 ["struts", SOURCE / "examples/models/scales.json", "--region", "4097"]),
                ("--two-point: '1:2' is not FIRST:LAST:COUNT", ["stats", box, "--two-point", "1:2"]),
                ("msq struts needs --foam or --lattice", ["struts", box]),
                ("needs --fraction", ["calibrate", "--foam", "2"]),
                ("msq calibrate needs --foam", ["calibrate", "--fraction", "0.5"]),
                ("'x.json' is a model file already", ["model", "x.json"]),
                ("'x.txt' does not end in .json", ["model", box, "-o", "x.txt"]),
                ("--any-files: is for model files", ["mesh", box, "--any-files", *out]),
                ("--foam: does not apply to a model file", ["info", "x.json", "--foam", "2"]),
                ("--up: does not apply to a model file", ["info", "x.json", "--up", "x"]),
                ("--skin: has no meaning here",
                 ["calibrate", "--foam", "2", "--skin", "1", "--fraction", "0.5"]),
                ("--size: a side of '0,9'", ["render", box, "-o", "x.png", "--size", "0,9"]),
                ("--zoom: 0 is not above 0", ["render", box, "-o", "x.png", "--zoom", "0"]),
                ("--glass: does not go with --plain",
                 ["render", box, "-o", "x.png", "--glass", "--plain"]),
                ("does not end in .png", ["render", box, "-o", "x.jpg"]),
        ):
            self.refuse(2, text, *arguments, cwd=self.folder)
        self.assertEqual(self.names(), [])

    def test_failures_have_the_value_and_the_limit(self):
        out = ["--pitch", "1", "-o", self.folder / "x.stl"]
        foam = ["mesh", "box:40,40,40", "--foam", "2", *out]
        self.refuse(1, "no_such.stl", "info", "no_such.stl", cwd=self.folder)
        self.refuse(1, "a?b.stl", "info", "a\nb.stl", cwd=self.folder)  # a line, whatever the name
        self.refuse(1, "99", *foam, "--radius", "99")
        self.refuse(1, "102400", *foam, "--radius", "0.2", "--memory", "100K")
        self.refuse(1, "the limit is 2147483392", "mesh", "box:4e9,4,4", "--pitch", "1e-7", "-o",
                    self.folder / "x.stl")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
