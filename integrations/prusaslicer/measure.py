#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Slices parts with PrusaSlicer's gyroid and with the patterns of FillMsq, and compares what the G-code says.

    measure.py slice_gcode directory [part.stl ...]
    measure.py --bunny bunny.off bunny.stl

A cube of 40 mm, and the parts given, at 15 and 30 %; a cylinder whose foam is graded from 80 % on the axis to 15 % at the rim. Prints tables,
and writes measurements.json and a picture of a layer of each foam (SVG) to the directory, beside the G-code. --bunny turns the bunny of CGAL's
examples, which has y upwards, into an STL file of 40 mm height.
"""
import json
import math
import pathlib
import re
import struct
import subprocess
import sys

LAYER, WIDTH = 0.2, 0.45
SPACING = WIDTH - LAYER * (1 - math.pi / 4)  # PrusaSlicer's distance of lines that touch
COMMON = {"layer_height": LAYER, "first_layer_height": LAYER, "infill_extrusion_width": WIDTH, "perimeter_generator": "classic",
          "skirts": 0, "gcode_flavor": "marlin"}
# Of the profile "0.20mm QUALITY" for the MK3S.
MK3S = {"perimeter_speed": 45, "external_perimeter_speed": 25, "infill_speed": 80, "solid_infill_speed": 80, "top_solid_infill_speed": 40,
        "travel_speed": 180, "default_acceleration": 1000, "machine_max_acceleration_x": "1000,1000",
        "machine_max_acceleration_y": "1000,1000", "machine_max_acceleration_extruding": "1250,1250", "machine_max_jerk_x": "8,8",
        "machine_max_jerk_y": "8,8", "retract_length": 0.8, "retract_speed": 35, "top_solid_layers": 5, "bottom_solid_layers": 5}


def write_stl(path, triangles):
    with open(path, "wb") as out:
        out.write(bytes(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *[c for point in triangle for c in point], 0))


def prism(corners, height):
    """Triangles of a convex polygon's prism."""
    low, high = ([(x, y, z) for x, y in corners] for z in (-height / 2, height / 2))
    triangles = []
    for i in range(len(corners)):
        j = (i + 1) % len(corners)
        triangles += [(low[i], low[j], high[j]), (low[i], high[j], high[i])]
        if 0 < i < len(corners) - 1:
            triangles += [(low[0], low[j], low[i]), (high[0], high[i], high[j])]
    return triangles


def slice_part(program, stl, gcode, **options):
    command = [program, stl, gcode] + [f"{key}={value}" for key, value in options.items()]
    output = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
    return json.loads(output[output.index("{"):])


def moves(gcode):
    """(z, from, to, role or None for travel) of each move in the plane."""
    x = y = z = 0.0
    role = None
    with open(gcode, encoding="utf-8") as lines:
        for line in lines:
            if line.startswith(";TYPE:"):
                role = line[6:].strip()
            elif line.startswith(("G1 ", "G0 ")):
                words = dict(re.findall(r"([XYZEF])(-?[\d.]+)", line.split(";")[0]))
                z = float(words.get("Z", z))
                to = float(words.get("X", x)), float(words.get("Y", y))
                if to != (x, y):
                    yield z, (x, y), to, role if "E" in words else None
                x, y = to


def length_within(a, b, center, radius):
    """Of the part of a line within a circle."""
    way = b[0] - a[0], b[1] - a[1]
    off = a[0] - center[0], a[1] - center[1]
    square = way[0] ** 2 + way[1] ** 2
    half = off[0] * way[0] + off[1] * way[1]
    root = half * half - square * (off[0] ** 2 + off[1] ** 2 - radius * radius)
    if root <= 0:
        return 0.0
    low, high = (-half - math.sqrt(root)) / square, (-half + math.sqrt(root)) / square
    return max(0.0, min(1, high) - max(0, low)) * math.sqrt(square)


def rings(gcode, center, radius, middle, rim, edges):
    """Density in rings between the edges, found and asked for, in the layers that hold sparse infill alone."""
    solid, lines = set(), []
    for z, a, b, role in moves(gcode):
        if role == "Internal infill":
            lines.append((z, a, b))
        elif role in ("Solid infill", "Top solid infill", "Bridge infill"):
            solid.add(z)
    lines = [line for line in lines if line[0] not in solid]
    layers = len({z for z, _, _ in lines})
    sums = [sum(length_within(a, b, center, edge) for _, a, b in lines) for edge in edges]
    found = []
    for i in range(1, len(edges)):
        p, q = edges[i - 1], edges[i]
        area = math.pi * (q * q - p * p)
        wanted = middle + (rim - middle) / radius * (2 / 3) * (q ** 3 - p ** 3) / (q * q - p * p)
        found.append({"from_mm": p, "to_mm": q, "wanted": wanted, "found": (sums[i] - sums[i - 1]) * SPACING / (area * layers)})
    return found


def draw(gcode, svg, share):
    """The layer at this share of the height."""
    colours = {"Internal infill": "#246", "Perimeter": "#b52", "External perimeter": "#d84"}
    layers = sorted({move[0] for move in moves(gcode) if move[3] == "Internal infill"})
    z = layers[int(share * (len(layers) - 1))]
    drawn = [move for move in moves(gcode) if move[0] == z and move[3] in colours]
    low = [min(move[1][i] for move in drawn) - 1 for i in (0, 1)]
    high = [max(move[1][i] for move in drawn) + 1 for i in (0, 1)]
    with open(svg, "w", encoding="utf-8") as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {high[0] - low[0]:.2f} {high[1] - low[1]:.2f}" width="720" '
                  f'fill="none" stroke-linecap="round" stroke-linejoin="round" stroke-width="{WIDTH * 0.9:.2f}">\n')
        end = None
        for _, a, b, role in drawn:
            if end != (a, role):
                out.write(('"/>\n' if end else "") + f'<path stroke="{colours[role]}" d="M{a[0] - low[0]:.2f} {high[1] - a[1]:.2f}')
            out.write(f"L{b[0] - low[0]:.2f} {high[1] - b[1]:.2f}")
            end = b, role
        out.write('"/>\n</svg>\n')


def stand_bunny(off, stl):
    words = pathlib.Path(off).read_text(encoding="ascii").split()
    count, faces = int(words[1]), int(words[2])
    points = [tuple(map(float, words[4 + 3 * i:7 + 3 * i])) for i in range(count)]
    low = min(y for _, y, _ in points)
    scale = 40 / (max(y for _, y, _ in points) - low)
    points = [(scale * x, -scale * z, scale * (y - low)) for x, y, z in points]
    first = 4 + 3 * count
    write_stl(stl, [[points[int(k)] for k in words[first + 4 * i + 1:first + 4 * i + 4]] for i in range(faces)])


def main():
    if sys.argv[1] == "--bunny":
        stand_bunny(*sys.argv[2:4])
        return
    program, directory = sys.argv[1], pathlib.Path(sys.argv[2])
    directory.mkdir(parents=True, exist_ok=True)
    cube = directory / "cube.stl"
    write_stl(cube, prism([(-20, -20), (20, -20), (20, 20), (-20, 20)], 40))
    results = []
    print("part      density  speeds    pattern     length   of gyroid   print     of gyroid  paths  fill step")
    for stl in [cube, *map(pathlib.Path, sys.argv[3:])]:
        for density in (15, 30):
            for speeds, options in (("default", {}), ("MK3S", MK3S)):
                native = None
                for pattern in ("gyroid", "msqgyroid", "msqfoam"):
                    if pattern == "msqgyroid" and (density, speeds) != (15, "default"):
                        continue
                    gcode = directory / f"{stl.stem}_{density}_{speeds}_{pattern}.gcode"
                    made = slice_part(program, stl, gcode, fill_pattern=pattern, fill_density=f"{density}%", **COMMON, **options)
                    native = native or made
                    results.append({"part": stl.stem, "density": density, "speeds": speeds, "pattern": pattern, **made})
                    print(f"{stl.stem:9} {density:5} %  {speeds:8}  {pattern:10} {made['length_mm'] / 1000:6.1f} m"
                          f"  {made['length_mm'] / native['length_mm']:8.3f}  {made['print_s'] / 60:7.1f} min"
                          f"  {made['print_s'] / native['print_s']:8.3f}  {made['paths']:6}  {made['fill_s']:7.2f} s", flush=True)
        draw(directory / f"{stl.stem}_15_default_msqfoam.gcode", directory / f"{stl.stem}.svg", 0.5)

    radius, height = 25, 12
    cylinder = directory / "cylinder.stl"
    write_stl(cylinder, prism([(radius * math.cos(a * math.pi / 90), radius * math.sin(a * math.pi / 90)) for a in range(180)], height))
    gcode = directory / "cylinder.gcode"
    made = slice_part(program, cylinder, gcode, fill_pattern="msqfoam", fill_density="80%", fill_density_rim="15%", **COMMON)
    graded = rings(gcode, (100, 100), radius, 0.80, 0.15, list(range(0, radius - 1, 4)))
    results.append({"part": "cylinder", "speeds": "default", "pattern": "msqfoam", "rings": graded, **made})
    draw(gcode, directory / "cylinder.svg", 0.5)
    print("\nrings of the cylinder, from 80 % on the axis to 15 % at the rim")
    for ring in graded:
        print(f"{ring['from_mm']:3} to {ring['to_mm']:2} mm  {100 * ring['wanted']:5.1f} %  found {100 * ring['found']:5.1f} %  "
              f"({100 * (ring['found'] / ring['wanted'] - 1):+.1f} %)")
    (directory / "measurements.json").write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
