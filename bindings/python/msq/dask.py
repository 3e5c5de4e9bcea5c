# SPDX-License-Identifier: Apache-2.0
"""Grids too large for one process, in chunks: as arrays of Dask, and into Zarr.

    def bracket():
        return msq.Model(msq.Shape.from_file("bracket.stl"), [msq.Foam(cell_size=4, radius=0.4)])

    grid = msq.PointGrid(origin=(0, 0, 0), spacing=0.05, counts=(4000, 3000, 2000))
    solid = msq.dask.array(bracket, grid)               # dask.array, computed when it is asked for
    msq.dask.to_zarr(bracket, grid, "bracket.zarr", levels=4)

Models cannot be sent to other processes, but recipes can: `build`, a function without arguments that
can be pickled and returns the Model. Each process calls it once and keeps the model. A chunk is one task
and one index window of the grid (docs/howto/windows.md), so chunks, workers and the order of tasks change no
byte. `import msq.dask` needs Dask (Debian: python3-dask), and to_zarr zarr (python3-zarr): with zarr 2 it
writes Zarr version 2, with zarr 3 or later version 3.
"""
from __future__ import annotations

import collections
import dataclasses
import itertools
import os
import threading
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Sequence, Set, Tuple, Union

import numpy as np

from .errors import UnsupportedError
from .model import Model
from .points import PointGrid

try:
    import dask
    import dask.array
    import dask.highlevelgraph
    from dask.base import tokenize
except ImportError as _error:
    raise ImportError("msq.dask needs Dask and its arrays (Debian: python3-dask; pip: dask[array]): "
                      f"{_error}") from None

Build = Callable[[], Model]
Box = Tuple[Tuple[int, int], ...]  #: (first, end) of z, y, x

_MODELS_KEPT = 4  # by a process
_VALUES = {"contains": np.dtype(np.bool_), "distance": np.dtype(np.float64),
           "region": np.dtype(np.int32), "material": np.dtype(np.uint32)}
_MEANS = ("contains", "distance")  # of which coarser levels are means; of the others single samples


class Stored(NamedTuple):
    """What to_zarr wrote."""

    path: str
    shapes: List[Tuple[int, int, int]]  #: of the levels, finest first: nz, ny, nx
    chunks: Tuple[int, int, int]  #: of all levels
    tasks: int  #: chunks, or shards, computed, of all levels
    model_hash: str  #: Model.hash; "" if the model has none


class _Recipe:
    """The function that builds the model, and its name among those of this process."""

    def __init__(self, build: Build) -> None:
        if not callable(build):
            raise TypeError(f"build is a {type(build).__name__}; it must be a function that returns a "
                            "Model")
        self.build = build
        self.token = tokenize(build)

    def __dask_tokenize__(self) -> str:
        return self.token

    def model(self) -> Model:
        """The model, built by the first call in this process."""
        with _lock:
            model = _models.pop(self.token, None)
            if model is None:
                model = self.build()
                if not isinstance(model, Model):
                    raise TypeError(f"build returned a {type(model).__name__}; it must return a Model")
            _models[self.token] = model
            while len(_models) > _MODELS_KEPT:
                _models.popitem(last=False)
            return model


_models: "collections.OrderedDict[str, Model]" = collections.OrderedDict()
_lock = threading.Lock()


def array(build: Build, grid: PointGrid, *, value: str = "contains", chunks: Any = "auto") -> Any:
    """A dask.array of a model's values at the points of a grid, of shape grid.shape: (nz, ny, nx).

    value: `contains` (bool), `distance` (float64), `region` (int32) or `material` (uint32, ids), as
    the methods of Model. chunks: as dask.array.zeros takes them, in the order z, y, x.
    """
    dtype = _dtype(value)
    recipe = _Recipe(build)
    shape = grid.shape
    try:
        normal = dask.array.core.normalize_chunks(chunks, shape, dtype=dtype)
    except ZeroDivisionError:
        raise ValueError(f"chunks are {chunks!r}; they must be at least 1") from None
    name = "msq-" + tokenize(recipe, grid, value, normal)
    ends = [list(itertools.accumulate(sizes, initial=0)) for sizes in normal]
    tasks = {(name, *index): (_block, recipe, grid, value,
                              tuple((ends[axis][i], ends[axis][i + 1]) for axis, i in enumerate(index)))
             for index in itertools.product(*(range(len(sizes)) for sizes in normal))}
    graph = dask.highlevelgraph.HighLevelGraph.from_collections(name, tasks)
    return dask.array.Array(graph, name, normal, dtype=dtype)


def to_zarr(build: Build, grid: PointGrid, path: Union[str, "os.PathLike[str]"], *,
            value: str = "contains", chunks: Union[int, Sequence[int]] = 256, levels: int = 1,
            unit: str = "millimeter", compressor: Any = "default",
            shards: Union[None, int, Sequence[int]] = None) -> Stored:
    """Computes the values at the points of a grid, and stores them as Zarr in a new folder: version 2
    where zarr 2 is installed, version 3 where zarr 3 or later is.

    The workers of the current dask.distributed client, or the local scheduler of Dask, compute and
    write one chunk per task; nothing large comes back. A task may be repeated: it writes the same
    bytes, and a chunk is renamed into place when it is whole. With shards, of Zarr version 3, a file
    and a task are a shard: one number or (nz, ny, nx), multiples of the chunks, which readers still
    fetch one by one.

    The arrays `0` (the whole grid), `1`, ... are levels of half the resolution each, with the metadata
    of OME-Zarr (0.4, with version 3 0.5) beside them, written last: a folder without it is not complete.
    value: as in array; `contains` is stored as uint8, 255 inside and 0 outside, and coarser levels
    hold the coverage. Those of `distance` are means; of ids single samples, each eighth one. chunks:
    of all levels, one number or (nz, ny, nx). unit: of lengths, a name of OME-Zarr. compressor: of
    numcodecs, with version 3 of zarr.codecs; default: Blosc with Zstandard, bits shuffled. None: none.

    FileExistsError if the path exists. RuntimeError if processes built models that differ.
    """
    version = _zarr_version()
    path = os.fspath(path)
    dtype = _dtype(value)
    recipe = _Recipe(build)
    sizes = _sizes(chunks, "chunks")
    parts = sizes  # of which each is a task
    if shards is not None:
        if version < 3:
            raise UnsupportedError("shards are of Zarr version 3; this zarr writes version 2 (pip: 'zarr>=3')")
        parts = _sizes(shards, "shards")
        if any(part % size for part, size in zip(parts, sizes)):
            raise ValueError(f"shards are {shards!r}; they must be multiples of the chunks {sizes}")
    if levels < 1 or (min(grid.shape) - 1) >> (levels - 1) < 1 and levels > 1:
        raise ValueError(f"levels is {levels}; it must be at least 1, and leave 2 points along each axis "
                         f"of {grid.shape}")
    if os.path.lexists(path):
        raise FileExistsError(f"{path} exists; to_zarr needs a new folder")
    stored_type = np.dtype(np.uint8) if value == "contains" else dtype
    folder = (_Folder3 if version >= 3 else _Folder2)(path)
    shapes, tasks, hashes = [], 0, set()  # type: List[Tuple[int, int, int]], int, Set[str]
    shape: Tuple[int, ...] = grid.shape
    for level in range(levels):
        folder.create(level, shape, sizes, None if shards is None else parts, stored_type, compressor)
        shared = dask.delayed(recipe, traverse=False)  # sent once, not with each task
        work = [dask.delayed(_write, pure=False)(shared, grid, value, path, level, box, sizes[0])
                if level == 0 else
                dask.delayed(_write_coarser, pure=False)(value, path, level, box, sizes[0])
                for box in _boxes(shape, parts)]
        hashes.update(dask.compute(*work))
        tasks += len(work)
        shapes.append(shape)  # type: ignore[arg-type]
        shape = tuple((count + 1) // 2 for count in shape)
    hashes -= {_NO_MODEL}
    if len(hashes) > 1:
        raise RuntimeError(f"build made models that differ: {', '.join(sorted(hashes))}")
    _remove_parts(path)
    folder.describe(_multiscales(grid, value, levels, unit, os.path.basename(os.path.normpath(path))))
    return Stored(path, shapes, sizes, tasks, hashes.pop())


_NO_MODEL = "-"  # of tasks that ask no model


def _dtype(value: str) -> np.dtype:
    if value not in _VALUES:
        raise ValueError(f"value is {value!r}; it must be one of {', '.join(map(repr, _VALUES))}")
    return _VALUES[value]


def _sizes(given: Union[int, Sequence[int]], name: str) -> Tuple[int, ...]:
    sizes = (given,) * 3 if isinstance(given, int) else tuple(int(size) for size in given)
    if len(sizes) != 3 or min(sizes) < 1:
        raise ValueError(f"{name} are {given!r}; they must be one number or three, each at least 1")
    return sizes


def _zarr_version() -> int:
    try:
        import zarr
    except ImportError as error:
        raise ImportError(f"to_zarr needs zarr (Debian: python3-zarr; pip: zarr): {error}") from None
    return int(zarr.__version__.split(".")[0])


class _Folder2:
    """A folder of Zarr version 2, by zarr 2."""

    def __init__(self, path: str) -> None:
        import zarr
        self._group = zarr.group(zarr.DirectoryStore(path, dimension_separator="/"))

    def create(self, level: int, shape: Sequence[int], chunks: Sequence[int],
               _shards: Optional[Sequence[int]], dtype: np.dtype, compressor: Any) -> None:
        if compressor == "default":
            from numcodecs import Blosc
            compressor = Blosc("zstd", clevel=1, shuffle=Blosc.BITSHUFFLE if dtype.itemsize == 1
                               else Blosc.SHUFFLE)
        self._group.create_dataset(str(level), shape=shape, chunks=chunks, dtype=dtype,
                                   compressor=compressor, fill_value=0, write_empty_chunks=False)

    def describe(self, image: Dict[str, Any]) -> None:
        self._group.attrs["multiscales"] = [{"version": "0.4", **image}]

    @staticmethod
    def open(path: str, level: int) -> Any:
        import zarr
        store = zarr.DirectoryStore(path, dimension_separator="/")
        return zarr.Array(store, path=str(level), write_empty_chunks=False)


class _Folder3:
    """A folder of Zarr version 3, by zarr 3 or later."""

    def __init__(self, path: str) -> None:
        import zarr
        self._group = zarr.create_group(path, zarr_format=3)

    def create(self, level: int, shape: Sequence[int], chunks: Sequence[int],
               shards: Optional[Sequence[int]], dtype: np.dtype, compressor: Any) -> None:
        if compressor == "default":
            from zarr.codecs import BloscCodec
            compressor = BloscCodec(cname="zstd", clevel=1,
                                    shuffle="bitshuffle" if dtype.itemsize == 1 else "shuffle")
        self._group.create_array(str(level), shape=tuple(shape), chunks=tuple(chunks), dtype=dtype,
                                 shards=None if shards is None else tuple(shards),
                                 compressors=compressor, fill_value=0, dimension_names=("z", "y", "x"),
                                 config={"write_empty_chunks": False})

    def describe(self, image: Dict[str, Any]) -> None:
        self._group.attrs["ome"] = {"version": "0.5", "multiscales": [image]}

    @staticmethod
    def open(path: str, level: int) -> Any:
        import zarr
        found = zarr.open_array(os.path.join(path, str(level)), mode="r+", zarr_format=3)
        return found.with_config({"write_empty_chunks": False})


def _boxes(shape: Sequence[int], sizes: Sequence[int]) -> List[Box]:
    """Those of the chunks."""
    along = [[(first, min(first + size, count)) for first in range(0, count, size)]
             for count, size in zip(shape, sizes)]
    return list(itertools.product(*along))


def _compute(model: Model, grid: PointGrid, value: str, box: Box) -> np.ndarray:
    """The values in a box of the grid's indices, or of its window's."""
    offset = (0, 0, 0) if grid.window is None else grid.window[0]
    first = tuple(low + int(start) for (low, _), start in zip(box[::-1], offset))
    count = tuple(high - low for low, high in box[::-1])
    part = dataclasses.replace(grid, window=(first, count))
    if value == "contains":
        return model.contains(part)
    if value == "distance":
        return model.distance(part)
    if value == "region":
        return model.region(part)
    return model.material(part)[0]


def _block(recipe: _Recipe, grid: PointGrid, value: str, box: Box) -> np.ndarray:
    return _compute(recipe.model(), grid, value, box)


def _slices(box: Box) -> Tuple[slice, ...]:
    return tuple(slice(low, high) for low, high in box)


def _pieces(box: Box, depth: int) -> List[Box]:
    """Parts of a box of at most that many planes, so that shards take little more than their own memory."""
    (first, end), *rest = box
    return [((z, min(z + depth, end)), *rest) for z in range(first, end, depth)]


def _store(path: str, level: int, box: Box, depth: int, values_of: Callable[[Box], np.ndarray]) -> None:
    """Stores one chunk or shard from the values of its pieces."""
    array = _open(path, level)
    pieces = _pieces(box, depth)
    if len(pieces) == 1:
        array[_slices(box)] = values_of(box)
        return
    values = np.empty([high - low for low, high in box], array.dtype)
    for piece in pieces:
        values[piece[0][0] - box[0][0]:piece[0][1] - box[0][0]] = values_of(piece)
    array[_slices(box)] = values


def _write(recipe: _Recipe, grid: PointGrid, value: str, path: str, level: int, box: Box,
           depth: int) -> str:
    """Computes and stores one chunk or shard; returns the hash of the model."""
    model = recipe.model()

    def values_of(piece: Box) -> np.ndarray:
        values = _compute(model, grid, value, piece)
        return values.view(np.uint8) * np.uint8(255) if value == "contains" else values

    _store(path, level, box, depth, values_of)
    try:
        return model.hash
    except UnsupportedError:  # of a build without xxHash, or of callbacks without hash_key
        return ""


def _write_coarser(value: str, path: str, level: int, box: Box, depth: int) -> str:
    """Stores one chunk or shard of a level from the one before."""
    finer = _open(path, level - 1)

    def values_of(piece: Box) -> np.ndarray:
        values = finer[tuple(slice(2 * low, min(2 * high, count))
                             for (low, high), count in zip(piece, finer.shape))]
        return _halved(values) if value in _MEANS else values[::2, ::2, ::2]

    _store(path, level, box, depth, values_of)
    return _NO_MODEL


def _halved(values: np.ndarray) -> np.ndarray:
    """Means of 2 x 2 x 2 values, of fewer at the end of an odd axis; whole numbers are rounded."""
    return np.concatenate([_halved_planes(values[z:z + 2]) for z in range(0, len(values), 2)])


def _halved_planes(values: np.ndarray) -> np.ndarray:
    """Of two planes, which the processor's cache holds, or of one."""
    total = values
    halvings = np.zeros((1, 1, 1), np.uint16)  # of which samples the sum has 2 to this power
    for axis in range(3):  # in this order for all chunks: sums of floats depend on it
        before = (slice(None),) * axis
        first, second = total[(*before, slice(0, None, 2))], total[(*before, slice(1, None, 2))]
        total = first.astype(np.uint16 if values.dtype == np.uint8 else values.dtype)
        total[(*before, slice(0, second.shape[axis]))] += second
        both = np.arange(total.shape[axis], dtype=np.uint16) < second.shape[axis]
        halvings = halvings + both.astype(np.uint16).reshape([-1 if i == axis else 1 for i in range(3)])
    if total.dtype.kind == "f":
        return total / 2.0**halvings
    return ((total + ((1 << halvings) >> 1)) >> halvings).astype(values.dtype)


def _open(path: str, level: int) -> Any:
    return (_Folder3 if _zarr_version() >= 3 else _Folder2).open(path, level)


def _remove_parts(path: str) -> None:
    """Removes what processes that were killed had begun to write."""
    for folder, _, names in os.walk(path):
        for name in names:
            if name.endswith(".partial"):
                os.unlink(os.path.join(folder, name))


def _multiscales(grid: PointGrid, value: str, levels: int, unit: str, name: str) -> Dict[str, Any]:
    """The metadata of OME-Zarr: where the points of each level are."""
    from .context import triple
    spacing, origin = triple(grid.spacing, "spacing"), triple(grid.origin, "origin")
    first = (0, 0, 0) if grid.window is None else grid.window[0]
    datasets = []
    for level in range(levels):
        step = 2**level
        shift = (step - 1) / 2 if value in _MEANS else 0.0  # of the mean of so many points
        datasets.append({"path": str(level), "coordinateTransformations": [
            {"type": "scale", "scale": [size * step for size in spacing[::-1]]},
            {"type": "translation", "translation": [
                start + (int(index) + shift) * size
                for start, index, size in zip(origin[::-1], tuple(first)[::-1], spacing[::-1])]}]})
    return {"name": name, "type": "mean" if value in _MEANS else "nearest",
            "axes": [{"name": axis, "type": "space", "unit": unit} for axis in "zyx"],
            "datasets": datasets}


__all__ = ["Stored", "array", "to_zarr"]
