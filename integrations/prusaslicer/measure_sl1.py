#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares PrusaSlicer's SL1 archives of a part filled with a foam with those that the command msq writes, and reads these by its importer.

    measure_sl1.py slice_sl1 msq directory part.stl

Prints what it found, and writes measurements_sl1.json to the directory, beside the archives.
"""
import json
import pathlib
import subprocess
import sys

CELL, RADIUS, SKIN, HEIGHT = 4, 0.4, 0.8, 0.5  # mm
SETTINGS = {"layer_height": HEIGHT, "initial_layer_height": HEIGHT, "supports_enable": 0, "pad_enable": 0, "elefant_foot_compensation": 0,
            "display_width": 120.96, "display_height": 68.04,  # as msq has them for the Original Prusa SL1; PrusaSlicer's defaults are rounded
            "foam_cell_size": CELL, "foam_radius": RADIUS, "foam_skin": SKIN}


def run(*command):
    output = subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout
    return json.loads(output[output.rindex("\n{") + 1 if "\n{" in output else output.index("{"):])


def main():
    program, msq, directory, part = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]), sys.argv[4]
    directory.mkdir(parents=True, exist_ok=True)
    theirs, ours = directory / "theirs.sl1", directory / "ours.sl1"

    def exported(archive, **more):
        return run(program, part, archive, *(f"{key}={value}" for key, value in {**SETTINGS, **more}.items()))

    sliced = exported(theirs)
    subprocess.run([msq, "slice", part, "--foam", str(CELL), "--radius", str(RADIUS), "--skin", str(SKIN), "--layer-height", str(HEIGHT),
                    "--grey", "16", "-o", ours], check=True)
    compared = run(program, "--compare", theirs, ours)
    histogram = compared["histogram"]
    print(f"export by PrusaSlicer against msq slice: {compared['layers']} layers, {compared['grey_pixels']} grey pixels, "
          f"greatest difference {compared['greatest']}/255, {compared['beyond']} pixels beyond 1/16, "
          f"coverage {compared['coverage'][0]:.1f} and {compared['coverage'][1]:.1f} pixels")
    print("  pixels by difference in 255ths:", ", ".join(f"{d}: {count}" for d, count in enumerate(histogram[:32]) if count and d))

    # Corrections of the printer act on the sections: the walls move by 0.02 mm.
    offset, layers = -0.02, {"layer_height": 2, "initial_layer_height": 2}
    plain = exported(directory / "plain.sl1", **layers)
    corrected = exported(directory / "corrected.sl1", absolute_correction=offset, **layers)
    moved = (corrected["volume_mm3"] - plain["volume_mm3"]) / (plain["walls_mm2"] + corrected["walls_mm2"]) * 2
    foot = exported(directory / "foot.sl1", elefant_foot_compensation=0.2, faded_layers=3, **layers)
    print(f"absolute_correction of {offset} mm: walls move by {moved:.5f} mm; elefant_foot_compensation of 0.2 mm: "
          f"volume {plain['volume_mm3']:.1f} mm3 becomes {foot['volume_mm3']:.1f}")

    imported = {name: run(program, "--import", archive) for name, archive in (("theirs", theirs), ("ours", ours))}
    for name, mesh in imported.items():
        size = [b - a for a, b in zip(mesh["min"], mesh["max"])]
        print(f"import of {name}: {mesh['triangles']} triangles, {mesh['volume_mm3']:.1f} mm3 ({mesh['volume_mm3'] / sliced['volume_mm3']:.4f} of the "
              f"sections), {size[0]:.3f} x {size[1]:.3f} x {size[2]:.3f} mm, layers of {mesh['layer_height']} mm, {mesh['settings']} settings")
    result = {"sliced": sliced, "compared": compared, "plain": plain, "corrected": corrected, "moved_mm": moved, "foot": foot, "imported": imported}
    (directory / "measurements_sl1.json").write_text(json.dumps(result, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
