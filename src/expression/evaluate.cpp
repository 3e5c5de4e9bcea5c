// SPDX-License-Identifier: Apache-2.0
// The scalar evaluator.
#include <hwy/highway.h>

#include "base/borrowed.h"
#include "expression/elementary-inl.h"
#include "expression/tape.h"

// What inlines a function of a target must be compiled for that target: on aarch64 the baseline is
// not NEON as Highway means it.
HWY_BEFORE_NAMESPACE();
namespace msq {

double apply(Op op, double a, double b) {
  double v = 0;
  HWY_NAMESPACE::with_op(op, [&](auto which) HWY_ATTR {
    v = HWY_NAMESPACE::result<decltype(which)::value>(HWY_NAMESPACE::Single(), a, b);
  });
  return v;
}

}  // namespace msq
HWY_AFTER_NAMESPACE();

namespace msq {

namespace {

/// `values`: room for one per node.
double evaluate_into(double* values, const Tape& tape, Vec3 position) {
  const size_t count = tape.nodes.size();
  for (size_t i = 0; i < count; ++i) {
    const Node& node = tape.nodes[i];
    switch (node.op) {
      case Op::constant:
        values[i] = node.value;
        break;
      case Op::x:
        values[i] = position.x;
        break;
      case Op::y:
        values[i] = position.y;
        break;
      case Op::z:
        values[i] = position.z;
        break;
      default:
        values[i] = apply(node.op, values[node.a], values[node.b]);
    }
  }
  return values[count - 1];
}

}  // namespace

double evaluate(const Tape& tape, Vec3 position) {
  constexpr size_t few = 1024;
  if (tape.nodes.size() > few) {
    const Borrowed<std::vector<double>> values;
    values->resize(tape.nodes.size());
    return evaluate_into(values->data(), tape, position);
  }
  double values[few];
  return evaluate_into(values, tape, position);
}

}  // namespace msq
