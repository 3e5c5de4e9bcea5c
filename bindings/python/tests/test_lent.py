# SPDX-License-Identifier: Apache-2.0
"""Objects and memory live as long as they are used, and no longer."""
import contextlib
import gc
import os
import signal
import threading
import time
import unittest
import weakref
from unittest import mock

import numpy as np

import msq
from msq import _handle, _library
from support import box_model


@contextlib.contextmanager
def closing(name, *handles):
    """Handles are closed as soon as C is called: what another thread may do. Yields the objects that
    had been released when C began."""
    released = []

    class Tracked(_handle.Reference):
        def __del__(self):
            released.append(self)
            super().__del__()

    for handle in handles:
        reference = handle._reference
        lib_release = reference._release
        tracked = Tracked(reference._as_parameter_, lib_release)
        del reference._release  # the tracked one releases it
        handle._reference = tracked
        del reference, tracked
    plain, seen = getattr(_library.lib, name), []

    def call(*arguments):
        for handle in handles:
            handle.close()
        seen.append(len(released))
        return plain(*arguments)

    with mock.patch.object(_library.lib, name, call):
        yield seen


class Objects(unittest.TestCase):
    def check(self, name, make, *handles):
        with closing(name, *handles) as seen:
            make()
        self.assertEqual(seen, [0], name)

    def test_outlive_a_close_on_another_thread(self):
        def box():
            return msq.Shape.box((0, 0, 0), (4, 4, 4))

        def foam():
            return msq.Foam(radius=0.2)

        def field():
            return msq.Field.gradient((0, 0, 0), 0.1, (0, 0, 5), 0.3)

        a, b = box(), box()
        self.check("msq_shape_boolean", lambda: msq.Shape.union(a, b), a, b)
        c, d = foam(), foam()
        self.check("msq_structure_boolean", lambda: msq.Structure.union(c, d), c, d)
        shape, structure, skin, material = box(), foam(), field(), msq.Material(3)
        self.check("msq_model_create", lambda: msq.Model(
            shape, [msq.Scale(structure, skin=skin, material=material)]),
            shape, structure, skin, material)
        one, other = box_model(), box_model()
        self.check("msq_model_regions", lambda: msq.Model.regions(one, other), one, other)
        radius = field()
        self.check("msq_structure_foam", lambda: msq.Foam(radius=radius), radius)
        near = box()
        self.check("msq_field_shape_distance",
                   lambda: msq.Field.shape_distance(near, [(0, 0.1), (1, 0.3)]), near)
        values = [msq.Field.grid(np.arange(8.0).reshape(2, 2, 2)) for _ in range(3)]
        with contextlib.suppress(msq.Error):
            self.check("msq_structure_functional", lambda: msq.Functional(
                "gyroid", warp=msq.SampledWarp(*values)), *values)


class Mine(Exception):
    pass


class Exceptions(unittest.TestCase):
    def fail(self, layer_or_points):
        view = getattr(layer_or_points, "rows", layer_or_points)
        self.views.append(weakref.ref(view.base if view.base is not None else view))
        raise Mine

    def setUp(self):
        self.views = []

    def caught(self, call):
        try:
            call()
        except Mine as error:
            return error
        raise AssertionError("nothing was raised")

    def test_hold_no_memory_that_was_lent(self):
        slicer = box_model().slicer(layer_height=1, pitch=0.5)
        field = msq.Field.host(self.fail, 0, 1)
        for call in (lambda: slicer.run(self.fail), lambda: field.evaluate(np.zeros((10, 3)))):
            error = self.caught(call)
            self.assertIsNotNone(error.__traceback__)
            self.assertTrue(self.views)
            self.assertEqual([view() for view in self.views], [None] * len(self.views))

    def test_form_no_cycles(self):
        field = msq.Field.host(self.fail, 0, 1)
        gone = []

        class Large:
            pass

        def work():
            large = Large()
            gone.append(weakref.ref(large))
            try:
                field.evaluate(np.zeros((10, 3)))
            except Mine:
                pass
            try:
                msq.Foam(radius=-1)
            except msq.Error:
                pass

        gc.collect()
        gc.disable()
        try:
            work()
            self.assertIsNone(gone[0]())
        finally:
            gc.enable()


class Interrupts(unittest.TestCase):
    def test_end_a_picture_between_passes(self):
        model = msq.Model(msq.Shape.box((0, 0, 0), (40, 40, 40)), [msq.Foam(radius=0.2, cell_size=2)])
        threads = []
        begin = time.monotonic()
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            while time.monotonic() < begin + 60:
                model.render(width=1500, height=1500, samples=4,
                             on_pass=lambda _picture, _done: threads.append(threading.current_thread()))
        self.assertEqual(set(threads) - {threading.main_thread()}, set())

    def test_within_a_pass_are_raised(self):
        def on_pass(_picture, _done):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            box_model().render(width=64, height=64, on_pass=on_pass)


class Values(unittest.TestCase):
    def test_that_c_would_cut_are_refused(self):
        model, plan = box_model(), box_model().slicer(layer_height=1, pitch=0.5)
        for text, call in (
                ("axis is 4294967298", lambda: model.contours(1, 0.1, axis=2**32 + 2)),
                ("topology_samples is 4294967298",
                 lambda: plan.contours(1, 0.1, topology_samples=2**32 + 2)),
                ("axis is 4294967296", lambda: msq.Foam(
                    radius=0.2, period=msq.Period([0, 1], [1, 2], axis=2**32))),
                ("null character", lambda: msq.Field.expression("1\0+x", 0, 1)),
                ("null character", lambda: msq.Functional(expression="x\0")),
                ("null character", lambda: msq.Shape.from_file("a.stl\0.png")),
                ("null character", lambda: model.to_json(title="a\0b"))):
            with self.assertRaisesRegex(ValueError, text):
                call()


if __name__ == "__main__":
    unittest.main()
