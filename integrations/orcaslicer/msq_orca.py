# /// script
# requires-python = ">=3.12"
# dependencies = ["numpy"]
#
# [tool.orcaslicer.plugin]
# name = "msq: lattices and foams"
# description = "Fills parts, or their sparse infill, with the lattices, foams and surfaces of msq."
# author = "msq"
# version = "0.2.0"
# ///
# SPDX-License-Identifier: Apache-2.0
"""A slicing-pipeline plug-in for OrcaSlicer (docs/orcaslicer.md says what of it was run).

With "where": "part" the slices become their intersection with the structure, at the step posSlice; OrcaSlicer
makes walls and infill of what is left. With "where": "infill" it is the sparse infill surfaces, at
posPrepareInfill: what is inside the structure becomes internal solid infill, the rest empty. At posInfill the
lines that OrcaSlicer made are measured and not changed.

Coordinates of the structure are millimetres: x and y as in the slices of the object, z from its bottom.
"""
import json
import sys

import numpy as np

import orca

DEFAULTS = {
    "where": "infill",  # "infill" or "part"
    # As in model files of msq (docs/model_file.md).
    "structure": {"foam": {"grid": {"cell_size": 8}, "radius": 0, "wall_thickness": 0.6}},
    "tolerance": 0.02,  # mm, of the structure's contours
    "msq_path": "",     # the folder that has the package msq; "": Python finds it
}
PLACES = ("infill", "part")
INFILL_ROLES = ("Sparse infill", "Internal solid infill")


class ConfigError(Exception):
    """The configuration makes no sense."""


def read_config(text):
    """DEFAULTS with what the text, a JSON object, says."""
    try:
        given = json.loads(text or "{}")
    except ValueError as error:
        raise ConfigError(f"the configuration is no JSON: {error}") from error
    if not isinstance(given, dict):
        raise ConfigError("the configuration is no JSON object")
    for key in given:
        if key not in DEFAULTS:
            raise ConfigError(f"the configuration has the unknown key {key!r}; it may have "
                              f"{', '.join(DEFAULTS)}")
    config = {**DEFAULTS, **given}
    if config["where"] not in PLACES:
        raise ConfigError(f"where is {config['where']!r}; it must be one of {', '.join(PLACES)}")
    if isinstance(config["tolerance"], bool) or not isinstance(config["tolerance"], (int, float)):
        raise ConfigError(f"tolerance is {config['tolerance']!r}; it must be a number")
    return config


def import_msq(path):
    """The package msq, which may lie outside of OrcaSlicer's own packages."""
    if path and path not in sys.path:
        sys.path.append(path)
    import msq  # pylint: disable=import-outside-toplevel
    return msq


def failures():
    """Exceptions that the slicer shows as messages: those of msq too, if it could be imported."""
    msq = sys.modules.get("msq")
    of_msq = () if msq is None else (msq.Error,)
    return (ConfigError, ImportError, ValueError, OSError, *of_msq)


def make_model(msq, config, ctx_object, unit):
    """The structure in a box that is wider than the object. unit: mm of one of the slicer's integers."""
    low_x, low_y, high_x, high_y = (unit * float(side) for side in ctx_object.bounding_box())
    layers = ctx_object.layers()
    top = max((layer.slice_z + layer.height for layer in layers), default=1.0)
    box = {"min": [low_x - 1, low_y - 1, -1], "max": [high_x + 1, high_y + 1, top + 1]}
    document = {"msq_model": 1, "scales": [{"shape": {"box": box}}, {"structure": config["structure"]}]}
    return msq.Model.from_json(json.dumps(document))


class Pieces:
    """The section of a model at a height, as polygons with holes in the slicer's integers."""

    def __init__(self, model, height, tolerance, unit):
        contours = model.contours(height, tolerance, type="int64", units=1 / unit)
        holes = {}
        for ring in np.flatnonzero(contours.holes):
            holes.setdefault(int(contours.parents[ring]), []).append(int(ring))
        self.polygons, lows, highs = [], [], []
        for ring in np.flatnonzero(~contours.holes):
            outer = contours[int(ring)]
            inner = [np.array(contours[hole]) for hole in holes.get(int(ring), ())]
            self.polygons.append(orca.host.ExPolygon(np.array(outer), inner))
            lows.append(outer.min(axis=0))
            highs.append(outer.max(axis=0))
        self.lows = np.array(lows, np.int64).reshape(-1, 2)
        self.highs = np.array(highs, np.int64).reshape(-1, 2)

    def within(self, polygon):
        """The intersection with a polygon of the slicer, as polygons of its own."""
        points = polygon.contour.as_array()
        low, high = points.min(axis=0), points.max(axis=0)
        del points  # an array is valid until execute() ends, and no longer than its polygon
        near = np.flatnonzero(((self.lows <= high) & (self.highs >= low)).all(axis=1))
        found = []
        for index in near:
            found.extend(polygon.intersection_ex(self.polygons[index]))
        return found


def copy_of(surface, polygon, surface_type=None):
    """A surface of its own: what a collection held is gone once the collection is set."""
    copied = orca.host.Surface(surface.surface_type if surface_type is None else surface_type, polygon)
    copied.thickness = surface.thickness
    copied.bridge_angle = surface.bridge_angle
    copied.extra_perimeters = surface.extra_perimeters
    return copied


def replace(collection, surfaces):
    if surfaces:
        collection.set(surfaces)
    else:
        collection.clear()


def cut_slices(layer, pieces):
    """The slices of a layer become their intersection with the structure."""
    for region in layer.regions():
        replace(region.slices, [copy_of(surface, polygon) for surface in region.slices.surfaces
                                for polygon in pieces.within(surface.expolygon)])
    layer.make_slices()  # the islands, from which overhangs, skirt and supports follow


def fill_sparse(layer, pieces):
    """The sparse infill of a layer becomes solid inside the structure and empty outside it."""
    for region in layer.regions():
        surfaces, is_changed = [], False
        for surface in region.fill_surfaces.surfaces:
            if surface.is_internal() and not surface.is_solid() and not surface.is_bridge():
                surfaces += [copy_of(surface, polygon, orca.host.SurfaceType.stInternalSolid)
                             for polygon in pieces.within(surface.expolygon)]
                is_changed = True
            else:
                surfaces.append(copy_of(surface, surface.expolygon))
        if is_changed:
            replace(region.fill_surfaces, surfaces)


def infill_length(ctx_object, unit):
    """mm of infill lines. Fills are read-only."""
    length = 0.0
    for layer in ctx_object.layers():
        for region in layer.regions():
            for path in region.fills.flatten_paths():
                if path.role in INFILL_ROLES:
                    steps = np.diff(path.points()[:, :2].astype(np.float64), axis=0)
                    length += unit * float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    return length


class Fill(orca.slicing.SlicingPipelineCapabilityBase):
    """Fills the parts of a plate."""

    def get_name(self):
        return "msq"

    def get_default_config(self):
        return dict(DEFAULTS)

    def execute(self, ctx):
        step = orca.slicing.Step
        if ctx.object is None or ctx.step not in (step.posSlice, step.posPrepareInfill, step.posInfill):
            return orca.ExecutionResult.success()
        try:
            return self.work(ctx)
        except failures() as error:
            return orca.ExecutionResult.failure(orca.PluginResult.FatalError, f"msq: {error}")

    def work(self, ctx):
        step, success = orca.slicing.Step, orca.ExecutionResult.success
        config = read_config(self.get_config())
        unit = float(orca.slicing.unscale(1))
        if ctx.step == step.posInfill:
            return success(f"msq: {infill_length(ctx.object, unit) / 1000:.2f} m of infill lines")
        if ctx.step != (step.posSlice if config["where"] == "part" else step.posPrepareInfill):
            return success()
        edit = cut_slices if config["where"] == "part" else fill_sparse
        model = make_model(import_msq(config["msq_path"]), config, ctx.object, unit)
        count = 0
        for layer in ctx.object.layers():
            if ctx.cancelled():
                return orca.ExecutionResult.skipped("msq: cancelled")
            edit(layer, Pieces(model, float(layer.slice_z), float(config["tolerance"]), unit))
            count += 1
        return success(f"msq: {count} layers filled")


@orca.plugin
class Package(orca.base):
    """What the file registers."""

    def register_capabilities(self):
        orca.register_capability(Fill)
