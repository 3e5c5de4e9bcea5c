# SPDX-License-Identifier: Apache-2.0
"""The boundary of a model as triangles."""
from __future__ import annotations

import contextlib
import ctypes
import os
import secrets
import shutil
from typing import (Any, BinaryIO, Dict, Iterator, List, NamedTuple, Optional, Sequence, Tuple,
                    Union)

import numpy as np

from . import _abi
from ._arrays import start_of
from ._interrupt import interruptible
from ._library import defaults, keep_exception, lib
from .context import Job, unsigned

Box = Tuple[Sequence[float], Sequence[float]]  #: (min, max), each x, y, z

_FORMATS = {"stl": _abi.MSQ_SURFACE_STL, "ply": _abi.MSQ_SURFACE_PLY}


class Mesh(NamedTuple):
    """Triangles that enclose a volume. Made by Model.mesh.

    matplotlib draws them on 3D axes: axes.plot_trisurf(*mesh.vertices.T, triangles=mesh.triangles).
    """

    vertices: np.ndarray  #: (n, 3) float64
    normals: np.ndarray  #: (n, 3) float32, outward, of length 1
    triangles: np.ndarray  #: (m, 3) uint32: vertices, counter-clockwise seen from outside

    @property
    def trimesh_arguments(self) -> Dict[str, Any]:
        """trimesh.Trimesh(**mesh.trimesh_arguments) is the mesh, with its vertices and their order."""
        return {"vertices": self.vertices, "faces": self.triangles, "vertex_normals": self.normals,
                "process": False}

    @property
    def vtk_cells(self) -> np.ndarray:
        """(4 * m,) int64: 3 and three vertices for each triangle, as vtkCellArray and
        pyvista.PolyData(mesh.vertices, mesh.vtk_cells) take them."""
        cells = np.empty((len(self.triangles), 4), np.int64)
        cells[:, 0] = 3
        cells[:, 1:] = self.triangles
        return cells.ravel()

    def __repr__(self) -> str:
        return f"<msq.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles>"


def definition_of(pitch: float, box: Optional[Box], length_scale: float,
                  slab_layers: int) -> _abi.msq_surface_def:
    definition = defaults(_abi.msq_surface_def)
    definition.pitch = pitch
    if box is not None:
        low, high = (tuple(map(float, corner)) for corner in box)
        if len(low) != 3 or len(high) != 3:
            raise ValueError(f"box is {box!r}; it must be two triples of numbers")
        definition.has_box = 1
        definition.min[:] = low
        definition.max[:] = high
    definition.length_scale = length_scale
    definition.slab_layers = unsigned(slab_layers, 32, "slab_layers")
    return definition


def mesh(model: Any, definition: _abi.msq_surface_def, job: Optional[Job]) -> Mesh:
    """See Model.mesh."""
    parts: List[Tuple[np.ndarray, np.ndarray, np.ndarray]] = []

    def copied(address: Any, count: int, dtype: Any) -> np.ndarray:
        if count == 0:
            return np.empty((0, 3), dtype)
        size = 3 * count * np.dtype(dtype).itemsize
        memory = (ctypes.c_uint8 * size).from_address(start_of(address))
        return np.frombuffer(memory, dtype).reshape(count, 3).copy()

    def take(_user: Any, pointer_to_slab: Any) -> int:
        try:
            slab = pointer_to_slab.contents
            parts.append((copied(slab.vertices, slab.vertex_count, np.float64),
                          copied(slab.normals, slab.vertex_count, np.float32),
                          copied(slab.triangles, slab.triangle_count, np.uint32)))
            return 0
        except BaseException as error:  # none may pass through C
            return keep_exception(error)

    reference, function = model._ref, _abi.msq_surface_fn(take)
    interruptible(lambda work: lib.msq_surface_mesh(reference, ctypes.byref(definition), function,
                                                    None, work), job, calls_back=True)
    if not parts:
        return Mesh(np.empty((0, 3)), np.empty((0, 3), np.float32), np.empty((0, 3), np.uint32))
    vertices, normals, triangles = (parts[0] if len(parts) == 1 else
                                    [np.concatenate(arrays) for arrays in zip(*parts)])
    return Mesh(vertices, normals, triangles)


def save_mesh(model: Any, file: Union[str, "os.PathLike[str]", BinaryIO], format: Optional[str],
              definition: _abi.msq_surface_def, job: Optional[Job]) -> None:
    """See Model.save_mesh."""
    if format is None:
        if not isinstance(file, (str, os.PathLike)):
            raise ValueError("format is None; it must be 'stl' or 'ply' where file is not a path")
        format = os.path.splitext(os.fspath(file))[1][1:].lower()
    if format not in _FORMATS:
        raise ValueError(f"format is {format!r}; it must be 'stl' or 'ply'")
    if isinstance(file, (str, os.PathLike)):
        with _replacing(os.fsdecode(file)) as opened:
            _write(model, opened, _FORMATS[format], definition, job)
    else:
        _write(model, file, _FORMATS[format], definition, job)


@contextlib.contextmanager
def _replacing(path: str) -> Iterator[BinaryIO]:
    """A file that gets its name when it is complete, and the permissions of the file that it replaces.
    A failure leaves that file as it is. What is no plain file is written to where it is."""
    target = os.path.realpath(path)  # so that a link stays
    if os.path.exists(target) and not os.path.isfile(target):
        with open(path, "wb") as file:
            yield file
        return
    folder, name = os.path.split(target)
    temporary = os.path.join(folder, f".{name[:40]}.{secrets.token_hex(4)}.part")
    try:
        opened = open(temporary, "xb")
    except OSError as error:
        error.filename = path
        raise
    try:
        with opened:
            yield opened
        with contextlib.suppress(OSError):  # there is none, or the disk has no permissions
            shutil.copymode(target, temporary)
        os.replace(temporary, target)
    except BaseException:
        with contextlib.suppress(OSError):
            os.remove(temporary)
        raise


def _write(model: Any, file: Any, format: int, definition: _abi.msq_surface_def,
           job: Optional[Job]) -> None:
    start = file.tell() if format == _abi.MSQ_SURFACE_PLY else 0

    def take(_user: Any, pointer_to_part: Any) -> int:
        try:
            part = pointer_to_part.contents
            if format == _abi.MSQ_SURFACE_PLY:  # STL comes in order
                file.seek(start + part.offset)
            file.write(ctypes.string_at(part.bytes, part.size))
            return 0
        except BaseException as error:  # none may pass through C
            return keep_exception(error)

    reference, function = model._ref, _abi.msq_file_fn(take)
    interruptible(lambda work: lib.msq_surface_file(reference, ctypes.byref(definition), format,
                                                    function, None, work), job, calls_back=True)
    if format == _abi.MSQ_SURFACE_PLY:
        file.seek(0, os.SEEK_END)
