# SPDX-License-Identifier: Apache-2.0
"""Which library the package loads, and the end of an interpreter."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import msq
from support import SANITIZED


class Loading(unittest.TestCase):
    def load(self, path, **more):
        environment = {**os.environ, "MSQ_LIBRARY": str(path), **more}
        return subprocess.run([sys.executable, "-B", "-c", "import msq; print(msq.__version__)"],
                              env=environment, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)

    def test_takes_the_library_that_is_named(self):
        self.assertEqual(self.load(os.environ["MSQ_LIBRARY"]).stdout, "0.2.0\n")
        missing = self.load("/no/such/libmsq.so")
        self.assertIn("ImportError", missing.stderr)
        self.assertIn("/no/such/libmsq.so", missing.stderr)

    def test_refuses_other_libraries(self):
        import ctypes.util
        other = self.load(ctypes.util.find_library("m"))
        self.assertIn("is not the library of msq", other.stderr)

    def test_takes_the_library_beside_the_package(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder, "msq")
            package.mkdir()
            for file in pathlib.Path(msq.__file__).parent.glob("*.py"):
                (package / file.name).write_bytes(file.read_bytes())
            (package / "libmsq.so.0").symlink_to(os.path.realpath(os.environ["MSQ_LIBRARY"]))
            self.assertEqual(self.load("", PYTHONPATH=folder).stdout, "0.2.0\n")
            (package / "libmsq.so.0").unlink()
            (package / "libmsq.so.0").write_bytes(b"no library")
            self.assertIn("ImportError", self.load("", PYTHONPATH=folder).stderr)

    def test_an_interpreter_ends_with_objects_alive(self):
        program = ("import msq, threading\n"
                   "box = msq.Shape.box((0, 0, 0), (8, 6, 4))\n"
                   "model = msq.Model(box, msq.Foam(cell_size=2, radius=.3))\n"
                   "layers = iter(model.slicer(layer_height=1, pitch=.1)); next(layers)\n"
                   "cycle = [model, layers]; cycle.append(cycle)\n"
                   "print('end')")
        ended = subprocess.run([sys.executable, "-B", "-c", program], text=True, check=False,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "end\n", ""))


if __name__ == "__main__":
    if SANITIZED:
        del Loading.test_refuses_other_libraries  # by another libm than the sanitizer's
    unittest.main()
