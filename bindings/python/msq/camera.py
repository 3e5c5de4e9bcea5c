# SPDX-License-Identifier: Apache-2.0
"""Cameras: from where a model is seen."""
from __future__ import annotations

import ctypes
import dataclasses
import math
from typing import TYPE_CHECKING, Optional, Sequence, Tuple

from . import _abi
from ._given import plain, shown
from ._library import constant, defaults, lib
from .context import doubles, triple, unsigned

if TYPE_CHECKING:
    from .model import Model


@dataclasses.dataclass(frozen=True)
class Camera:
    """From where a model is seen: from eye to target, which is in the middle of the picture.

        camera = msq.Camera.fit(model, 800, 600, direction=(1, 1, -1))

    projection: `orthographic` (height: model units from the lower to the upper edge) or
    `perspective` (field_of_view: degrees between them). clip_near, clip_far: distances from eye
    along the view between which the model is seen; the rest is cut away.
    """

    eye: Sequence[float]
    target: Sequence[float]
    up: Sequence[float] = (0.0, 0.0, 1.0)
    projection: str = "orthographic"
    height: float = 0.0
    field_of_view: float = 40.0
    clip_near: float = 0.0
    clip_far: float = math.inf

    def __post_init__(self) -> None:
        for name in ("eye", "target", "up"):
            object.__setattr__(self, name, plain(getattr(self, name)))

    def __repr__(self) -> str:
        return shown(self)

    @classmethod
    def fit(cls, model: Model, width: int, height: int, *,
            direction: Sequence[float] = (-0.5, 0.8, -0.4), up: Optional[Sequence[float]] = None,
            projection: str = "perspective", field_of_view: float = 40.0, clip_near: float = 0.0,
            clip_far: float = math.inf) -> Camera:
        """That whose picture of width x height pixels the model's box just fits, seen along a
        direction. up None: z, or y where that is almost along it."""
        lens = _define(projection, field_of_view, clip_near, clip_far)
        lib.msq_camera_fit(model._ref, doubles(direction, "direction"),
                           None if up is None else doubles(up, "up"), unsigned(width, 32, "width"),
                           unsigned(height, 32, "height"), ctypes.byref(lens))
        return cls(tuple(lens.eye), tuple(lens.target), tuple(lens.up), projection, lens.height,
                   field_of_view, clip_near, clip_far)

    def ray(self, position: Sequence[float], width: int,
            height: int) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
        """Origin and direction of the ray of a position in a picture: pixels right and down from
        its upper left corner. t of Model.cast along it is the depth."""
        x, y = position
        origin, direction = (ctypes.c_double * 3)(), (ctypes.c_double * 3)()
        lib.msq_camera_ray(ctypes.byref(definition_of(self)), unsigned(width, 32, "width"),
                           unsigned(height, 32, "height"), (ctypes.c_double * 2)(x, y), origin,
                           direction)
        return tuple(origin), tuple(direction)


def _define(projection: str, field_of_view: float, clip_near: float,
            clip_far: float) -> _abi.msq_camera:
    definition = defaults(_abi.msq_camera)
    definition.projection = constant("MSQ_CAMERA_", projection, "projection")
    definition.field_of_view = field_of_view
    definition.clip_near = clip_near
    definition.clip_far = clip_far
    return definition


def definition_of(camera: Camera) -> _abi.msq_camera:
    """The camera as C has it."""
    if not isinstance(camera, Camera):
        raise TypeError(f"camera is a {type(camera).__name__}; it must be a Camera")
    definition = _define(camera.projection, camera.field_of_view, camera.clip_near, camera.clip_far)
    definition.eye[:] = triple(camera.eye, "eye")
    definition.target[:] = triple(camera.target, "target")
    definition.up[:] = triple(camera.up, "up")
    definition.height = camera.height
    return definition
