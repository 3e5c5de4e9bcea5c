# SPDX-License-Identifier: Apache-2.0
"""Nodes of the Implicit extension of 3MF that treat each component alone, as terms of formulas."""
from __future__ import annotations

import math
from typing import Callable, Dict, Tuple

from ._formula import Formula

Terms = Tuple[int, ...]
Form = Callable[[Formula, Terms], int]


def _sine_over_cosine(f: Formula, a: Terms) -> int:
    return f.divide(f.call("sin", a[0]), f.call("cos", a[0]))


def _leg(f: Formula, a: int) -> int:
    """The root of 1 - a a."""
    one = f.number(1.0)
    return f.call("sqrt", f.multiply(f.subtract(one, a), f.add(one, a)))


def _hyperbolic_cosine(f: Formula, a: Terms) -> int:
    both = f.add(f.call("exp", a[0]), f.call("exp", f.negate(a[0])))
    return f.divide(both, f.number(2.0))


def _round(f: Formula, a: Terms) -> int:
    """Halves go away from 0, as in C."""
    half = f.number(0.5)
    return f.select(f.less(a[0], f.number(0.0)),
                    f.negate(f.call("floor", f.subtract(half, a[0]))),
                    f.call("floor", f.add(a[0], half)))


def _sign(f: Formula, a: Terms) -> int:
    zero = f.number(0.0)
    return f.subtract(f.less(zero, a[0]), f.less(a[0], zero))


def _remainder(f: Formula, a: Terms) -> int:
    """Of the sign of the dividend."""
    rest = f.call("mod", f.call("abs", a[0]), f.call("abs", a[1]))
    return f.select(f.less(a[0], f.number(0.0)), f.negate(rest), rest)


def _power(f: Formula, a: Terms) -> int:
    """pow of C: bases below 0 have whole exponents."""
    base, exponent = a
    value = f.value(exponent)
    is_whole = math.isfinite(value) and value == math.floor(value)
    if is_whole and abs(value) <= 65536:
        return f.power(base, int(value))
    zero, one = f.number(0.0), f.number(1.0)

    def positive(of: int) -> int:
        return f.call("exp", f.multiply(exponent, f.call("log", of)))

    if math.isfinite(value) and not is_whole:
        return positive(base)  # the log of a base below 0 is NaN
    undefined = f.divide(zero, zero)
    odd = f.call("mod", exponent, f.number(2.0))
    flip = f.subtract(one, f.multiply(f.number(2.0), odd))
    whole = f.subtract(one, f.less(f.call("floor", exponent), exponent))
    below = f.select(whole, f.multiply(flip, positive(f.negate(base))), undefined)
    at_zero = f.select(f.less(zero, exponent), zero, f.divide(one, zero))
    some = f.select(f.less(zero, base), positive(base),
                    f.select(f.less(base, zero), below, at_zero))
    either = f.add(f.less(zero, exponent), f.less(exponent, zero))
    return f.select(either, some, one)


def _logarithm(base: float) -> Form:
    return lambda f, a: f.divide(f.call("log", a[0]), f.number(math.log(base)))


def _named(name: str) -> Form:
    return lambda f, a: f.call(name, *a)


# Nodes that treat each component alone: the names of the inputs, whether there may be matrices, and
# the term of a component.
_AB = ("A", "B")
COMPONENTWISE: Dict[str, Tuple[Tuple[str, ...], Form]] = {
    "addition": (_AB, lambda f, a: f.add(*a)),
    "subtraction": (_AB, lambda f, a: f.subtract(*a)),
    "multiplication": (_AB, lambda f, a: f.multiply(*a)),
    "division": (_AB, lambda f, a: f.divide(*a)),
    "sin": (("A",), _named("sin")),
    "cos": (("A",), _named("cos")),
    "tan": (("A",), _sine_over_cosine),
    "arcsin": (("A",), lambda f, a: f.call("atan2", a[0], _leg(f, a[0]))),
    "arccos": (("A",), lambda f, a: f.call("atan2", _leg(f, a[0]), a[0])),
    "arctan": (("A",), lambda f, a: f.call("atan2", a[0], f.number(1.0))),
    "arctan2": (_AB, _named("atan2")),
    "min": (_AB, lambda f, a: f.least(*a)),
    "max": (_AB, lambda f, a: f.greatest(*a)),
    "abs": (("A",), _named("abs")),
    "fmod": (_AB, _remainder),
    "mod": (_AB, _named("mod")),
    "pow": (_AB, _power),
    "sqrt": (("A",), _named("sqrt")),
    "exp": (("A",), _named("exp")),
    "log": (("A",), _named("log")),
    "log2": (("A",), _logarithm(2.0)),
    "log10": (("A",), _logarithm(10.0)),
    "select": (("A", "B", "C", "D"), lambda f, a: f.select(f.less(a[0], a[1]), a[2], a[3])),
    "clamp": (("A", "min", "max"), lambda f, a: f.greatest(a[1], f.least(a[0], a[2]))),
    "sinh": (("A",), lambda f, a: f.multiply(f.call("tanh", a[0]), _hyperbolic_cosine(f, a))),
    "cosh": (("A",), _hyperbolic_cosine),
    "tanh": (("A",), _named("tanh")),
    "round": (("A",), _round),
    "ceil": (("A",), _named("ceil")),
    "floor": (("A",), _named("floor")),
    "sign": (("A",), _sign),
    "fract": (("A",), lambda f, a: f.call("mod", a[0], f.number(1.0))),
}
