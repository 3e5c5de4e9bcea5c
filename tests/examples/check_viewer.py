#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The viewer shows a part in a window, turns it, zooms and changes what fills it as it is told, says
its frame rate, and ends by itself. Runs it under Xvfb; exit status 77, skipped, where that or the
viewer is not there.

usage: check_viewer.py VIEWER|none
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import png_pixels

WIDTH, HEIGHT = 200, 200
LEAKS = pathlib.Path(__file__).resolve().with_name("leaks_of_others.txt")
OVERLAY = 72  # rows from the top that text may lie upon

program = sys.argv[1]
if program == "none":
    print("skipped: the viewer was not built, for want of SDL2 (Debian: libsdl2-dev)")
    sys.exit(77)
if not shutil.which("xvfb-run") or not shutil.which("xauth"):
    print("skipped: no xvfb-run (Debian: xvfb xauth)")
    sys.exit(77)

problems = []


def view(folder, script, *options, part="block:20"):
    command = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24", program, part, "--size",
               str(WIDTH), str(HEIGHT), "--script", script, *options]
    # Without OpenGL, whose drivers leak, and differ.
    environment = dict(os.environ, SDL_VIDEODRIVER="x11", SDL_RENDER_DRIVER="software",
                       SDL_FRAMEBUFFER_ACCELERATION="0",
                       LSAN_OPTIONS=f"suppressions={LEAKS}:print_suppressions=0")
    # On busy machines xvfb-run at times fails to remove its own files, and hides what the viewer said.
    for _ in range(3):
        result = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True,
                                timeout=240)
        if "xvfb-run: error" not in result.stderr:
            break
    return result


def expect(condition, text):
    if not condition:
        problems.append(text)


def look(folder, name):
    """The picture, and where it shows the part, below the text."""
    width, height, rows = png_pixels.read(folder / name)
    expect((width, height) == (WIDTH, HEIGHT), f"{name}: {width} x {height} pixels")
    ground = rows[-1][0]
    part = [(x, y) for y in range(OVERLAY, height) for x in range(width)
            if png_pixels.differ(rows[y][x], ground)]
    return rows, part


def expect_part(name, rows, part):
    share = len(part) / (WIDTH * (HEIGHT - OVERLAY))
    expect(0.1 < share < 0.9, f"{name}: {100 * share:.1f} % of the window is not background")
    if not part:
        return
    middle = sum(x for x, _ in part) / len(part)
    expect(abs(middle - WIDTH / 2) < 0.1 * WIDTH, f"{name}: the part's middle is at column {middle:.0f}")
    colours = {rows[y][x] for x, y in part}
    expect(len(colours) > 50, f"{name}: {len(colours)} colours: nothing is shaded")
    corners = [rows[-1][0], rows[-1][-1], rows[OVERLAY][-1]]
    expect(not any(png_pixels.differ(c, corners[0]) for c in corners), f"{name}: corners {corners}")


def expect_text(name, rows):
    """White letters on a dark ground in the upper left corner."""
    corner = [rows[y][x] for y in range(10, 70) for x in range(10, 150)]
    white = sum(min(pixel) > 240 for pixel in corner)
    dark = sum(max(pixel) < 120 for pixel in corner)
    expect(white > 100 and dark > 1000, f"{name}: {white} white and {dark} dark pixels of text")


def expect_change(name, before, after, least):
    rows = range(OVERLAY, HEIGHT)
    changed = sum(png_pixels.differ(before[y][x], after[y][x]) for y in rows for x in range(WIDTH))
    share = changed / (WIDTH * len(rows))
    expect(share > least, f"{name}: only {100 * share:.1f} % of the pixels changed")


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(temporary)
    done = view(folder, "key o; wait; shot front.png; drag 120 60; shot moving.png; wait;"
                        "shot turned.png; pan 30 0; shot aside.png; pan -30 0; wheel 3;"
                        "shot near.png; key 3; key [; wait; shot solid.png; key ]; spin 5; quit",
                "--fill", "cubic:10:1.5")
    if done.returncode != 0:
        sys.exit(f"the viewer ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    expect(re.search(r"^5 pictures in [\d.]+ s: [\d.]+ a second$", done.stdout, re.M),
           f"no frame rate: {done.stdout}")
    front, part = look(folder, "front.png")
    expect_part("front.png", front, part)
    expect_text("front.png", front)
    turned, part = look(folder, "turned.png")
    expect_part("turned.png", turned, part)
    expect_change("turned.png", front, turned, 0.1)
    moving, part = look(folder, "moving.png")
    expect_part("moving.png", moving, part)
    aside, part = look(folder, "aside.png")
    middle = sum(x for x, _ in part) / max(len(part), 1)
    expect(abs(middle - WIDTH / 2 - 30) < 8, f"aside.png: the part's middle is at column {middle:.0f}")
    near, part = look(folder, "near.png")
    expect_change("near.png", turned, near, 0.1)
    solid, part = look(folder, "solid.png")
    expect_change("solid.png", near, solid, 0.1)

    done = view(folder, "jump 3; quit", "--fill", "solid")
    expect(done.returncode == 1 and "no command of a script: jump 3" in done.stderr,
           f"a script that makes no sense: {done.returncode}, {done.stderr}")
    (folder / "ball.json").write_text(json.dumps({"msq_model": 1, "scales": [
        {"shape": {"sphere": {"radius": 10}}},
        {"structure": {"lattice": {"unit_cell": "cubic", "radius": 1.5, "grid": {"cell_size": 10}}}}]}))
    done = view(folder, "key o; wait; shot ball.png; key 3; wait; shot filled.png; quit", part="ball.json")
    if done.returncode != 0:
        sys.exit(f"a model file: {done.returncode}:\n{done.stdout}{done.stderr}")
    ball, part = look(folder, "ball.png")
    expect_part("ball.png", ball, part)
    expect_change("filled.png", ball, look(folder, "filled.png")[0], 0.1)

    done = view(folder, "quit", "--fill", "cheese:4:1")
    expect(done.returncode == 1 and "cheese: no structure" in done.stderr,
           f"a fill that makes no sense: {done.returncode}, {done.stderr}")

if problems:
    sys.exit("\n".join(problems))
print("the viewer shows what it should")
