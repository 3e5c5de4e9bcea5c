# SPDX-License-Identifier: Apache-2.0
"""msq as a package of Conan 2, from the sources of the tree that this file is in:

    conan create packaging/conan --build=missing

With libraries of the system instead of packages: -pr packaging/conan/debian12.profile.
"""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load
from conan.tools.gnu import PkgConfigDeps


class MsqConan(ConanFile):
    name = "msq"
    description = "Lattices, TPMS and Voronoi foams inside a part, without meshing them"
    # With with_cgal the binary is under GPL-3.0-or-later: CGAL's triangulations are.
    license = "Apache-2.0"
    topics = ("additive-manufacturing", "lattice", "tpms", "voronoi", "slicing")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    # There is no fPIC: msq is always compiled with it.
    options = {
        "shared": [True, False],
        "with_assimp": [True, False],  # binary STL, 3MF and AMF
        "with_cgal": [True, False],  # foam method 2, self-intersections
        "with_xxhash": [True, False],  # hashes
        "with_json": [True, False],  # documents, glTF
        "with_tiff": [True, False],  # stacks of TIFF in documents
        "tools": [True, False],  # the library msq_io and the command msq
        "with_isal": [True, False],  # fast PNG in msq_io
    }
    default_options = {
        "shared": True,
        "with_assimp": True,
        "with_cgal": False,
        "with_xxhash": True,
        "with_json": True,
        "with_tiff": False,
        "tools": False,
        "with_isal": True,
    }

    def _root(self):
        return os.path.normpath(os.path.join(self.recipe_folder, "..", ".."))

    def set_version(self):
        text = load(self, os.path.join(self._root(), "CMakeLists.txt"))
        self.version = re.search(r"project\(msq VERSION ([\d.]+)", text).group(1)

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "src/*", "tools/*", "bindings/cpp/*",
                        "docs/man/*", "packaging/debian/*"):
            copy(self, pattern, self._root(), self.export_sources_folder)

    def configure(self):
        if not self.options.tools:
            del self.options.with_isal
        if self.options.with_cgal:
            self.output.warning("with_cgal makes the binary GPL-3.0-or-later")

    def requirements(self):
        self.requires("onetbb/[>=2021.5]")
        self.requires("highway/[>=1.0 <2]")
        if self.options.with_assimp:
            self.requires("assimp/[>=5.2 <7]")
            self.requires("pugixml/[>=1.11 <2]")
        if self.options.with_assimp or self.options.tools:
            self.requires("minizip/[>=1.1 <2]")
            self.requires("zlib/[>=1.2.11 <2]")
        if self.options.with_cgal:
            self.requires("cgal/[>=5.4 <7]")
            self.requires("gmp/[>=6.2 <7]")
            self.requires("mpfr/[>=4.1 <5]")
        if self.options.with_xxhash:
            self.requires("xxhash/[>=0.8 <1]")
        if self.options.with_json or self.options.tools:
            self.requires("nlohmann_json/[>=3.10 <4]")
        if self.options.with_tiff:
            self.requires("libtiff/[>=4.5 <5]")
        if self.options.tools:
            self.requires("cli11/[>=2.1 <3]")
            self.requires("libpng/[>=1.6 <2]")
            if self.options.with_isal:
                self.requires("isa-l/[>=2.30 <3]")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        chosen = {
            "MSQ_WITH_ASSIMP": self.options.with_assimp,
            "MSQ_WITH_CGAL": self.options.with_cgal,
            "MSQ_WITH_XXHASH": self.options.with_xxhash,
            "MSQ_WITH_JSON": self.options.with_json,
            "MSQ_BUILD_TOOLS": self.options.tools,
            "MSQ_WITH_ISAL": self.options.get_safe("with_isal", False),
            "MSQ_WITH_TIFF": self.options.with_tiff,
            "MSQ_WITH_PYTHON": False,
            "MSQ_BUILD_EXAMPLES": False,
            "MSQ_BUILD_TESTS": False,
            "MSQ_BUILD_FUZZERS": False,
        }
        for name, value in chosen.items():
            toolchain.cache_variables[name] = bool(value)
        toolchain.generate()
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()  # libhwy, minizip, libisal

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # Programs take the CMake package and the pkg-config files that msq installs.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "msq")]
        self.cpp_info.libs = ["msq_io", "msq"] if self.options.tools else ["msq"]
        if self.settings.os == "Windows" and self.options.shared:
            self.cpp_info.defines = ["MSQ_SHARED"]
        if self.settings.os in ("Linux", "FreeBSD") and not self.options.shared:
            self.cpp_info.system_libs = ["pthread", "m", "stdc++"]
