# SPDX-License-Identifier: Apache-2.0
"""Layers of a model as arrays."""
from __future__ import annotations

import ctypes
import operator
from typing import (TYPE_CHECKING, Any, Callable, Iterator, List, Optional, Sequence, Tuple, Union,
                    overload)

import numpy as np

from . import _abi, _png
from ._arrays import output as output_array
from ._arrays import pointer, vector
from ._grid import Window, set_window
from ._handle import Handle
from ._interrupt import interruptible
from ._lent import Lent
from ._library import constant, defaults, keep_exception, lib, report
from ._signals import HeldSignals
from .context import Job, job_reference, c_text, triple, unsigned
from .contours import Contours, Window, contours_definition
from .errors import HostError
from .printability import Printability, inspect

if TYPE_CHECKING:
    from .model import Model

_STOPPED = 1  # the callback's code for "enough"; exceptions have negative ones
_MOST_AHEAD_BYTES = 64 << 20  # of layers that an iterator holds

# Axes u, v, w of layers normal to an axis, as Model.contours has them.
_AXES = {0: (0, 1, 0, 0, 0, 1, 1, 0, 0), 1: (1, 0, 0, 0, 0, 1, 0, 1, 0), 2: ()}
_PIXELS = {"bytes": np.uint8, "grey": np.uint8, "distance": np.float32, "material": np.uint32,
           "onset": np.float32, "channel": np.float32}
_NAMES = [name for name in ("bits", *_PIXELS) if name != "channel"]  # which need no more than a name

Region = Tuple[Sequence[float], Sequence[float]]


class Output:
    """One of the things that each layer of a Slicer holds.

    kind: `bits`, `bytes`, `grey`, `distance`, `material`, `onset`, `channel` or `contours`.
    grey_samples, grey_gamma, grey_threshold: of grey. scale, signed: of the onset: the scale whose
    structure it is, 0: the finest resolved, and whether the radius or level is subtracted. channel:
    the name of a channel of the materials. tolerance, pitch, window, type, units: of contours, as in
    Slicer.contours.
    """

    def __init__(self, kind: str, *, grey_samples: int = 4, grey_gamma: float = 1.0,
                 grey_threshold: int = 0, scale: int = 0, signed: bool = False,
                 channel: Optional[str] = None, tolerance: Optional[float] = None, pitch: float = 0.0,
                 window: Optional[Window] = None, type: str = "float64",
                 units: float = 1.0) -> None:
        if kind not in ("bits", *_PIXELS, "contours"):
            raise ValueError(f"output is {kind!r}; it must be one of bits, {', '.join(_PIXELS)}, "
                             "contours")
        if (kind == "contours") != (tolerance is not None):
            raise ValueError(f"output is {kind!r} and tolerance is {tolerance}; contours need one, "
                             "and no other")
        self._kind = kind
        definition = defaults(_abi.msq_output_def)
        definition.output = constant("MSQ_LAYER_", kind, "output")
        definition.grey_samples = unsigned(grey_samples, 32, "grey_samples")
        definition.grey_gamma = grey_gamma
        definition.grey_threshold = unsigned(grey_threshold, 32, "grey_threshold")
        definition.onset_scale = unsigned(scale, 32, "scale")
        definition.onset_value = _abi.MSQ_ONSET_SIGNED if signed else _abi.MSQ_ONSET_PLAIN
        if channel is not None:
            definition.channel = c_text(channel, "channel")
        if tolerance is not None:
            self._contours = contours_definition(tolerance, axis=2, window=window, pitch=pitch,
                                                 type=type, units=units, length_scale=0.0)
            definition.contours = ctypes.pointer(self._contours)
        self._definition = definition

    @property
    def kind(self) -> str:
        """As given."""
        return self._kind

    def __repr__(self) -> str:
        return f"<msq.Output {self._kind}>"


class Layer:
    """One layer: `data` has its bytes, `pixels` a bool for each pixel.

    Row 0 is the one of smallest y, so pictures shown with row 0 on top are mirrored. If the slicer
    has several outputs, `outputs` has each, and the layer itself is the first.
    """

    __slots__ = ("index", "z", "output", "width", "height", "inside_count", "rows", "_outputs")

    def __init__(self, index: int, z: float, output: str, width: int, height: int,
                 inside_count: int, rows: np.ndarray,
                 outputs: Tuple[Union[Layer, Contours], ...] = ()) -> None:
        self.index = index  #: in the plan
        self.z = z
        self.output = output  #: kind of the first output
        self.width = width  #: pixels in x
        self.height = height  #: pixels in y
        #: pixels inside; samples inside where output is `grey`; 0 where it is `onset` or `contours`
        self.inside_count = inside_count
        #: (height, stride) of uint8, with what pads the rows: 0; of `contours`: (0, 0)
        self.rows = rows
        self._outputs = outputs

    @property
    def outputs(self) -> Tuple[Union[Layer, Contours], ...]:
        """In the order of the slicer's: a Layer of one output for pixels, or Contours."""
        return self._outputs or (self,)

    def contours(self, number: int = 0) -> Contours:
        """The first of the outputs that is contours, or the one after so many others."""
        found = [output for output in self.outputs if isinstance(output, Contours)]
        if not 0 <= number < len(found):
            raise IndexError(f"contours {number} do not exist; {len(found)} of the layer's outputs "
                             "are contours")
        return found[number]

    @property
    def data(self) -> np.ndarray:
        """The rows without what pads them, as a view.

        bits: uint8 (height, (width + 7) // 8), leftmost pixel in the high bit, as PNG and PBM have
        them. bytes: uint8 (height, width), 255 inside and 0 outside. grey: uint8 (height, width),
        coverage. distance, onset, channel: float32 (height, width). material: uint32 (height, width).
        """
        if self.output == "contours":
            raise ValueError("the first output is contours, which has no pixels: see contours()")
        if self.output == "bits":
            return self.rows[:, :(self.width + 7) // 8]
        return self.rows.view(_PIXELS[self.output])[:, :self.width]

    @property
    def pixels(self) -> np.ndarray:
        """A new array of bools, (height, width): inside, with any coverage, or of a material. Onsets:
        at most 0. Channels: not 0."""
        if self.output == "bits":
            return np.unpackbits(self.data, axis=1, count=self.width).view(np.bool_)
        return self.data <= 0 if self.output in ("distance", "onset") else self.data != 0

    def copy(self) -> Layer:
        """A layer of its own memory, to keep beyond the callback of Slicer.run."""
        outputs = tuple(output.copy() if isinstance(output, Layer) else output
                        for output in self._outputs)
        first = outputs[0] if outputs else None
        return Layer(self.index, self.z, self.output, self.width, self.height, self.inside_count,
                     first.rows if isinstance(first, Layer) else self.rows.copy(), outputs)

    def _repr_png_(self) -> bytes:
        """A notebook shows the layer so, with y upwards: coverage if it is grey, else what is inside."""
        if self.output == "contours":
            raise ValueError("the first output is contours, which has no pixels: see contours()")
        if self.output == "grey":
            return _png.encoded(self.data[::-1])
        return _png.encoded(self.pixels[::-1].astype(np.uint8) * np.uint8(255))

    def __repr__(self) -> str:
        return (f"<msq.Layer {self.index} at z = {self.z:g}: {self.width} x {self.height}, "
                f"{self.inside_count} inside>")


class Slicer(Handle):
    """A plan of layers normal to z, or in a frame; one sample a pixel, at its centre.

        for layer in model.slicer(layer_height=0.1, pitch=0.05):
            save(layer.index, layer.data)

    pitch, resolution: size of a pixel and number of pixels, one or two numbers each; one of them
    follows from the other and the region. region: (min, max), else the model's bounding box.
    layer_height, or layer_z: heights, strictly ascending. layer_count 0: as many as cover the region.
    output: `bits`, `bytes`, `grey` (coverage by grey_samples x grey_samples samples per pixel, to the
    power of grey_gamma, and 0 below grey_threshold), `distance`, `material` (ids) or `onset`; or a
    list of Output for several at once, which come in Layer.outputs. mirror: `x`, `y`
    or `xy`, and transpose: how layers are turned, for the panels of printers. slab_layers: computed
    at once, 0: as many as pay. length_scale: as in
    Model.contains. window: ((i, j, k), (nx, ny, nz)), the first pixel and layer and the numbers of
    pixels and layers of a part of the plan, which then has the bytes of the whole there. axis: 0 (x),
    1 (y) or 2 (z), the normal of the layers; pixels lie along the other two in their order. frame: (origin,
    (u, v, w)), orthonormal axes along which pixels and layers lie. With either, region, heights and
    contours are in the coordinates of the layers, and x, y, z of pixels and layers mean these.

    Slicers are sequences: len(slicer), slicer[i] (one layer, by itself), slicer[2:4] (a list) and
    iteration (slab by slab, faster).
    """

    _kind = "slicer"

    def __init__(self, model: Model, *, layer_height: Optional[float] = None, pitch: Any = None,
                 resolution: Any = None, layer_count: int = 0, region: Optional[Region] = None,
                 layer_z: Any = None, output: Union[str, Sequence[Output]] = "bits",
                 slab_layers: int = 0,
                 length_scale: float = 0.0, window: Optional[Window] = None,
                 grey_samples: int = 4, grey_gamma: float = 1.0, grey_threshold: int = 0,
                 mirror: str = "", transpose: bool = False, axis: int = 2,
                 frame: Optional[Tuple[Sequence[float], Any]] = None) -> None:
        definition = defaults(_abi.msq_slicer_def)
        if axis not in _AXES:
            raise ValueError(f"axis is {axis!r}; it must be 0, 1 or 2")
        if frame is not None:
            if axis != 2:
                raise ValueError(f"axis is {axis!r} and frame is given; only one of them can be")
            origin, axes = frame
            definition.frame_origin[:] = triple(origin, "frame")
            rows = [triple(row, "frame") for row in axes]
            if len(rows) != 3:
                raise ValueError(f"frame has {len(rows)} axes; it must have 3")
            definition.frame_axes[:] = [number for row in rows for number in row]
        elif axis != 2:
            definition.frame_axes[:] = _AXES[axis]
        set_window(definition.window, window)
        if isinstance(output, str):
            if output not in _NAMES:
                raise ValueError(f"output is {output!r}; it must be one of {', '.join(_NAMES)}, or a list "
                                 "of Output")
            definition.output = constant("MSQ_LAYER_", output, "output")
            self._kinds: Tuple[str, ...] = (output,)
        else:
            several = tuple(output)
            for one in several:
                if not isinstance(one, Output):
                    raise TypeError(f"output has {one!r}; it must be a name or a list of Output")
            if not several:
                raise ValueError("output is empty; it must have at least one Output")
            definitions = (_abi.msq_output_def * len(several))(*(one._definition for one in several))
            definition.outputs = definitions
            definition.output_count = len(several)
            self._kinds = tuple(one.kind for one in several)
            output = several
        definition.grey_samples = unsigned(grey_samples, 32, "grey_samples")
        definition.grey_gamma = grey_gamma
        definition.grey_threshold = unsigned(grey_threshold, 32, "grey_threshold")
        if mirror not in ("", "x", "y", "xy"):
            raise ValueError(f"mirror is {mirror!r}; it must be one of '', 'x', 'y', 'xy'")
        definition.orientation = ((_abi.MSQ_LAYER_MIRROR_X if "x" in mirror else 0)
                                  | (_abi.MSQ_LAYER_MIRROR_Y if "y" in mirror else 0)
                                  | (_abi.MSQ_LAYER_TRANSPOSE if transpose else 0))
        if pitch is not None:
            definition.pitch[:] = _pair(pitch, "pitch")
        if resolution is not None:
            definition.resolution[:] = [unsigned(count, 32, "resolution")
                                        for count in _pair(resolution, "resolution")]
        if layer_height is not None:
            definition.layer_height = layer_height
        definition.layer_count = unsigned(layer_count, 64, "layer_count")
        definition.slab_layers = unsigned(slab_layers, 32, "slab_layers")
        if region is not None:
            low, high = region
            definition.has_region = 1
            definition.region_min[:] = triple(low, "region")
            definition.region_max[:] = triple(high, "region")
        heights = list_heights(definition, layer_z)  # kept until the slicer is made
        definition.length_scale = length_scale
        self._output = output
        self._plan(model, definition)

    @classmethod
    def _of_definition(cls, model: Model, definition: _abi.msq_slicer_def) -> Slicer:
        """The slicer of a definition that msq has made."""
        names = {getattr(_abi, f"MSQ_LAYER_{name.upper()}"): name
                 for name in ("bits", "bytes", "grey", "distance", "material", "onset",
                              "contours", "channel")}
        made = cls.__new__(cls)
        if definition.output_count:
            made._kinds = tuple(names[definition.outputs[i].output]
                                for i in range(definition.output_count))
            made._output = made._kinds
        else:
            made._output = names[definition.output]
            made._kinds = (made._output,)
        made._plan(model, definition)
        return made

    def _plan(self, model: Model, definition: _abi.msq_slicer_def) -> None:
        self._is_turned = definition.orientation != 0
        self._reference = self._create(lib.msq_slicer_create, model._ref, ctypes.byref(definition))
        plan = report(_abi.msq_slicer_report, lib.msq_slicer_info, self._ref)
        self.width: int = plan.width  #: pixels in x
        self.height: int = plan.height  #: pixels in y
        self.layer_count: int = plan.layer_count
        self.slab_layers: int = plan.slab_layers  #: layers computed at once
        self.stride: int = plan.stride  #: bytes from one row to the next
        self.layer_bytes: int = plan.layer_bytes
        #: centre of pixel (0, 0) of the whole plan
        self.origin: Tuple[float, float] = tuple(plan.origin)
        #: pixel (i, j) is sampled at origin + (window[0] + (i, j)) * pitch
        self.pitch: Tuple[float, float] = tuple(plan.pitch)
        #: first pixel and layer, and numbers of them, in the whole plan
        self.window: Window = (tuple(plan.window.first), tuple(plan.window.count))
        self.whole: Tuple[int, int, int] = tuple(plan.whole)  #: pixels and layers of the whole plan

    @property
    def output(self) -> Union[str, Tuple[Output, ...]]:
        """As given."""
        return self._output

    def z(self, index: int) -> float:
        """z of a layer's samples."""
        z = ctypes.c_double()
        lib.msq_slicer_layer_z(self._ref, self._index(index), ctypes.byref(z))
        return z.value

    def __len__(self) -> int:
        return self.layer_count

    @overload
    def __getitem__(self, index: int) -> Layer: ...

    @overload
    def __getitem__(self, index: slice) -> List[Layer]: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[Layer, List[Layer]]:
        if not isinstance(index, slice):
            return self.layer(index)
        chosen = range(self.layer_count)[index]
        if abs(chosen.step) == 1 and len(chosen) > 1:  # all from the first to the last
            found = list(self.layers(min(chosen), len(chosen)))
            return found if chosen.step > 0 else found[::-1]
        return [self.layer(one) for one in chosen]

    def __repr__(self) -> str:
        return (f"<msq.Slicer: {self.layer_count} layers of {self.width} x {self.height} pixels, "
                f"{' and '.join(self._kinds)}>")

    @property
    def extent(self) -> Tuple[float, float, float, float]:
        """x of the left and right, y of the lower and upper edge of the pixels, as matplotlib wants it:
        imshow(layer.pixels, origin="lower", extent=slicer.extent). Not if layers are turned."""
        if self._is_turned:
            raise ValueError("the layers are mirrored or transposed; extent is of those that are not")
        low = [self.origin[axis] + (self.window[0][axis] - 0.5) * self.pitch[axis]
               for axis in range(2)]
        return (low[0], low[0] + self.width * self.pitch[0],
                low[1], low[1] + self.height * self.pitch[1])

    def __iter__(self) -> Iterator[Layer]:
        return self.layers()

    def layer(self, index: int, *, out: Optional[np.ndarray] = None,
              job: Optional[Job] = None) -> Layer:
        """Computes one layer; for many in order, iteration is two to three times as fast.

        out: uint8 (height, stride), contiguous, to write the first output to; else memory of its own.
        """
        index = self._index(index)
        rows = output_array(out, (self.height, self.stride), (np.uint8,))
        kind = self._kinds[0]
        # Samples inside are counted by a run, which also has all outputs.
        if kind in ("grey", "contours", "channel") or len(self._kinds) > 1:
            found: List[Layer] = []
            self.run(lambda layer: found.append(layer.copy()), index, 1, job=job)
            layer = found[0]
            if out is None or kind == "contours":
                return layer
            rows[:] = layer.rows
            return Layer(index, layer.z, kind, self.width, self.height, layer.inside_count, rows,
                         layer._outputs)
        reference = self._ref
        interruptible(lambda work: lib.msq_slice_layer(
            reference, index, pointer(rows, ctypes.c_uint8), rows.nbytes, work), job, is_long=False)
        layer = Layer(index, self.z(index), kind, self.width, self.height, 0, rows)
        if kind != "onset":
            layer.inside_count = (_count_bits(rows) if kind == "bits"
                                  else int(np.count_nonzero(layer.pixels)))
        return layer

    def contours(self, index: int, tolerance: float, *, window: Optional[Window] = None,
                 pitch: float = 0.0, type: str = "float64", units: float = 1.0,
                 topology_samples: int = 0, job: Optional[Job] = None) -> Contours:
        """The rings of one layer, in the rectangle of its pixels unless there is a window: see
        Contours."""
        return Contours(self, self._index(index), tolerance, axis=2, window=window, pitch=pitch,
                        type=type, units=units, length_scale=0.0,
                        topology_samples=topology_samples, job=job)

    def printability(self, kinds: Sequence[str] = ("island", "loose", "void"), *,
                     has_plate: bool = True, width: float = 0.0, min_volume: float = 0.0,
                     overhang: float = 0.0, job: Optional[Job] = None) -> Printability:
        """Inspects all layers for what is doubtful about printing them.

        kinds: of `island`, `loose`, `void`, `cup`, `overhang` and `thin`. `thin` needs a width in
        model units, 2 to 32 pixels. `overhang`: how far the solid may reach beyond that of the
        layer below, in model units, 0 to 31 pixels. has_plate: the first layer lies on a build
        plate. Findings of less than min_volume are ignored. Costs about twice as much as the layers.
        """
        return inspect(self, kinds, has_plate, width, min_volume, overhang, job)

    def layers(self, first: int = 0, count: Optional[int] = None, *,
               job: Optional[Job] = None) -> Iterator[Layer]:
        """Iterates over layers, each with memory of its own.

        Computes a slab of slab_layers at a time (fewer where they hold more than 64 MiB), when its
        first layer is asked for. A loop that is left needs no tidying up, and an interrupt cancels
        the slab in work. job: its progress is that of a slab.
        """
        first, last = self._range(first, count)
        values = sum(0 if kind in ("bits", "contours") else np.dtype(_PIXELS[kind]).itemsize
                     for kind in self._kinds)
        bytes_ahead = max(self.layer_bytes, values * self.width * self.height)
        deep = max(1, min(self.slab_layers, _MOST_AHEAD_BYTES // max(1, bytes_ahead)))
        for at in range(first, last, deep):
            slab: List[Layer] = []

            def call(work: Any, first: int = at, slab: List[Layer] = slab) -> None:
                self._run(lambda layer: slab.append(layer.copy()), first, min(deep, last - first),
                          work, HeldSignals())

            interruptible(call, job, calls_back=True)
            slab.reverse()
            while slab:
                yield slab.pop()

    def run(self, take: Callable[[Layer], Any], first: int = 0, count: Optional[int] = None, *,
            job: Optional[Job] = None) -> bool:
        """Computes layers and calls take(layer) for each, in order, on this thread, while others
        compute the next slab. What is the fastest, and copies nothing.

        The layer's arrays are views of memory that is valid until take returns: keep layer.copy(),
        or what follows from it. A view that is kept is a BufferError. take stops the run by
        returning False, and run returns False then; exceptions stop it too, and are raised here.
        """
        first, last = self._range(first, count)
        reference = job_reference(Job() if job is None else job)
        with HeldSignals(reference, cancels=False) as signals:
            return self._run(take, first, last - first, reference, signals)

    def _run(self, take: Callable[[Layer], Any], first: int, count: int, job: Any,
             signals: HeldSignals) -> bool:
        def take_layer(_user: Any, pointer_to_layer: Any) -> int:
            lent = Lent()
            try:
                signals.raise_held()
                signals.allowed = True
                given = pointer_to_layer.contents
                goes_on = self._give(given, lent, take)
                if lent.are_kept():
                    raise BufferError(f"a view of layer {given.index} is kept beyond the callback, and "
                                      "its memory is not: keep layer.copy()")
                signals.allowed = False
                return 0 if goes_on else _STOPPED
            except BaseException as error:  # none may pass through C
                signals.allowed = False
                lent.take_back(error)
                return keep_exception(error)

        try:
            lib.msq_slicer_run(self._ref, first, count, _abi.msq_layer_fn(take_layer), None, job)
        except HostError as error:
            if error.code == _STOPPED:
                return False
            raise
        return True

    def _give(self, given: Any, lent: Lent, take: Callable[[Layer], Any]) -> bool:
        """Calls take with a layer that the callback has. Returns whether the run goes on."""
        outputs = tuple(self._read_output(given, number, lent) for number in range(len(self._kinds)))
        first = outputs[0]
        if len(outputs) == 1 and isinstance(first, Layer):
            return take(first) is not False
        rows = first.rows if isinstance(first, Layer) else np.empty((0, 0), np.uint8)
        return take(Layer(given.index, given.z, self._kinds[0], given.width, given.height,
                          given.inside_count, rows, outputs)) is not False

    def _read_output(self, given: Any, number: int, lent: Lent) -> Union[Layer, Contours]:
        """One output of a layer that the callback has, in memory that is lent."""
        output = given.outputs[number].contents
        if output.contours:
            # A pointer of its own: that of the field is gone with the layer.
            return Contours._of_layer(
                ctypes.POINTER(_abi.msq_contours).from_buffer_copy(output.contours))
        memory = lent.array(output.data, ctypes.c_uint8, output.stride * given.height)
        return Layer(given.index, given.z, self._kinds[number], given.width, given.height,
                     output.inside_count, memory.reshape(given.height, output.stride))

    def _index(self, index: int) -> int:
        index = operator.index(index)
        found = index + self.layer_count if index < 0 else index
        if not 0 <= found < self.layer_count:
            raise IndexError(f"layer {index} does not exist; there are {self.layer_count} layers")
        return found

    def _range(self, first: int, count: Optional[int]) -> Tuple[int, int]:
        first = operator.index(first)
        last = self.layer_count if count is None else first + operator.index(count)
        if not 0 <= first <= last <= self.layer_count:
            raise IndexError(f"layers {first} to {last} do not exist; there are {self.layer_count} "
                             "layers")
        return first, last


def list_heights(definition: _abi.msq_slicer_def, layer_z: Any) -> Optional[np.ndarray]:
    """Sets the heights of the definition, if there are any. The caller keeps what this returns as
    long as the definition is used."""
    if layer_z is None:
        return None
    heights = vector(layer_z, np.float64, (-1,), "layer_z")
    definition.layer_z = pointer(heights, ctypes.c_double)
    definition.layer_z_count = len(heights)
    return heights


def _pair(value: Any, name: str) -> Tuple[Any, Any]:
    values = (value, value) if np.ndim(value) == 0 else tuple(value)
    if len(values) != 2:
        raise ValueError(f"{name} has {len(values)} numbers; it must have 2")
    return values  # type: ignore[return-value]


_BITS_OF = np.array([bin(byte).count("1") for byte in range(256)], np.uint8)


def _count_bits(rows: np.ndarray) -> int:
    return int(_BITS_OF[rows].sum(dtype=np.int64))
