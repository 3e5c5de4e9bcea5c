# SPDX-License-Identifier: Apache-2.0
"""The wheel: with the library it names its platform and works alone; without it is pure Python."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

HERE = pathlib.Path(__file__).resolve().parent.parent
TOOLS = all(importlib.util.find_spec(name) for name in ("pip", "setuptools", "wheel"))
USE = ("import msq, pathlib; from msq._library import lib; assert msq.build_info().version; "
       "print(pathlib.Path(lib._name).parent)")
USE_IO = "import msq.io, pathlib; print(pathlib.Path(msq.io._io._name).parent)"


@unittest.skipIf(os.environ.get("MSQ_SANITIZE"), "a sanitized library cannot be loaded alone")
@unittest.skipUnless(TOOLS, "needs pip, setuptools and wheel")
class Wheel(unittest.TestCase):
    def build(self, folder, library):
        source = pathlib.Path(folder) / "source"
        shutil.copytree(HERE, source, ignore=shutil.ignore_patterns("build", "*.egg-info", "tests"))
        environment = {name: value for name, value in os.environ.items()
                       if name not in ("MSQ_LIBRARY", "PYTHONPATH")}
        if library:
            environment["MSQ_LIBRARY"] = library
        else:
            environment.pop("MSQ_IO_LIBRARY", None)
        done = subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps",
                               "--no-index", "-w", folder, str(source)], env=environment,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return next(pathlib.Path(folder).glob("*.whl"))

    def test_carries_the_library_that_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            wheel = self.build(folder, os.environ["MSQ_LIBRARY"])
            self.assertRegex(wheel.name, r"^msq-[\d.]+-py3-none-(?!any)\w+\.whl$")
            site = pathlib.Path(folder) / "site"
            with zipfile.ZipFile(wheel) as archive:
                archive.extractall(site)
            environment = {name: value for name, value in os.environ.items()
                           if name not in ("MSQ_LIBRARY", "MSQ_IO_LIBRARY")}
            environment["PYTHONPATH"] = str(site)
            done = subprocess.run([sys.executable, "-B", "-c", USE], env=environment, cwd=folder,
                                  capture_output=True, text=True, check=False)
            self.assertEqual((done.stdout.strip(), done.stderr), (str(site / "msq"), ""))
            if "MSQ_IO_LIBRARY" in os.environ:
                done = subprocess.run([sys.executable, "-B", "-c", USE_IO], env=environment, cwd=folder,
                                      capture_output=True, text=True, check=False)
                self.assertEqual((done.stdout.strip(), done.stderr), (str(site / "msq"), ""))

    def test_is_pure_without_one(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertTrue(self.build(folder, None).name.endswith("-py3-none-any.whl"))


if __name__ == "__main__":
    unittest.main()
