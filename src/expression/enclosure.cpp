// SPDX-License-Identifier: Apache-2.0
// Rounding is monotone. So the ends of a sum, a difference, a product, a quotient or a root,
// rounded as the evaluator rounds them, enclose its results without any slack. Sines, cosines,
// exponentials, logarithms, angles and hyperbolic tangents are not known to be monotone in the last
// bits: their ends move out by `slack`, which is more than twice their error (elementary-inl.h).
#include "expression/enclosure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/infinity.h"

namespace msq {

namespace {

constexpr double slack = 0x1p-48;
constexpr double max_angle = 0x1p19;
constexpr Enclosure unbounded{-infinity, infinity};

/// The sine of x + quarters pi / 2.
Enclosure sine(const Enclosure& x, double quarters) {
  Enclosure e{-1, 1};
  if (x.low >= -max_angle && x.high <= max_angle) {
    // Whether a maximum, or a minimum, of the sine lies between the ends; if in doubt, true.
    const auto holds = [&](double at) {
      const double first = std::ceil(x.low / two_pi + (quarters - at) / 4 - 1e-9);
      const double last = std::floor(x.high / two_pi + (quarters - at) / 4 + 1e-9);
      return first <= last;
    };
    const Op op = quarters == 0 ? Op::sine : Op::cosine;
    const double a = apply(op, x.low, 0), b = apply(op, x.high, 0);
    if (!holds(1)) e.high = std::max(a, b);
    if (!holds(3)) e.low = std::min(a, b);
  }
  return {e.low - slack, e.high + slack};
}

Enclosure product(const Enclosure& p, const Enclosure& q) {
  const double all[] = {p.low * q.low, p.low * q.high, p.high * q.low, p.high * q.high};
  return {*std::min_element(all, all + 4), *std::max_element(all, all + 4)};
}

Enclosure quotient(const Enclosure& p, const Enclosure& q) {
  if (q.low <= 0 && q.high >= 0) return unbounded;
  const double all[] = {p.low / q.low, p.low / q.high, p.high / q.low, p.high / q.high};
  return {*std::min_element(all, all + 4), *std::max_element(all, all + 4)};
}

Enclosure magnitude(const Enclosure& p) {
  const double a = std::abs(p.low), b = std::abs(p.high);
  return {p.low <= 0 && p.high >= 0 ? 0 : std::min(a, b), std::max(a, b)};
}

/// Of the angle of (x, y).
Enclosure angle(const Enclosure& y, const Enclosure& x) {
  constexpr double pi = two_pi / 2, wide = 0x1p-46;
  // The angle jumps from -pi to pi on the negative x axis, to which pi belongs. Elsewhere the ends
  // are at corners.
  if (x.low <= 0 && y.low < 0 && y.high >= 0) return {-pi - wide, pi + wide};
  const double all[] = {apply(Op::arctangent, y.low, x.low), apply(Op::arctangent, y.low, x.high),
                        apply(Op::arctangent, y.high, x.low),
                        apply(Op::arctangent, y.high, x.high)};
  return {*std::min_element(all, all + 4) - wide, *std::max_element(all, all + 4) + wide};
}

Enclosure hypotenuse(const Enclosure& p, const Enclosure& q) {
  const Enclosure a = magnitude(p), b = magnitude(q);
  return {apply(Op::hypotenuse, a.low, b.low) * (1 - slack),
          apply(Op::hypotenuse, a.high, b.high) * (1 + slack) + 0x1p-500};
}

/// -0 included.
Enclosure with_zero(const Enclosure& p) {
  return {std::min(p.low, 0.0), std::max(p.high, 0.0)};
}

Enclosure exponential(const Enclosure& p) {
  return {apply(Op::exponential, p.low, 0) * (1 - slack),
          apply(Op::exponential, p.high, 0) * (1 + slack) + std::numeric_limits<double>::min()};
}

Enclosure logarithm(const Enclosure& p) {
  if (!(p.low > 0)) return unbounded;
  const double a = apply(Op::logarithm, p.low, 0), b = apply(Op::logarithm, p.high, 0);
  return {a - slack * (1 + std::abs(a)), b + slack * (1 + std::abs(b))};
}

}  // namespace

Enclosure enclose_result(Op op, const Enclosure& p, const Enclosure& q, bool is_square) {
  switch (op) {
    case Op::add:
      return {p.low + q.low, p.high + q.high};
    case Op::subtract:
      return {p.low - q.high, p.high - q.low};
    case Op::multiply: {
      if (!is_square) return product(p, q);
      const Enclosure m = magnitude(p);
      return {m.low * m.low, m.high * m.high};
    }
    case Op::divide:
      return quotient(p, q);
    case Op::minimum:
      return {std::min(p.low, q.low), std::min(p.high, q.high)};
    case Op::maximum:
      return {std::max(p.low, q.low), std::max(p.high, q.high)};
    case Op::arctangent:
      return angle(p, q);
    case Op::hypotenuse:
      return hypotenuse(p, q);
    case Op::less:
      return {p.high < q.low ? 1.0 : 0.0, p.low < q.high ? 1.0 : 0.0};
    case Op::keep:
      return p.low > 0.5 ? q : p.high <= 0.5 ? Enclosure{0, 0} : with_zero(q);
    case Op::drop:
      return p.low > 0.5 ? Enclosure{0, 0} : p.high <= 0.5 ? q : with_zero(q);
    case Op::negate:
      return {-p.high, -p.low};
    case Op::absolute:
      return magnitude(p);
    case Op::square_root:
      return p.low >= 0 ? Enclosure{std::sqrt(p.low), std::sqrt(p.high)} : unbounded;
    case Op::sine:
      return sine(p, 0);
    case Op::cosine:
      return sine(p, 1);
    case Op::exponential:
      return exponential(p);
    case Op::logarithm:
      return logarithm(p);
    case Op::tangent_hyperbolic:
      return {apply(op, p.low, 0) - slack, apply(op, p.high, 0) + slack};
    case Op::floor:
      return {std::floor(p.low), std::floor(p.high)};
    default:
      return unbounded;
  }
}

void enclose(const Tape& tape, const Interval (&box)[3], std::vector<Enclosure>& nodes) {
  nodes.resize(tape.nodes.size());
  for (size_t i = 0; i < tape.nodes.size(); ++i) {
    const Node& node = tape.nodes[i];
    Enclosure e = unbounded;
    if (node.op == Op::constant) {
      e = {node.value, node.value};
    } else if (node.op < Op::add) {
      e = box[int(node.op) - int(Op::x)];
    } else {
      const Enclosure& p = nodes[node.a];
      const Enclosure& q = has_two_operands(node.op) ? nodes[node.b] : p;
      if (is_bounded(p) && is_bounded(q)) e = enclose_result(node.op, p, q, node.a == node.b);
    }
    nodes[i] = is_bounded(e) ? e : unbounded;  // NaN is not bounded either
  }
}

namespace {

bool is_minus_zero(const Node& node) {
  return node.op == Op::constant && node.value == 0 && std::signbit(node.value);
}

}  // namespace

Tape shortened(const Tape& tape, const std::vector<Enclosure>& nodes) {
  TapeBuilder builder;
  std::vector<uint32_t> number(tape.nodes.size());
  for (size_t i = 0; i < tape.nodes.size(); ++i) {
    const Node& node = tape.nodes[i];
    if (node.op == Op::constant) {
      number[i] = builder.constant(node.value);
      continue;
    }
    if (node.op < Op::add) {
      number[i] = builder.coordinate(int(node.op) - int(Op::x));
      continue;
    }
    const uint32_t a = number[node.a], b = has_two_operands(node.op) ? number[node.b] : 0;
    const Enclosure& p = nodes[node.a];
    const Enclosure& q = nodes[has_two_operands(node.op) ? node.b : node.a];
    const bool is_known = is_bounded(p) && is_bounded(q);
    if (is_known && node.op == Op::minimum && p.high < q.low)
      number[i] = a;
    else if (is_known && node.op == Op::minimum && q.high < p.low)
      number[i] = b;
    else if (is_known && node.op == Op::maximum && p.low > q.high)
      number[i] = a;
    else if (is_known && node.op == Op::maximum && p.high < q.low)
      number[i] = b;
    else if (is_known && node.op == Op::absolute && p.low > 0)
      number[i] = a;
    else if (is_known && node.op == Op::less && (p.high < q.low || p.low >= q.high))
      number[i] = builder.constant(p.high < q.low ? 1 : 0);
    else if (is_known && node.op == Op::floor && std::floor(p.low) == std::floor(p.high))
      number[i] = builder.constant(std::floor(p.low) + 0.0);
    else if (is_bounded(p) && (node.op == Op::keep || node.op == Op::drop) &&
             (p.low > 0.5 || p.high <= 0.5))
      number[i] = (p.low > 0.5) == (node.op == Op::keep) ? b : builder.constant(-0.0);
    else if (node.op == Op::add && is_minus_zero(builder[a]))
      number[i] = b;
    else if (node.op == Op::add && is_minus_zero(builder[b]))
      number[i] = a;
    else
      number[i] = builder.apply(node.op, a, b);
  }
  return builder.finish(number.back());
}

}  // namespace msq
