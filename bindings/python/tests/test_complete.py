# SPDX-License-Identifier: Apache-2.0
"""Nothing that msq.h offers is left out of the package, save what is listed here."""
import ctypes
import dataclasses
import pathlib
import re
import unittest

import msq
from msq import _abi

# Functions that the package has no need of.
NOT_NEEDED = {"msq_status_name": "exceptions have the name",
              "msq_structure_struts": "Structure.strut_graph has the same struts as arrays"}
NOT_NEEDED.update({name: "Python counts its own references" for name in _abi.FUNCTIONS
                   if name.endswith("_retain")})
# Fields that the package has no use for. A loop on threads of Python would hold the interpreter's lock.
# Settings of a document are written by hand or by the command.
FIELDS_NOT_NEEDED = {"msq_json_def.slicing", "msq_json_def.camera", "msq_json_def.render",
                     "msq_context_def.parallel_for", "msq_context_def.parallel_for_user",
                     "msq_context_def.parallel_for_release"}
# Functions, reports, and fields of definitions as "struct.field", still to be bound.
NOT_YET = set()

REPORTS = {"msq_build_report": msq.BuildInfo, "msq_memory_report": msq.MemoryInfo,
           "msq_cache_report": msq.CacheInfo, "msq_shape_report": msq.ShapeInfo,
           "msq_unit_cell_report": msq.UnitCellInfo, "msq_lattice_faces_report": msq.LatticeFaces,
           "msq_job_report": msq.JobInfo, "msq_calibration_report": msq.Calibration,
           "msq_printability_report": msq.Printability}
# Reports that objects hold, as attributes and arrays.
ARRAYS = {"msq_slicer_report", "msq_contours_report", "msq_fill_report",
          "msq_strut_graph_report", "msq_document_report", "msq_beam_file_report"}
DEFINITIONS = {"msq_camera"}  # beside those that end in _def
SET_BY_NAME = {"struct_size", "reserved", "reserved2", "user", "release"}


def package_text():
    folder = pathlib.Path(msq.__file__).parent
    return "\n".join(path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.py"))
                     if path.name != "_abi.py")


class Complete(unittest.TestCase):
    def setUp(self):
        self.text = package_text()

    def missing_functions(self):
        called = set(re.findall(r"\b(?:lib|library)\.(msq_\w+)", self.text))
        called |= {f"{name}_init" for name in
                   re.findall(r"defaults\(_abi\.(msq_\w+)\)", self.text)}
        called |= {f"msq_{kind}_release" for kind in re.findall(r'_kind = "(\w+)"', self.text)}
        return set(_abi.FUNCTIONS) - called - set(NOT_NEEDED)

    def missing_fields(self):
        missing = set()
        for name, kind in vars(_abi).items():
            if name in DEFINITIONS or (name.endswith("_def") and isinstance(kind, type)):
                missing |= {f"{name}.{label}" for label, _ in kind._fields_
                            if label not in SET_BY_NAME
                            and not re.search(rf"\.{label}\b|\b{label}={label}\b|\"{label}\"", self.text)}
        return missing - FIELDS_NOT_NEEDED

    def test_every_function_is_bound(self):
        missing = self.missing_functions()
        self.assertEqual(sorted(missing - NOT_YET), [], "bind them in bindings/python/msq, or list "
                         "them in NOT_YET of test_complete.py")

    def test_every_field_of_definitions_can_be_set(self):
        missing = self.missing_fields()
        self.assertEqual(sorted(missing - NOT_YET), [], "give them keywords in bindings/python/msq,"
                         " or list them in NOT_YET of test_complete.py")

    def test_the_list_of_what_is_not_yet_bound_is_up_to_date(self):
        reports = {name for name in vars(_abi) if name.endswith("_report")} - set(REPORTS)
        missing = self.missing_functions() | self.missing_fields() | reports
        self.assertEqual(sorted(NOT_YET - missing), [])

    def test_reports_are_whole(self):
        for name, kind in vars(_abi).items():
            if not name.endswith("_report") or name in NOT_YET | ARRAYS:
                continue
            self.assertIn(name, REPORTS)
            labels = [label for label, _ in kind._fields_ if label not in SET_BY_NAME]
            fields = [field.name for field in dataclasses.fields(REPORTS[name])]
            self.assertEqual(fields[:len(labels)], labels)

    def test_names_are_exported_and_explained(self):
        for name in msq.__all__:
            self.assertTrue(hasattr(msq, name), name)
            thing = getattr(msq, name)
            if isinstance(thing, type) and thing.__module__.startswith("msq"):
                self.assertTrue(thing.__doc__, name)
                for label, member in vars(thing).items():
                    is_method = callable(member) or isinstance(member, (classmethod, property))
                    if is_method and not label.startswith("_"):
                        self.assertTrue(getattr(thing, label).__doc__, f"{name}.{label}")

    def test_structs_name_their_fields_once(self):
        for name, kind in vars(_abi).items():
            if isinstance(kind, type) and issubclass(kind, ctypes.Structure):
                labels = [label for label, _ in getattr(kind, "_fields_", [])]
                self.assertEqual(len(labels), len(set(labels)), name)


if __name__ == "__main__":
    unittest.main()
