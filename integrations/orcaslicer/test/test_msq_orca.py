# SPDX-License-Identifier: Apache-2.0
"""The plug-in for OrcaSlicer against a stub that keeps its rules (orca_stub.py). Sections are compared
with membership of points."""
import json
import pathlib
import re
import sys
import unittest

import msq
import numpy as np

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(pathlib.Path(__file__).resolve().parents[1])]
import orca_stub as stub  # noqa: E402

ORCA = stub.install()
import msq_orca  # noqa: E402

SIDE, HEIGHT = 20.0, 0.4  # mm
FOAM = {"foam": {"grid": {"cell_size": 5}, "radius": 0.7, "seed": 3}}


def rectangle(low, high):
    x0, y0, x1, y1 = (round(side / stub.UNIT) for side in (*low, *high))
    return stub.ExPolygon(np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], np.int64))


def make_object(layer_count=4):
    """A block about the origin: sparse infill within solid bottoms, lines in the fills."""
    half, kind = SIDE / 2, stub.SurfaceType
    layers = []
    for index in range(layer_count):
        slices = [stub.Surface(kind.stInternal, rectangle((-half, -half), (half, half)))]
        slices[0].extra_perimeters = 2
        fill = [stub.Surface(kind.stInternal, rectangle((-half + 1, -half + 1), (0, half - 1))),
                stub.Surface(kind.stBottom, rectangle((0, -half + 1), (half - 1, half - 1)))]
        fills = [stub.ExtrusionPath("Sparse infill", [(0, 0, 0), (3000000, 4000000, 0)]),
                 stub.ExtrusionPath("Outer wall", [(0, 0, 0), (9000000, 0, 0)])]
        layers.append(stub.Layer((index + 0.5) * HEIGHT, HEIGHT, [stub.LayerRegion(slices, fill, fills)]))
    edge = round(half / stub.UNIT)
    return stub.PrintObject(layers, (-edge, -edge, edge, edge))


def covers(surfaces, points):
    """Even-odd, of the rings of all surfaces."""
    inside = np.zeros(len(points), bool)
    for surface in surfaces:
        for ring in [surface._expolygon._contour, *surface._expolygon._holes]:
            a = ring.array * stub.UNIT
            b = np.roll(a, -1, axis=0)
            for (ax, ay), (bx, by) in zip(a, b):
                if ay == by:
                    continue
                crosses = (ay <= points[:, 1]) != (by <= points[:, 1])
                at = ax + (points[:, 1] - ay) / (by - ay) * (bx - ax)
                inside ^= crosses & (points[:, 0] < at)
    return inside


def structure_model():
    return msq.Model(msq.Shape.box((-20, -20, -5), (20, 20, 20)), [msq.Foam(cell_size=5, radius=0.7, seed=3)])


class Plugin(unittest.TestCase):
    def setUp(self):
        self.fill = msq_orca.Fill()

    def run_step(self, step, print_object, cancel_after=None, **config):
        self.fill.config = json.dumps({"structure": FOAM, **config})
        return stub.run(self.fill, step, print_object, cancel_after)

    def assert_done(self, result):
        self.assertEqual(result.status, stub.PluginResult.Success, result.message)

    def check_section(self, surfaces, low, high, height):
        """Points of the rectangle, but for those near the boundary, are where the model says."""
        points = np.random.RandomState(5).uniform(low, high, (1500, 2))
        solid = np.column_stack([points, np.full(len(points), height)])
        model = structure_model()
        clear = np.abs(model.distance(solid)) > 0.06
        self.assertGreater(clear.sum(), 1000)
        inside = model.contains(solid)
        self.assertGreater(inside.sum(), 20)
        self.assertTrue((covers(surfaces, points)[clear] == inside[clear]).all())

    def test_slices_become_sections(self):
        block = make_object()
        result = self.run_step(stub.Step.posSlice, block, where="part")
        self.assert_done(result)
        self.assertIn("4 layers", result.message)
        for layer in block.layers():
            region, = layer.regions()
            self.assertEqual((region.slices.edits, region.fill_surfaces.edits, layer.slices_made), (1, 0, 1))
            for surface in region.slices._surfaces:
                self.assertEqual((surface.surface_type, surface.extra_perimeters), (stub.SurfaceType.stInternal, 2))
            self.check_section(region.slices._surfaces, (-9.9, -9.9), (9.9, 9.9), layer.slice_z)

    def test_sparse_infill_becomes_solid_in_the_structure(self):
        block = make_object()
        self.assert_done(self.run_step(stub.Step.posPrepareInfill, block, where="infill"))
        for layer in block.layers():
            region, = layer.regions()
            self.assertEqual((region.slices.edits, region.fill_surfaces.edits, layer.slices_made), (0, 1, 0))
            kinds = [surface.surface_type for surface in region.fill_surfaces._surfaces]
            self.assertEqual(kinds.count(stub.SurfaceType.stBottom), 1)
            self.assertNotIn(stub.SurfaceType.stInternal, kinds)
            solid = [s for s in region.fill_surfaces._surfaces if s.surface_type is stub.SurfaceType.stInternalSolid]
            self.check_section(solid, (-8.9, -8.9), (-0.1, 8.9), layer.slice_z)

    def test_each_place_has_its_step(self):
        for where, step in (("part", stub.Step.posPrepareInfill), ("infill", stub.Step.posSlice),
                            ("part", stub.Step.posPerimeters), ("infill", stub.Step.psGCodePostProcess)):
            block = make_object(1)
            self.assert_done(self.run_step(step, block, where=where))
            region, = block.layers()[0].regions()
            self.assertEqual((region.slices.edits, region.fill_surfaces.edits), (0, 0))
        self.assert_done(self.run_step(stub.Step.psSkirtBrim, None))

    def test_fills_are_measured(self):
        block = make_object(200)
        result = self.run_step(stub.Step.posInfill, block)
        self.assert_done(result)
        self.assertIn("1.00 m of infill", result.message)  # 200 lines of 5 mm; walls do not count

    def test_a_layer_without_structure_is_empty(self):
        block = make_object(1)
        self.assert_done(self.run_step(stub.Step.posSlice, block, where="part", structure={
            "lattice": {"unit_cell": "cubic", "radius": 0.2, "grid": {"cell_size": 90, "origin": [45, 45, 45]}}}))
        self.assertEqual(block.layers()[0].regions()[0].slices._surfaces, [])

    def test_bad_configurations_change_nothing(self):
        for config, text in (({"wher": "part"}, "unknown key 'wher'"), ({"where": "skin"}, "where is 'skin'"),
                             ({"tolerance": "fine"}, "tolerance is 'fine'"),
                             ({"structure": {"foam": {"radios": 1}}}, "radios: unknown key"),
                             ({"structure": {"foam": {"radius": -1}}}, "radius"),
                             ({"structure": {"foam": {"grid": {"cell_size": 1e-8}, "radius": 1e-9}}}, "limit"), ({"tolerance": -1}, "tolerance")):
            with self.subTest(text):
                block = make_object(2)
                result = self.run_step(stub.Step.posPrepareInfill, block, **config)
                self.assertEqual(result.status, stub.PluginResult.FatalError)
                self.assertIn(text, result.message)
                self.assertTrue(result.message.startswith("msq: "))
                for layer in block.layers():
                    self.assertEqual(layer.regions()[0].fill_surfaces.edits, 0)
        self.fill.config = "{"
        self.assertIn("no JSON", stub.run(self.fill, stub.Step.posSlice, make_object(1)).message)

    def test_cancelling(self):
        block = make_object()
        result = self.run_step(stub.Step.posSlice, block, cancel_after=2, where="part")
        self.assertEqual(result.status, stub.PluginResult.Skipped)
        self.assertEqual([layer.regions()[0].slices.edits for layer in block.layers()], [1, 1, 0, 0])

    def test_the_file_describes_itself(self):
        text = pathlib.Path(msq_orca.__file__).read_text(encoding="utf-8")
        header = re.match(r"# /// script\n(.*?)# ///\n", text, flags=re.S)[1]
        self.assertTrue(all(line == "#" or line.startswith("# ") for line in header.splitlines()))
        for key in ("name", "description", "author", "version"):
            self.assertRegex(header, rf'(?m)^# {key} = ".+"$')
        self.assertEqual(len(ORCA.packages), 1)
        ORCA.packages[0]().register_capabilities()
        self.assertEqual(ORCA.registered, [msq_orca.Fill])
        self.assertEqual(json.loads(json.dumps(self.fill.get_default_config())), msq_orca.DEFAULTS)


class Rules(unittest.TestCase):
    """The stub finds what it is there to find."""

    def run_body(self, body):
        capability = stub.Capability()
        capability.execute = lambda ctx: body(ctx) or stub.ExecutionResult.success()
        stub.run(capability, stub.Step.posSlice, make_object(1))

    def test_rules(self):
        kept = []

        def region(ctx):
            return ctx.object.layers()[0].regions()[0]

        def keep_array(ctx):
            kept.append(region(ctx).slices.surfaces[0].expolygon.contour.as_array())

        def use_after_set(ctx):
            surface = region(ctx).slices.surfaces[0]
            region(ctx).slices.set([stub.Surface(surface.surface_type, surface.expolygon)])
            surface.expolygon  # pylint: disable=pointless-statement

        def replace_fills(ctx):
            region(ctx).fills = ()

        def edit_points(ctx):
            region(ctx).fills.flatten_paths()[0].points()[0, 0] = 1

        for body, error in ((keep_array, stub.Broken), (use_after_set, stub.Broken), (replace_fills, AttributeError),
                            (edit_points, ValueError), (lambda ctx: ORCA.host.model(), stub.Broken)):
            with self.assertRaises(error):
                self.run_body(body)
            kept.clear()
        self.run_body(lambda ctx: kept.append(region(ctx)))
        with self.assertRaises(stub.Broken):
            kept[0].slices.surfaces  # pylint: disable=pointless-statement


if __name__ == "__main__":
    unittest.main()
