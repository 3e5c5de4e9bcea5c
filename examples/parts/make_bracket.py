#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes bracket.stl, the part that the examples fill: a bearing bracket of 64 x 40 x 40 mm.

    python3 examples/parts/make_bracket.py examples/parts/bracket.stl

The solid is a signed distance function, built from round unions and intersections, and meshed by
dual contouring (Ju, Losasso, Schaefer and Warren, "Dual contouring of Hermite data", 2002): one
vertex in each grid cell that the surface passes, put where the tangent planes of the cell's crossed
edges meet, so sharp edges stay sharp. Dual contouring can give edges with four triangles where a
cell's corners are ambiguous; the grid here meets no such cell, and check() fails if that changes.

The same bytes on every machine: only + - * / and sqrt are used, which IEEE 754 rounds correctly,
and no sum() of floats, whose rounding differs between versions of Python. CGAL finds no
self-intersection in the result.
"""
import struct
import sys
from math import sqrt

STEP = 0.85  # mm, edge of a grid cell
HEADER = b"msq example part: bearing bracket, millimetres; made by make_bracket.py"


# The part: distances in mm, negative inside.

def length(x, y):
    return sqrt(x * x + y * y)


def round_union(a, b, r):
    """Union with a fillet of radius r where the two surfaces meet at a right angle."""
    return max(r, min(a, b)) - length(max(r - a, 0.0), max(r - b, 0.0))


def round_intersection(a, b, r):
    """Intersection whose edge is rounded with radius r."""
    return min(-r, max(a, b)) + length(max(r + a, 0.0), max(r + b, 0.0))


def bracket(x, y, z):
    x, y = abs(x), abs(y)  # two planes of symmetry

    # Base plate, 64 x 40 x 8 with corners of radius 8.
    corner_x, corner_y = x - 24.0, y - 12.0
    outline = (length(max(corner_x, 0.0), max(corner_y, 0.0))
               + min(max(corner_x, corner_y), 0.0) - 8.0)
    base = round_intersection(outline, z - 8.0, 1.2)

    # Bearing housing: a round arch about the bore's axis, straight sides down to the plate.
    axis = length(x, z - 26.0)
    arch = axis - 14.0 if z > 26.0 else x - 14.0
    housing = round_intersection(arch, y - 13.0, 1.5)

    # Gusset ribs towards both ends, with a sloping back from (14, 26) down to (27.5, 8).
    slope = (18.0 * (x - 14.0) + 13.5 * (z - 26.0)) / 22.5
    rib = round_intersection(max(slope, x - 27.5, z - 26.0), y - 3.5, 1.0)

    solid = round_union(base, round_union(housing, rib, 2.0), 2.5)

    # Bore with a wider bearing seat from both sides, their rims chamfered by 1 mm.
    bore = axis - 7.0
    seat = max(axis - 9.5, 9.0 - y)
    rim = (axis - 9.5 - (y - 12.0)) / sqrt(2.0)
    solid = max(solid, -min(bore, seat, rim))

    # Grease hole from the top of the arch into the bore.
    solid = max(solid, -max(length(x, y) - 2.0, 26.0 - z))

    # Four bolt holes, counterbored from above.
    bolt = length(x - 24.0, y - 12.0)
    counterbore = max(bolt - 4.8, 4.0 - z)
    solid = max(solid, -min(bolt - 2.7, counterbore))

    return max(solid, -z)


def gradient(x, y, z, e=1e-5):
    gx = bracket(x + e, y, z) - bracket(x - e, y, z)
    gy = bracket(x, y + e, z) - bracket(x, y - e, z)
    gz = bracket(x, y, z + e) - bracket(x, y, z - e)
    size = sqrt(gx * gx + gy * gy + gz * gz) or 1.0
    return gx / size, gy / size, gz / size


# Dual contouring.

def crossing(p, q):
    """Where the edge from p (inside) to q (outside) leaves the solid."""
    lo, hi = 0.0, 1.0
    for _ in range(40):
        t = 0.5 * (lo + hi)
        if bracket(*(a + t * (b - a) for a, b in zip(p, q))) <= 0.0:
            lo = t
        else:
            hi = t
    return tuple(a + lo * (b - a) for a, b in zip(p, q))


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def solve3(m, v):
    """Solves the symmetric system m x = v by Cramer's rule; m is (xx, xy, xz, yy, yz, zz)."""
    a, b, c, d, e, f = m
    i, j, k = d * f - e * e, c * e - b * f, b * e - c * d
    det = a * i + b * j + c * k
    return ((i * v[0] + j * v[1] + k * v[2]) / det,
            (j * v[0] + (a * f - c * c) * v[1] + (b * c - a * e) * v[2]) / det,
            (k * v[0] + (b * c - a * e) * v[1] + (a * d - b * b) * v[2]) / det)


def cell_vertex(low, hermite):
    """The point of the cell nearest to all tangent planes of its crossed edges."""
    mean = [0.0, 0.0, 0.0]
    for point, _ in hermite:
        mean = [mean[a] + point[a] / len(hermite) for a in range(3)]
    m, v = [0.0] * 6, [0.0] * 3
    for point, n in hermite:
        d = dot(n, [point[a] - mean[a] for a in range(3)])
        for slot, (r, c) in enumerate(((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))):
            m[slot] += n[r] * n[c]
        for a in range(3):
            v[a] += n[a] * d
    for slot in (0, 3, 5):  # pulls towards the mean where the planes leave a direction free
        m[slot] += 0.01
    x = solve3(m, v)
    p = [min(max(mean[a] + x[a], low[a]), low[a] + STEP) for a in range(3)]
    for _ in range(6):  # onto the surface, without leaving the cell
        d = bracket(*p)
        if abs(d) < 1e-7:
            break
        n = gradient(*p)
        p = [min(max(p[a] - d * n[a], low[a]), low[a] + STEP) for a in range(3)]
    if abs(p[2]) < 1e-4:
        p[2] = 0.0
    return tuple(p)


def mesh():
    """Vertices, and triangles of vertex indices, counter-clockwise from outside."""
    # Half a step off the planes of symmetry and of the plate: none runs through corners.
    half = [int(size / STEP) + 2 for size in (32, 20)]
    counts = (2 * half[0], 2 * half[1], int(40 / STEP) + 4)
    start = (-(half[0] - 0.5) * STEP, -(half[1] - 0.5) * STEP, -0.5 * STEP)

    def corner(i, j, k):
        return start[0] + i * STEP, start[1] + j * STEP, start[2] + k * STEP

    nx, ny, nz = counts
    inside = [[[bracket(*corner(i, j, k)) <= 0.0 for k in range(nz)] for j in range(ny)]
              for i in range(nx)]

    hermite = {}  # cell -> [(crossing, normal)]
    quads = []
    for i in range(nx - 1):
        for j in range(ny - 1):
            for k in range(nz - 1):
                here = inside[i][j][k]
                for axis in range(3):
                    o = [i, j, k]
                    o[axis] += 1
                    there = inside[o[0]][o[1]][o[2]]
                    if here == there:
                        continue
                    p, q = corner(i, j, k), corner(*o)
                    at = crossing(p, q) if here else crossing(q, p)
                    sample = (at, gradient(*at))
                    u, w = (axis + 1) % 3, (axis + 2) % 3
                    ring = []  # the four cells about the edge, counter-clockwise seen from +axis
                    for du, dw in ((0, 0), (-1, 0), (-1, -1), (0, -1)):
                        cell = [i, j, k]
                        cell[u] += du
                        cell[w] += dw
                        ring.append(tuple(cell))
                        hermite.setdefault(ring[-1], []).append(sample)
                    quads.append(ring if here else ring[::-1])

    index = {cell: n for n, cell in enumerate(hermite)}
    vertices = [cell_vertex(corner(*cell), samples) for cell, samples in hermite.items()]

    triangles = []
    for ring in quads:
        a, b, c, d = (index[cell] for cell in ring)
        pa, pb, pc, pd = vertices[a], vertices[b], vertices[c], vertices[d]
        # The diagonal whose middle lies nearer to the surface.
        mid_ac = abs(bracket(*((s + t) / 2 for s, t in zip(pa, pc))))
        mid_bd = abs(bracket(*((s + t) / 2 for s, t in zip(pb, pd))))
        triangles += [(a, b, c), (a, c, d)] if mid_ac <= mid_bd + 1e-9 else [(b, c, d), (b, d, a)]
    return vertices, triangles


# Checking and writing.

def check(vertices, triangles):
    """Fails unless the triangles are a closed, outward-facing 2-manifold of the promised size."""
    def require(condition, message):
        if not condition:
            sys.exit("make_bracket.py: " + message)

    require(20000 <= len(triangles) <= 40000, f"{len(triangles)} triangles, not 20,000 to 40,000")
    require(len(set(vertices)) == len(vertices), "two vertices coincide")
    edges = set()
    fans = {}  # vertex -> {next: after}: the links of the triangles about it
    for t in triangles:
        for a, b, c in (t, t[1:] + t[:1], t[2:] + t[:2]):
            require((a, b) not in edges, f"edge {a}-{b} is used twice in one direction")
            edges.add((a, b))
            fans.setdefault(a, {})[b] = c
    require(all((b, a) in edges for a, b in edges), "an edge has one triangle only")
    for v, links in fans.items():
        first = turn = next(iter(links))
        steps = 0
        while steps == 0 or turn != first:
            turn = links[turn]
            steps += 1
        require(steps == len(links), f"vertex {v} joins two sheets")

    volume = 0.0
    for t in triangles:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (vertices[n] for n in t)
        volume += (ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz)
                   + az * (bx * cy - by * cx)) / 6
    require(volume > 0, f"volume is {volume:.1f}: inside out")
    lowest = min(v[2] for v in vertices)
    require(lowest == 0.0, f"lowest point is at z = {lowest}")
    return volume


def write_stl(path, vertices, triangles):
    out = bytearray(HEADER.ljust(80)) + struct.pack("<I", len(triangles))
    for t in triangles:
        a, b, c = (vertices[n] for n in t)
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        size = sqrt(dot(n, n)) or 1.0
        out += struct.pack("<12fH", *(k / size for k in n), *a, *b, *c, 0)
    with open(path, "wb") as file:
        file.write(out)


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: make_bracket.py OUT.stl")
    vertices, triangles = mesh()
    # As the file will hold them, so that what is checked is what is read back.
    vertices = [struct.unpack("<3f", struct.pack("<3f", *v)) for v in vertices]
    volume = check(vertices, triangles)
    write_stl(sys.argv[1], vertices, triangles)
    size = [max(v[a] for v in vertices) - min(v[a] for v in vertices) for a in range(3)]
    print(f"{sys.argv[1]}: {len(triangles)} triangles, {size[0]:.2f} x {size[1]:.2f} x "
          f"{size[2]:.2f} mm, {volume / 1000:.2f} cm3")


if __name__ == "__main__":
    main()
