# SPDX-License-Identifier: Apache-2.0
"""_abi.py is what msq.h declares, with the sizes, offsets and values that the C
compiler gives it."""
import ctypes
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from msq import _abi
from support import SOURCE

HEADER = SOURCE / "include" / "msq.h"
MAKE_BINDINGS = SOURCE / "bindings" / "make_bindings.py"


def structs():
    return {name: kind for name, kind in vars(_abi).items()
            if name.startswith("msq_") and isinstance(kind, type)
            and issubclass(kind, ctypes.Structure) and hasattr(kind, "_fields_")}


def constants():
    return {name: value for name, value in vars(_abi).items() if name.startswith("MSQ_")}


class Abi(unittest.TestCase):
    def test_names_the_functions_that_the_header_declares(self):
        sys.path.insert(0, str(SOURCE / "tests" / "header"))
        sys.dont_write_bytecode = True
        from declared import declared_functions
        self.assertEqual(list(_abi.FUNCTIONS), declared_functions(str(HEADER)))

    def test_has_the_layout_that_the_compiler_gives(self):
        lines = ["#include <msq.h>", "#include <stdio.h>", "int main(void) {"]
        expected = []
        for name, kind in structs().items():
            lines.append(f'printf("sizeof {name} %zu\\n", sizeof({name}));')
            expected.append(f"sizeof {name} {ctypes.sizeof(kind)}")
            for label, _ in kind._fields_:
                lines.append(f'printf("{name}.{label} %zu %zu\\n", offsetof({name}, {label}), '
                             f"sizeof((({name}*)0)->{label}));")
                field = getattr(kind, label)
                expected.append(f"{name}.{label} {field.offset} {field.size}")
        for name, value in constants().items():
            lines.append(f'printf("{name} %d\\n", (int){name});')
            expected.append(f"{name} {value}")
        lines += ["return 0;", "}"]
        with tempfile.TemporaryDirectory() as folder:
            source, program = pathlib.Path(folder, "layout.c"), pathlib.Path(folder, "layout")
            source.write_text("\n".join(lines))
            subprocess.run([os.environ.get("CC", "cc"), "-std=c99", f"-I{HEADER.parent}",
                            str(source), "-o", str(program)], check=True)
            environment = {key: value for key, value in os.environ.items() if key != "LD_PRELOAD"}
            printed = subprocess.run([str(program)], stdout=subprocess.PIPE, text=True, check=True,
                                     env=environment).stdout
        self.assertEqual(printed.splitlines(), expected)
        self.assertGreater(len(structs()), 15)

    def test_abi_json_has_the_layout_of_ctypes(self):
        # ... which the test above compares with that of the compiler.
        description = json.loads((SOURCE / "bindings" / "abi.json").read_text(encoding="utf-8"))
        self.assertEqual({one["name"] for one in description["structs"]}, set(structs()))
        for one in description["structs"]:
            kind = structs()[one["name"]]
            self.assertEqual(one["size"], ctypes.sizeof(kind), one["name"])
            self.assertEqual([(field["name"], field["offset"]) for field in one["fields"]],
                             [(label, getattr(kind, label).offset) for label, _ in kind._fields_])

    def test_statuses_have_exceptions(self):
        from msq.errors import BY_STATUS
        self.assertEqual({name: value for name, value in constants().items()
                          if name.startswith("MSQ_E_")}.values() ^ BY_STATUS.keys(), set())


class MakeBindings(unittest.TestCase):
    """What make_bindings.py does not understand it says."""

    def make(self, text):
        with tempfile.TemporaryDirectory() as folder:
            header = pathlib.Path(folder, "odd.h")
            header.write_text(text)
            return subprocess.run([sys.executable, "-B", str(MAKE_BINDINGS), "--header", str(header),
                                   "--output", folder], text=True, stderr=subprocess.PIPE,
                                  check=False)

    def test_refuses_what_it_cannot_read(self):
        good = "typedef int32_t msq_status;\nMSQ_API msq_status msq_f(const double p[3]);\n"
        self.assertEqual(self.make(good).returncode, 0)
        for bad in ("int32_t msq_g(void);", "typedef struct msq_s { int x : 3; } msq_s;",
                    "typedef struct msq_s { bool x; } msq_s;", "typedef union { int x; } msq_u;",
                    "MSQ_API msq_status msq_g(msq_unknown *x);", "enum msq_e { MSQ_A = 1 << 3 };"):
            made = self.make(good + bad)
            self.assertEqual(made.returncode, 1, bad)
            self.assertIn("does not read", made.stderr)


if __name__ == "__main__":
    unittest.main()
