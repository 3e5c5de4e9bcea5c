# SPDX-License-Identifier: Apache-2.0
"""Chunks of a grid as tasks of Dask: with two worker processes, one of them killed, into the same bytes as in
one process. Exit status 77: Dask, its workers or zarr are missing."""
import functools
import importlib.util
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import msq

MISSING = [name for name in ("dask", "distributed", "zarr") if not importlib.util.find_spec(name)]
if not MISSING:
    import warnings
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of their own
        import dask
        import distributed
        import zarr

        import msq.dask
    # `-W error` is for msq: workers would take it over.
    del sys.warnoptions[:]
    warnings.simplefilter("ignore")

ZARR_3 = not MISSING and int(zarr.__version__.split(".")[0]) >= 3
GRID = msq.PointGrid(origin=(-0.4, -0.3, -0.2), spacing=(0.1, 0.11, 0.12), counts=(83, 61, 42))


def build(log=None, seconds=0.0, different=False):
    """A recipe; log: a folder in which each process that builds it leaves its number."""
    if log:
        handle, _ = tempfile.mkstemp(prefix=f"{os.getpid()}-", dir=log)
        os.close(handle)
    time.sleep(seconds)
    seed = os.getpid() if different else 7
    context = msq.Context(threads=1)
    return msq.Model(msq.Shape.sphere((4, 3, 2), 3.6, context=context),
                     [msq.Foam(cell_size=1.5, radius=0.25, seed=seed, context=context)],
                     material=msq.Material(5))


def image_of(group):
    """The metadata of OME-Zarr."""
    if ZARR_3:
        ome = group.attrs["ome"]
        assert ome["version"] == "0.5"
        image, = ome["multiscales"]
    else:
        image, = group.attrs["multiscales"]
        assert image["version"] == "0.4"
    return image


def files(folder):
    """Names and bytes of all files below a folder."""
    folder = pathlib.Path(folder)
    return {path.relative_to(folder).as_posix(): path.read_bytes()
            for path in folder.rglob("*") if path.is_file()}


class DaskTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        scheduler = dask.config.set(scheduler="threads", num_workers=2)
        scheduler.__enter__()
        self.addCleanup(scheduler.__exit__, None, None, None)

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_arrays_of_any_chunks(self):
        model = build()
        for value, expected in (("contains", model.contains(GRID)), ("distance", model.distance(GRID)),
                                ("material", model.material(GRID)[0]), ("region", model.region(GRID))):
            for chunks in ("auto", (42, 61, 83), (13, 20, 31), ((1, 40, 1), (60, 1), (83,))):
                made = msq.dask.array(build, GRID, value=value, chunks=chunks)
                self.assertEqual((made.shape, made.dtype), (expected.shape, expected.dtype))
                np.testing.assert_array_equal(made.compute(), expected)
        made = msq.dask.array(build, GRID, chunks=20)
        self.assertEqual(len(dask.optimize(made)[0].__dask_graph__().to_dict()), made.npartitions)
        self.assertEqual(made.name, msq.dask.array(build, GRID, chunks=20).name)
        self.assertEqual(int(made.sum()), np.count_nonzero(model.contains(GRID)))

    def test_a_window_of_a_grid(self):
        window = msq.PointGrid(GRID.origin, GRID.spacing, GRID.counts, ((5, 7, 9), (40, 30, 20)))
        with self.assertRaisesRegex(ValueError, "chunks are 0; they must be at least 1"):
            msq.dask.array(build, GRID, chunks=0)
        part = msq.dask.array(build, window, chunks=16).compute()
        np.testing.assert_array_equal(part, build().contains(GRID)[9:29, 7:37, 5:45])
        msq.dask.to_zarr(build, window, self.path("part"), chunks=16)
        group = zarr.open_group(self.path("part"), mode="r")
        np.testing.assert_array_equal(group["0"][:], 255 * part.view(np.uint8))
        (_, shift), = (of["coordinateTransformations"] for of in image_of(group)["datasets"])
        np.testing.assert_allclose(shift["translation"], [-0.2 + 9 * 0.12, -0.3 + 7 * 0.11, -0.4 + 0.5])

    def test_levels(self):
        made = msq.dask.to_zarr(build, GRID, self.path("ball.zarr"), chunks=(16, 20, 24), levels=3,
                                unit="micrometer")
        self.assertEqual(made.shapes, [(42, 61, 83), (21, 31, 42), (11, 16, 21)])
        self.assertEqual(made.tasks, 3 * 4 * 4 + 2 * 2 * 2 + 1)
        self.assertEqual(made.model_hash, build().hash)
        levels = [255 * build().contains(GRID).view(np.uint8)]
        for _ in range(2):  # by a mean that knows which samples there are
            padded = np.full([(count + 1) // 2 * 2 for count in levels[-1].shape], np.nan)
            padded[tuple(map(slice, levels[-1].shape))] = levels[-1]
            nz, ny, nx = padded.shape
            blocks = padded.reshape(nz // 2, 2, ny // 2, 2, nx // 2, 2)
            levels.append(np.floor(np.nanmean(blocks, axis=(1, 3, 5)) + 0.5).astype(np.uint8))
        group = zarr.open_group(self.path("ball.zarr"), mode="r")
        for number, level in enumerate(levels):
            np.testing.assert_array_equal(group[str(number)][:], level)
        image = image_of(group)
        self.assertEqual(image["name"], "ball.zarr")
        self.assertEqual([axis["name"] for axis in image["axes"]], ["z", "y", "x"])
        self.assertEqual({axis["unit"] for axis in image["axes"]}, {"micrometer"})
        scale, shift = image["datasets"][2]["coordinateTransformations"]
        np.testing.assert_allclose(scale["scale"], [0.48, 0.44, 0.4])
        np.testing.assert_allclose(shift["translation"], [-0.2 + 0.18, -0.3 + 0.165, -0.4 + 0.15])

    def test_ids_and_distances(self):
        for value, expected in (("material", build().material(GRID)[0]),
                                ("distance", build().distance(GRID))):
            msq.dask.to_zarr(build, GRID, self.path(value), value=value, chunks=30, levels=2)
            group = zarr.open_group(self.path(value), mode="r")
            np.testing.assert_array_equal(group["0"][:], expected)
        np.testing.assert_allclose(group["1"][3, 4, 5], expected[6:8, 8:10, 10:12].mean())
        group = zarr.open_group(self.path("material"), mode="r")
        np.testing.assert_array_equal(group["1"][:], build().material(GRID)[0][::2, ::2, ::2])

    @unittest.skipUnless(ZARR_3, "shards need zarr 3")
    def test_shards(self):
        plain = msq.dask.to_zarr(build, GRID, self.path("plain"), chunks=8, levels=2)
        made = msq.dask.to_zarr(build, GRID, self.path("shards"), chunks=8, levels=2,
                                shards=(16, 32, 24))
        self.assertEqual(made.shapes, plain.shapes)
        self.assertEqual(made.tasks, 3 * 2 * 4 + 2 * 1 * 2)
        for level in "01":
            a, b = (zarr.open_group(self.path(name), mode="r")[level] for name in ("plain", "shards"))
            self.assertEqual((b.chunks, b.shards), ((8, 8, 8), (16, 32, 24)))
            np.testing.assert_array_equal(a[:], b[:])
        stored = [name for name in files(self.path("shards")) if "zarr.json" not in name]
        self.assertLessEqual(len(stored), made.tasks)
        msq.dask.to_zarr(build, GRID, self.path("again"), chunks=8, levels=2, shards=(16, 32, 24))
        expected, found = files(self.path("shards")), files(self.path("again"))
        found["zarr.json"] = found["zarr.json"].replace(b'"again"', b'"shards"')
        self.assertEqual(found, expected)
        with self.assertRaisesRegex(ValueError, "multiples of the chunks"):
            msq.dask.to_zarr(build, GRID, self.path("none"), chunks=8, shards=20)

    @unittest.skipIf(ZARR_3 or MISSING, "of zarr 2")
    def test_shards_of_version_2(self):
        with self.assertRaisesRegex(msq.UnsupportedError, "version 3"):
            msq.dask.to_zarr(build, GRID, self.path("none"), chunks=8, shards=16)

    @unittest.skipIf(os.environ.get("MSQ_SANITIZE"), "sanitized, workers take too long to start")
    def test_a_worker_is_killed(self):
        chunks = (12, 8, 20)
        alone = msq.dask.to_zarr(build, GRID, self.path("alone"), chunks=chunks, levels=2)
        log = self.path("log")
        os.mkdir(log)
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True,
                                      dashboard_address=None, silence_logs=50,
                                      local_directory=self.folder) as cluster, \
                distributed.Client(cluster) as client:
            pids = set(client.run(os.getpid).values())
            self.assertEqual(len(pids), 2)
            with self.assertRaisesRegex(RuntimeError, "models that differ"):
                msq.dask.to_zarr(functools.partial(build, different=True), GRID, self.path("different"),
                                 chunks=30)
            recipe = functools.partial(build, log=log)
            killer = _Killer(self.path("two/0"), log, min(pids))
            made = msq.dask.to_zarr(recipe, GRID, self.path("two"), chunks=chunks, levels=2)
            killer.join()
            self.assertGreaterEqual(killer.seen, 5, "the worker was killed midway")
            self.assertLess(killer.seen, alone.tasks)
            self.assertFalse(_is_running(killer.pid))
            builders = [name.split("-")[0] for name in os.listdir(log)]
            self.assertEqual(len(builders), len(set(builders)))  # each process once
            self.assertLessEqual(pids, set(map(int, builders)))
            # The arrays of another chunking are the same.
            again = msq.dask.to_zarr(build, GRID, self.path("again"), chunks=(42, 16, 50), levels=2)
        self.assertEqual(made[1:], alone[1:])
        self.assertNotEqual(again.tasks, alone.tasks)
        expected, found = files(self.path("alone")), files(self.path("two"))
        attributes = "zarr.json" if ZARR_3 else ".zattrs"
        for contents in (expected, found):
            contents[attributes] = contents[attributes].replace(b'"alone"', b'"two"')
        self.assertEqual(found, expected)
        for level in "01":
            np.testing.assert_array_equal(zarr.open_group(self.path("again"), mode="r")[level][:],
                                          zarr.open_group(self.path("alone"), mode="r")[level][:])

    def test_what_is_refused(self):
        with self.assertRaisesRegex(TypeError, "build is a Model"):
            msq.dask.array(build(), GRID)
        with self.assertRaisesRegex(TypeError, "build returned a int"):
            msq.dask.array(functools.partial(int), GRID).compute()
        with self.assertRaisesRegex(ValueError, "value is 'colour'"):
            msq.dask.array(build, GRID, value="colour")
        with self.assertRaisesRegex(ValueError, "chunks are 0"):
            msq.dask.to_zarr(build, GRID, self.path("none"), chunks=0)
        with self.assertRaisesRegex(ValueError, "levels is 7"):
            msq.dask.to_zarr(build, GRID, self.path("none"), levels=7)
        self.assertEqual(os.listdir(self.folder), [])
        with self.assertRaisesRegex(FileExistsError, "exists; to_zarr"):
            msq.dask.to_zarr(build, GRID, self.folder)


class _Killer:
    """Kills a process once it has built its model and five chunks are in a folder."""

    def __init__(self, folder, log, pid):
        self.pid, self.seen, self._folder, self._log = pid, 0, pathlib.Path(folder), pathlib.Path(log)
        self._thread = threading.Thread(target=self._watch)
        self._thread.start()

    def _watch(self):
        deadline = time.monotonic() + 30
        while (self.seen < 5 or not list(self._log.glob(f"{self.pid}-*"))) and \
                time.monotonic() < deadline:
            self.seen = sum(path.name.isdigit() for path in self._folder.rglob("*") if path.is_file())
            time.sleep(0.001)
        os.kill(self.pid, signal.SIGKILL)

    def join(self):
        self._thread.join()


def _is_running(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


if __name__ == "__main__":
    if MISSING:
        print(f"skipped: {', '.join(MISSING)} not installed (Debian: python3-dask, python3-distributed, "
              "python3-zarr)")
        sys.exit(77)
    unittest.main(warnings="ignore")
