# SPDX-License-Identifier: Apache-2.0
"""Files are whole or absent: after signals, on full disks, where nothing may be written. Progress is
for terminals."""
import json
import os
import pathlib
import pty
import re
import resource
import select
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np
from command import PROGRAM, TIMEOUT, Case

BOX = "box:20,20,20"
FOAM = ["--foam", "2", "--radius", "0.3"]
# Each takes minutes where nothing stops it.
LONG = {
    "slice": ["slice", "box:60,60,60", *FOAM, "-p", "0.01", "-l", "0.01", "-o"],
    "svg": ["slice", "box:60,60,60", *FOAM, "-p", "0.1", "-l", "0.001", "-o"],
    "mesh": ["mesh", "box:90,90,90", *FOAM, "--pitch", "0.02", "-o"],
    "render": ["render", "box:90,90,90", *FOAM, "--size", "9000,9000", "-o"],
    "stats": ["stats", "box:90,90,90", *FOAM, "--samples", "10000000000", "-o"],
    "struts": ["struts", "box:900,900,900", "--foam", "2", "--radius", "0.3", "-o"],
}


def limit_files(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


@unittest.skipUnless(os.path.exists("/proc/self/status"), "no /proc")
class Signals(Case):
    def start(self, *arguments, **options):
        return subprocess.Popen([PROGRAM, *map(str, arguments)], stderr=subprocess.PIPE, text=True,
                                stdout=subprocess.DEVNULL, **options)

    def wait(self, process):
        """Until the command catches signals, and a little longer, so that work has begun."""
        end = time.monotonic() + TIMEOUT
        while time.monotonic() < end:
            status = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
            caught = int(re.search(r"SigCgt:\s*([0-9a-f]+)", status)[1], 16)
            if caught >> (signal.SIGTERM - 1) & 1:
                break
            time.sleep(0.01)
        time.sleep(0.15)
        self.assertIsNone(process.poll(), process.stderr.read() if process.poll() else "")

    def stop(self, process, number, status):
        """Waits until the work has begun, then sends a signal."""
        self.wait(process)
        process.send_signal(number)
        _, text = process.communicate(timeout=TIMEOUT)
        self.assertEqual((process.returncode, text), (status, "msq: interrupted\n"))

    def test_ctrl_c_leaves_nothing(self):
        outputs = {"slice": "layers/", "svg": "a.svg", "mesh": "a.stl", "render": "a.png",
                   "stats": "a.txt", "struts": "a.csv"}
        for name, output in outputs.items():
            with self.subTest(name):
                process = self.start(*LONG[name], self.folder / output)
                self.stop(process, signal.SIGINT, 130)
                self.assertEqual(self.names(), [])

    def test_other_signals(self):
        for number, status in ((signal.SIGTERM, 143), (signal.SIGHUP, 129)):
            self.stop(self.start(*LONG["mesh"], self.folder / "a.stl"), number, status)
        self.assertEqual(self.names(), [])

    def test_an_existing_file_stays(self):
        path = self.folder / "a.stl"
        path.write_text("what was there")
        self.stop(self.start(*LONG["mesh"], path), signal.SIGINT, 130)
        self.assertEqual(self.names(), ["a.stl"])
        self.assertEqual(path.read_text(), "what was there")

    def test_while_it_waits_for_points(self):
        process = self.start("query", BOX, "-", "-o", self.folder / "a.npy", stdin=subprocess.PIPE)
        self.stop(process, signal.SIGINT, 130)
        self.assertEqual(self.names(), [])

    def test_while_it_waits_for_the_other_end(self):
        fifo = self.folder / "fifo.csv"
        os.mkfifo(fifo)
        for arguments in (["query", BOX, fifo], ["struts", BOX, *FOAM, "-o", fifo]):
            self.stop(self.start(*arguments), signal.SIGTERM, 143)
        self.assertEqual(self.names(), ["fifo.csv"])

    def test_an_ignored_signal_stays_ignored(self):
        process = self.start(*LONG["mesh"], self.folder / "a.stl",
                             preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        self.wait(process)
        process.send_signal(signal.SIGHUP)
        time.sleep(0.2)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=TIMEOUT)
        self.assertEqual(process.returncode, 143)


class Disks(Case):
    def test_a_full_disk(self):
        points = self.folder / "points.npy"
        np.save(points, np.zeros((50000, 3)))
        for output, arguments in (
                ("layers/", ["slice", BOX, *FOAM, "-p", "0.05", "-l", "0.4", "-o"]),
                ("a.svg", ["slice", BOX, *FOAM, "-p", "0.1", "-l", "0.4", "-o"]),
                ("a.sl1", ["slice", BOX, *FOAM, "-l", "0.4", "--no-thumbnails",
                           "-o"]),
                ("a.ply", ["mesh", BOX, *FOAM, "-p", "0.5", "-o"]),
                ("a.png", ["render", BOX, *FOAM, "--size", "300,300", "--samples", "1", "-o"]),
                ("a.csv", ["struts", BOX, *FOAM, "-o"]),
                ("a.jsonl", ["struts", BOX, *FOAM, "-o"]),
                ("a.csv", ["query", BOX, points, "-o"]),
                ("a.npy", ["query", BOX, points, "-o"]),
                ("a.json", ["calibrate", *FOAM, "--fraction", "0.1", "--curve", "4096", "--json",
                            "-o"])):
            with self.subTest(output):
                self.refuse(1, "File too large", *arguments, self.folder / output,
                            preexec_fn=limit_files(4096))
                self.assertEqual(self.names(), ["points.npy"])

    def test_standard_output_that_is_full_or_closed(self):
        with open("/dev/full", "w", encoding="ascii") as full:
            done = subprocess.run([PROGRAM, "--help"], stdout=full, stderr=subprocess.PIPE,
                                  text=True, timeout=TIMEOUT)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "msq: standard output: No space left on device\n"))
        done = subprocess.run(["bash", "-c", '"$0" --help | exec 0<&-; exit ${PIPESTATUS[0]}',
                               PROGRAM], stderr=subprocess.PIPE, text=True, timeout=TIMEOUT)
        self.assertIn((done.returncode, done.stderr),
                      [(1, "msq: standard output: Broken pipe\n"), (0, "")])

    def test_paths_that_cannot_be_written(self):
        (self.folder / "folder.stl").mkdir()
        for text, output in (("no_such/a.stl", "no_such/a.stl"), ("folder.stl", "folder.stl")):
            self.refuse(1, text, "mesh", BOX, "--pitch", "4", "-o", self.folder / output)
        self.refuse(1, "directory", "info", "-o", self.folder)
        self.assertEqual(self.names(), ["folder.stl"])

    def test_a_folder_of_an_earlier_run_stays(self):
        path = self.folder / "layers"
        plan = ("-p", "1", "-l", "0.5", "-o", path)
        self.msq("slice", "box:4,4,4", *plan)
        (path / "layer00005.png").unlink()
        (path / "layer00005.png" / "in the way").mkdir(parents=True)
        before = {name: (self.folder / name).read_bytes() for name in self.names() if name[-6:] in
                  ("00.png", "04.png", "06.png")}
        names = self.names()
        self.refuse(1, "layer00005.png", "slice", "box:2,2,4", *plan)
        self.assertEqual(self.names(), names)
        for name, data in before.items():
            self.assertEqual((self.folder / name).read_bytes(), data)
        shutil.rmtree(path / "layer00005.png")
        self.msq("slice", "box:2,2,4", *plan)
        self.assertEqual(len(self.names()), 9)
        self.assertTrue(all((self.folder / name).read_bytes() != data for name, data in
                            before.items()))

    def test_an_existing_file_is_replaced_and_a_link_followed(self):
        link, path = self.folder / "link.json", self.folder / "real.json"
        path.write_text("old")
        link.symlink_to(path)
        self.msq("info", "--json", "-o", link)
        self.assertTrue(link.is_symlink())
        self.assertIn("version", json.loads(path.read_text()))
        self.msq("info", "--json", "-o", "/dev/null")
        self.assertTrue(os.path.exists("/dev/null") and not os.path.isfile("/dev/null"))


class Streams(Case):
    def test_standard_output_by_its_names(self):
        """Output goes on from where the shell is in its file."""
        path = self.folder / "all.txt"
        plain = self.msq("info")
        for name in ("-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"):
            if not (name == "-" or os.path.exists(name)):
                continue
            script = f'echo before; "$0" info -o {name}; echo behind'
            with path.open("w", encoding="utf-8") as file:
                subprocess.run(["bash", "-c", script, PROGRAM], stdout=file, check=True,
                               timeout=TIMEOUT)
            self.assertEqual(path.read_text(), f"before\n{plain}behind\n", name)
        done = subprocess.run([PROGRAM, "info", "-o", "/dev/stderr"], capture_output=True, text=True,
                              timeout=TIMEOUT)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", plain))

    def test_pipes_with_names(self):
        pipe = self.folder / "pipe.csv"
        os.mkfifo(pipe)
        with subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE, text=True) as reader:
            self.msq("query", BOX, "-", "-o", pipe, input="1,1,1\n")
            self.assertEqual(reader.communicate(timeout=TIMEOUT)[0],
                             "x,y,z,membership\n1,1,1,1\n")


class Terminals(Case):
    def on_terminal(self, *arguments):
        """Standard error of a command that is stopped once it has shown progress."""
        main, other = pty.openpty()
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stderr=other,
                                   stdout=subprocess.DEVNULL)
        os.close(other)
        text, end = b"", time.monotonic() + 20
        while time.monotonic() < end and b"left" not in text:
            if select.select([main], [], [], 0.7)[0]:
                text += os.read(main, 4096)
            elif "--quiet" in arguments:
                break
        process.send_signal(signal.SIGINT)
        process.wait(timeout=TIMEOUT)
        try:
            while True:
                more = os.read(main, 4096)
                if not more:
                    break
                text += more
        except OSError:
            pass  # Linux says so at the end of a terminal
        os.close(main)
        self.assertEqual(process.returncode, 130)
        return text.decode()

    def test_progress_has_rate_and_time_left(self):
        text = self.on_terminal("slice", "box:30,30,30", *FOAM, "-p", "0.05", "-l", "0.001", "-o",
                                self.folder / "layers")
        self.assertRegex(text, r"\rslicing  \d+ %  [\d.]+ layers/s  (\d+:)?\d+:\d\d left\x1b\[K")
        self.assertTrue(text.endswith("\r\x1b[Kmsq: interrupted\r\n"), repr(text[-80:]))

    def test_quiet(self):
        text = self.on_terminal(*LONG["mesh"], self.folder / "a.stl", "--quiet")
        self.assertEqual(text, "msq: interrupted\r\n")


class Warnings(Case):
    def test_a_warning_is_a_line_and_no_failure(self):
        path = self.folder / "open.off"
        path.write_text("OFF\n4 3 0\n0 0 0\n8 0 0\n0 6 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n")
        done = subprocess.run([PROGRAM, "info", path], capture_output=True, text=True,
                              timeout=TIMEOUT)
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"^msq: warning: [^\n]+\n$")
        self.assertIn("closed", done.stdout)
        self.msq("info", path, "--quiet")

    def test_numbers_have_a_point_in_all_locales(self):
        text = self.msq("info", "box:1.5,2,3", env={**os.environ, "LC_ALL": "de_DE.UTF-8"})
        self.assertIn("1.5 2 3", text)


if __name__ == "__main__":
    unittest.main()
