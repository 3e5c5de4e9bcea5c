# SPDX-License-Identifier: Apache-2.0
"""Numbers estimated from stratified samples."""
from __future__ import annotations

import ctypes
import dataclasses
from typing import Any, Optional, Sequence

import numpy as np

from . import _abi
from ._arrays import pointer, vector
from ._interrupt import interruptible
from ._library import constant, defaults, lib
from .context import Job, triple
from .points import Stratified, definition_of, query_of

_DTYPE = np.dtype([(label, np.float64) for label, _ in _abi.msq_estimate._fields_])


@dataclasses.dataclass(frozen=True)
class Estimate:
    """An estimated number between 0 and 1."""

    value: float
    standard_error: float  #: from the spread within the sample's cells
    low: float  #: low to high holds the true value with a probability of 95 %
    high: float


def estimate(given: _abi.msq_estimate) -> Estimate:
    return Estimate(given.value, given.standard_error, given.low, given.high)


@dataclasses.dataclass(frozen=True)
class Calibration:
    """The parameter of a structure at a volume fraction, and the curve between the two."""

    samples: int  #: points asked
    parameter: float  #: the least that holds at least the target share of the points
    fraction: Estimate  #: volume fraction at that parameter
    max_fraction: float  #: at the greatest parameter that the structure's kind allows
    parameters: np.ndarray  #: of the curve, nowhere falling; as many as were asked for
    fractions: np.ndarray  #: parameters[i] has the fraction fractions[i]; strictly ascending


def volume_fraction(model: Any, sample: Stratified, phase: str, length_scale: float,
                    job: Optional[Job]) -> Estimate:
    points, found = definition_of(sample), _abi.msq_estimate()
    query, which = query_of(length_scale), constant("MSQ_PHASE_", phase, "phase")
    interruptible(lambda work: lib.msq_volume_fraction(
        model, ctypes.byref(points.definition), query, which, ctypes.byref(found), work), job)
    return estimate(found)


def along_segments(function: Any, model: Any, sample: Stratified, lengths: Any,
                   direction: Optional[Sequence[float]], phase: str, step: float,
                   length_scale: float, job: Optional[Job]) -> np.recarray:
    points, query = definition_of(sample), query_of(length_scale)
    definition = defaults(_abi.msq_segments_def)
    definition.phase = constant("MSQ_PHASE_", phase, "phase")
    if direction is not None:
        definition.direction[:] = triple(direction, "direction")
    kept = vector(np.atleast_1d(lengths), np.float64, (-1,), "lengths")
    definition.lengths = pointer(kept, ctypes.c_double)
    definition.length_count = len(kept)
    definition.step = step
    found = np.zeros(len(kept), _DTYPE)
    interruptible(lambda work: function(
        model, ctypes.byref(points.definition), query, ctypes.byref(definition),
        pointer(found, _abi.msq_estimate), len(found), work), job)
    return found.view(np.recarray)


def calibrate(context: Any, structure: Any, target: float, sample: Optional[Stratified],
              curve: int, job: Optional[Job]) -> Calibration:
    points = None if sample is None else ctypes.byref(definition_of(sample).definition)
    filled = _abi.msq_calibration_report()
    filled.struct_size = ctypes.sizeof(filled)
    parameters, fractions = np.empty(curve), np.empty(curve)
    pointers = [pointer(array, ctypes.c_double) if curve else None
                for array in (parameters, fractions)]
    interruptible(lambda work: lib.msq_structure_calibrate(
        context, structure, points, target, *pointers, curve, ctypes.byref(filled), work), job)
    return Calibration(filled.samples, filled.parameter, estimate(filled.fraction),
                       filled.max_fraction, parameters, fractions)
