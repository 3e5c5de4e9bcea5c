# SPDX-License-Identifier: Apache-2.0
"""Terms of an expression of msq, and its text."""
from __future__ import annotations

import heapq
import math
from typing import Dict, List, Tuple, Union

from .errors import LimitError

TURN = 2 * math.pi
MOST_BYTES = 65536  # of msq_structure_functional, as the next two
MOST_NESTED = 100
MOST_PARAMETERS = 1024
MOST_TERMS = 200_000

Affine = Tuple[float, float, float, float]  #: factors of x, y and z, and a number
_Key = Tuple[str, Tuple[int, ...], Tuple[float, ...]]
_Piece = Union[str, Tuple[int, int]]

_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
_OTHERS = _LETTERS + _LETTERS.lower() + "0123456789"

_EXTREMES = ("min", "max")
# What a term is where it stands: of a lower rank than its place asks for, it gets parentheses.
_WHOLE, _SUM, _PRODUCT, _SIGNED, _PRIMARY = range(5)


class Formula:
    """Terms in three angles x, y, z of 0 to 2 pi. Equal terms are one, and named by a number.

    Terms that are affine in the angles stay so: rotations and shifts one after another are one. Of
    each term, low and high bound the value, and `defined` says that it is never NaN.
    """

    def __init__(self) -> None:
        self._known: Dict[_Key, int] = {}
        self._keys: List[_Key] = []
        self.low: List[float] = []
        self.high: List[float] = []
        self.defined: List[bool] = []

    # Terms

    def _term(self, kind: str, of: Tuple[int, ...], values: Tuple[float, ...], low: float,
              high: float, defined: bool) -> int:
        key = (kind, of, tuple(0.0 if value == 0 else value for value in values))  # no -0
        found = self._known.get(key)
        if found is not None:
            return found
        if len(self._keys) >= MOST_TERMS:
            raise LimitError(f"the graph has more than {MOST_TERMS} operations")
        if not defined or math.isnan(low) or math.isnan(high):
            low, high = -math.inf, math.inf
        self._known[key] = len(self._keys)
        self._keys.append(key)
        self.low.append(low)
        self.high.append(high)
        self.defined.append(defined)
        return len(self._keys) - 1

    def affine(self, values: Affine) -> int:
        """A sum of multiples of the angles and a number, all finite."""
        spans = [factor * TURN for factor in values[:3]]
        low = values[3] + sum(min(0.0, span) for span in spans)
        high = values[3] + sum(max(0.0, span) for span in spans)
        return self._term("affine", (), tuple(values), low, high, True)

    def number(self, value: float) -> int:
        """A finite number."""
        return self.affine((0.0, 0.0, 0.0, value))

    def _affine(self, term: int) -> Tuple[float, ...]:
        kind, _, values = self._keys[term]
        return values if kind == "affine" else ()

    def value(self, term: int) -> float:
        """The value of a number; NaN of other terms."""
        values = self._affine(term)
        return values[3] if values and not any(values[:3]) else math.nan

    def _bounded(self, term: int) -> bool:
        return self.defined[term] and self.low[term] > -math.inf and self.high[term] < math.inf

    def _folded(self, values: List[float]) -> int:
        """An affine term, or -1 if its numbers overflow."""
        if not all(map(math.isfinite, values)):
            return -1
        return self.affine((values[0], values[1], values[2], values[3]))

    def add(self, a: int, b: int) -> int:
        """a + b"""
        if self._affine(a) and self._affine(b):
            folded = self._folded([p + q for p, q in zip(self._affine(a), self._affine(b))])
            if folded >= 0:
                return folded
        if self.value(a) == 0:
            return b
        if self.value(b) == 0:
            return a
        return self._term("+", (a, b), (), self.low[a] + self.low[b], self.high[a] + self.high[b],
                          self.defined[a] and self.defined[b]
                          and (self._bounded(a) or self._bounded(b)))

    def subtract(self, a: int, b: int) -> int:
        """a - b"""
        if self._affine(a) and self._affine(b):
            folded = self._folded([p - q for p, q in zip(self._affine(a), self._affine(b))])
            if folded >= 0:
                return folded
        if self.value(b) == 0:
            return a
        if self.value(a) == 0:
            return self.negate(b)
        return self._term("-", (a, b), (), self.low[a] - self.high[b], self.high[a] - self.low[b],
                          self.defined[a] and self.defined[b]
                          and (self._bounded(a) or self._bounded(b)))

    def negate(self, a: int) -> int:
        """-a"""
        if self._affine(a):
            return self._folded([-value for value in self._affine(a)])
        kind, of, _ = self._keys[a]
        if kind == "negate":
            return of[0]
        return self._term("negate", (a,), (), -self.high[a], -self.low[a], self.defined[a])

    def multiply(self, a: int, b: int) -> int:
        """a b"""
        for factor, other in ((a, b), (b, a)):
            value = self.value(factor)
            if math.isnan(value):
                continue
            if self._affine(other):
                folded = self._folded([value * one for one in self._affine(other)])
                if folded >= 0:
                    return folded
            if value == 1:
                return other
            if value == 0 and self._bounded(other):
                return factor
        if a == b:
            return self.power(a, 2)
        defined = self._bounded(a) and self._bounded(b)
        low = high = math.nan
        if defined:
            corners = [p * q for p in (self.low[a], self.high[a])
                       for q in (self.low[b], self.high[b])]
            low, high = min(corners), max(corners)
        return self._term("*", (a, b), (), low, high, defined)

    def divide(self, a: int, b: int) -> int:
        """a / b"""
        value = self.value(b)
        if value and self._affine(a):
            folded = self._folded([one / value for one in self._affine(a)])
            if folded >= 0:
                return folded
        if value == 1:
            return a
        apart = self._bounded(b) and (self.low[b] > 0 or self.high[b] < 0)
        defined = apart and self._bounded(a)
        low = high = math.nan
        if defined:
            corners = [p / q for p in (self.low[a], self.high[a])
                       for q in (self.low[b], self.high[b])]
            low, high = min(corners), max(corners)
        return self._term("/", (a, b), (), low, high, defined)

    def power(self, a: int, exponent: int) -> int:
        """a to a whole exponent, as a product or 1 over one."""
        if exponent == 0:
            return self.number(1.0)
        if exponent == 1:
            return a
        low, high = -math.inf, math.inf
        if exponent > 0 and self._bounded(a):
            try:
                ends = sorted((self.low[a] ** exponent, self.high[a] ** exponent))
            except OverflowError:
                ends = [-math.inf, math.inf]
            low, high = ends
            if self.low[a] <= 0 <= self.high[a]:
                low = min(low, 0.0)
        if exponent % 2 == 0:
            low = max(low, 0.0)
        return self._term("^", (a,), (float(exponent),), low, high, self.defined[a])

    def least(self, a: int, b: int) -> int:
        """The smaller one. The text of one of many terms nests little."""
        return self._extreme("min", a, b)

    def greatest(self, a: int, b: int) -> int:
        """The greater one."""
        return self._extreme("max", a, b)

    def _extreme(self, kind: str, a: int, b: int) -> int:
        if a == b:
            return a
        choose = min if kind == "min" else max
        return self._term(kind, (a, b), (), choose(self.low[a], self.low[b]),
                          choose(self.high[a], self.high[b]), self.defined[a] and self.defined[b])

    def less(self, a: int, b: int) -> int:
        """1 where a < b, otherwise 0."""
        return self._term("<", (a, b), (), 0.0, 1.0, self.defined[a] and self.defined[b])

    def select(self, condition: int, a: int, b: int) -> int:
        """a where the condition is 1, b where it is 0."""
        if a == b and self.defined[condition]:
            return a
        return self._term("select", (condition, a, b), (), min(self.low[a], self.low[b]),
                          max(self.high[a], self.high[b]),
                          self.defined[condition] and self.defined[a] and self.defined[b])

    def call(self, name: str, *of: int) -> int:
        """A function of the grammar: abs, sqrt, sin, cos, exp, log, tanh, floor, ceil, atan2, mod."""
        a = of[0]
        low, high, defined = -math.inf, math.inf, self.defined[a]
        if name == "abs":
            if self.low[a] >= 0:
                return a
            if self.value(a) < 0:
                return self.negate(a)
            low = max(self.low[a], -self.high[a], 0.0)
            high = max(-self.low[a], self.high[a])
        elif name == "sqrt":
            defined = defined and self.low[a] >= 0
            low, high = 0.0, math.sqrt(max(self.high[a], 0.0))
        elif name in ("sin", "cos"):
            defined, low, high = self._bounded(a), -1.0, 1.0
        elif name == "exp":
            low = 0.0
            high = math.exp(self.high[a]) if self.high[a] < 700 else math.inf
        elif name == "log":
            defined = defined and self.low[a] >= 0
        elif name == "tanh":
            low, high = -1.0, 1.0
        elif name in ("floor", "ceil"):
            low, high = self.low[a] - 1, self.high[a] + 1
        elif name == "atan2":
            defined, low, high = defined and self.defined[of[1]], -math.pi, math.pi
        elif name == "mod":
            b = of[1]
            defined = (self._bounded(a) and self._bounded(b)
                       and (self.low[b] > 0 or self.high[b] < 0))
            low, high = min(self.low[b], 0.0), max(self.high[b], 0.0)
        return self._term(name, of, (), low, high, defined)

    # Text

    def text(self, root: int) -> Tuple[str, Dict[str, float]]:
        """The expression of a term, and the values of its parameters."""
        needed = self._needed(root)
        self._check(root, needed)
        names: Dict[float, str] = {}
        written: List[str] = []
        length = 0
        waiting: List[_Piece] = [(root, _WHOLE)]
        while waiting:
            piece = waiting.pop()
            if isinstance(piece, str):
                written.append(piece)
                length += len(piece)
                if length > MOST_BYTES:
                    raise LimitError(_too_long(length))
            else:
                rank, pieces = self._pieces(piece[0], names)
                if rank < piece[1]:
                    pieces = ["(", *pieces, ")"]
                waiting.extend(reversed(pieces))
        return "".join(written), {name: value for value, name in names.items()}

    def _needed(self, root: int) -> List[int]:
        """The terms that a term is made of, ascending: none needs a later one."""
        seen = {root}
        waiting = [root]
        while waiting:
            for term in self._keys[waiting.pop()][1]:
                if term not in seen:
                    seen.add(term)
                    waiting.append(term)
        return sorted(seen)

    def _check(self, root: int, needed: List[int]) -> None:
        """Refuses what is too long or nested too deeply, before anything of it is written."""
        size: Dict[int, int] = {}
        depth: Dict[int, int] = {}
        extremes: Dict[int, Tuple[int, int]] = {}  # of terms of min and max: terms, deepest of them
        for term in needed:
            kind, of, _ = self._keys[term]
            total, deepest = 0, 1
            if kind in _EXTREMES:
                both = [extremes[one] if self._keys[one][0] == kind else (1, depth[one])
                        for one in of]
                count = min(sum(one[0] for one in both), 1 << 62)
                deepest = max(one[1] for one in both)
                extremes[term] = count, deepest
                total = sum(size[one] for one in of) + len("min(,)")
                deepest += math.ceil(math.log2(count))
            else:
                for piece in self._pieces(term, None)[1]:
                    if isinstance(piece, str):
                        total += len(piece)
                    else:
                        inner = self._rank(piece[0]) < piece[1]
                        total += size[piece[0]] + 2 * inner
                        deepest = max(deepest, depth[piece[0]] + inner)
                if kind == "negate" or (self._rank(term) == _PRIMARY and of):
                    deepest += 1
                elif kind in ("^", "affine"):
                    deepest = max(deepest, 2)  # the exponent, or a sign
            size[term], depth[term] = min(total, 1 << 62), deepest
        if size[root] > MOST_BYTES:
            raise LimitError(_too_long(size[root]))
        if depth[root] > MOST_NESTED:
            raise LimitError(f"its expression nests {depth[root]} deep; the limit is {MOST_NESTED}")

    def _leaves(self, term: int) -> List[int]:
        """The terms of which a minimum of minima is the least; likewise maxima."""
        kind = self._keys[term][0]
        found: Dict[int, None] = {}
        waiting = [term]
        while waiting:
            one = waiting.pop()
            if self._keys[one][0] == kind:
                waiting.extend(reversed(self._keys[one][1]))
            else:
                found[one] = None
        return list(found)

    def _rank(self, term: int) -> int:
        kind, _, values = self._keys[term]
        if kind == "affine":
            factors = [value for value in values if value]
            if len(factors) > 1:
                return _SUM
            if factors and not values[3] and factors[0] != 1:
                return _PRODUCT if factors[0] != -1 else _SIGNED
            return _SIGNED if values[3] < 0 else _PRIMARY
        return {"+": _SUM, "-": _SUM, "*": _PRODUCT, "/": _PRODUCT, "negate": _SIGNED,
                "^": _SIGNED, "<": _WHOLE}.get(kind, _PRIMARY)

    def _pieces(self, term: int, names: Union[Dict[float, str], None]
                ) -> Tuple[int, List[_Piece]]:
        """How a term is written: texts, and terms with the ranks of their places."""
        kind, of, values = self._keys[term]
        rank = self._rank(term)
        if kind == "affine":
            return rank, [_sum_of(values, names)]
        if kind in ("+", "-"):
            return rank, [(of[0], _SUM), kind, (of[1], _PRODUCT)]
        if kind in ("*", "/"):
            return rank, [(of[0], _PRODUCT), kind, (of[1], _SIGNED)]
        if kind == "<":
            return rank, [(of[0], _SUM), "<", (of[1], _SUM)]
        if kind == "negate":
            return rank, ["-", (of[0], _SIGNED)]
        if kind == "^":
            return rank, [(of[0], _PRIMARY), f"^{int(values[0])}"]
        if kind in _EXTREMES:
            return rank, _balanced(kind, self._leaves(term))
        pieces: List[_Piece] = [kind + "("]
        for number, one in enumerate(of):
            pieces.extend(([","] if number else []) + [(one, _WHOLE)])
        return rank, [*pieces, ")"]


def _balanced(name: str, of: List[int]) -> List[_Piece]:
    """A minimum of many terms as minima of two, nested little."""
    parts: List[Tuple[int, int, List[_Piece]]] = [(0, i, [(one, _WHOLE)])
                                                  for i, one in enumerate(of)]
    heapq.heapify(parts)
    count = len(parts)
    while len(parts) > 1:
        first, second = heapq.heappop(parts), heapq.heappop(parts)
        count += 1
        heapq.heappush(parts, (max(first[0], second[0]) + 1, count,
                               [name + "(", *first[2], ",", *second[2], ")"]))
    return parts[0][2]


def _sum_of(values: Tuple[float, ...], names: Union[Dict[float, str], None]) -> str:
    text = ""
    for factor, axis in zip(values, "xyz"):
        if not factor:
            continue
        if abs(factor) == 1:
            text += ("-" if factor < 0 else "+" if text else "") + axis
        else:
            text += ("+" if text else "") + _number(factor, names) + "*" + axis
    if values[3] or not text:
        shown = _number(values[3], names)
        text += ("+" if text and not shown.startswith("-") else "") + shown
    return text


def _number(value: float, names: Union[Dict[float, str], None]) -> str:
    """A number, or the name of a parameter that has its value, where that is shorter."""
    shown = repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
    if len(shown) <= 2:
        return shown
    if names is None:
        return "AA"  # as long as a name
    if value not in names:
        if len(names) == MOST_PARAMETERS:
            return shown
        names[value] = _name(len(names))
    return names[value]


def _name(number: int) -> str:
    if number < len(_LETTERS):
        return _LETTERS[number]
    first, second = divmod(number - len(_LETTERS), len(_OTHERS))
    return _LETTERS[first] + _OTHERS[second]


def _too_long(size: int) -> str:
    return (f"its expression has {size} characters or more, as terms that several nodes share are "
            f"written out; the limit is {MOST_BYTES}")
