# SPDX-License-Identifier: Apache-2.0
"""Lists of beams: arrays of any layout, what they hold, and what is refused."""
import unittest

import numpy as np

import msq

NODES = np.array([(-2, -2, -2), (2, -1.5, -2), (1.5, 2, 0.25), (-1.75, 1.5, 2), (0, 0, 0)])
BEAMS = np.array([(0, 1), (1, 2), (2, 3), (3, 0)], np.uint32)
RADII = np.array([(0.5, 0.5), (0.25, 0.75), (0.75, 0), (0.5, 0.25)])
CAPS = np.array([(0, 1), (1, 1), (0, 2), (2, 1)], np.uint8)
BALLS = np.array([4, 1], np.uint32)
BALL_RADII = np.array([0.5, 0.875])
POINTS = (np.random.RandomState(1).rand(20000, 3) - 0.5) * 7


def contains(beams, points=POINTS):
    return msq.Model(msq.Shape.box((-4, -4, -4), (4, 4, 4)), [beams]).contains(points)


def frame(**changes):
    given = {"nodes": NODES, "beams": BEAMS, "radius": RADII, "cap": CAPS, "balls": BALLS,
             "ball_radius": BALL_RADII, **changes}
    return msq.Beams(given.pop("nodes"), given.pop("beams"), **given)


def distance_to_segment(points, a, b):
    along = np.clip((points - a) @ (b - a) / np.dot(b - a, b - a), 0, 1)
    return np.linalg.norm(points - a - along[:, None] * (b - a), axis=1)


class Beams(unittest.TestCase):
    def test_hold_what_is_near_their_axes(self):
        near = np.min([distance_to_segment(POINTS, NODES[i], NODES[j]) for i, j in BEAMS], axis=0)
        expected = (near <= 0.3) | (np.linalg.norm(POINTS - NODES[4], axis=1) <= 0.75)
        inside = contains(msq.Beams(NODES, BEAMS, radius=0.3, balls=[4], ball_radius=0.75))
        np.testing.assert_array_equal(inside, expected)
        self.assertTrue(inside.any() and not inside.all())

    def test_caps_and_radii_are_of_each_end(self):
        ends = [(-1, 0, 0), (1, 0, 0)]
        beyond = [(-1.4, 0, 0), (1.4, 0, 0), (-0.9, 0.495, 0), (0, 0.4, 0)]
        for cap, radius, expected in (
                ("sphere", 0.5, [1, 1, 1, 1]), ("butt", 0.5, [0, 0, 1, 1]),
                ("hemisphere", [(0.5, 0.25)], [1, 0, 0, 0]),
                ("sphere", [(0.5, 0.25)], [1, 0, 0, 0]),
                ([(0, 2)], 0.5, [1, 0, 1, 1]), ([(2, 1)], 0.5, [0, 1, 1, 1])):
            inside = contains(msq.Beams(ends, [(0, 1)], radius=radius, cap=cap), beyond)
            self.assertEqual(inside.tolist(), [bool(x) for x in expected], (cap, radius))

    def test_layouts_change_no_answer(self):
        expected = contains(frame())
        self.assertTrue(expected.any() and not expected.all())
        wide = np.full((5, 9), np.nan)
        wide[:, 2:5] = NODES
        spread = np.zeros((4, 5), np.uint32)
        spread[:, 1:3] = BEAMS
        cap_rows = np.full((4, 4), 77, np.uint8)
        cap_rows[:, 1:3] = CAPS
        radius_rows = np.full((8, 3), np.nan)
        radius_rows[::2, :2] = RADII
        every_other = np.full(4, np.nan)
        every_other[::2] = BALL_RADII
        some_balls = np.full((2, 3), 99, np.uint32)
        some_balls[:, 2] = BALLS
        for changes in (
                {"nodes": wide[:, 2:5], "beams": spread[:, 1:3], "cap": cap_rows[:, 1:3],
                 "radius": radius_rows[::2, :2], "balls": some_balls[:, 2],
                 "ball_radius": every_other[::2]},
                {"nodes": NODES.astype(np.float32), "radius": RADII.astype(np.float32),
                 "ball_radius": BALL_RADII.astype(np.float32)},
                {"radius": RADII.astype(np.float32), "ball_radius": BALL_RADII.tolist()},
                {"nodes": NODES.tolist(), "beams": BEAMS.tolist(), "radius": RADII.tolist(),
                 "cap": CAPS.tolist(), "balls": BALLS.tolist()},
                {"beams": BEAMS.astype(np.int64), "cap": np.asfortranarray(CAPS),
                 "radius": np.asfortranarray(RADII), "balls": BALLS[::-1].copy()[::-1]}):
            np.testing.assert_array_equal(contains(frame(**changes)), expected)
        same = np.broadcast_to(np.array((0.25, 0.5)), (4, 2))
        np.testing.assert_array_equal(contains(frame(radius=same)),
                                      contains(frame(radius=same.copy())))

    def test_arrays_are_not_needed_afterwards(self):
        nodes = NODES.copy()
        beams = frame(nodes=nodes)
        nodes[:] = np.nan
        np.testing.assert_array_equal(contains(beams), contains(frame()))

    def test_lengths(self):
        ends = [(-1, 0, 0), (1, 0, 0), (1, 2, 0), (1, 2, 0.25)]
        for options, length in (({}, 2), ({"length_scale": 0.5}, 0.5), ({"radius": 1.5}, 3)):
            beams = msq.Beams(ends, [(0, 1), (2, 3)], **{"radius": 0.125, **options})
            model = msq.Model(msq.Shape.box((-4, -4, -4), (4, 4, 4)), [beams])
            self.assertEqual(model.scale_length(1), length)
        for min_length, expected in ((0, True), (0.25, True), (0.5, False)):
            beams = msq.Beams(ends, [(0, 1), (2, 3)], radius=0.125, min_length=min_length)
            self.assertEqual(contains(beams, [(1, 2, 0.1)]).tolist(), [expected])

    def test_refusals(self):
        bad_nodes = NODES.copy()
        bad_nodes[3, 1] = np.nan
        field = msq.Field.gradient((0, 0, 0), 0.1, (1, 0, 0), 0.2)
        for kind, text, changes in (
                (msq.ArgumentError, "node 3", {"nodes": bad_nodes}),
                (msq.ArgumentError, "beam 1 is at node 5", {"beams": [(0, 1), (5, 2), (2, 3),
                                                                      (3, 0)]}),
                (msq.ArgumentError, "radius is -1", {"radius": -1}),
                (msq.ArgumentError, "cap 1 of beam 0 is 3", {"cap": [(0, 3)] * 4}),
                (msq.ArgumentError, "there must be a beam or a ball",
                 {"beams": None, "radius": 0, "cap": "butt", "balls": None, "ball_radius": 0}),
                (msq.LimitError, "100 bytes|100", {"context": msq.Context(memory_limit=100)}),
                (ValueError, "'sphere', 'hemisphere', 'butt'", {"cap": "round"}),
                (ValueError, "3 radius and 4 beams", {"radius": RADII[:3]}),
                (ValueError, "1 cap and 4 beams", {"cap": [(0, 0)]}),
                (ValueError, "3 ball_radius and 2 balls", {"ball_radius": [1, 2, 3]}),
                (ValueError, r"radius have shape \(4,\)", {"radius": RADII[:, 0]}),
                (ValueError, r"beams have shape \(4, 3\)", {"beams": np.zeros((4, 3), np.uint32)}),
                (ValueError, r"balls have shape \(2, 1\)", {"balls": BALLS[:, None]}),
                (ValueError, "whole", {"beams": BEAMS - 0.5}),
                (ValueError, "whole", {"balls": [-1, 2]}),
                (TypeError, "nodes of float32", {"nodes": NODES.astype(np.float32)}),
                (TypeError, "", {"radius": field}),
                (TypeError, "Job", {"job": 1})):
            with self.assertRaisesRegex(kind, text):
                frame(**changes)

    def test_jobs(self):
        job = msq.Job()
        frame(job=job)
        self.assertEqual(job.progress, 1)
        job.cancel()
        with self.assertRaises(msq.CancelledError):
            frame(job=job)


if __name__ == "__main__":
    unittest.main()
