# SPDX-License-Identifier: Apache-2.0
"""Layers: the three ways give the same, the same as points."""
import unittest

import numpy as np

import msq
from support import box_model, reference_model


class Layers(unittest.TestCase):
    def check_ways(self, slicer):
        """Iteration, callback and random access give the same layers; returns them."""
        layers = list(slicer)
        self.assertEqual([layer.index for layer in layers], list(range(len(slicer))))
        called = []
        self.assertTrue(slicer.run(lambda layer: called.append(layer.copy())))
        for layers_of_a_way in (called, [slicer[i] for i in range(len(slicer))]):
            self.assertEqual(len(layers_of_a_way), len(layers))
            for ours, theirs in zip(layers, layers_of_a_way):
                self.assertTrue(np.array_equal(ours.rows, theirs.rows))
                self.assertEqual((ours.index, ours.z, ours.inside_count, ours.width, ours.height),
                                 (theirs.index, theirs.z, theirs.inside_count, theirs.width,
                                  theirs.height))
        return layers

    def test_are_the_same_in_every_way_and_those_of_points(self):
        model = reference_model()
        bits = self.check_ways(model.slicer(layer_height=0.5, pitch=0.125, slab_layers=4))
        bytes_ = self.check_ways(model.slicer(layer_height=0.5, pitch=0.125, output="bytes"))
        slicer = model.slicer(layer_height=0.5, pitch=0.125)
        self.assertEqual(len(bits), 18)
        for ours, theirs in zip(bits, bytes_):
            self.assertEqual(ours.pixels.shape, (slicer.height, slicer.width))
            self.assertEqual(ours.pixels.dtype, np.bool_)
            self.assertTrue(np.array_equal(ours.pixels, theirs.pixels))
            self.assertEqual(ours.data.shape, (slicer.height, (slicer.width + 7) // 8))
            self.assertEqual(set(np.unique(theirs.data)), {0, 255})
            self.assertEqual(ours.pixels.sum(), ours.inside_count)
            grid = msq.PointGrid((*slicer.origin, slicer.z(ours.index)), (*slicer.pitch, 1),
                                 (slicer.width, slicer.height, 1))
            self.assertEqual(ours.z, slicer.z(ours.index))
            self.assertTrue(np.array_equal(ours.pixels, model.contains(grid)[0]))

    def test_holds_channels(self):
        steel = msq.Material(3, density=7.75)
        model = msq.Model(msq.Shape.sphere((0, 0, 0), 4), [msq.Lattice("bcc", cell_size=2, radius=0.3)],
                          material=steel)
        slicer = model.slicer(layer_height=1, pitch=0.25,
                              output=[msq.Output("channel", channel="density"), msq.Output("bits")])
        layer = slicer[3]
        density, inside = layer.data, layer.outputs[1].pixels
        self.assertEqual(density.dtype, np.float32)
        self.assertTrue(inside.any())
        self.assertTrue(np.array_equal(density, np.where(inside, np.float32(7.75), np.float32(0))))
        self.assertEqual(layer.inside_count, np.count_nonzero(inside))
        with self.assertRaisesRegex(msq.ArgumentError, "channel colour"):
            model.slicer(layer_height=1, pitch=0.25, output=[msq.Output("channel", channel="colour")])

    def test_holds_several_outputs(self):
        model = reference_model()
        plan = {"layer_height": 1.5, "pitch": 0.25}
        kinds = [msq.Output("bits"), msq.Output("contours", tolerance=0.03),
                 msq.Output("grey", grey_samples=8), msq.Output("distance"),
                 msq.Output("onset", scale=1, signed=True),
                 msq.Output("contours", tolerance=0.05, type="int32", units=1e5)]
        slicer = model.slicer(output=kinds, slab_layers=3, **plan)
        self.assertEqual(slicer.output, tuple(kinds))
        kept = []

        def take(layer):
            kept.append((layer.contours(), layer.contours(1), layer.copy(), layer.data.copy()))

        self.assertTrue(slicer.run(take))
        grey = model.slicer(output="grey", grey_samples=8, **plan)
        single = {kind: model.slicer(output=kind, **plan)
                  for kind in ("bits", "distance", "onset")}
        self.assertEqual(len(kept), len(slicer))
        for index, (layer, ways) in enumerate(zip(slicer, kept)):
            rings, coarse, copied, data = ways
            alone = slicer[index]
            for layer in (layer, copied, alone):
                self.assertEqual((layer.index, layer.output), (index, "bits"))
                self.assertTrue(np.array_equal(layer.data, data))
                self.assertTrue(np.array_equal(layer.data, single["bits"][index].data))
                self.assertEqual(layer.inside_count, single["bits"][index].inside_count)
                self.assertEqual(len(layer.outputs), len(kinds))
                self.assertTrue(np.array_equal(layer.outputs[2].rows, grey[index].rows))
                self.assertEqual(layer.outputs[2].inside_count, grey[index].inside_count)
                self.assertTrue(np.array_equal(layer.outputs[3].rows,
                                               single["distance"][index].rows))
                self.assertTrue(np.array_equal(layer.contours().points, rings.points))
            wanted = slicer.contours(index, 0.03)
            for label in ("points", "starts", "parents", "holes"):
                self.assertTrue(np.array_equal(getattr(rings, label), getattr(wanted, label)))
            self.assertEqual(coarse.points.dtype, np.int32)
            self.assertGreater(len(coarse), 0)
        onset = np.concatenate([layer.data for layer in single["onset"]])
        signed = np.concatenate([layer.outputs[4].data for layer in slicer])
        self.assertTrue((signed <= onset).all() and (signed < 0).any())

    def test_lies_in_a_frame(self):
        model = box_model()
        plan = {"layer_height": 0.5, "pitch": 0.25}
        for axis, order in ((0, (1, 2, 0)), (1, (0, 2, 1)), (2, (0, 1, 2))):
            slicer = model.slicer(axis=axis, **plan)
            sides = np.array((8, 6, 4))[list(order)]
            self.assertEqual((slicer.width, slicer.height, len(slicer)),
                             (4 * sides[0], 4 * sides[1], 2 * sides[2]))
            rows = np.zeros((3, 3))
            rows[range(3), order] = 1
            framed = model.slicer(frame=((0, 0, 0), rows), **plan)
            for k in (0, 3, 5):
                u, v = np.meshgrid(slicer.origin[0] + 0.25 * np.arange(slicer.width),
                                   slicer.origin[1] + 0.25 * np.arange(slicer.height))
                points = np.empty((u.size, 3))
                for n, values in enumerate((u, v, np.full(u.shape, slicer.z(k)))):
                    points[:, order[n]] = values.ravel()
                inside = model.contains(points).reshape(u.shape)
                self.assertTrue(np.array_equal(slicer[k].pixels, inside))
                self.assertTrue(np.array_equal(framed[k].pixels, inside))
        turned = model.slicer(frame=((1, 2, 3), ((0.6, 0.8, 0), (-0.8, 0.6, 0), (0, 0, 1))), **plan)
        self.assertGreater(turned[3].inside_count, 0)
        for words, arguments in (("axis is 3", {"axis": 3}), ("3", {"frame": ((0, 0, 0), [])}),
                                 ("only one", {"axis": 0, "frame": ((0, 0, 0), np.eye(3))})):
            with self.assertRaisesRegex(ValueError, words):
                model.slicer(**arguments, **plan)

    def test_refuses_outputs(self):
        model = box_model()
        plan = {"layer_height": 0.5, "pitch": 0.25}
        with self.assertRaisesRegex(ValueError, "it must be one of bits"):
            msq.Output("pixels")
        with self.assertRaisesRegex(ValueError, "contours need one"):
            msq.Output("contours")
        with self.assertRaisesRegex(ValueError, "contours need one"):
            msq.Output("bits", tolerance=1.0)
        with self.assertRaisesRegex(ValueError, "at least one"):
            model.slicer(output=[], **plan)
        with self.assertRaisesRegex(TypeError, "list of Output"):
            model.slicer(output=["bits"], **plan)
        with self.assertRaisesRegex(ValueError, "it must be one of bits"):
            model.slicer(output="contours", **plan)
        slicer = model.slicer(output=[msq.Output("contours", tolerance=0.1)], **plan)
        layer = slicer[0]
        self.assertEqual(len(layer.contours()), len(slicer.contours(0, 0.1)))
        with self.assertRaisesRegex(ValueError, "no pixels"):
            layer.data
        with self.assertRaisesRegex(IndexError, "1 of the layer's outputs"):
            layer.contours(1)
        kept = []
        with self.assertRaises(BufferError):
            model.slicer(output=[msq.Output("bytes"), msq.Output("bits")], **plan).run(
                lambda layer: kept.append(layer.outputs[1].data))

    def test_plans_as_asked(self):
        model = box_model(foam=False)
        slicer = model.slicer(region=((-1, -1, 0), (9, 7, 4)), resolution=(20, 16),
                              layer_z=[0.5, 1.5, 2.25])
        self.assertEqual((slicer.width, slicer.height, len(slicer)), (20, 16, 3))
        self.assertEqual(slicer.pitch, (0.5, 0.5))
        self.assertEqual(slicer.origin, (-0.75, -0.75))
        self.assertEqual([layer.z for layer in slicer], [0.5, 1.5, 2.25])
        self.assertEqual(slicer[0].inside_count, 16 * 12)
        self.assertEqual(slicer[-1].index, 2)
        self.assertEqual(slicer.output, "bits")
        counted = model.slicer(pitch=(0.5, 1), layer_height=0.25, layer_count=7)
        self.assertEqual((counted.width, counted.height, len(counted)), (16, 6, 7))
        full = box_model().slicer(pitch=0.5, layer_height=0.5, length_scale=float("inf"))
        self.assertEqual(full[0].inside_count, 16 * 12)

    def test_ranges(self):
        slicer = box_model().slicer(pitch=0.25, layer_height=0.25, slab_layers=3)
        self.assertEqual([layer.index for layer in slicer.layers(5, 8)], list(range(5, 13)))
        self.assertEqual(list(slicer.layers(16)), [])
        seen = []
        self.assertTrue(slicer.run(lambda layer: seen.append(layer.index), 14))
        self.assertEqual(seen, [14, 15])
        for bad in (lambda: slicer[16], lambda: slicer[-17], lambda: list(slicer.layers(17)),
                    lambda: list(slicer.layers(3, 14)), lambda: slicer.run(print, -1)):
            with self.assertRaisesRegex(IndexError, "there are 16 layers"):
                bad()
        with self.assertRaises(TypeError):
            slicer[1.5]

    def test_fills_the_given_array(self):
        slicer = box_model().slicer(pitch=0.25, layer_height=0.25)
        out = np.full((slicer.height, slicer.stride), 7, np.uint8)
        layer = slicer.layer(5, out=out)
        self.assertIs(layer.rows, out)
        self.assertTrue(np.array_equal(out, slicer[5].rows))
        with self.assertRaisesRegex(ValueError, "shape"):
            slicer.layer(5, out=out[1:])

    def test_iterators_know_nothing_of_each_other(self):
        slicer = box_model().slicer(pitch=0.25, layer_height=0.25, slab_layers=4)
        for one, other in zip(slicer, slicer.layers(1)):
            self.assertEqual(one.index + 1, other.index)
        for layer in slicer:
            if layer.index == 5:
                break  # leaves nothing behind
        self.assertEqual(next(iter(slicer)).index, 0)


    def test_of_windows_are_those_of_the_plan(self):
        model = reference_model()
        plan = {"layer_height": 0.5, "pitch": 0.1, "output": "bytes"}
        slicer = model.slicer(**plan)
        whole = np.array([layer.data for layer in slicer])
        self.assertEqual(whole.shape, slicer.whole[::-1])
        self.assertEqual(slicer.window, ((0, 0, 0), slicer.whole))
        panel = model.slicer(**plan, window=((33, 5, 2), (70, 50, 9)))
        layers = self.check_ways(panel)
        self.assertEqual((panel.width, panel.height, len(panel)), (70, 50, 9))
        self.assertEqual((panel.origin, panel.whole), (slicer.origin, slicer.whole))
        self.assertEqual(panel.window, ((33, 5, 2), (70, 50, 9)))
        for layer in layers:
            self.assertEqual(layer.z, slicer.z(2 + layer.index))
            self.assertTrue(np.array_equal(layer.data, whole[2 + layer.index, 5:55, 33:103]))
        with self.assertRaisesRegex(msq.ArgumentError, str(slicer.width)):
            model.slicer(**plan, window=((0, 0, 0), (slicer.width + 1, 1, 1)))


class Callbacks(unittest.TestCase):
    def setUp(self):
        self.slicer = box_model().slicer(pitch=0.25, layer_height=0.25, slab_layers=4)

    def test_stop_by_false(self):
        seen = []

        def take(layer):
            seen.append(layer.index)
            return layer.index < 6

        self.assertFalse(self.slicer.run(take))
        self.assertEqual(seen, list(range(7)))

    def test_exceptions_are_raised_as_they_are(self):
        class Own(Exception):
            pass

        def take(layer):
            if layer.index == 5:
                raise Own("at five")

        names = []
        try:
            self.slicer.run(take)
        except Own as error:
            trace = error.__traceback__
            while trace:
                names.append(trace.tb_frame.f_code.co_name)
                trace = trace.tb_next
        self.assertIn("take", names)
        for kind in (KeyboardInterrupt, SystemExit, StopIteration, msq.LimitError):
            def fail(_layer, kind=kind):
                raise kind("x")
            with self.assertRaises(kind):
                self.slicer.run(fail)

    def test_may_call_msq(self):
        inner = []

        def take(layer):
            inner.append(np.array_equal(self.slicer[layer.index].rows, layer.rows))
            if layer.index == 2:
                def fail(_layer):
                    raise KeyError("inner")
                with self.assertRaises(KeyError):
                    self.slicer.run(fail)

        self.assertTrue(self.slicer.run(take))
        self.assertEqual(inner, [True] * 16)

    def test_views_are_of_the_memory_of_c_and_may_not_be_kept(self):
        kept = []
        for keep in (lambda layer: layer, lambda layer: layer.rows,
                     lambda layer: layer.data[1:, ::2]):
            def take(layer, keep=keep):
                self.assertFalse(layer.rows.flags.owndata or layer.rows.flags.writeable)
                kept.append(keep(layer))
            with self.assertRaisesRegex(BufferError, "layer 0 is kept"):
                self.slicer.run(take)
            kept.clear()
        self.assertTrue(self.slicer.run(lambda layer: kept.append((layer.copy(), layer.pixels))))
        self.assertTrue(np.array_equal(kept[3][0].rows, self.slicer[3].rows))


class Outputs(unittest.TestCase):
    def setUp(self):
        self.model = reference_model()

    def slicer(self, **options):
        return self.model.slicer(resolution=(40, 24), layer_height=0.25, **options)

    def test_grey_is_the_mean_of_finer_pixels(self):
        grey = self.slicer(output="grey", grey_samples=2)
        fine = self.model.slicer(resolution=(80, 48), layer_height=0.25)
        for layer, samples in zip(grey, fine):
            count = samples.pixels.reshape(24, 2, 40, 2).sum(axis=(1, 3))
            self.assertTrue(np.array_equal(layer.data, np.floor(255 * count / 4 + 0.5)))
            self.assertEqual(layer.inside_count, count.sum())
            again = grey[layer.index]
            self.assertTrue(np.array_equal(again.rows, layer.rows))
            self.assertEqual(again.inside_count, layer.inside_count)
        strong = self.slicer(output="grey", grey_samples=2, grey_threshold=100)[3].data
        self.assertEqual(set(np.unique(strong)) - {0, 128, 191, 255}, set())

    def test_distances_have_the_sign_of_membership(self):
        distance = self.slicer(output="distance")[2]
        self.assertEqual(distance.data.dtype, np.float32)
        self.assertTrue(np.array_equal(distance.pixels, self.slicer()[2].pixels))
        self.assertEqual(distance.inside_count, np.count_nonzero(distance.pixels))

    def test_layers_are_turned(self):
        for output in ("bits", "bytes", "grey", "distance"):
            plain = self.slicer(output=output)[1]
            turned = self.slicer(output=output, mirror="x", transpose=True)
            self.assertEqual((turned.width, turned.height), (24, 40))
            self.assertTrue(np.array_equal(turned[1].pixels, plain.pixels.T[:, ::-1]))
            self.assertTrue(np.array_equal(self.slicer(output=output, mirror="xy")[1].pixels,
                                           plain.pixels[::-1, ::-1]))

    def test_wrong_options_are_refused(self):
        with self.assertRaisesRegex(ValueError, "mirror is 'z'"):
            self.slicer(mirror="z")
        with self.assertRaisesRegex(ValueError, "output is 'mirror_x'"):
            self.slicer(output="mirror_x")
        with self.assertRaisesRegex(msq.ArgumentError, "grey_samples is 5"):
            self.slicer(output="grey", grey_samples=5)


if __name__ == "__main__":
    unittest.main()
