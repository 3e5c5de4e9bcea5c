#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
r"""What the Python package costs: layers by its three ways and by a thread that a pull form would
replace, and single calls. Wall time and time of the processor, of all threads, each the least of
`--repeat` rounds in which the ways take turns. The allocator is told to keep memory: else what
shows most is the page faults of slabs that it gave back, which the main thread alone has.

    MALLOC_TRIM_THRESHOLD_=2000000000 MALLOC_MMAP_THRESHOLD_=2000000000 \
    MSQ_LIBRARY=build/libmsq.so.0 PYTHONPATH=bindings/python python3 bench/python_calls.py
"""
import argparse
import ctypes
import queue
import threading
import time
import zlib

import numpy as np

import msq


def by_thread(slicer):
    """Layers from a thread that runs the slicer ahead, two at a time."""
    layers = queue.Queue(2)

    def work():
        slicer.run(lambda layer: layers.put(layer.copy()))
        layers.put(None)

    thread = threading.Thread(target=work)
    thread.start()
    while True:
        layer = layers.get()
        if layer is None:
            break
        yield layer
    thread.join()


def loop(layers, use):
    for layer in layers:
        use(layer)


def least(ways, repeat):
    """Seconds of each way: on the wall, and of the processor."""
    times = {name: [] for name in ways}
    for _ in range(repeat):
        for name, way in ways.items():
            wall, processor = time.perf_counter(), time.process_time()
            way()
            times[name].append((time.perf_counter() - wall, time.process_time() - processor))
    return {name: tuple(map(min, zip(*values))) for name, values in times.items()}


def show(found, factor):
    for way, (wall, processor) in found.items():
        print(f"  {factor * wall:9.3f} {factor * processor:9.3f}  {way}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--repeat", type=int, default=25)
    repeat = parser.parse_args().repeat
    box = msq.Shape.box((0, 0, 0), (20, 15, 10))
    model = msq.Model(box, msq.Foam(cell_size=2.5, radius=0.3))
    for name, use in (("that is dropped", lambda layer: None),
                      ("that is deflated", lambda layer: zlib.compress(layer.rows.tobytes(), 1))):
        for output in ("bits", "bytes"):
            slicer = model.slicer(layer_height=0.05, pitch=0.02, output=output)
            print(f"ms a layer of {slicer.width} x {slicer.height} in {output} {name}:")
            found = least({
                "Slicer.run": lambda: slicer.run(lambda layer: use(layer) and None),
                "iteration": lambda: loop(slicer, use),
                "a thread and a queue": lambda: loop(by_thread(slicer), use),
                "Slicer.layer": lambda: loop((slicer[i] for i in range(len(slicer))), use)}, repeat)
            show(found, 1e3 / len(slicer))

    points = np.random.RandomState(1).rand(32767, 3) * (20, 15, 10)
    out = np.empty(len(points), np.bool_)
    longer = np.concatenate((points, points[:1]))  # from here on on a thread of its own
    address, value = (ctypes.c_double * 3)(1, 1, 1), ctypes.c_int32()
    lib = msq.model.lib
    found = least({
        "msq_point_membership through ctypes": lambda: [lib.msq_point_membership(
            model._ref, address, None, ctypes.byref(value)) for _ in range(1000)],
        "Model.contains of one point": lambda: [model.contains((1, 1, 1)) for _ in range(1000)],
        "Model.contains of an array of one point": lambda: [model.contains(points[:1])
                                                            for _ in range(1000)]}, repeat)
    field = msq.Field.host(lambda points: points[:, 0], 0, 20)
    hosted = msq.Model(box, msq.Functional("gyroid", level=field))
    found.update(least({"Model.contains of one point, with a field of Python": lambda: [
        hosted.contains((1, 1, 1)) for _ in range(1000)]}, repeat))
    print("us a call:")
    show(found, 1e3)
    show(least({"32767 points": lambda: model.contains(points, out=out),
                "32768 points, on a thread": lambda: model.contains(longer)}, 20 * repeat), 1e6)


if __name__ == "__main__":
    main()
