# SPDX-License-Identifier: Apache-2.0
"""Pictures of a model as arrays."""
from __future__ import annotations

import ctypes
import dataclasses
import itertools
import threading
from typing import TYPE_CHECKING, Any, Callable, Optional, Sequence, Tuple

import numpy as np

from . import _abi, _png
from ._arrays import output, pointer, vector
from ._interrupt import Relay, interruptible
from ._library import constant, defaults, keep_exception, lib
from .camera import Camera, definition_of
from .context import Job, triple, unsigned
from .errors import HostError
from .points import query_of

if TYPE_CHECKING:
    from .model import Model

_STOPPED = 1  # the callback's code for "enough"; exceptions have negative ones
_LONG = 1 << 15  # pixels

# Arrays of a picture: dtype, numbers a pixel, and the pointer that C takes.
_ARRAYS = {"depth": (np.float32, (), ctypes.c_float), "normal": (np.float32, (3,), ctypes.c_float),
           "scale": (np.int32, (), ctypes.c_int32), "material": (np.uint32, (), ctypes.c_uint32),
           "rgba": (np.uint8, (4,), ctypes.c_uint8)}


@dataclasses.dataclass
class Picture:
    """What a camera sees, row 0 on top: arrays (height, width, ...), None those not asked for."""

    depth: Optional[np.ndarray] = None  #: float32, from eye along the view; infinity in a miss
    normal: Optional[np.ndarray] = None  #: float32 (..., 3), outward; 0 in a miss
    scale: Optional[np.ndarray] = None  #: int32, whose surface it is; -1 in a miss
    material: Optional[np.ndarray] = None  #: uint32, its id; 0 in a miss
    rgba: Optional[np.ndarray] = None  #: uint8 (..., 4), sRGB and opacity

    def _repr_png_(self) -> Optional[bytes]:
        """A notebook shows the picture so, if it has rgba."""
        return None if self.rgba is None else _png.encoded(self.rgba)

    def __repr__(self) -> str:
        arrays = {name: getattr(self, name) for name in _ARRAYS}
        held = [name for name, array in arrays.items() if array is not None]
        height, width = arrays[held[0]].shape[:2] if held else (0, 0)
        return f"<msq.Picture: {width} x {height}, {', '.join(held)}>"


@dataclasses.dataclass(frozen=True)
class RenderPass:
    """How far a picture has come."""

    step: int  #: pixels along a side of the blocks that are of one ray yet
    samples: int  #: of rgba, along a side of a pixel
    is_last: bool  #: the picture is done


def make_definition(width: int, height: int, tile: Optional[Sequence[int]], samples: int,
                    first_step: int, colour_by: str, colours: Any, background: Any, light: Any,
                    ambient: Optional[float], shadows: bool, occlusion_rays: int,
                    occlusion_distance: float) -> Tuple[_abi.msq_render_def, Any]:
    """The definition, and what it points to."""
    definition = defaults(_abi.msq_render_def)
    definition.width = unsigned(width, 32, "width")
    definition.height = unsigned(height, 32, "height")
    if tile is not None:
        (definition.tile_x, definition.tile_y, definition.tile_width,
         definition.tile_height) = [unsigned(number, 32, "tile") for number in tile]
    definition.samples = unsigned(samples, 32, "samples")
    definition.first_step = unsigned(first_step, 32, "first_step")
    definition.colour_by = constant("MSQ_COLOUR_", colour_by, "colour_by")
    given = None
    if colours is not None:
        given = vector(colours, np.float64, (-1, 3), "colours")
        definition.colours = pointer(given, ctypes.c_double)
        definition.colour_count = len(given)
    values = tuple(float(part) for part in background)
    if len(values) not in (3, 4):
        raise ValueError(f"background has {len(values)} numbers; it must have 3 or 4")
    definition.background[:] = values if len(values) == 4 else (*values, 1.0)
    if light is not None:
        definition.light[:] = triple(light, "light")
    if ambient is not None:
        definition.ambient = ambient
    definition.shadows = int(shadows)
    definition.occlusion_rays = unsigned(occlusion_rays, 32, "occlusion_rays")
    definition.occlusion_distance = occlusion_distance
    return definition, given


def _arrays(outputs: Sequence[str], out: Optional[Picture], shape: Tuple[int, int]) -> Picture:
    if out is not None:
        names = [name for name in _ARRAYS if getattr(out, name) is not None]
    else:
        names = [outputs] if isinstance(outputs, str) else list(outputs)
    picture = Picture() if out is None else out
    for name in names:
        if name not in _ARRAYS:
            raise ValueError(f"outputs have {name!r}; they must be of "
                             f"{', '.join(map(repr, _ARRAYS))}")
        dtype, parts, _ = _ARRAYS[name]
        setattr(picture, name, output(getattr(picture, name), (*shape, *parts), (dtype,)))
    for one, other in itertools.combinations(dict.fromkeys(names), 2):
        if np.may_share_memory(getattr(picture, one), getattr(picture, other)):
            raise ValueError(f"out has {one} and {other} that lie in the same memory")
    return picture


def render(model: Model, camera: Optional[Camera], definition: _abi.msq_render_def, keep: Any,
           outputs: Sequence[str], length_scale: float,
           on_pass: Optional[Callable[[Picture, RenderPass], Any]], out: Optional[Picture],
           job: Optional[Job]) -> Picture:
    """See Model.render. keep: what the definition points to."""
    if camera is None:
        camera = Camera.fit(model, definition.width, definition.height)
    view, query = definition_of(camera), query_of(length_scale)
    picture = _arrays(outputs, out, (definition.tile_height or definition.height,
                                     definition.tile_width or definition.width))
    frame = defaults(_abi.msq_frame)
    for name, (_, _, kind) in _ARRAYS.items():
        array = getattr(picture, name)
        if array is not None:
            setattr(frame, name, pointer(array, kind))
    reference = model._ref

    def call(work: Any, fn: Any = _abi.msq_render_fn()) -> None:
        _held = picture, keep  # for as long as the call, whatever becomes of the caller
        lib.msq_render(reference, ctypes.byref(view), ctypes.byref(definition), query,
                       ctypes.byref(frame), fn, None, work)

    if on_pass is None:
        interruptible(call, job, definition.width * definition.height >= _LONG)
        return picture
    relay = Relay() if threading.current_thread() is threading.main_thread() else None
    take_pass = _abi.msq_render_fn(_trampoline(on_pass, picture, relay))
    try:
        interruptible(lambda work: call(work, take_pass), job, relay=relay, calls_back=True)
    except HostError as error:
        if error.code != _STOPPED:
            raise
    return picture


def _trampoline(on_pass: Callable[[Picture, RenderPass], Any], picture: Picture,
                relay: Optional[Relay]) -> Callable[[Any, Any], int]:
    """Passes a pass on to the thread that render was called on: windows are drawn there."""
    def take_pass(_user: Any, given: Any) -> int:
        try:
            done = given.contents
            made = RenderPass(done.step, done.samples, bool(done.is_last))
            goes_on = (on_pass(picture, made) if relay is None
                       else relay.run(lambda: on_pass(picture, made)))
            return _STOPPED if goes_on is False else 0
        except BaseException as error:  # none may pass through C
            return keep_exception(error)
    return take_pass
