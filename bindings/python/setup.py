# SPDX-License-Identifier: Apache-2.0
"""Builds the wheel. MSQ_LIBRARY names a shared library of msq that the wheel carries, and MSQ_IO_LIBRARY
one of msq_io beside it; its tag then names the platform. Without it the wheel is pure Python, and finds the library of the system."""
import os
import pathlib
import shutil
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    try:
        from wheel.bdist_wheel import bdist_wheel
    except ImportError:
        bdist_wheel = None

LIBRARY = os.environ.get("MSQ_LIBRARY")
IO_LIBRARY = os.environ.get("MSQ_IO_LIBRARY") if LIBRARY else None  # it needs the other


def name_of(library: pathlib.Path) -> str:
    """The name under which the package finds it: libmsq.so.0.2.0 becomes libmsq.so.0."""
    if sys.platform.startswith("linux"):
        return ".".join(library.name.split(".")[:3])
    return library.name


class BuildWithLibrary(build_py):
    def run(self):
        package = pathlib.Path(self.build_lib) / "msq"
        for name in ("*.so*", "*.dylib", "*.dll"):  # of an earlier build
            for old in package.glob(name):
                old.unlink()
        super().run()
        for name in filter(None, (LIBRARY, IO_LIBRARY)):
            library = pathlib.Path(name).resolve()
            shutil.copyfile(library, package / name_of(library))


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return bool(LIBRARY)


commands = {"build_py": BuildWithLibrary}
if bdist_wheel:
    class PlatformWheel(bdist_wheel):
        def get_tag(self):
            python, abi, platform = super().get_tag()
            return ("py3", "none", platform) if LIBRARY else (python, abi, platform)

    commands["bdist_wheel"] = PlatformWheel

setup(cmdclass=commands, distclass=WithLibrary)
