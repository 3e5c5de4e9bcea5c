#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Slices a box of foam with Python's standard library alone, by callback and layer by layer.

    python3 examples/python/slice_ctypes.py [path of libmsq.so.0]

A binding declares every struct of msq.h. This example declares those that it uses, field by field.
"""
import argparse
import sys
from ctypes import (CDLL, CFUNCTYPE, POINTER, Structure, byref, c_char_p, c_double, c_int32,
                    c_size_t, c_uint32, c_uint64, c_void_p, create_string_buffer, sizeof,
                    string_at)

UINT64_MAX = 2**64 - 1
LAYER_BITS = 1


class Neighbourhood(Structure):
    _fields_ = [("origin", c_double * 3), ("cell_size", c_double * 3), ("rotation", c_double * 9)]


class Param(Structure):
    _fields_ = [("value", c_double), ("field", c_void_p)]


class FoamDef(Structure):
    _fields_ = [("struct_size", c_uint32), ("method", c_int32), ("grid", Neighbourhood),
                ("radius", Param), ("jitter", c_double), ("seed", c_uint64), ("density", Param)]


class ScaleDef(Structure):
    _fields_ = [("shape", c_void_p), ("structure", c_void_p)]


class ModelDef(Structure):
    _fields_ = [("struct_size", c_uint32), ("scale_count", c_uint32),
                ("scales", POINTER(ScaleDef)), ("scale_size", c_uint32), ("reserved", c_uint32)]


class SlicerDef(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_int32), ("pitch", c_double * 2),
                ("resolution", c_uint32 * 2), ("layer_height", c_double), ("layer_count", c_uint64),
                ("has_region", c_int32), ("slab_layers", c_uint32), ("region_min", c_double * 3),
                ("region_max", c_double * 3), ("layer_z", POINTER(c_double)),
                ("layer_z_count", c_uint64), ("length_scale", c_double)]


class SlicerReport(Structure):
    _fields_ = [("struct_size", c_uint32), ("slab_layers", c_uint32), ("width", c_uint32),
                ("height", c_uint32), ("layer_count", c_uint64), ("stride", c_uint64),
                ("layer_bytes", c_uint64), ("origin", c_double * 2), ("pitch", c_double * 2)]


class Layer(Structure):
    _fields_ = [("struct_size", c_uint32), ("output", c_int32), ("index", c_uint64),
                ("z", c_double), ("data", c_void_p), ("stride", c_uint64), ("width", c_uint32),
                ("height", c_uint32), ("inside_count", c_uint64)]


LayerFn = CFUNCTYPE(c_int32, c_void_p, POINTER(Layer))


class Error(Exception):
    pass


def load(path):
    """The library, with the arguments of the functions used here declared."""
    lib = CDLL(path)

    def declare(result, name, *arguments):
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments

    handle, out = c_void_p, POINTER(c_void_p)
    declare(c_char_p, "msq_error_message")
    declare(c_char_p, "msq_status_name", c_int32)
    for name in ("msq_foam_def_init", "msq_model_def_init", "msq_slicer_def_init"):
        declare(c_int32, name, c_void_p, c_size_t)
    declare(c_int32, "msq_context_create", c_void_p, out)
    declare(c_int32, "msq_shape_from_box", handle, c_double * 3, c_double * 3, out)
    declare(c_int32, "msq_structure_foam", handle, POINTER(FoamDef), out)
    declare(c_int32, "msq_model_create", handle, POINTER(ModelDef), out)
    declare(c_int32, "msq_slicer_create", handle, POINTER(SlicerDef), out)
    declare(c_int32, "msq_slicer_info", handle, POINTER(SlicerReport))
    declare(c_int32, "msq_slicer_run", handle, c_uint64, c_uint64, LayerFn, c_void_p, c_void_p)
    declare(c_int32, "msq_slice_layer", handle, c_uint64, c_void_p, c_uint64, c_void_p)
    for name in ("context", "shape", "structure", "model", "slicer"):
        declare(None, f"msq_{name}_release", handle)
    return lib


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("library", nargs="?", default="libmsq.so.0",
                        help="path of the shared library (default: libmsq.so.0, from the system)")
    lib = load(parser.parse_args().library)

    def check(status):
        if status != 0:
            name = lib.msq_status_name(status).decode()
            raise Error(f"{name}: {lib.msq_error_message().decode()}")

    def defaults(kind, init):
        definition = kind()
        check(init(byref(definition), sizeof(definition)))
        return definition

    def make(create, *arguments):
        handle = c_void_p()
        check(create(*arguments, byref(handle)))
        return handle

    vector = c_double * 3
    context = make(lib.msq_context_create, None)
    box = make(lib.msq_shape_from_box, context, vector(0, 0, 0), vector(20, 15, 10))

    foam_def = defaults(FoamDef, lib.msq_foam_def_init)
    foam_def.grid.cell_size[:] = 2.5, 2.5, 2.5
    foam_def.radius.value = 0.3
    foam = make(lib.msq_structure_foam, context, byref(foam_def))

    scales = (ScaleDef * 2)(ScaleDef(shape=box), ScaleDef(structure=foam))
    model_def = defaults(ModelDef, lib.msq_model_def_init)
    model_def.scales, model_def.scale_count = scales, len(scales)
    model_def.scale_size = sizeof(ScaleDef)
    model = make(lib.msq_model_create, context, byref(model_def))

    slicer_def = defaults(SlicerDef, lib.msq_slicer_def_init)
    slicer_def.output = LAYER_BITS
    slicer_def.pitch[:] = 0.1, 0.1
    slicer_def.layer_height = 0.2
    slicer = make(lib.msq_slicer_create, model, byref(slicer_def))
    plan = SlicerReport(struct_size=sizeof(SlicerReport))
    check(lib.msq_slicer_info(slicer, byref(plan)))

    streamed, inside = [], 0

    # An exception cannot pass through C: keep it, stop the run by a negative code, raise it after.
    problem = []

    def take(_user, layer):
        nonlocal inside
        try:
            of = layer.contents
            streamed.append(string_at(of.data, of.stride * of.height))  # valid in here only: copied
            inside += of.inside_count
            return 0
        except BaseException as error:
            problem.append(error)
            return -1

    status = lib.msq_slicer_run(slicer, 0, UINT64_MAX, LayerFn(take), None, None)
    if problem:
        raise problem[0]
    check(status)

    buffer = create_string_buffer(plan.layer_bytes)
    different = 0
    for index in range(plan.layer_count):
        check(lib.msq_slice_layer(slicer, index, buffer, len(buffer), None))
        different += buffer.raw != streamed[index]

    for release, handle in ((lib.msq_slicer_release, slicer), (lib.msq_model_release, model),
                            (lib.msq_structure_release, foam), (lib.msq_shape_release, box),
                            (lib.msq_context_release, context)):
        release(handle)

    samples = plan.width * plan.height * plan.layer_count
    print(f"{plan.layer_count} layers of {plan.width} x {plan.height} pixels: "
          f"{100 * inside / samples:.1f} % filled; {different} layers differ between the two ways")
    return 0 if different == 0 and len(streamed) == plan.layer_count and inside > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
