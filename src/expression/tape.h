// SPDX-License-Identifier: Apache-2.0
// A function of three coordinates as a list of operations. This file defines the meaning of
// expressions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "base/hash_input.h"
#include "base/pi.h"
#include "base/vec.h"

namespace msq {

enum class Op : uint8_t {
  constant,
  x,  // the coordinates
  y,
  z,
  add,  // from here on with two operands
  subtract,
  multiply,
  divide,
  minimum,     // of IEEE 754-2019: NaN if either operand is NaN; -0 is below 0
  maximum,     // likewise
  arctangent,  // the angle of the point (b, a), of atan2(a, b): above -pi to pi; 0 for the origin
  hypotenuse,  // the root of a a + b b
  less,        // 1 if a is below b, otherwise 0
  keep,        // b if a is above 1/2, otherwise -0: adding -0 changes no number
  drop,        // -0 if a is above 1/2, otherwise b
  negate,      // from here on with one operand
  absolute,
  square_root,
  sine,
  cosine,
  exponential,
  logarithm,
  tangent_hyperbolic,
  floor,
};
constexpr Op last_op = Op::floor;

constexpr bool has_one_operand(Op op) {
  return op >= Op::negate;
}
constexpr bool has_two_operands(Op op) {
  return op >= Op::add && op < Op::negate;
}
/// Whether the operation gives the same bits with its operands swapped, if they are not NaN.
constexpr bool is_symmetric(Op op) {
  return op == Op::add || op == Op::multiply || op == Op::minimum || op == Op::maximum;
}

/// Whether bounds of the operands may decide which operand, or which number, is the result.
constexpr bool is_choice(Op op) {
  return op == Op::minimum || op == Op::maximum || op == Op::absolute || op == Op::less ||
         op == Op::keep || op == Op::drop || op == Op::floor;
}

/// Whether the result is defined for all operands, and small changes of them change it by little.
constexpr bool is_continuous(Op op) {
  return op <= Op::multiply || op == Op::minimum || op == Op::maximum || op == Op::hypotenuse ||
         op == Op::negate || op == Op::absolute || op == Op::sine || op == Op::cosine ||
         op == Op::exponential || op == Op::tangent_hyperbolic;
}

struct Node {
  Op op = Op::constant;
  uint32_t a = 0, b = 0;  ///< numbers of the operands, which come earlier
  double value = 0;       ///< of a constant
};

/// The last node is the value. Equal operations on equal operands are one node.
struct Tape {
  std::vector<Node> nodes;

  /// The operations by name. Constants have their sign: 1 / -0 is not 1 / 0.
  void describe(HashInput& input) const;
  /// Whether no operation has jumps, poles or operands without a result.
  bool is_continuous() const;
};

constexpr uint32_t max_tape_nodes = 8192;

class TapeBuilder {
 public:
  uint32_t constant(double value);
  uint32_t coordinate(int axis) { return node(static_cast<Op>(int(Op::x) + axis), 0, 0); }
  /// Adds an operation; an operation on constants is computed at once. With one operand, b is 0.
  uint32_t apply(Op op, uint32_t a, uint32_t b = 0);

  const Node& operator[](uint32_t i) const { return nodes_[i]; }
  size_t size() const { return nodes_.size(); }
  /// The tape of a node, without the nodes that it does not need.
  Tape finish(uint32_t root) const;

 private:
  uint32_t node(Op op, uint32_t a, uint32_t b, uint64_t bits = 0, double value = 0);

  std::vector<Node> nodes_;
  std::map<std::tuple<Op, uint32_t, uint32_t, uint64_t>, uint32_t> known_;
};

/// The result of an operation: IEEE additions, products, quotients, roots and comparisons in double
/// precision, and sines, cosines, exponentials, logarithms, angles and hyperbolic tangents built
/// from those. NaN if an operand is NaN, except of the operand that keep or drop leaves out. So the
/// bits are the same on every machine (elementary-inl.h).
double apply(Op op, double a, double b);

/// The value at a position. This is the definition. All other evaluators agree with it bit for bit.
double evaluate(const Tape& tape, Vec3 position);

}  // namespace msq
