# SPDX-License-Identifier: Apache-2.0
"""The declarations of msq_io.h. Made from it by make_bindings.py: change those."""
from ctypes import (POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_size_t, c_uint32,
                    c_uint64, c_uint8, c_void_p)

from ._abi import (msq_file_part, msq_job, msq_layer, msq_mesh_def, msq_model, msq_slicer,
                   msq_slicer_def, msq_strut_graph, msq_surface_def)

MSQ_IO_SVG_STACK = 1
MSQ_IO_SVG_FILES = 2


class msq_io_file(Structure):
    """Opaque."""


class msq_io_writer(Structure):
    """Opaque."""


class msq_io_writer_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_uint32), ("threads", c_uint32),
                ("replace", c_int32), ("queue_bytes", c_uint64), ("first_layer", c_uint64),
                ("layer_count", c_uint64)]


class msq_io_writer_report(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("layer_count", c_uint64),
                ("written_count", c_uint64), ("bytes", c_uint64), ("peak_queue_bytes", c_uint64)]


class msq_io_png_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("level", c_int32), ("digits", c_uint32),
                ("prefix", c_char_p)]


class msq_io_panel_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("portrait", c_int32), ("pixels", c_uint32 * 2),
                ("size", c_double * 2), ("mirror", c_int32 * 2)]


class msq_io_sl1_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("level", c_int32), ("faded_layers", c_uint32),
                ("panel", POINTER(msq_io_panel_def)), ("job", c_char_p),
                ("exposure_time", c_double), ("initial_exposure_time", c_double),
                ("fast_tilt_time", c_double), ("slow_tilt_time", c_double), ("area_fill", c_double),
                ("printer_model", c_char_p), ("printer_variant", c_char_p), ("material", c_char_p),
                ("settings", c_char_p), ("created", c_int64), ("layer_height", c_double),
                ("thumbnail_model", POINTER(msq_model))]


class msq_io_svg_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("layout", c_int32), ("units", c_double),
                ("decimals", c_uint32), ("digits", c_uint32), ("prefix", c_char_p)]


class msq_io_beams_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("clipping", c_int32), ("mesh", POINTER(msq_mesh_def))]


class msq_io_slices_def(Structure):
    _fields_ = [("struct_size", c_uint32), ("reserved", c_uint32), ("units", c_double),
                ("layer_height", c_double)]


# name: [result, arguments ...]
FUNCTIONS = {
    "msq_io_version": [c_uint32],
    "msq_io_error_message": [c_char_p],
    "msq_io_file_create": [c_int32, c_char_p, c_int32, POINTER(POINTER(msq_io_file))],
    "msq_io_file_write": [c_int32, POINTER(msq_io_file), c_void_p, c_uint64],
    "msq_io_file_part": [c_int32, c_void_p, POINTER(msq_file_part)],
    "msq_io_file_finish": [c_int32, POINTER(msq_io_file)],
    "msq_io_file_release": [None, POINTER(msq_io_file)],
    "msq_io_writer_def_init": [c_int32, POINTER(msq_io_writer_def), c_size_t],
    "msq_io_writer_layer": [c_int32, c_void_p, POINTER(msq_layer)],
    "msq_io_writer_finish": [c_int32, POINTER(msq_io_writer)],
    "msq_io_writer_info": [c_int32, POINTER(msq_io_writer), POINTER(msq_io_writer_report)],
    "msq_io_writer_release": [None, POINTER(msq_io_writer)],
    "msq_io_png_def_init": [c_int32, POINTER(msq_io_png_def), c_size_t],
    "msq_io_png_create": [c_int32, POINTER(msq_slicer), c_char_p, POINTER(msq_io_writer_def),
                          POINTER(msq_io_png_def), POINTER(POINTER(msq_io_writer))],
    "msq_io_picture_save": [c_int32, c_char_p, c_uint32, c_uint32, c_uint32, POINTER(c_uint8),
                            c_uint64, c_int32],
    "msq_io_panel_def_init": [c_int32, POINTER(msq_io_panel_def), c_size_t],
    "msq_io_panel_plan": [c_int32, POINTER(msq_model), POINTER(msq_io_panel_def),
                          POINTER(msq_slicer_def)],
    "msq_io_sl1_def_init": [c_int32, POINTER(msq_io_sl1_def), c_size_t],
    "msq_io_sl1_create": [c_int32, POINTER(msq_slicer), c_char_p, POINTER(msq_io_writer_def),
                          POINTER(msq_io_sl1_def), POINTER(POINTER(msq_io_writer)),
                          POINTER(msq_job)],
    "msq_io_svg_def_init": [c_int32, POINTER(msq_io_svg_def), c_size_t],
    "msq_io_svg_create": [c_int32, POINTER(msq_slicer), c_char_p, POINTER(msq_io_writer_def),
                          POINTER(msq_io_svg_def), POINTER(POINTER(msq_io_writer))],
    "msq_io_surface_save": [c_int32, POINTER(msq_model), POINTER(msq_surface_def), c_int32,
                            c_char_p, c_int32, POINTER(msq_job)],
    "msq_io_beams_def_init": [c_int32, POINTER(msq_io_beams_def), c_size_t],
    "msq_io_beams_save": [c_int32, POINTER(msq_strut_graph), POINTER(msq_io_beams_def), c_char_p,
                          c_int32],
    "msq_io_slices_def_init": [c_int32, POINTER(msq_io_slices_def), c_size_t],
    "msq_io_slices_create": [c_int32, POINTER(msq_slicer), c_char_p, POINTER(msq_io_writer_def),
                             POINTER(msq_io_slices_def), POINTER(POINTER(msq_io_writer))],
}
