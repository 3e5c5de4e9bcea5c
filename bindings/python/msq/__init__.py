# SPDX-License-Identifier: Apache-2.0
"""msq: lattices and foams inside a part, without ever meshing them.

    part = msq.Shape.from_file("bracket.stl")
    model = msq.Model(part, [msq.Foam(cell_size=4, radius=0.4)])
    inside = model.contains(points)                # (n, 3) float32 or float64, read where it lies
    for layer in model.slicer(layer_height=0.1, pitch=0.1):
        save(layer.index, layer.data)

Lengths are in the model's unit, millimetres with files. What the words mean exactly:
docs/concepts.md of msq; msq.h says the rest. Objects are immutable, and any thread may use them;
calls let other Python threads run. Failures are exceptions with the library's message: see Error.
"""
from ._grid import Grid, Period, SampledWarp, Warp
from ._host import HostPoints
from .beam_file import BeamFile, BeamLattice
from .camera import Camera
from .context import (BuildInfo, CacheInfo, Context, Job, JobInfo, MemoryInfo, build_info)
from .contours import Contours
from .document import Document
from .errors import (ArgumentError, CancelledError, Error, FileError, HostError, InternalError,
                     LimitError, MeshError, OutOfMemoryError, UnsupportedError)
from .field import Field, Param
from .fill import Fill
from .implicit_file import ImplicitPart, read_3mf_implicit
from .material import Material
from .model import Model, Scale
from .picture import Picture, RenderPass
from .points import PointGrid, PointSet, Stratified
from .printability import Printability
from .progress import progress
from .shape import Shape, ShapeInfo
from .slicer import Layer, Output, Slicer
from .statistics import Calibration, Estimate
from .structure import (Beams, Foam, Functional, HostFunctional, HostStructure, Lattice,
                        LatticeFaces, PlateLattice, Structure, Waves)
from .strut_graph import StrutGraph
from .surface import Mesh
from .unit_cell import UnitCell, UnitCellInfo

__version__ = "0.2.0"

__all__ = [
    "ArgumentError", "BeamFile", "BeamLattice", "Beams", "BuildInfo", "CacheInfo", "Calibration",
    "Camera", "CancelledError",
    "Context", "Contours", "Document", "Error", "Estimate", "Field", "FileError", "Fill", "Foam", "Functional",
    "Grid", "HostError",
    "HostFunctional", "HostPoints", "HostStructure", "ImplicitPart", "InternalError", "Job", "JobInfo",
    "Lattice",
    "LatticeFaces", "Layer", "LimitError", "Material", "MemoryInfo", "Mesh", "MeshError",
    "Model",
    "OutOfMemoryError", "Output", "Param", "Period", "Picture", "PlateLattice", "PointGrid", "PointSet",
    "Printability", "RenderPass", "Scale",
    "Shape", "ShapeInfo", "Slicer", "Stratified", "Structure", "StrutGraph", "UnitCell", "UnitCellInfo",
    "SampledWarp", "UnsupportedError", "Warp", "Waves", "build_info", "progress",
    "read_3mf_implicit",
]
