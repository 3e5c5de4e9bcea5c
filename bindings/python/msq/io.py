# SPDX-License-Identifier: Apache-2.0
"""Files of printers and other programs, by the library msq_io that stands beside msq.

    import msq.io
    slicer = model.slicer(layer_height=0.05, pitch=0.05, mirror="y")
    msq.io.save_png(slicer, "layers")                    # a folder
    plan = msq.io.panel_slicer(model, layer_height=0.05)  # for the panel of a resin printer
    msq.io.save_sl1(plan, "part.sl1", thumbnail=model)

Threads of msq_io encode layers while msq computes the next ones; no Python runs in between. A file or
a folder gets its name when it is complete. A failure, an interrupt and a cancelled job leave none.
Existing files are errors, unless replace=True.

The library is the one that the environment variable MSQ_IO_LIBRARY names, one beside this file, one
beside the library of msq, or what the system's loader finds. Importing this module fails if there is
none.
"""
from __future__ import annotations

import ctypes
import dataclasses
import os
import pathlib
import sys
from typing import Any, Callable, List, NamedTuple, Optional, Tuple, Type, Union

import numpy as np

from . import _abi, _io_abi
from ._arrays import pointer, triples, vector
from ._handle import lend
from ._interrupt import interruptible
from ._library import StructT, constant, defaults, lib, raise_error
from .context import Job, c_path, c_text, unsigned
from .errors import BY_STATUS, Error, HostError, naming
from .model import Model
from .slicer import Slicer, list_heights
from .strut_graph import StrutGraph
from .surface import _FORMATS, Box, definition_of

Path = Union[str, "os.PathLike[str]"]


def _candidates() -> List[str]:
    named = os.environ.get("MSQ_IO_LIBRARY")
    if named:
        return [named]
    major = _abi.MSQ_VERSION_MAJOR
    names = (("msq_io.dll", f"msq_io-{major}.dll") if sys.platform == "win32" else
             (f"libmsq_io.{major}.dylib", "libmsq_io.dylib") if sys.platform == "darwin" else
             (f"libmsq_io.so.{major}", "libmsq_io.so"))
    folders = [pathlib.Path(__file__).resolve().parent]
    loaded = pathlib.Path(getattr(lib, "_name", ""))
    if loaded.parent != pathlib.Path():
        folders.append(loaded.parent)
    beside = [str(folder / name) for folder in folders for name in names
              if (folder / name).exists()]
    return beside or list(names)


def _raise_status(status: int, _function: Any, _arguments: Any) -> int:
    if status != _abi.MSQ_OK:
        raise_error(status, _io.msq_io_error_message().decode("utf-8", "replace"))
    return status


def _load() -> ctypes.CDLL:
    problems = []
    for name in _candidates():
        try:
            library = ctypes.CDLL(name)
            break
        except OSError as error:
            problems.append(str(error))
    else:
        raise ImportError("the library msq_io cannot be loaded; MSQ_IO_LIBRARY may name its file: "
                          + "; ".join(problems))
    missing = [name for name in _io_abi.FUNCTIONS if not hasattr(library, name)]
    if missing:
        raise ImportError(f"{library._name} is older than this package or is not msq_io: it has no "
                          + ", ".join(missing))
    for name, (result, *arguments) in _io_abi.FUNCTIONS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments
        if result is ctypes.c_int32:
            function.errcheck = _raise_status
    if library.msq_io_version() // 100 != _abi.MSQ_VERSION // 100:
        raise ImportError(f"{library._name} is of another version than this package")
    # Objects of one library are nothing to another one.
    if ctypes.cast(library.msq_version, ctypes.c_void_p).value != ctypes.cast(
            lib.msq_version, ctypes.c_void_p).value:
        raise ImportError(f"{library._name} uses another library of msq than {lib._name}")
    return library


_io = _load()


def _defaults(kind: Type[StructT]) -> StructT:
    definition = kind()
    getattr(_io, f"{kind.__name__}_init")(ctypes.byref(definition), ctypes.sizeof(definition))
    return definition


class Written(NamedTuple):
    """What was written."""

    layers: int
    bytes: int  #: size of the file, or of all files of the folder
    peak_queue_bytes: int  #: most that waited for threads or the disk


@dataclasses.dataclass(frozen=True)
class Panel:
    """The panel of a resin printer, in PrusaSlicer's terms. The defaults are those of the Original
    Prusa SL1."""

    pixels: Tuple[int, int] = (2560, 1440)  #: along x and y of the model
    size: Tuple[float, float] = (120.96, 68.04)  #: mm, along x and y of the model
    portrait: bool = True  #: x of the model runs along the columns of images
    mirror: Tuple[bool, bool] = (True, False)

    def _definition(self) -> _io_abi.msq_io_panel_def:
        definition = _defaults(_io_abi.msq_io_panel_def)
        definition.pixels[:] = [unsigned(count, 32, "pixels") for count in self.pixels]
        definition.size[:] = self.size
        definition.portrait = bool(self.portrait)
        definition.mirror[:] = [bool(mirror) for mirror in self.mirror]
        return definition


def panel_slicer(model: Model, *, layer_height: Optional[float] = None, layer_z: Any = None,
                 panel: Panel = Panel(), layer_count: int = 0, grey_samples: int = 4,
                 grey_gamma: float = 1.0, grey_threshold: int = 0, slab_layers: int = 0,
                 length_scale: float = 0.0) -> Slicer:
    """A slicer whose images are those of a panel, in grey, with the part in its middle. Other
    arguments as of Slicer."""
    definition = defaults(_abi.msq_slicer_def)
    if layer_height is not None:
        definition.layer_height = layer_height
    heights = list_heights(definition, layer_z)  # kept until the slicer is made
    definition.layer_count = unsigned(layer_count, 64, "layer_count")
    definition.grey_samples = unsigned(grey_samples, 32, "grey_samples")
    definition.grey_gamma = grey_gamma
    definition.grey_threshold = unsigned(grey_threshold, 32, "grey_threshold")
    definition.slab_layers = unsigned(slab_layers, 32, "slab_layers")
    definition.length_scale = length_scale
    given = panel._definition()
    _io.msq_io_panel_plan(model._ref, ctypes.byref(given), ctypes.byref(definition))
    return Slicer._of_definition(model, definition)


class _Options(NamedTuple):
    """What writers of all formats take."""

    output: int
    threads: int
    queue_bytes: Optional[int]
    first: int
    count: Optional[int]
    replace: bool
    job: Optional[Job]


def _write(slicer: Slicer, options: _Options, create: Callable[..., None]) -> Written:
    """create(slicer, definition of the writer, new writer, job); then the run."""
    if not isinstance(slicer, Slicer):
        raise TypeError(f"slicer is a {type(slicer).__name__}; it must be a Slicer")
    first, last = slicer._range(options.first, options.count)
    definition = _defaults(_io_abi.msq_io_writer_def)
    definition.output = unsigned(options.output, 32, "output")
    definition.threads = unsigned(options.threads, 32, "threads")
    if options.queue_bytes is not None:
        definition.queue_bytes = unsigned(options.queue_bytes, 64, "queue_bytes")
    definition.first_layer, definition.layer_count = first, last - first
    definition.replace = bool(options.replace)
    reference = slicer._ref
    writer = ctypes.POINTER(_io_abi.msq_io_writer)()
    report = _io_abi.msq_io_writer_report()
    report.struct_size = ctypes.sizeof(report)

    def call(work: Any) -> None:
        try:
            create(reference, ctypes.byref(definition), ctypes.byref(writer), work)
            # C calls the writer: Python has no part in the run.
            take = ctypes.cast(_io.msq_io_writer_layer, _abi.msq_layer_fn)
            failure = None
            try:
                lib.msq_slicer_run(reference, first, last - first, take, writer, work)
            except HostError as error:  # of the writer, which says more, or of an object of a host
                failure = error
            try:
                _io.msq_io_writer_finish(writer)
            except Error as error:
                if failure is not None and BY_STATUS.get(failure.code) is not type(error):
                    raise failure from None
                raise
            _io.msq_io_writer_info(writer, ctypes.byref(report))
        finally:
            _io.msq_io_writer_release(writer)

    interruptible(call, options.job)
    return Written(report.layer_count, report.bytes, report.peak_queue_bytes)


def save_png(slicer: Slicer, folder: Path, *, level: int = 0, digits: int = 5,
             prefix: str = "layer", output: int = 0, threads: int = 0,
             queue_bytes: Optional[int] = None, first: int = 0, count: Optional[int] = None,
             replace: bool = False, job: Optional[Job] = None) -> Written:
    """Writes a folder with a PNG for each layer: layer00000.png and so on. Layers of bits become
    images of 1 bit, bytes and grey of 8; row 0 is on top, so a slicer with mirror="y" has y upwards.

    level: 0 is the fastest way to compress, 1 to 9 are levels of zlib. digits, prefix: of the names.
    output: which of several outputs of the slicer. first, count: of the layers; parts of a stack may
    be written to one folder. threads: that encode; 0: one per core. queue_bytes: of layers that wait.
    """
    definition = _defaults(_io_abi.msq_io_png_def)
    definition.level = unsigned(level, 31, "level")
    definition.digits = unsigned(digits, 32, "digits")
    definition.prefix = c_text(prefix, "prefix")
    path = c_path(folder)
    with naming(folder):
        return _write(slicer, _Options(output, threads, queue_bytes, first, count, replace, job),
                      lambda given, common, made, _job: _io.msq_io_png_create(
                          given, path, common, ctypes.byref(definition), made))


def save_sl1(slicer: Slicer, path: Path, *, panel: Panel = Panel(), level: int = 0,
             name: str = "part", exposure_time: float = 8.0, initial_exposure_time: float = 35.0,
             faded_layers: int = 10, fast_tilt_time: float = 5.0, slow_tilt_time: float = 8.0,
             area_fill: float = 50.0, printer_model: str = "SL1", printer_variant: str = "default",
             material: str = "", settings: str = "", created: int = 0, layer_height: float = 0.0,
             thumbnail: Optional[Model] = None, output: int = 0, threads: int = 0,
             queue_bytes: Optional[int] = None, first: int = 0, count: Optional[int] = None,
             replace: bool = False, job: Optional[Job] = None) -> Written:
    """Writes an SL1 archive for a resin printer, from layers that panel_slicer planned for the same
    panel.

    name: of the job, which names of layers begin with. Times in seconds. thumbnail: the model of
    which thumbnails are drawn. settings: more lines `key = value` of prusaslicer.ini. created:
    seconds since 1970 UTC; 0: those of 1980, so that equal layers make equal files. The rest as in
    save_png and msq_io_sl1_def.
    """
    definition = _defaults(_io_abi.msq_io_sl1_def)
    of_panel = panel._definition()
    definition.panel = ctypes.pointer(of_panel)
    definition.level = unsigned(level, 31, "level")
    definition.job = c_text(name, "name")
    definition.exposure_time = exposure_time
    definition.initial_exposure_time = initial_exposure_time
    definition.faded_layers = unsigned(faded_layers, 32, "faded_layers")
    definition.fast_tilt_time = fast_tilt_time
    definition.slow_tilt_time = slow_tilt_time
    definition.area_fill = area_fill
    definition.printer_model = c_text(printer_model, "printer_model")
    definition.printer_variant = c_text(printer_variant, "printer_variant")
    definition.material = c_text(material, "material")
    definition.settings = c_text(settings, "settings")
    definition.created = unsigned(created, 63, "created")
    definition.layer_height = layer_height
    if thumbnail is not None:
        lend(definition, "thumbnail_model", thumbnail)
    file = c_path(path)
    with naming(path):
        return _write(slicer, _Options(output, threads, queue_bytes, first, count, replace, job),
                      lambda given, common, made, work: _io.msq_io_sl1_create(
                          given, file, common, ctypes.byref(definition), made, work))


def save_svg(slicer: Slicer, path: Path, *, layout: str = "stack", units: float = 1.0,
             decimals: int = 4, digits: int = 5, prefix: str = "layer", output: int = 0,
             threads: int = 0, queue_bytes: Optional[int] = None, first: int = 0,
             count: Optional[int] = None, replace: bool = False,
             job: Optional[Job] = None) -> Written:
    """Writes contours as SVG: one file with a group for each layer (`stack`), as Slic3r has it, or a
    folder with a file for each (`files`).

    The slicer has an Output of contours; output says which. units: those of the contours, by which
    coordinates are divided. decimals: digits behind the point. The rest as in save_png.
    """
    definition = _defaults(_io_abi.msq_io_svg_def)
    layouts = {"stack": _io_abi.MSQ_IO_SVG_STACK, "files": _io_abi.MSQ_IO_SVG_FILES}
    if layout not in layouts:
        raise ValueError(f"layout is {layout!r}; it must be 'stack' or 'files'")
    definition.layout = layouts[layout]
    definition.units = units
    definition.decimals = unsigned(decimals, 32, "decimals")
    definition.digits = unsigned(digits, 32, "digits")
    definition.prefix = c_text(prefix, "prefix")
    name = c_path(path)
    with naming(path):
        return _write(slicer, _Options(output, threads, queue_bytes, first, count, replace, job),
                      lambda given, common, made, _job: _io.msq_io_svg_create(
                          given, name, common, ctypes.byref(definition), made))


def save_slices(slicer: Slicer, path: Path, *, units: float = 1.0, layer_height: float = 0.0,
                output: int = 0, threads: int = 0, queue_bytes: Optional[int] = None, first: int = 0,
                count: Optional[int] = None, replace: bool = False,
                job: Optional[Job] = None) -> Written:
    """Writes contours as a stack of slices in a 3MF file. layer_height: for a stack of one layer. The
    rest as in save_svg."""
    definition = _defaults(_io_abi.msq_io_slices_def)
    definition.units = units
    definition.layer_height = layer_height
    name = c_path(path)
    with naming(path):
        return _write(slicer, _Options(output, threads, queue_bytes, first, count, replace, job),
                      lambda given, common, made, _job: _io.msq_io_slices_create(
                          given, name, common, ctypes.byref(definition), made))


def save_mesh(model: Model, path: Path, pitch: float, *, format: Optional[str] = None,
              box: Optional[Box] = None, length_scale: float = 0.0, slab_layers: int = 0,
              replace: bool = False, job: Optional[Job] = None) -> None:
    """Writes a preview mesh as binary STL or PLY, as the end of the path says or format. Arguments as
    of Model.mesh. Unlike Model.save_mesh it refuses an existing file, unless replace=True."""
    name = c_path(path)
    if format is None:
        format = os.path.splitext(os.fspath(path))[1][1:].lower()
    if format not in _FORMATS:
        raise ValueError(f"format is {format!r}; it must be 'stl' or 'ply'")
    definition = definition_of(pitch, box, length_scale, slab_layers)
    reference, kind = model._ref, _FORMATS[format]
    with naming(path):
        interruptible(lambda work: _io.msq_io_surface_save(reference, ctypes.byref(definition), kind, name,
                                                           bool(replace), work), job)


def save_beams(graph: StrutGraph, path: Path, *, vertices: Any = None, triangles: Any = None,
               clipping: str = "none", replace: bool = False) -> None:
    """Writes struts as a beam lattice in a 3MF file. vertices, triangles: of a mesh, as in
    Shape.from_mesh. It is solid, and united with the beams, or, if clipping is `inside` or `outside`,
    beams are kept there and it is not solid."""
    definition = _defaults(_io_abi.msq_io_beams_def)
    definition.clipping = constant("MSQ_CLIPPING_", clipping, "clipping")
    kept: List[Any] = []
    if (vertices is None) != (triangles is None):
        raise ValueError("vertices and triangles go together; one of them is None")
    if vertices is not None:
        points = triples(vertices, "vertices")
        corners = vector(triangles, np.uint32, (-1, 3), "triangles")
        mesh = defaults(_abi.msq_mesh_def)
        mesh.coordinate_type = points.coordinate_type
        mesh.vertices, mesh.vertex_count = points.address, points.count
        mesh.vertex_stride = points.stride
        mesh.triangles, mesh.triangle_count = pointer(corners, ctypes.c_uint32), len(corners)
        definition.mesh = ctypes.pointer(mesh)
        kept += [points, corners, mesh]
    with naming(path):
        _io.msq_io_beams_save(graph._ref, ctypes.byref(definition), c_path(path), bool(replace))


def save_picture(path: Path, pixels: Any, *, replace: bool = False) -> None:
    """Writes an array of uint8 as a PNG: (height, width) grey, (height, width, 3) RGB, or
    (height, width, 4) RGBA, as Picture.rgba is."""
    given = np.asarray(pixels)
    if given.dtype != np.uint8 or given.ndim not in (2, 3):
        raise ValueError(f"pixels are {given.dtype} of shape {given.shape}; they must be uint8, "
                         "(height, width) or (height, width, channels)")
    given = np.ascontiguousarray(given)
    height, width = given.shape[:2]
    channels = given.shape[2] if given.ndim == 3 else 1
    with naming(path):
        _io.msq_io_picture_save(c_path(path), width, height, channels,
                                pointer(given, ctypes.c_uint8), 0, bool(replace))


__all__ = ["Panel", "Written", "panel_slicer", "save_beams", "save_mesh", "save_picture", "save_png",
           "save_sl1", "save_slices", "save_svg"]
