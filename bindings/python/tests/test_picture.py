# SPDX-License-Identifier: Apache-2.0
"""Pictures are what rays say, and come in passes that can be stopped."""
import dataclasses
import math
import unittest

import numpy as np

import msq
from support import box_model

WIDTH, HEIGHT = 40, 30
ALL = ("depth", "normal", "scale", "material", "rgba")


def materials_model():
    context = msq.Context(threads=2)
    steel = msq.Material(7, density=7.8, context=context)
    box = msq.Shape.box((0, 0, 0), (4, 4, 4), context=context)
    lattice = msq.Lattice("cubic", radius=0.2, context=context)
    return msq.Model(box, [msq.Scale(lattice)], material=steel)


class Pictures(unittest.TestCase):
    def test_have_the_pixels_that_rays_have(self):
        model = materials_model()
        for projection in ("orthographic", "perspective"):
            camera = msq.Camera.fit(model, WIDTH, HEIGHT, projection=projection)
            picture = model.render(camera, WIDTH, HEIGHT, outputs=ALL)
            rays = [camera.ray((i + 0.5, j + 0.5), WIDTH, HEIGHT)
                    for j in range(HEIGHT) for i in range(WIDTH)]
            hits = model.cast(np.array([ray[0] for ray in rays]), np.array([ray[1] for ray in rays]))
            hits = hits.reshape(HEIGHT, WIDTH)
            self.assertTrue(np.array_equal(picture.depth, hits.t.astype(np.float32)))
            self.assertTrue(np.array_equal(picture.normal, hits.normal.astype(np.float32)))
            self.assertTrue(np.array_equal(picture.scale, hits.scale))
            self.assertTrue(np.array_equal(picture.material, hits.material))
            self.assertEqual(set(picture.material.flat), {0, 7})
            self.assertTrue(np.array_equal(picture.rgba[..., 3], np.where(hits.scale < 0, 0, 255)))

    def test_tiles_and_given_arrays(self):
        model = box_model()
        whole = model.render(width=WIDTH, height=HEIGHT, outputs="rgba", samples=2, shadows=True)
        self.assertIsNone(whole.depth)
        out = msq.Picture(rgba=np.zeros((7, 9, 4), np.uint8))
        tile = model.render(width=WIDTH, height=HEIGHT, tile=(11, 5, 9, 7), samples=2, shadows=True,
                            out=out)
        self.assertIs(tile, out)
        self.assertTrue(np.array_equal(tile.rgba, whole.rgba[5:12, 11:20]))
        with self.assertRaisesRegex(ValueError, "shape"):
            model.render(width=WIDTH, height=HEIGHT, out=out)
        depth = np.zeros((HEIGHT, WIDTH), np.float32)
        with self.assertRaisesRegex(ValueError, "depth and scale that lie in the same memory"):
            model.render(width=WIDTH, height=HEIGHT,
                         out=msq.Picture(depth=depth, scale=depth.view(np.int32)))
        model.render(width=9, height=7, outputs=("rgba", "rgba"))
        with self.assertRaisesRegex(ValueError, "'colour'"):
            model.render(outputs=("colour",))
        with self.assertRaisesRegex(msq.ArgumentError, "samples is 17"):
            model.render(width=WIDTH, height=HEIGHT, samples=17)
        with self.assertRaisesRegex(TypeError, "Camera"):
            model.render((0, 0, 1))

    def test_looks_of_a_box(self):
        model = box_model(foam=False)
        camera = msq.Camera(eye=(4, 3, 10), target=(4, 3, 0), up=(0, 1, 0), height=6)
        picture = model.render(camera, 8, 6, outputs=("depth", "normal", "rgba"), ambient=1,
                               colours=[(1, 0, 0.5)])
        self.assertTrue((picture.depth == 6).all())
        self.assertTrue((picture.normal == (0, 0, 1)).all())
        self.assertTrue((picture.rgba == (255, 0, 188, 255)).all())
        behind = model.render(dataclasses.replace(camera, clip_far=5), 8, 6, background=(0, 1, 0))
        self.assertTrue((behind.rgba == (0, 255, 0, 255)).all())
        by_normal = model.render(camera, 8, 6, colour_by="normal", ambient=1, light=(0, 0, 1),
                                 occlusion_rays=2, occlusion_distance=0.5)
        self.assertTrue((by_normal.rgba == (188, 188, 255, 255)).all())

    def test_passes_go_from_coarse_to_fine(self):
        model, passes = box_model(), []

        def on_pass(picture, done):
            passes.append((done.step, done.samples, done.is_last, picture.rgba.copy()))

        job = msq.Job()
        whole = model.render(width=WIDTH, height=HEIGHT, samples=2)
        got = model.render(width=WIDTH, height=HEIGHT, samples=2, first_step=8, on_pass=on_pass,
                           job=job)
        self.assertEqual([entry[:3] for entry in passes],
                         [(8, 1, False), (4, 1, False), (2, 1, False), (1, 1, False),
                          (1, 2, True)])
        self.assertTrue(np.array_equal(got.rgba, whole.rgba))
        self.assertTrue(np.array_equal(passes[-1][3], whole.rgba))
        self.assertEqual(job.progress, 1)

        steps = []

        def stop(_picture, done):
            steps.append(done.step)
            return done.step > 4

        model.render(width=WIDTH, height=HEIGHT, first_step=8, on_pass=stop)
        self.assertEqual(steps, [8, 4])

        def fail(_picture, _done):
            raise KeyError("mine")

        with self.assertRaisesRegex(KeyError, "mine"):
            model.render(width=WIDTH, height=HEIGHT, on_pass=fail)
        job = msq.Job()
        job.cancel()
        with self.assertRaises(msq.CancelledError):
            model.render(job=job)


class Cameras(unittest.TestCase):
    def test_fit_and_refuse(self):
        model = box_model(foam=False)
        camera = msq.Camera.fit(model, 100, 100, direction=(0, 0, -2), projection="orthographic")
        self.assertEqual(camera.up, (0, 1, 0))
        self.assertEqual(camera.height, 8)
        self.assertEqual(camera.target, (4, 3, 2))
        self.assertGreater(camera.eye[2], 4)
        with self.assertRaisesRegex(msq.ArgumentError, "field_of_view is 180"):
            msq.Camera.fit(model, 100, 100, field_of_view=180)
        with self.assertRaisesRegex(ValueError, "'fish'"):
            msq.Camera.fit(model, 100, 100, projection="fish")
        with self.assertRaisesRegex(msq.ArgumentError, "clip_far is 1"):
            msq.Camera((0, 0, 0), (1, 0, 0), clip_near=2, clip_far=1, height=1).ray((0, 0), 4, 4)
        self.assertEqual(camera.clip_far, math.inf)


if __name__ == "__main__":
    unittest.main()
