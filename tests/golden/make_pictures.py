#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes pictures.txt: what cameras see of a ball and of a box, ray by ray, from the definitions in
msq.h alone. Standard library only.

Run: python3 make_pictures.py > pictures.txt
"""
import math

WIDTH, HEIGHT = 22, 14

# Eye, target, up, picture's height (orthographic) or angle (perspective), clip planes.
CAMERAS = {
    "orthographic": ((7, -4, 6), (1, 2, 2.5), (0, 0, 1), 6.5, 0, math.inf),
    "perspective": ((7, -4, 6), (0.5, 2.5, 3), (0.3, -0.1, 1), 44, 0, math.inf),
    "cut": ((7, -4, 6), (0.5, 2.5, 3), (0, 0, 2), 44, 7.75, 9.5),
}
COLOUR = (0.75, 0.5, 0.25)
BACKGROUND = (0.125, 0.25, 0.5, 0.8)
LIGHT = (-0.5, 1, 0.75)  # right, up, towards the eye
AMBIENT = 0.2
SAMPLES = 3


def add(a, b, s=1.0):
    return tuple(x + s * y for x, y in zip(a, b))


def scaled(a, s):
    return tuple(s * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def ball(origin, direction):
    """Entry, exit and the normal at the entry of a ball."""
    centre, radius = (1, 2, 3), 2.25
    o = add(origin, centre, -1)
    a, b, c = dot(direction, direction), dot(o, direction), dot(o, o) - radius * radius
    root = b * b - a * c
    if root < 0:
        return None
    t = (-b - math.sqrt(root)) / a
    return t, (-b + math.sqrt(root)) / a, scaled(add(o, direction, t), 1 / radius)


def box(origin, direction):
    """The same of a box."""
    low, high = (-1, 0.5, 1), (2.5, 4, 4.25)
    enter, leave, normal = -math.inf, math.inf, None
    for axis in range(3):
        o, d = origin[axis], direction[axis]
        if d == 0:
            if not low[axis] <= o <= high[axis]:
                return None
            continue
        near, far = sorted(((low[axis] - o) / d, (high[axis] - o) / d))
        if near > enter:
            enter = near
            normal = tuple(-math.copysign(1, d) if i == axis else 0 for i in range(3))
        leave = min(leave, far)
    return (enter, leave, normal) if enter <= leave else None


def srgb(linear):
    value = 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055
    return math.floor(255 * value + 0.5)


def picture(camera, solid):
    """Depth and red, green, blue, opacity of each pixel."""
    eye, target, up, size, near, far = CAMERAS[camera]
    forward = unit(add(target, eye, -1))
    right = unit(cross(forward, up))
    upwards = cross(right, forward)
    is_flat = camera == "orthographic"
    pixel = (size if is_flat else 2 * math.tan(math.radians(size / 2))) / HEIGHT
    light = unit(add(add(scaled(right, LIGHT[0]), upwards, LIGHT[1]), forward, -LIGHT[2]))

    def see(x, y):
        """Depth and premultiplied colour at a position."""
        offset = add(scaled(right, (x - WIDTH / 2) * pixel), upwards, (HEIGHT / 2 - y) * pixel)
        origin = add(eye, offset) if is_flat else eye
        direction = forward if is_flat else add(forward, offset)
        met = solid(origin, direction)
        if met is None or met[1] < near or max(met[0], near) > far:
            return math.inf, (*scaled(BACKGROUND[:3], BACKGROUND[3]), BACKGROUND[3])
        depth, _, normal = met
        if depth < near:  # in the cut
            depth, normal = near, scaled(unit(direction), -1)
        brightness = AMBIENT + (1 - AMBIENT) * max(0, dot(normal, light))
        return depth, (*scaled(COLOUR, brightness), 1)

    for j in range(HEIGHT):
        for i in range(WIDTH):
            total = (0, 0, 0, 0)
            for v in range(SAMPLES):
                for u in range(SAMPLES):
                    total = add(total, see(i + (u + 0.5) / SAMPLES, j + (v + 0.5) / SAMPLES)[1])
            mean = scaled(total, 1 / SAMPLES**2)
            yield (see(i + 0.5, j + 0.5)[0],
                   *(srgb(part / mean[3]) for part in mean[:3]), math.floor(255 * mean[3] + 0.5))


def main():
    print("# Made by make_pictures.py: camera and solid; then for each pixel, row by row, depth and\n"
          "# red, green, blue and opacity as bytes. Cameras and light: see there.")
    for camera in CAMERAS:
        for solid in (ball, box):
            print(camera, solid.__name__)
            for depth, *rgba in picture(camera, solid):
                print(f"{depth:.8g}", *rgba)


if __name__ == "__main__":
    main()
