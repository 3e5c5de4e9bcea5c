# SPDX-License-Identifier: Apache-2.0
"""Objects say what they were made from: repr, and parameters that can be read back."""
import copy
import unittest
import weakref

import numpy as np

import msq
from support import box_model

NAMES = {"msq": msq, "array": np.array}


class ReadBack(unittest.TestCase):
    def test_parameters_are_as_given_or_defaults(self):
        field = msq.Field.gradient((0, 0, 0), 0.1, (0, 0, 5), 0.3)
        foam = msq.Foam(cell_size=(2, 2.5, 3), radius=field, seed=7)
        self.assertEqual(foam.cell_size, (2, 2.5, 3))
        self.assertIs(foam.radius, field)
        self.assertEqual((foam.seed, foam.jitter, foam.density, foam.method), (7, 1.0, 1.0, "auto"))
        lattice = msq.Lattice("octet", radius=0.2)
        self.assertEqual((lattice.unit_cell, lattice.radius, lattice.cell_size), ("octet", 0.2, 1.0))
        sheet = msq.Functional("gyroid", kind="sheet", thickness=0.1)
        self.assertEqual((sheet.function, sheet.kind, sheet.thickness), ("gyroid", "sheet", 0.1))
        self.assertIsNone(sheet.expression)
        context = msq.Context(threads=3, memory_limit=1 << 30)
        self.assertEqual((context.threads, context.memory_limit), (3, 1 << 30))
        shape = msq.Shape.box((0, 0, 0), (1, 1, 1))
        model = msq.Model(shape, [foam, msq.Scale(lattice, skin=0.2)])
        self.assertIs(model.shape, shape)
        self.assertIs(model.structures[0], foam)

    def test_parameters_cannot_be_set(self):
        foam = msq.Foam(radius=0.2)
        with self.assertRaisesRegex(AttributeError, "radius cannot be set: a Foam is immutable"):
            foam.radius = 0.3
        self.assertEqual(foam.radius, 0.2)

    def test_what_was_not_given_is_no_attribute(self):
        model = msq.Model.regions(box_model())
        with self.assertRaisesRegex(AttributeError, "this Model was made without a shape"):
            model.shape
        self.assertFalse(hasattr(model, "structures"))

    def test_copies_and_closed_objects(self):
        foam = msq.Foam(radius=0.2)
        twin = copy.copy(foam)
        foam.close()
        self.assertEqual(twin.radius, 0.2)
        self.assertEqual(repr(foam), "<msq.Foam, closed>")

    def test_lists_given_are_not_those_kept(self):
        size = [1.0, 2.0, 3.0]
        foam = msq.Foam(radius=0.2, cell_size=size)
        size[0] = 9
        self.assertEqual(foam.cell_size, [1.0, 2.0, 3.0])

    def test_objects_are_kept_however_many(self):
        foams = [msq.Foam(radius=0.2, seed=seed) for seed in range(20)]
        self.assertEqual(msq.Model(msq.Shape.box((0, 0, 0), (1, 1, 1)), foams).structures, foams)
        self.assertEqual(repr(msq.Structure.union(*foams)).count("msq.Foam"), 20)

    def test_generators_are_kept_as_what_they_yield(self):
        foam = msq.Foam(radius=0.2)
        box = msq.Shape.box((0, 0, 0), (1, 1, 1))
        model = msq.Model(box, (one for one in [foam, msq.Scale(foam, skin=0.1)]))
        self.assertIs(model.structures[0], foam)
        self.assertEqual(len(model.structures), 2)

    def test_grids_and_cameras_are_compared(self):
        grid = msq.PointGrid(np.zeros(3), 1, [2, 3, 4])
        self.assertEqual(grid, msq.PointGrid((0.0, 0.0, 0.0), 1, (2, 3, 4)))
        self.assertNotEqual(grid, msq.PointGrid(np.ones(3), 1, (2, 3, 4)))
        self.assertEqual(len({grid, msq.PointGrid([0, 0, 0], 1, np.array([2, 3, 4]))}), 1)
        self.assertEqual(msq.Stratified((0, 0, 0), 1, (2, 2, 2), rotation=np.eye(3)),
                         msq.Stratified((0, 0, 0), 1, (2, 2, 2), rotation=np.eye(3).tolist()))
        self.assertEqual(msq.Camera(np.array([9, 0, 0]), (0, 0, 0)), msq.Camera((9, 0, 0), (0, 0, 0)))

    def test_large_arrays_are_not_kept(self):
        values = np.zeros((8, 8, 8))
        field = msq.Field.grid(values)
        gone = weakref.ref(values)
        del values
        self.assertIsNone(gone())
        self.assertEqual(repr(field), "msq.Field.grid(<array (8, 8, 8)>)")


class Repr(unittest.TestCase):
    def test_it_is_what_makes_the_object_again(self):
        field = msq.Field.radial((0, 0, 0), 1.0, 0.1, 4.0, 0.3, axis=(0, 0, 1))
        ball = msq.Shape.sphere((1, 2, 3), 4.0)
        steel = msq.Material(7, density=7.8)
        for made in (field, field.map([(0.0, 1.0), (1.0, 2.0)]), ball, ball.offset(0.5),
                     ball - msq.Shape.box((0, 0, 0), (1, 1, 1)), steel,
                     msq.Foam(radius=field, cell_size=2, seed=3), msq.Lattice("kelvin", radius=0.2),
                     msq.Functional(expression="cos(x)", level=0.1, parameters={"a": 1.0}),
                     msq.Model(ball, [msq.Foam(radius=0.2)], material=steel)):
            again = eval(repr(made), dict(NAMES))
            self.assertEqual(repr(again), repr(made))
            if msq.build_info().with_xxhash:
                self.assertEqual(again.hash, made.hash, repr(made))
        for made in (msq.Warp(12, 1, outer_radius=3.0), msq.SampledWarp(field, field, field),
                     msq.Period([0, 1], [1, 2]), msq.Grid(2, (1, 2, 3)), msq.UnitCell("bcc"),
                     msq.UnitCell(nodes=[(0, 0, 0), (1, 1, 1)], struts=[(0, 1)]),
                     msq.Scale(msq.Foam(radius=0.2), skin=0.1), msq.Camera((9, 0, 0), (0, 0, 0)),
                     msq.PointGrid((0, 0, 0), 1, (2, 3, 4), ((0, 0, 0), (1, 1, 1))),
                     msq.Stratified((0, 0, 0), 1, (2, 3, 4), seed=3),
                     msq.Lattice(msq.UnitCell("bcc"), radius=0.1, warp=msq.Warp(12, 4))):
            self.assertEqual(repr(eval(repr(made), dict(NAMES))), repr(made))
        self.assertEqual(repr(msq.Warp(12, 1, 3.0)),
                         "msq.Warp(count=12, inner_radius=1, outer_radius=3.0)")
        self.assertEqual(repr(msq.Period(np.zeros(99), 1)),
                         "msq.Period(positions=<array (99,)>, cell_sizes=1)")
        self.assertEqual(repr(msq.Foam(radius=0.2, cell_size=2)), "msq.Foam(radius=0.2, cell_size=2)")

    def test_others_say_what_they_hold(self):
        model = box_model()
        slicer = model.slicer(layer_height=0.5, pitch=0.5)
        self.assertEqual(repr(slicer), "<msq.Slicer: 8 layers of 16 x 12 pixels, bits>")
        self.assertEqual(repr(msq.Job()), "<msq.Job, 0 % done>")
        self.assertRegex(repr(model.mesh(0.5)), r"<msq.Mesh: \d+ vertices, \d+ triangles>")
        self.assertEqual(repr(model.render(width=20, height=10, outputs=("depth", "rgba"))),
                         "<msq.Picture: 20 x 10, depth, rgba>")
        function = msq.Field.host(lambda points: points[:, 0], 0.0, 1.0)
        self.assertIn("<function <lambda>>", repr(function))


if __name__ == "__main__":
    unittest.main()
