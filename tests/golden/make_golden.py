#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes membership.txt: which points of space lattices and foams hold, found the slow way.

An oracle that shares nothing with msq but the definitions in its headers: struts are capsules; a
lattice is its unit cell's struts in all cells around; a foam's struts are the edges of the Voronoi
diagram, each found from a triple of seeds by cutting the triple's axis with the bisector of every
other seed near by. Seeds: SplitMix64 of cell index and seed number. Standard library only.

Points: coordinate c of point i is low + (high - low) * (h >> 44) / 2^20, h being output 3 i + c of
SplitMix64 with state 0 started at 1234. One character a point: 1 inside, 0 outside, ? within 1e-6 of
the boundary.

Run: python3 make_golden.py > membership.txt (about a minute)
"""
import itertools
import math

MASK = (1 << 64) - 1
GAMMA = 0x9E3779B97F4A7C15
COUNT = 2500
NEAR = 1e-6


def finalise(x):
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & MASK
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & MASK
    return x ^ (x >> 31)


def output(key, n):
    return finalise((key + n * GAMMA) & MASK)


def points(low, high):
    for i in range(COUNT):
        yield tuple(low[c] + (high[c] - low[c]) * (output(1234, 3 * i + c) >> 44) / 2.0**20
                    for c in range(3))


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def distance_to_segment(p, a, b):
    ab, ap = sub(b, a), sub(p, a)
    l2 = dot(ab, ab)
    t = min(1.0, max(0.0, dot(ap, ab) / l2)) if l2 > 0 else 0.0
    return math.dist(p, (a[0] + t * ab[0], a[1] + t * ab[1], a[2] + t * ab[2]))


def marks(segments, radius, low, high):
    text = []
    for p in points(low, high):
        r = radius(p)
        d = min(distance_to_segment(p, a, b) for a, b in segments)
        text.append('?' if abs(d - r) <= NEAR else '1' if d < r else '0')
    return ''.join(text)


# ---- lattices: the edges of every cell around, repeated ones and all


def corners():
    return list(itertools.product((0, 1), repeat=3))


def unit_struts(name):
    if name == 'cubic':
        return [(a, b) for a, b in itertools.combinations(corners(), 2) if math.dist(a, b) == 1]
    if name == 'bcc':
        return [((0.5, 0.5, 0.5), c) for c in corners()]
    faces = [tuple(side if c == axis else 0.5 for c in range(3))
             for axis in range(3) for side in (0, 1)]
    return [(a, b) for a, b in itertools.combinations(corners() + faces, 2)
            if abs(math.dist(a, b) - math.sqrt(0.5)) < 1e-9]


def lattice_segments(name, size, low, high, reach):
    segments = set()
    cells = [range(math.floor((low[c] - reach) / size[c]) - 1, math.ceil((high[c] + reach) / size[c]) + 1)
             for c in range(3)]
    for cell in itertools.product(*cells):
        for a, b in unit_struts(name):
            ends = [tuple((cell[c] + e[c]) * size[c] for c in range(3)) for e in (a, b)]
            segments.add((min(ends), max(ends)))
    return segments


# ---- foams


def seed_of(number, jitter, cell, scale):
    key = finalise((number + 1) & MASK)
    x, y, z = (c & 0xFFFFFFFF for c in cell)
    h = output(finalise(key ^ (y | z << 32)), x)
    parts = (h & 0x1FFFFF, h >> 21 & 0x1FFFFF, h >> 42 & 0x1FFFFF)
    amount = math.floor(jitter * 2.0**31)
    return tuple((cell[c] + 0.5 + ((parts[c] - 0x100000) * amount >> 31) / 2.0**21) * scale[c]
                 for c in range(3))


def foam_segments(number, jitter, scale, low, high, radius):
    """All Voronoi edges that come within the radius of the box, by their first seeds."""
    empty = math.sqrt(dot(scale, scale))  # no point is farther from its nearest seed
    owner_reach = radius + empty
    around = [math.ceil((owner_reach + 2 * empty) / scale[c]) for c in range(3)]
    cells = [range(math.floor(low[c] / scale[c]) - around[c], math.ceil(high[c] / scale[c]) + around[c])
             for c in range(3)]
    seeds = [seed_of(number, jitter, (x, y, z), scale)
             for z in cells[2] for y in cells[1] for x in cells[0]]
    segments = []
    for n, own in enumerate(seeds):
        if any(own[c] < low[c] - owner_reach or own[c] > high[c] + owner_reach for c in range(3)):
            continue
        near = sorted((math.dist(own, s), m, sub(s, own)) for m, s in enumerate(seeds)
                      if m != n and math.dist(own, s) <= 2 * empty)
        half = [(s, dot(s, s) / 2, m) for _, m, s in near]
        for (u, hu, mu), (v, hv, mv) in itertools.combinations(half, 2):
            if mu < n or mv < n:
                continue
            # Points equally far from 0, u and v: those with u.p = hu and v.p = hv.
            d = cross(u, v)
            d2 = dot(d, d)
            if d2 < 1e-18:
                continue
            vd, du = cross(v, d), cross(d, u)
            at = tuple((hu * vd[c] + hv * du[c]) / d2 for c in range(3))
            least, most = -math.inf, math.inf
            for w, hw, mw in half:
                if mw == mu or mw == mv:
                    continue
                slope, room = dot(w, d), hw - dot(w, at)  # w.(at + t d) <= hw
                if slope > 1e-14:
                    most = min(most, room / slope)
                elif slope < -1e-14:
                    least = max(least, room / slope)
                elif room < -1e-12:
                    most = -math.inf
                if least > most:
                    break
            if least <= most and math.isfinite(least) and math.isfinite(most):
                segments.append(tuple(tuple(own[c] + at[c] + t * d[c] for c in range(3))
                                      for t in (least, most)))
    return segments


def main():
    print('# Made by make_golden.py: name, size of the cells, radius (or radii of a gradient in x),')
    print('# corners of the box of points, for foams number and jitter; then a mark a point.')

    def put(name, size, radii, low, high, foam=None):
        print(name, *map(repr, size), *map(repr, radii), *map(repr, low), *map(repr, high),
              *map(repr, foam or (0, 1.0)))
        most = max(radii)
        if foam:
            unit = max(size)
            scale = tuple(s / unit for s in size)
            edges = foam_segments(*foam, scale, [v / unit for v in low], [v / unit for v in high],
                                  most / unit)
            segments = [tuple(tuple(v * unit for v in e) for e in ends) for ends in edges]
        else:
            segments = lattice_segments(name, size, low, high, most)

        def radius(p):
            t = (p[0] - low[0]) / (high[0] - low[0])
            return radii[0] + t * (radii[1] - radii[0])

        text = marks(segments, radius, low, high)
        for i in range(0, len(text), 100):
            print(text[i:i + 100])

    for name, radius in (('cubic', 0.2), ('bcc', 0.12), ('octet', 0.08)):
        put(name, (1.0, 1.0, 1.0), (radius, radius), (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0))
        put(name, (1.25, 0.75, 2.0), (0.05, 2 * radius), (-1.5, 0.0, -3.0), (0.5, 1.5, 0.5))
    box = ((-0.5, -1.0, 0.25), (0.5, 0.0, 1.25))
    put('foam', (1.0, 1.0, 1.0), (0.1, 0.1), *box, (0, 1.0))
    put('foam', (1.0, 1.0, 1.0), (0.3, 0.3), *box, (2**64 - 1, 1.0))
    put('foam', (1.0, 1.0, 1.0), (0.05, 0.4), *box, (77, 0.5))
    put('foam', (2.0, 2.0, 1.0), (0.3, 0.3), (-1.0, -2.0, 0.5), (1.0, 0.0, 1.5), (5, 1.0))
    put('foam', (1.0, 1.0, 1.0), (0.2, 0.2), *box, (123456789, 0.0625))


if __name__ == '__main__':
    main()
