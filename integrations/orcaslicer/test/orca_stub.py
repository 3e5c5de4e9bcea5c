# SPDX-License-Identifier: Apache-2.0
"""Stands in for the module orca of OrcaSlicer's slicing-pipeline plug-ins, with the rules that its public
documents state:

- slices and fill surfaces can be edited; perimeters and fills are read-only;
- references into a collection are invalid once the collection is set or cleared;
- objects and arrays of the slicing graph are valid until execute() ends;
- user interface and the live model are not for plug-ins on the slicing thread.

A rule that is broken raises Broken. Clipper's place is taken by a clip of polygons to a rectangle, so the
polygons of the graph must be rectangles.
"""
import enum
import gc
import sys
import types
import weakref

import numpy as np

UNIT = 1e-6  # mm


class Broken(AssertionError):
    """A plug-in has broken a rule."""


class Life:
    """Of a run of execute(): what it gave away must not be used after it, nor its arrays kept."""

    def __init__(self):
        self.is_over, self.arrays = False, []

    def check(self):
        if self.is_over:
            raise Broken("an object of the slicing graph was used after execute()")

    def lend(self, array):
        self.check()
        lent = array.view()
        self.arrays.append(weakref.ref(lent))
        return lent

    def end(self):
        self.is_over = True
        gc.collect()
        if any(array() is not None for array in self.arrays):
            raise Broken("an array of the slicing graph was kept after execute()")


def ring_of(points):
    if isinstance(points, Polygon):
        points = points.array
    if not isinstance(points, np.ndarray) or points.dtype != np.int64 or points.ndim != 2 or \
            points.shape[1] != 2 or len(points) < 3:
        raise ValueError("a polygon takes an (N, 2) int64 array of 3 points or more")
    return points.copy()


class Polygon:
    def __init__(self, points, life=None):
        self.array, self.life = ring_of(points), life

    def as_array(self):
        return self.life.lend(self.array) if self.life else self.array.view()


def clip(ring, axis, bound, sign):
    """The part of a ring with sign * coordinate >= sign * bound (Sutherland and Hodgman, 1974)."""
    found = []
    for a, b in zip(ring, ring[1:] + ring[:1]):
        inside = sign * (a[axis] - bound) >= 0, sign * (b[axis] - bound) >= 0
        if inside[0]:
            found.append(a)
        if inside[0] != inside[1]:
            t = (bound - a[axis]) / (b[axis] - a[axis])
            found.append(tuple(bound if i == axis else a[i] + t * (b[i] - a[i]) for i in (0, 1)))
    return found


class ExPolygon:
    def __init__(self, contour, holes=None, life=None):
        self.life = life
        self._contour = Polygon(contour, life)
        self._holes = [Polygon(hole, life) for hole in holes or []]

    @property
    def contour(self):
        if self.life:
            self.life.check()
        return self._contour

    @property
    def holes(self):
        return list(self._holes)

    def intersection_ex(self, other):
        if self.life:
            self.life.check()
        low, high = self._contour.array.min(axis=0), self._contour.array.max(axis=0)
        if self._holes or len(self._contour.array) != 4:
            raise NotImplementedError("a polygon of the stub's graph that is no rectangle")
        rings = []
        for polygon in [other._contour, *other._holes]:
            ring = [tuple(map(float, point)) for point in polygon.array]
            for axis in (0, 1):
                ring = clip(ring, axis, float(low[axis]), 1)
                ring = clip(ring, axis, float(high[axis]), -1)
            rings.append(np.rint(np.array(ring).reshape(-1, 2)).astype(np.int64))
        if len(rings[0]) < 3:
            return []
        return [ExPolygon(rings[0], [ring for ring in rings[1:] if len(ring) >= 3])]


class SurfaceType(enum.Enum):
    stTop, stBottom, stInternal, stInternalSolid = range(4)


class Surface:
    def __init__(self, surface_type, expolygon):
        if not isinstance(surface_type, SurfaceType) or not isinstance(expolygon, ExPolygon):
            raise TypeError("Surface(surface_type, expolygon)")
        self.surface_type, self._expolygon = surface_type, expolygon
        self.thickness, self.bridge_angle, self.extra_perimeters = -1.0, -1.0, 0
        self.is_gone = False

    @property
    def expolygon(self):
        if self.is_gone:
            raise Broken("a surface was used after its collection was set")
        return self._expolygon

    def is_internal(self):
        return self.surface_type in (SurfaceType.stInternal, SurfaceType.stInternalSolid)

    def is_solid(self):
        return self.surface_type is not SurfaceType.stInternal

    def is_bridge(self):
        return False


class SurfaceCollection:
    def __init__(self, surfaces=()):
        self._surfaces, self.life, self.edits = list(surfaces), None, 0

    @property
    def surfaces(self):
        self.life.check()
        for surface in self._surfaces:
            polygon = surface.expolygon
            polygon.life = polygon._contour.life = self.life
        return list(self._surfaces)

    def clear(self):
        self.set([])

    def set(self, surfaces):
        self.life.check()
        copies = []
        for surface in surfaces:
            polygon = surface.expolygon
            copied = Surface(surface.surface_type, ExPolygon(polygon._contour, polygon._holes))
            copied.thickness, copied.extra_perimeters = surface.thickness, surface.extra_perimeters
            copies.append(copied)
        for surface in self._surfaces:
            surface.is_gone = True
        self._surfaces = copies
        self.edits += 1


class ExtrusionPath:
    def __init__(self, role, points):
        self._role, self._points = role, np.array(points, np.int64)
        self._points.flags.writeable = False
        self.life = None

    @property
    def role(self):
        return self._role

    def points(self):
        return self.life.lend(self._points)


class Fills:
    """Read-only."""

    __slots__ = ("_paths", "life")

    def __init__(self, paths):
        self._paths, self.life = tuple(paths), None

    def flatten_paths(self):
        self.life.check()
        for path in self._paths:
            path.life = self.life
        return list(self._paths)


class LayerRegion:
    def __init__(self, slices, fill_surfaces=(), fills=()):
        self._parts = SurfaceCollection(slices), SurfaceCollection(fill_surfaces), Fills(fills)

    # Without setters: as in the slicer, a collection is edited and not replaced.
    slices = property(lambda self: self._parts[0])
    fill_surfaces = property(lambda self: self._parts[1])
    fills = property(lambda self: self._parts[2])


class Layer:
    def __init__(self, slice_z, height, regions):
        self.slice_z, self.height, self._regions = slice_z, height, regions
        self.print_z = slice_z + height / 2
        self.slices_made = 0

    def regions(self):
        return list(self._regions)

    def make_slices(self):
        self.slices_made += 1


class PrintObject:
    def __init__(self, layers, box):
        self._layers, self._box = layers, box

    def layers(self):
        return list(self._layers)

    def bounding_box(self):
        return self._box


class PluginResult(enum.Enum):
    Success, Skipped, RecoverableError, FatalError = range(4)


class ExecutionResult:
    def __init__(self, status, message=""):
        self.status, self.message = status, message

    @classmethod
    def success(cls, message=""):
        return cls(PluginResult.Success, message)

    @classmethod
    def skipped(cls, message=""):
        return cls(PluginResult.Skipped, message)

    @classmethod
    def failure(cls, status, message):
        return cls(PluginResult(status), message)


class Step(enum.Enum):
    posSlice, posPerimeters, posPrepareInfill, posInfill, posIroning, psSkirtBrim, psGCodePostProcess = range(7)


class Capability:
    config = "{}"

    def get_config(self):
        return self.config


class Context:
    def __init__(self, step, print_object, cancel_after=None):
        self.step, self.object, self.cancel_after, self.asked = step, print_object, cancel_after, 0

    def cancelled(self):
        self.asked += 1
        return self.cancel_after is not None and self.asked > self.cancel_after


def run(capability, step, print_object, cancel_after=None):
    """One call of execute(), as the slicer makes it. Returns the result."""
    life = Life()
    for layer in print_object.layers() if print_object else ():
        for region in layer.regions():
            for part in (region.slices, region.fill_surfaces, region.fills):
                part.life = life
    result = capability.execute(Context(step, print_object, cancel_after))
    life.end()
    if not isinstance(result, ExecutionResult):
        raise Broken(f"execute() returned {result!r}")
    return result


def forbidden(*_):
    raise Broken("user interface or live model on the slicing thread")


def install():
    """Makes `import orca` find this."""
    orca = types.ModuleType("orca")
    orca.registered, orca.packages = [], []
    orca.PluginResult, orca.ExecutionResult, orca.base = PluginResult, ExecutionResult, object
    orca.register_capability = orca.registered.append
    orca.plugin = lambda cls: orca.packages.append(cls) or cls
    orca.slicing = types.SimpleNamespace(SlicingPipelineCapabilityBase=Capability, Step=Step,
                                         unscale=lambda value: UNIT * value)
    orca.host = types.SimpleNamespace(ExPolygon=ExPolygon, Surface=Surface, SurfaceType=SurfaceType, model=forbidden,
                                      ui=types.SimpleNamespace(message=forbidden))
    sys.modules["orca"] = orca
    return orca
