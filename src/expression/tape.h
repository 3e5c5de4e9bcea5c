// SPDX-License-Identifier: Apache-2.0
// A function of three coordinates, as a list of operations: what an expression means.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "base/vec.h"

namespace msq {

enum class Op : uint8_t {
  constant,
  x,  // the coordinates
  y,
  z,
  add,  // from here on of two operands
  subtract,
  multiply,
  divide,
  minimum,  // a where a < b, else b
  maximum,  // a where a > b, else b
  negate,   // from here on of one
  absolute,
  square_root,
  sine,
  cosine,
  exponential,
  logarithm,
};

constexpr bool has_one_operand(Op op) {
  return op >= Op::negate;
}
constexpr bool has_two_operands(Op op) {
  return op >= Op::add && op < Op::negate;
}

struct Node {
  Op op = Op::constant;
  uint32_t a = 0, b = 0;  ///< numbers of the operands, which come earlier
  double value = 0;       ///< of a constant
};

/// The last node is the value. Equal operations of equal operands are one node.
struct Tape {
  std::vector<Node> nodes;
};

constexpr uint32_t most_tape_nodes = 1024;

class TapeBuilder {
 public:
  uint32_t constant(double value);
  uint32_t coordinate(int axis) { return node(static_cast<Op>(int(Op::x) + axis), 0, 0); }
  /// An operation; of constants it is computed at once. One operand: b is 0.
  uint32_t apply(Op op, uint32_t a, uint32_t b = 0);

  const Node& operator[](uint32_t i) const { return nodes_[i]; }
  size_t size() const { return nodes_.size(); }
  /// The tape of a node, without what it does not need.
  Tape finish(uint32_t root) const;

 private:
  uint32_t node(Op op, uint32_t a, uint32_t b, uint64_t bits = 0, double value = 0);

  std::vector<Node> nodes_;
  std::map<std::tuple<Op, uint32_t, uint32_t, uint64_t>, uint32_t> known_;
};

/// What an operation gives: IEEE additions, products, quotients, roots and comparisons in double
/// precision, and sines, cosines, exponentials and logarithms made of those, so the same bits on
/// every machine (elementary-inl.h).
double apply(Op op, double a, double b);

/// The value at a position. This is the definition that all other evaluators agree with bit for
/// bit.
double evaluate(const Tape& tape, Vec3 position);

constexpr double two_pi = 6.283185307179586;

}  // namespace msq
