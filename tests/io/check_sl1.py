#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SL1 archives hold msq's grey layers, pixel by pixel, with PrusaSlicer's keys.

usage: check_sl1.py write_samples
"""
import io
import subprocess
import sys
import tempfile
import zipfile

import png_rows


def ini(text):
    return dict(line.split(" = ", 1) for line in text.decode().split("\n") if line)


def check(program, orientation, mirror_x, mirror_y, plain):
    with tempfile.TemporaryDirectory() as folder:
        said = subprocess.run([program, "sl1", folder, orientation, str(mirror_x), str(mirror_y)],
                              check=True, capture_output=True, text=True).stdout
        width, height, count = map(int, said.split())
        with open(folder + "/layers.raw", "rb") as file:
            layers = [[file.read(width) for _ in range(height)] for _ in range(count)]
        with open(folder + "/sample.sl1", "rb") as file:
            archive = zipfile.ZipFile(io.BytesIO(file.read()))
    assert archive.testzip() is None
    portrait = orientation == "portrait"
    assert (width, height) == ((136, 240) if portrait else (240, 136))
    assert 0 < sum(map(sum, layers[3])) < 128 * width * height
    used = 0
    for k in range(count):
        rows, header = png_rows.read(archive.read(f"sample{k:05d}.png"))
        assert header[:4] == (width, height, 8, 0), header
        assert rows == layers[k], f"layer {k}"
        used += sum(map(sum, rows))
    # As PrusaSlicer turns its images (RasterBase.hpp): the first row has the largest y, x runs
    # along columns in portrait, which mirrors.
    for k, image in enumerate(plain or []):
        turned = image[::-1]  # of landscape without mirrors: back to x, y
        if portrait:
            turned = list(map(bytes, zip(*turned)))
        if bool(mirror_x) != portrait:
            turned = [row[::-1] for row in turned]
        if not mirror_y:
            turned = turned[::-1]
        assert turned == layers[k], f"the panel's orientation, layer {k}"

    config, profile = ini(archive.read("config.ini")), ini(archive.read("prusaslicer.ini"))
    wanted = {"action": "print", "jobDir": "sample", "layerHeight": "0.1", "expTime": "8",
              "expTimeFirst": "35", "numFade": "10", "numSlow": "0", "numFast": str(count),
              "printerModel": "SL1", "printerVariant": "default", "materialName": "",
              "fileCreationTimestamp": "2025-12-23 at 10:44:05 UTC", "hollow": "0",
              "expUserProfile": "0", "prusaSlicerVersion": "msq", "printProfile": "",
              "printerProfile": ""}
    rest = {key: config[key] for key in config if key not in wanted}
    assert wanted == {key: config[key] for key in wanted if key in config}, config
    assert sorted(rest) == ["printTime", "usedMaterial"], rest
    # Three first layers, ten that fade, the others, 5 s each for the tilt.
    step = 27 / 11
    time = 3 * 35 + sum(35 - i * step for i in range(1, 12)) + (count - 14) * 8 + 5 * count
    assert abs(float(config["printTime"]) - time) < 1e-3, (config["printTime"], time)
    assert abs(float(config["usedMaterial"]) - used / 255 * 0.05 ** 2 * 0.1 / 1000) < 1e-6
    assert profile["display_orientation"] == orientation
    assert (profile["display_mirror_x"], profile["display_mirror_y"]) == (str(mirror_x), str(mirror_y))
    assert (profile["display_pixels_x"], profile["display_pixels_y"]) == ("240", "136")
    assert (profile["display_width"], profile["display_height"]) == ("12", "6.8")
    assert profile["layer_height"] == profile["initial_layer_height"] == "0.1"
    assert profile["gamma_correction"] == "1"
    for size in ((400, 400), (800, 480)):
        header = archive.read("thumbnail/thumbnail%dx%d.png" % size)[16:29]
        assert header == bytes([0, 0, *divmod(size[0], 256), 0, 0, *divmod(size[1], 256), 8, 6, 0, 0, 0])
    assert len(archive.namelist()) == count + 4
    assert archive.getinfo("config.ini").date_time == (2025, 12, 23, 10, 44, 4)
    return layers


def main():
    plain = check(sys.argv[1], "landscape", 0, 0, None)
    for orientation in ("landscape", "portrait"):
        for mirrors in ((0, 0), (0, 1), (1, 0), (1, 1)):
            check(sys.argv[1], orientation, *mirrors, plain)
    print("9 archives")


main()
