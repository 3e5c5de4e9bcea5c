# SPDX-License-Identifier: Apache-2.0
"""What is doubtful about printing layers."""
from __future__ import annotations

import ctypes
import dataclasses
from typing import Any, List, Optional, Sequence

import numpy as np

from . import _abi
from ._interrupt import interruptible
from ._library import constant, defaults, keep_exception, lib
from .context import Job

_FINDING = np.dtype(_abi.msq_finding)


@dataclasses.dataclass(frozen=True)
class Printability:
    """What Slicer.printability found: numbers, volumes in model units cubed, and the list.

    findings is a structured array with the fields of msq_finding: kind (see Printability.kinds),
    first_layer, last_layer, sample_count, volume, point, min, max. findings_of("void") has those of
    one kind.
    """

    layer_count: int  #: layers that were inspected
    solid_count: int  #: solid samples
    solid_volume: float
    island_count: int  #: parts of layers that lie on nothing
    loose_count: int  #: parts of the solid that do not reach the plate
    void_count: int  #: enclosed voids
    thin_count: int  #: places thinner than the width
    island_volume: float
    loose_volume: float
    void_volume: float
    thin_volume: float
    cup_count: int  #: voids that are closed until a later layer
    overhang_count: int  #: parts of layers beyond the solid below
    cup_volume: float
    overhang_volume: float
    findings: np.ndarray

    #: values of findings["kind"]
    kinds = {"island": _abi.MSQ_FINDING_ISLAND, "loose": _abi.MSQ_FINDING_LOOSE,
             "void": _abi.MSQ_FINDING_VOID, "thin": _abi.MSQ_FINDING_THIN,
             "cup": _abi.MSQ_FINDING_CUP, "overhang": _abi.MSQ_FINDING_OVERHANG}

    def findings_of(self, kind: str) -> np.ndarray:
        """The findings of one kind: `island`, `loose`, `void`, `thin`, `cup` or `overhang`."""
        return self.findings[self.findings["kind"] == constant("MSQ_FINDING_", kind, "kind")]


def inspect(slicer: Any, kinds: Sequence[str], has_plate: bool, width: float, min_volume: float,
            overhang: float, job: Optional[Job]) -> Printability:
    """Of Slicer.printability."""
    definition = defaults(_abi.msq_printability_def)
    definition.kinds = 0
    for kind in [kinds] if isinstance(kinds, str) else kinds:
        definition.kinds |= constant("MSQ_FINDING_", kind, "kinds")
    definition.has_plate = bool(has_plate)
    definition.width = width
    definition.min_volume = min_volume
    definition.overhang = overhang
    filled = _abi.msq_printability_report()
    filled.struct_size = ctypes.sizeof(filled)
    batches: List[np.ndarray] = []

    def take(_user: Any, findings: Any, count: int) -> int:
        try:
            memory = (_abi.msq_finding * count).from_address(ctypes.addressof(findings.contents))
            batches.append(np.frombuffer(memory, _FINDING).copy())
            return 0
        except BaseException as error:  # none may pass through C
            return keep_exception(error)

    function, reference = _abi.msq_findings_fn(take), slicer._ref

    def call(work: Any) -> None:
        lib.msq_printability(reference, ctypes.byref(definition), function, None,
                             ctypes.byref(filled), work)

    interruptible(call, job, calls_back=True)
    found = np.concatenate(batches) if batches else np.empty(0, _FINDING)
    return Printability(findings=found,
                        **{field.name: getattr(filled, field.name)
                           for field in dataclasses.fields(Printability)
                           if field.name != "findings"})
