// SPDX-License-Identifier: Apache-2.0
// The growth of a node, in units of 2 pi, when a coordinate grows by 2 pi: 1 for the coordinate, a
// multiple of it for sums and for products with constants. It is 0 for sines and cosines of an
// operand that grows by a whole number, and for all nodes whose operands do not grow.
#include "expression/period.h"

#include <cmath>
#include <limits>

namespace msq {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// a + b and a b if they are exact.
double exact_sum(double a, double b) {
  const double s = a + b;
  return s - a == b && s - b == a ? s : unknown;
}
double exact_product(double a, double b) {
  const double p = a * b;
  return std::fma(a, b, -p) == 0 ? p : unknown;
}

double growth(const Tape& tape, const Node& node, const std::vector<double>& of) {
  const double a = of[node.a], b = has_two_operands(node.op) ? of[node.b] : 0;
  if (a == 0 && b == 0) return 0;
  switch (node.op) {
    case Op::add:
      return exact_sum(a, b);
    case Op::subtract:
      return exact_sum(a, -b);
    case Op::negate:
      return -a;
    case Op::multiply: {
      const Node &p = tape.nodes[node.a], &q = tape.nodes[node.b];
      if (p.op == Op::constant) return exact_product(p.value, b);
      if (q.op == Op::constant) return exact_product(q.value, a);
      return unknown;
    }
    case Op::sine:
    case Op::cosine:
      return a == std::round(a) ? 0 : unknown;
    default:
      return unknown;
  }
}

}  // namespace

std::vector<double> growths(const Tape& tape, int axis) {
  std::vector<double> of(tape.nodes.size());
  for (size_t i = 0; i < of.size(); ++i) {
    const Node& node = tape.nodes[i];
    of[i] = node.op < Op::add ? static_cast<int>(node.op) - static_cast<int>(Op::x) == axis
                              : growth(tape, node, of);
  }
  return of;
}

std::array<bool, 3> repeats(const Tape& tape) {
  std::array<bool, 3> all{};
  for (int axis = 0; axis < 3; ++axis)
    all[static_cast<size_t>(axis)] = growths(tape, axis).back() == 0;
  return all;
}

}  // namespace msq
