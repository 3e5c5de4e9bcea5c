#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Volume fractions of the named functions, for docs/concepts.md and tests/unit/test_functional.cpp.

The points are multiples of a vector modulo 1 that fill the cell evenly (powers of the inverse of the root
of g^4 = g + 1). With 40 million the numbers are accurate to about 0.00001. Needs NumPy.
usage: make_fractions.py [points]
"""
import sys

import numpy as np

SHEET = 0.2


class Angle:
    """A multiple of a coordinate. Sines and cosines of a batch of points are computed once."""

    def __init__(self, values, times=1, known=None):
        self.values, self.times, self.known = values, times, {} if known is None else known

    def __rmul__(self, times):
        return Angle(self.values, times * self.times, self.known)

    def of(self, function):
        key = function.__name__, self.times
        if key not in self.known:
            self.known[key] = function(self.times * self.values)
        return self.known[key]


def functions():
    def s(angle):
        return angle.of(np.sin)

    def c(angle):
        return angle.of(np.cos)

    yield "gyroid", lambda x, y, z: s(x) * c(y) + s(y) * c(z) + s(z) * c(x)
    yield "Schwarz P", lambda x, y, z: c(x) + c(y) + c(z)
    yield "diamond", lambda x, y, z: (s(x) * s(y) * s(z) + s(x) * c(y) * c(z) + c(x) * s(y) * c(z) +
                                      c(x) * c(y) * s(z))

    def ones(x, y, z):
        return c(x) + c(y) + c(z)

    def pairs(x, y, z):
        return c(x) * c(y) + c(y) * c(z) + c(z) * c(x)

    def twists(x, y, z):
        return s(2 * x) * c(y) * s(z) + s(2 * y) * c(z) * s(x) + s(2 * z) * c(x) * s(y)

    def turns(x, y, z):
        return s(2 * x) * s(y) + s(2 * y) * s(z) + s(2 * z) * s(x)

    def triple(x, y, z):
        return c(x) * c(y) * c(z)

    yield "I-WP", lambda *p: 2 * pairs(*p) - ones(*(2 * a for a in p))
    yield "Neovius", lambda *p: 3 * ones(*p) + 4 * triple(*p)
    yield "F-RD", lambda *p: 4 * triple(*p) - pairs(*(2 * a for a in p))
    yield "Lidinoid", lambda *p: 0.5 * twists(*p) - 0.5 * pairs(*(2 * a for a in p)) + 0.15
    yield "split P", lambda *p: (1.1 * twists(*p) - 0.2 * pairs(*(2 * a for a in p)) -
                                 0.4 * ones(*(2 * a for a in p)))
    yield "Fischer-Koch S", lambda x, y, z: (c(2 * x) * s(y) * c(z) + c(2 * y) * s(z) * c(x) +
                                             c(2 * z) * s(x) * c(y))
    yield "C(Y)", lambda x, y, z: (turns(x, y, z) + s(2 * x) * c(z) + s(2 * y) * c(x) +
                                   s(2 * z) * c(y) - s(x) * s(y) * s(z) - triple(x, y, z))
    yield "C(±Y)", lambda *p: turns(*p) - 2 * triple(*p)
    yield "Karcher K", lambda *p: (0.3 * ones(*p) + 0.3 * pairs(*p) -
                                   0.4 * ones(*(2 * a for a in p)) + 0.2)
    yield "G′", lambda *p: twists(*p) + 0.32
    yield "double gyroid", lambda *p: pairs(*(2 * a for a in p)) - 2.75 * twists(*p) + 0.95
    yield "double diamond", lambda x, y, z: (-0.5 * (s(x) * s(y) + s(y) * s(z) + s(z) * s(x)) -
                                             0.5 * triple(x, y, z))
    yield "double P", lambda *p: -0.5 * pairs(*p) - 0.2 * ones(*(2 * a for a in p))
    yield "honeycomb", lambda x, y, z: c(2 * y) + 2 * c(x) * c(y) + 0.5
    yield "rods", lambda x, y, z: 1 - c(x) - c(y)


def main(count):
    ratio = 1.2207440846057596
    step = np.array([ratio**-1, ratio**-2, ratio**-3])
    named, batch = list(functions()), 1 << 18
    held = np.zeros((len(named), 2))
    for first in range(0, count, batch):
        n = np.arange(first, min(first + batch, count))[:, None]
        angles = [Angle(a) for a in 2 * np.pi * np.modf(0.5 + n * step)[0].T]
        for i, (_, function) in enumerate(named):
            values = function(*angles)
            held[i] += (values <= 0).sum(), (np.abs(values) <= SHEET).sum()
    print(f"| | network, level 0 | sheet, level {SHEET} |\n|---|---|---|")
    for (name, _), (network, sheet) in zip(named, held / count):
        print(f"| {name} | {network:.4f} | {sheet:.4f} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 40_000_000)
