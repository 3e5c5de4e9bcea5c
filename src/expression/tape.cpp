// SPDX-License-Identifier: Apache-2.0
#include "expression/tape.h"

#include <algorithm>
#include <cstring>

namespace msq {

uint32_t TapeBuilder::node(Op op, uint32_t a, uint32_t b, uint64_t bits, double value) {
  const auto [found, is_new] =
      known_.try_emplace({op, a, b, bits}, static_cast<uint32_t>(nodes_.size()));
  if (is_new) nodes_.push_back({op, a, b, value});
  return found->second;
}

uint32_t TapeBuilder::constant(double value) {
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return node(Op::constant, 0, 0, bits, value);
}

uint32_t TapeBuilder::apply(Op op, uint32_t a, uint32_t b) {
  const bool is_constant =
      nodes_[a].op == Op::constant && (has_one_operand(op) || nodes_[b].op == Op::constant);
  if (is_constant) return constant(msq::apply(op, nodes_[a].value, nodes_[b].value));
  if (is_symmetric(op) && b < a) std::swap(a, b);
  return node(op, a, has_one_operand(op) ? 0 : b);
}

Tape TapeBuilder::finish(uint32_t root) const {
  std::vector<bool> is_needed(nodes_.size());
  is_needed[root] = true;
  for (uint32_t i = root + 1; i-- > 0;) {
    if (!is_needed[i]) continue;
    if (nodes_[i].op >= Op::add) is_needed[nodes_[i].a] = true;
    if (has_two_operands(nodes_[i].op)) is_needed[nodes_[i].b] = true;
  }
  Tape tape;
  std::vector<uint32_t> number(nodes_.size());
  for (uint32_t i = 0; i <= root; ++i) {
    if (!is_needed[i]) continue;
    number[i] = static_cast<uint32_t>(tape.nodes.size());
    Node node = nodes_[i];
    if (node.op >= Op::add) node.a = number[node.a];
    if (has_two_operands(node.op)) node.b = number[node.b];
    tape.nodes.push_back(node);
  }
  return tape;
}

namespace {

/// Names that outlive a new order of the operations.
const char* name_of(Op op) {
  switch (op) {
    case Op::constant:
      return "constant";
    case Op::x:
      return "x";
    case Op::y:
      return "y";
    case Op::z:
      return "z";
    case Op::add:
      return "+";
    case Op::subtract:
      return "-";
    case Op::multiply:
      return "*";
    case Op::divide:
      return "/";
    case Op::minimum:
      return "min";
    case Op::maximum:
      return "max";
    case Op::arctangent:
      return "atan2";
    case Op::hypotenuse:
      return "hypot";
    case Op::less:
      return "<";
    case Op::keep:
      return "keep";
    case Op::drop:
      return "drop";
    case Op::negate:
      return "negate";
    case Op::absolute:
      return "abs";
    case Op::square_root:
      return "sqrt";
    case Op::sine:
      return "sin";
    case Op::cosine:
      return "cos";
    case Op::exponential:
      return "exp";
    case Op::logarithm:
      return "log";
    case Op::tangent_hyperbolic:
      return "tanh";
    case Op::floor:
      return "floor";
  }
  return "";
}

}  // namespace

void Tape::describe(HashInput& input) const {
  input.integer(nodes.size());
  for (const Node& node : nodes) {
    input.text(name_of(node.op));
    if (node.op == Op::constant) input.exact_number(node.value);
    if (node.op >= Op::add) input.integer(node.a);
    if (has_two_operands(node.op)) input.integer(node.b);
  }
}

bool Tape::is_continuous() const {
  return std::all_of(nodes.begin(), nodes.end(),
                     [](const Node& node) { return msq::is_continuous(node.op); });
}

}  // namespace msq
