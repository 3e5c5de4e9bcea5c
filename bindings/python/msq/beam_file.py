# SPDX-License-Identifier: Apache-2.0
"""Beam lattices of 3MF files."""
from __future__ import annotations

import ctypes
import os
from typing import Any, List, Optional, Sequence, Union

import numpy as np

from . import _abi
from ._arrays import view
from ._handle import Handle, Reference
from ._interrupt import build
from ._library import constant, constant_name, defaults, lib
from .context import Context, Job, MadeIn, c_path, context_of
from .errors import naming
from .shape import Shape
from .structure import Beams


class BeamLattice:
    """Beams and balls of a file, in millimetres: read-only arrays, as Beams takes them.

    clipping: `none`, `inside` or `outside`: which part of the beams belongs to the solid, as seen
    from the mesh of clipping_shape(). min, max: a box that holds all of them, not clipped.
    """

    def __init__(self, file: BeamFile, number: int) -> None:
        self._file = file
        self._number = number
        report = _abi.msq_beam_file_report()
        report.struct_size = ctypes.sizeof(report)
        reference = file._ref
        lib.msq_beam_file_info(reference, number, ctypes.byref(report))
        self.clipping = constant_name("MSQ_CLIPPING_", report.clipping)
        self.min = tuple(report.min)
        self.max = tuple(report.max)
        definition = defaults(_abi.msq_beams_def)
        lib.msq_beam_file_beams(reference, number, ctypes.byref(definition))
        beams, balls = report.beam_count, report.ball_count

        self.nodes = view(reference, definition.nodes, (report.node_count, 3), "<f8")
        self.beams = view(reference, definition.beams, (beams, 2), "<u4")  #: indices of nodes
        self.radii = view(reference, definition.radii, (beams, 2), "<f8")  #: at the first and second node
        self.caps = view(reference, definition.caps, (beams, 2), "|u1")  #: as MSQ_CAP_*
        self.balls = view(reference, definition.balls, (balls,), "<u4")  #: indices of nodes
        self.ball_radii = view(reference, definition.ball_radii, (balls,), "<f8")

    def structure(self, *, length_scale: float = 0.0, job: Optional[Job] = None) -> Beams:
        """A structure of these beams and balls, not clipped."""
        more = {}
        if len(self.beams):
            more.update(beams=self.beams, radius=self.radii, cap=self.caps)
        if len(self.balls):
            more.update(balls=self.balls, ball_radius=self.ball_radii)
        return Beams(self.nodes, length_scale=length_scale, context=self._file.context, job=job,
                     **more)

    def clipping_shape(self, *, winding: str = "auto") -> Shape:
        """The mesh that clips these beams."""
        return self._file._shape(self._number, "clipping", winding)


class BeamFile(Handle):
    """The beam lattices of a 3MF file, and its mesh.

    lattices: a list of BeamLattice. Those that nothing clips are one. mesh_triangles: triangles of
    the build, 0 if there is no mesh besides the beams.
    """

    _kind = "beam_file"
    context = MadeIn()

    def __init__(self) -> None:
        raise TypeError("files of beams are opened by BeamFile.open and BeamFile.from_memory")

    @classmethod
    def open(cls, path: Union[str, "os.PathLike[str]"], *, max_bytes: int = 0,
             max_triangles: int = 0, context: Optional[Context] = None,
             job: Optional[Job] = None) -> BeamFile:
        """Reads a 3MF file. max_triangles limits beams and balls, too; 0: 200 million. max_bytes
        and job as in Shape.from_file."""
        context = context_of(context)
        definition = Shape._file("3mf", 1.0, "auto", max_bytes, max_triangles)
        name = c_path(path)
        with naming(path):
            return cls._made(context, build(
                lambda new: cls._create(new, context._ref, name, ctypes.byref(definition)),
                lib.msq_beam_file_open, job))

    @classmethod
    def from_memory(cls, data: Any, *, max_bytes: int = 0, max_triangles: int = 0,
                    context: Optional[Context] = None, job: Optional[Job] = None) -> BeamFile:
        """The same from a file's bytes, or any contiguous buffer of them."""
        context = context_of(context)
        definition = Shape._file("3mf", 1.0, "auto", max_bytes, max_triangles)
        view = np.frombuffer(data, np.uint8)  # without a copy
        return cls._made(context, build(
            lambda new: cls._create(new, context._ref, view.ctypes.data, view.size,
                                    ctypes.byref(definition)),
            lib.msq_beam_file_open_memory, job))

    @classmethod
    def _made(cls, context: Context, reference: Reference) -> BeamFile:
        made = cls._wrap(reference)
        made.context = context
        report = _abi.msq_beam_file_report()
        report.struct_size = ctypes.sizeof(report)
        lib.msq_beam_file_info(made._ref, 0, ctypes.byref(report))
        made.mesh_triangles = report.mesh_triangle_count
        made.lattices: List[BeamLattice] = [BeamLattice(made, number)
                                            for number in range(report.lattice_count)]
        return made

    def mesh(self, *, winding: str = "auto") -> Shape:
        """What is solid besides the beams: all triangles of the build."""
        return self._shape(0, "solid", winding)

    def _shape(self, lattice: int, mesh: str, winding: str) -> Shape:
        return Shape._make(self.context, lib.msq_beam_file_shape, self._ref, lattice,
                           constant("MSQ_BEAM_FILE_", mesh, "mesh"),
                           constant("MSQ_WINDING_", winding, "winding"))

    def __repr__(self) -> str:
        beams = sum(len(lattice.beams) for lattice in self.lattices)
        return f"<msq.BeamFile of {beams} beams, {self.mesh_triangles} triangles>"
