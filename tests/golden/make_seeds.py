#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes seeds.txt: seeds of foams, points of samples and what follows from them, computed from
docs/seeds.md alone. Standard library only; Python's numbers are IEEE 754 doubles, rounded one
operation at a time.

Run: python3 make_seeds.py > seeds.txt (a few seconds). With --page: the rows of the tables in
docs/seeds.md. With --check: fails unless seeds.txt and the page have all of that.
"""
import contextlib
import io
import itertools
import math
import pathlib
import struct
import sys

MASK = (1 << 64) - 1
IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)

HEADER = """\
# Made by make_seeds.py from docs/seeds.md. Numbers with a point are hexadecimal floating-point.
#
# mix x finalise(x) output(x, 7) unit(x)
# turn <9 of a definition's rotation> <the 9 that count>
# foam seed jitter <origin> <cell size> <9 of its rotation> density ...
#   density: 1 none; constant d; ramp a bx by bz low high: (a + bx x + by y + bz z) kept within low
#   and high; bits: 2^(h mod 17 - 1), h = finalise(x ^ finalise(y ^ finalise(z))) of the bits of x, y, z.
# What follows is of the last foam:
# place <point> i j k <fraction of the cell>
# cell i j k bits <seed in its cell>
# from i0 j0 k0 i j k <seed from the corner of (i0, j0, k0), foam units>
# block i j k n hash: of the seeds in their cells, n^3 cells from (i, j, k), x first
# leaves i j k count hash: of a cell: of each leaf its path, and its seed in the cell
# leaf i j k path <seed in the cell>: the first few of them
# nearest <point> i j k path: the nearest seed
# inside <point> radius 0 or 1
# sample seed n nx ny nz <origin> <cell size> <9 of its rotation>
# point number <position>: of the last sample
# direction number <direction of the segment from that point>
#
# hash: h = 0, then h = finalise(h ^ w) for each word w, numbers by their bits."""


# ---- numbers


def finalise(x):
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9 & MASK
    x = (x ^ (x >> 27)) * 0x94D049BB133111EB & MASK
    return x ^ (x >> 31)


def output(key, n):
    return finalise((key + n * 0x9E3779B97F4A7C15) & MASK)


def unit(bits):
    return (bits >> 11) * 2.0**-53


def u32(i):
    return i % (1 << 32)


def bits_of(x):
    return struct.unpack('<Q', struct.pack('<d', x))[0]


def number_of(bits):
    return struct.unpack('<d', struct.pack('<Q', bits))[0]


def hashed(words):
    h = 0
    for w in words:
        h = finalise(h ^ w)
    return h


# ---- vectors


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(a, s):
    return (a[0] * s, a[1] * s, a[2] * s)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


# ---- frames


def nearest_rotation(matrix):
    r = [list(matrix[3 * i:3 * i + 3]) for i in range(3)]
    for _ in range(2):
        d = [[(3.0 if k == j else 0.0) -
              (0.0 + r[0][k] * r[0][j] + r[1][k] * r[1][j] + r[2][k] * r[2][j])
              for j in range(3)] for k in range(3)]
        r = [[0.5 * (0.0 + r[i][0] * d[0][j] + r[i][1] * d[1][j] + r[i][2] * d[2][j])
              for j in range(3)] for i in range(3)]
    return tuple(r[0] + r[1] + r[2])


class Grid:
    def __init__(self, origin=(0.0, 0.0, 0.0), size=(1.0, 1.0, 1.0), rotation=IDENTITY):
        self.origin, self.size, self.given = origin, size, rotation
        self.rotation = nearest_rotation(rotation)

    def to_grid(self, p):
        d, r = sub(p, self.origin), self.rotation
        return tuple(r[c] * d[0] + r[3 + c] * d[1] + r[6 + c] * d[2] for c in range(3))

    def turned(self, g):
        r = self.rotation
        return tuple(r[3 * c] * g[0] + r[3 * c + 1] * g[1] + r[3 * c + 2] * g[2] for c in range(3))

    def from_grid(self, g):
        return tuple(t + o for t, o in zip(self.turned(g), self.origin))

    def locate(self, p):
        parts = [g / s for g, s in zip(self.to_grid(p), self.size)]
        cell = tuple(math.floor(c) for c in parts)
        return cell, tuple(c - f for c, f in zip(parts, cell))


# ---- densities


class Constant:
    def __init__(self, value):
        self.value, self.most = value, value

    def __call__(self, p):
        return self.value

    def words(self):
        return ['constant', self.value]


class Ramp:
    def __init__(self, a, b, low, high):
        self.a, self.b, self.low, self.high = a, b, low, high

    def __call__(self, p):
        v = self.a + self.b[0] * p[0] + self.b[1] * p[1] + self.b[2] * p[2]
        return min(max(v, self.low), self.high)

    def words(self):
        return ['ramp', self.a, *self.b, self.low, self.high]


class Bits:
    def __call__(self, p):
        x, y, z = (bits_of(c) for c in p)
        return 2.0**(finalise(x ^ finalise(y ^ finalise(z))) % 17 - 1)

    def words(self):
        return ['bits']


# ---- foams


class Foam:
    def __init__(self, seed, jitter, grid=Grid(), density=None):
        self.seed, self.jitter, self.grid, self.density = seed, jitter, grid, density
        self.key = finalise((seed + 1) & MASK)
        self.j = math.floor(jitter * 2.0**31)
        self.unit = max(grid.size)
        inverse = 1 / self.unit
        self.scale = tuple(s * inverse for s in grid.size)
        self.known = {}

    def bits(self, cell):
        i, j, k = cell
        row = finalise(self.key ^ (u32(j) | u32(k) << 32))
        return output(row, u32(i))

    def fractions(self, bits):
        parts = (bits % 2**21, (bits >> 21) % 2**21, (bits >> 42) % 2**21)
        return tuple((2**20 + ((b - 2**20) * self.j >> 31)) * 2.0**-21 for b in parts)

    def in_cell(self, cell):
        return self.fractions(self.bits(cell))

    def placed(self, cell, within, home):
        return tuple(((cell[c] - home[c]) + within[c]) * self.scale[c] for c in range(3))

    # Leaves: (path, level, low corner, seed in the cell).

    def splits(self, cell, level, path, low):
        if level == 5:
            return False
        half = 2.0**-(level + 1)
        g = tuple((cell[c] + low[c] + half) * self.grid.size[c] for c in range(3))
        m = self.density(self.grid.from_grid(g)) * 8.0**-level
        if m <= 1:
            return False
        return m >= 8 or unit(output(self.bits(cell), 2 * path + 1)) < (m - 1) / 7

    def leaves(self, cell):
        if cell not in self.known:
            self.known[cell] = list(self.grow(cell, 0, 1, (0.0, 0.0, 0.0)))
        return self.known[cell]

    def grow(self, cell, level, path, low):
        if self.density is not None and self.splits(cell, level, path, low):
            half = 2.0**-(level + 1)
            for n in range(8):
                corner = tuple(low[c] + (n >> c & 1) * half for c in range(3))
                yield from self.grow(cell, level + 1, 8 * path + n, corner)
            return
        bits = self.bits(cell) if level == 0 else output(self.bits(cell), 2 * path)
        f = self.fractions(bits)
        yield path, level, low, tuple(low[c] + f[c] * 2.0**-level for c in range(3))

    def seeds_about(self, home, reach):
        """(position, level, cell, path) in the order of seeds, of all cells within reach of home."""
        n = [math.ceil(reach / s) for s in self.scale]
        for k in range(-n[2], n[2] + 1):
            for j in range(-n[1], n[1] + 1):
                for i in range(-n[0], n[0] + 1):
                    cell = (home[0] + i, home[1] + j, home[2] + k)
                    for path, level, _, seed in self.leaves(cell):
                        yield self.placed(cell, seed, home), level, cell, path

    def leaf_of(self, cell, q):
        level, low, leaves = 0, (0.0, 0.0, 0.0), self.leaves(cell)
        while not any(leaf[1] == level and leaf[2] == low for leaf in leaves):
            half = 2.0**-(level + 1)
            low = tuple(low[c] + (half if q[c] >= (low[c] + half) * self.scale[c] else 0.0)
                        for c in range(3))
            level += 1
        return next(leaf[0] for leaf in leaves if leaf[1] == level and leaf[2] == low)

    def nearest(self, p):
        """The cell and path of the nearest seed, all seeds about, their squared distances, q."""
        home, fraction = self.grid.locate(p)
        q = tuple(f * s for f, s in zip(fraction, self.scale))
        # No point is farther from a seed than the diagonal of a cell.
        seeds = list(self.seeds_about(home, math.sqrt(dot(self.scale, self.scale))))
        own = self.leaf_of(home, q)
        squared = [dot(d, d) for d in (sub(s[0], q) for s in seeds)]
        least = min(squared)
        equal = [s for s, d in zip(seeds, squared) if d == least]
        first = next((s for s in equal if s[2] == home and s[3] == own), equal[0])
        return first, least, home, q

    def edges_near(self, p, radius):
        """What decides whether p is inside, for radii up to this: edges, and the unit they are in."""
        nearest, least, home, q = self.nearest(p)
        reach = math.sqrt(least) + 2 * (radius / self.unit) + 1e-9
        near = []
        for position, *_ in self.seeds_about(home, reach):
            d = sub(position, q)
            if dot(d, d) <= reach * reach:
                near.append(position)
        scale = 2.0**nearest[1]
        near = [times(s, scale) for s in near]
        edges = [edge_of(near, triple, times(q, scale))
                 for triple in itertools.combinations(range(len(near)), 3)]
        return [edge for edge in edges if edge is not None], scale

    def is_inside(self, edges, radius):
        edges, scale = edges
        r = radius / self.unit * scale
        return any(meets(edge, r) for edge in edges)

    def inside(self, p, radius):
        return self.is_inside(self.edges_near(p, radius), radius)

    def touching_radius(self, p, most):
        """The least number that makes p inside, if it is at most that."""
        edges = self.edges_near(p, most)
        if not self.is_inside(edges, most):
            return None
        low, high = 0, bits_of(most)  # as doubles ascend, so do their bits
        while high - low > 1:
            middle = (low + high) // 2
            if self.is_inside(edges, number_of(middle)):
                high = middle
            else:
                low = middle
        return number_of(high)


def edge_of(near, triple, q):
    """Of three seeds, all that does not depend on the radius."""
    a, b, c = (near[i] for i in triple)
    u, v = sub(b, a), sub(c, a)
    direction = cross(u, v)
    squared = dot(direction, direction)
    if squared == 0:
        return None
    w = 1 / squared
    offset = times(cross(sub(times(v, dot(u, u)), times(u, dot(v, v))), direction), 0.5 * w)
    e = sub(sub(q, a), offset)
    foot = dot(e, direction) * w
    d = sub(e, times(direction, foot))
    low, high = -math.inf, math.inf
    for i, n in enumerate(near):
        if i in triple:
            continue
        e = sub(n, a)
        across = dot(direction, e)
        room = 0.5 * dot(e, e) - dot(offset, e)
        if across > 1e-14:
            high = min(high, room / across)
        elif across < -1e-14:
            low = max(low, room / across)
        elif room < -1e-12:
            return None
    return w, foot, dot(d, d), low, high


def meets(edge, r):
    w, foot, squared, low, high = edge
    x = (r * r - squared) * w
    if x < 0:
        return False
    gap = max(low, foot - math.sqrt(x)) - min(high, foot + math.sqrt(x))
    return gap <= 0 or gap * gap <= 1e-24 * w


# ---- samples


class Sample:
    def __init__(self, seed, per_cell, counts, grid=Grid()):
        self.seed, self.n, self.counts, self.grid = seed, per_cell, counts, grid
        self.key = finalise(finalise((seed + 1) & MASK) ^ 0x73747261746966)
        self.directions = finalise(finalise((seed + 1) & MASK) ^ 0x646972656374)

    def point(self, number):
        i, (nx, ny, _) = number // self.n, self.counts
        cell = (i % nx, i // nx % ny, i // nx // ny)
        g = tuple((cell[c] + unit(output(self.key, 3 * number + c))) * self.grid.size[c]
                  for c in range(3))
        return self.grid.from_grid(g)

    def direction(self, number):
        stream = finalise(self.directions ^ finalise(number))
        for n in itertools.count(0, 2):
            a = 2 * unit(output(stream, n)) - 1
            b = 2 * unit(output(stream, n + 1)) - 1
            q = a * a + b * b
            if q < 1:
                root = 2 * math.sqrt(1 - q)
                return (a * root, b * root, 1 - 2 * q)


# ---- what is written


def text(word):
    return word.hex() if isinstance(word, float) else str(word)


def put(*words):
    print(*map(text, words))


class Numbers:
    """Numbers to choose points and cells by."""

    def __init__(self, key):
        self.key, self.n = key, 0

    def below(self, count):
        self.n += 1
        return output(self.key, self.n) % count

    def between(self, low, high):
        """One of 2^20 equal steps."""
        return low + (high - low) * self.below(1 << 20) * 2.0**-20


def turn(c, s, d, t):
    """By the angles of cosine and sine c, s and d, t."""
    return (c, -s * d, s * t, s, c * d, -c * t, 0.0, t, d)


TURNED = Grid((0.3, 0.2, -0.7), (1.1, 0.7, 0.6), turn(0.6, 0.8, 5 / 13, -12 / 13))
# Off by less than 1e-9: not yet the rotation that counts.
SKEWED = Grid((-120.3, 3.1, 1e3), (2.1, 2.3, 0.8),
              tuple(m + e for m, e in zip(turn(-7 / 25, -24 / 25, 15 / 17, 8 / 17), (2e-10, -1e-10, 3e-10) * 3)))


def put_foam(foam):
    put('foam', foam.seed, foam.jitter, *foam.grid.origin, *foam.grid.size, *foam.grid.given,
        *(foam.density.words() if foam.density else ['1']))


def put_plain(foam, numbers):
    put_foam(foam)
    far = [(0, 0, 0), (-1, -1, -1), (1, 2, 3), (-3, 2, -1), (16777215, -16777215, 16777214),
           (-16777215, 0, 16777215), (2**31 - 1, -2**31, 0), (-2**31, 2**31 - 1, -1)]
    for cell in far + [tuple(numbers.below(1 << 25) - (1 << 24) for _ in range(3))
                       for _ in range(6)]:
        put('cell', *cell, foam.bits(cell), *foam.in_cell(cell))
    for _ in range(6):
        home = tuple(numbers.below(1 << 25) - (1 << 24) for _ in range(3))
        cell = tuple(h + numbers.below(15) - 7 for h in home)
        put('from', *home, *cell, *foam.placed(cell, foam.in_cell(cell), home))
    for corner in ((-5, -6, -3), (16777200, -16777216, -8)):
        cells = [tuple(corner[c] + offset[2 - c] for c in range(3))
                 for offset in itertools.product(range(12), repeat=3)]
        put('block', *corner, 12, hashed(bits_of(c) for cell in cells for c in foam.in_cell(cell)))


def put_leaves(foam, cells):
    for cell in cells:
        leaves = foam.leaves(cell)
        put('leaves', *cell, len(leaves),
            hashed(w for path, _, _, seed in leaves for w in (path, *map(bits_of, seed))))
        for path, _, _, seed in leaves[:2]:
            put('leaf', *cell, path, *seed)


def put_nearest(foam, points):
    for p in points:
        nearest = foam.nearest(p)[0]
        put('nearest', *p, *nearest[2], nearest[3])


def put_inside(foam, points):
    """The radius with which a point is just inside, and the number before it."""
    for p in points:
        density, across = foam.density(p) if foam.density else 1.0, 1
        while across**3 < density:
            across += 1
        most = 0.375 * min(foam.grid.size) / across
        radius = foam.touching_radius(p, most)
        put('inside', *p, radius or most, int(radius is not None))
        if radius is not None and radius > 1e-9:
            put('inside', *p, number_of(bits_of(radius) - 1), 0)


def put_places(grid, points):
    for p in points:
        cell, fraction = grid.locate(p)
        put('place', *p, *cell, *fraction)


def some_points(numbers, count, low, high, steps=0):
    """In a box, all its corners apart the same; with steps at multiples of 1 / steps."""
    for _ in range(count):
        p = tuple(numbers.between(a, b) for a, b in zip(low, high))
        yield tuple(round(c * steps) / steps for c in p) if steps else p


def around(grid, cells):
    """A box in model coordinates about the first cells of a grid."""
    corner = grid.from_grid((0.0, 0.0, 0.0))
    reach = cells * max(grid.size)
    return tuple(c - reach for c in corner), tuple(c + reach for c in corner)


def put_numbers(numbers):
    for x in [0, 1, MASK, 1 << 63] + [numbers.below(1 << 64) for _ in range(4)]:
        put('mix', x, finalise(x), output(x, 7), unit(x))
    for grid in (Grid(), TURNED, SKEWED, Grid(rotation=(0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0))):
        put('turn', *grid.given, *grid.rotation)


def put_plain_foams(numbers):
    for seed, jitter, grid in ((0, 1.0, Grid()), (MASK, 1.0, Grid()), (77, 0.5, Grid()),
                               (123456789, 0.0625, Grid()), (5, 0.0, Grid()), (5, 1e-9, Grid()),
                               (2**63 + 12345, 1 / 3, Grid(size=(49.0, 49.0, 49.0))),
                               (1, 0.0, Grid(size=(49.0, 49.0, 49.0))), (6, 0.0, TURNED),
                               (6, 1e-9, TURNED), (7, 0.9999999999, SKEWED)):
        foam = Foam(seed, jitter, grid)
        put_plain(foam, numbers)
        low, high = around(grid, 3)
        put_places(grid, some_points(numbers, 8, low, high))
        put_inside(foam, some_points(numbers, 12, low, high))
        put_inside(foam, some_points(numbers, 12, low, high, 8))


def put_graded_foams(numbers):
    near = [(0, 0, 0), (-1, -1, -1), (3, -2, 7)]
    far = [(16777215, -16777215, 100), (-16777216, 5, 16777214)]
    for seed, jitter, grid, density, cells, steps in (
            (5, 1.0, Grid(), Constant(3.0), near + far, 0),
            (5, 1.0, Grid(), Constant(20.0), near + far, 0),
            (MASK, 0.75, Grid(), Constant(32768.0), near[:1], None),
            (9, 0.0, Grid(), Constant(3.0), near, 8),
            (10, 0.0, Grid(), Constant(12.0), near, 16),
            (8, 0.0, Grid(size=(49.0, 49.0, 49.0)), Constant(8.0), near, 0),
            (6, 1.0, Grid(), Ramp(40.0, (24.0, -8.0, 4.0), 0.5, 120.0), near, 0),
            (6, 0.8, TURNED, Ramp(30.0, (-16.0, 8.0, 4.0), 0.0, 600.0), near, 0),
            (4, 1.0, SKEWED, Ramp(1000.0, (8.0, 0.5, -0.03125), 0.25, 4000.0), near, None),
            (3, 1.0, TURNED, Bits(), near + far, None),
            (2, 0.9, SKEWED, Bits(), near + far, None)):
        foam = Foam(seed, jitter, grid, density)
        put_foam(foam)
        put_leaves(foam, cells)
        if steps is None:
            continue
        low, high = around(grid, 1)
        put_nearest(foam, some_points(numbers, 60 if steps else 12, low, high, steps))
        put_inside(foam, some_points(numbers, 12, low, high, steps))


def put_samples(numbers):
    for seed, per_cell, counts, grid in (
            (42, 2, (1000, 1000, 1000), Grid()), (0, 2, (3, 5, 7), TURNED),
            (MASK, 4096, (2**20, 2**20, 2**10), SKEWED),
            (7, 3, (2**31 - 1, 1, 2), Grid((0.1, -1e5, 0.0), (1e-3, 1e4, 3.0)))):
        sample = Sample(seed, per_cell, counts, grid)
        points = per_cell * math.prod(counts)
        put('sample', seed, per_cell, *counts, *grid.origin, *grid.size, *grid.given)
        for number in [0, 1, 2, points - 1] + [numbers.below(points) for _ in range(12)]:
            put('point', number, *sample.point(number))
            if points < 1000:
                put('direction', number, *sample.direction(number))


def put_page():
    def row(*cells):
        print('| ' + ' | '.join(cells) + ' |')

    row('finalise(1)', f'`{finalise(1):#018x}`')
    row('finalise(2⁶⁴ − 1)', f'`{finalise(MASK):#018x}`')
    row('output(1, 1)', f'`{output(1, 1):#018x}`')
    row('output(5, u32(−1))', f'`{output(5, u32(-1)):#018x}`')
    row('unit(output(1, 1))', f'`{unit(output(1, 1)).hex()}`')
    for seed, jitter, cell in ((0, 1.0, (0, 0, 0)), (0, 1.0, (-1, 2, -3)), (0, 0.3, (-1, 2, -3)),
                               (0, 0.0, (-1, 2, -3)), (5, 0.3, (-16777215, 0, 16777215)),
                               (MASK, 1.0, (16777215, -16777215, 7))):
        foam = Foam(seed, jitter)
        row('2⁶⁴ − 1' if seed == MASK else str(seed), f'{jitter:g}',
            str(cell).replace('-', '−'), f'`{foam.bits(cell):#018x}`',
            ', '.join(f'{int(f * 2**21)}' for f in foam.in_cell(cell)))
    for density in (1.0, 20.0, 300.0):
        leaves = Foam(5, 1.0, Grid(), Constant(density)).leaves((3, -2, 7))
        for n in sorted({0, len(leaves) // 2, len(leaves) - 1}):
            path, _, _, seed = leaves[n]
            row(f'{density:g}', f'{n + 1} of {len(leaves)}', str(path),
                ', '.join(f'{int(c * 2**26)}' for c in seed))
    sample = Sample(42, 2, (1000, 1000, 1000))
    for number in (0, 2000, 1999999999):
        row(str(number), ', '.join(f'`{c.hex()}`' for c in sample.point(number)))
    row('2000', ', '.join(f'`{c.hex()}`' for c in sample.direction(2000)))


def put_all():
    print(HEADER)
    numbers = Numbers(2024)
    put_numbers(numbers)
    put_plain_foams(numbers)
    put_graded_foams(numbers)
    put_samples(numbers)


def written_by(put_lines):
    with io.StringIO() as out, contextlib.redirect_stdout(out):
        put_lines()
        return out.getvalue()


def check():
    here = pathlib.Path(__file__).resolve().parent
    if (here / 'seeds.txt').read_text(encoding='utf-8') != written_by(put_all):
        sys.exit('seeds.txt is not what this script writes')
    page = (here.parent.parent / 'docs' / 'seeds.md').read_text(encoding='utf-8').splitlines()
    for row in written_by(put_page).splitlines():
        if row not in page:
            sys.exit(f'docs/seeds.md lacks this row:\n{row}')


def main():
    if sys.argv[1:] == ['--check']:
        check()
    elif sys.argv[1:] == ['--page']:
        sys.stdout.reconfigure(encoding='utf-8')
        put_page()
    else:
        put_all()


if __name__ == '__main__':
    main()
