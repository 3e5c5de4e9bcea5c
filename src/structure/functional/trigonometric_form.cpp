// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/trigonometric_form.h"

#include <algorithm>
#include <cmath>

#include "expression/batch.h"

namespace msq {

namespace {

constexpr int max_frequency = 64;
constexpr double u = 0x1p-24;  // rounding in single precision, relative

bool is_coordinate(const Node& node) {
  return node.op >= Op::x && node.op <= Op::z;
}

/// The integer multiple of a coordinate that a node is, and the axis; 0: none.
int frequency_of(const Tape& tape, uint32_t i, int& axis) {
  const Node* node = &tape.nodes[i];
  double times = 1;
  if (node->op == Op::multiply) {
    const Node *a = &tape.nodes[node->a], *b = &tape.nodes[node->b];
    if (a->op != Op::constant) std::swap(a, b);
    if (a->op != Op::constant) return 0;
    times = a->value;
    node = b;
  }
  if (!is_coordinate(*node) || times != std::round(times) || std::abs(times) > max_frequency)
    return 0;
  axis = static_cast<int>(node->op) - static_cast<int>(Op::x);
  return static_cast<int>(times);
}

}  // namespace

std::optional<TrigonometricForm> TrigonometricForm::of(const Tape& tape) {
  TrigonometricForm form;
  form.tape_ = tape;
  const size_t count = tape.nodes.size();
  form.frequency_.resize(count);
  std::vector<uint32_t> inputs;  // pairs of nodes, either of which may be missing
  std::vector<bool> is_part(count);
  for (uint32_t i = 0; i < count; ++i) {
    const Node& node = tape.nodes[i];
    int axis = 0;
    if (node.op == Op::sine || node.op == Op::cosine)
      form.frequency_[i] = frequency_of(tape, node.a, axis);
    if (form.frequency_[i] != 0) {
      size_t wave = 0;
      while (wave < form.waves_.size() &&
             (form.waves_[wave].axis != axis || form.waves_[wave].frequency != form.frequency_[i]))
        ++wave;
      if (wave == form.waves_.size()) {
        form.waves_.push_back({axis, form.frequency_[i]});
        inputs.insert(inputs.end(), {UINT32_MAX, UINT32_MAX});
      }
      inputs[2 * wave + (node.op == Op::cosine)] = i;
      is_part[i] = true;
    } else if (node.op == Op::constant) {
      is_part[i] = std::abs(node.value) < 1e9;
    } else {
      is_part[i] =
          is_rational(node.op) && is_part[node.a] && (has_one_operand(node.op) || is_part[node.b]);
    }
  }
  if (!is_part[count - 1]) return std::nullopt;

  const Interval cell{0, two_pi};
  std::vector<Enclosure> nodes;
  enclose(tape, {cell, cell, cell}, nodes);
  for (const Enclosure& e : nodes) {
    if (!is_bounded(e)) return std::nullopt;  // it may be NaN
    form.most_.push_back(std::max(-e.low, e.high));
  }
  if (!(form.slack(0) < 1e-2)) return std::nullopt;

  form.values_ = compile(tape.nodes, inputs, {static_cast<uint32_t>(count - 1)});
  std::vector<int> parts(count, -1), frequencies;
  for (size_t i = 0; i < inputs.size(); ++i)
    if (inputs[i] != UINT32_MAX) parts[inputs[i]] = static_cast<int>(i);
  for (const Wave& wave : form.waves_) frequencies.push_back(wave.frequency);
  form.products_ = WaveProducts::of(tape, parts, frequencies);
  return form;
}

// The error of each node follows from those of its operands and its own rounding. A wave is s C + c
// S with four rounded factors, two products and a sum, and |s C| + |c S| is at most sqrt(2): less
// than 6 u in addition to the angles' error. The tape's own roundings in double precision are
// within the slack of the factor 1.01.
double TrigonometricForm::slack(double angle_error, double of_waves) const {
  std::vector<double> error(tape_.nodes.size());
  for (size_t i = 0; i < error.size(); ++i) {
    const Node& node = tape_.nodes[i];
    if (frequency_[i] != 0) {
      error[i] = of_waves + std::abs(frequency_[i]) * angle_error;
      continue;
    }
    if (node.op == Op::constant) {
      error[i] = u * std::abs(node.value);
      continue;
    }
    if (!is_rational(node.op)) continue;  // within a wave
    const double a = error[node.a], b = has_two_operands(node.op) ? error[node.b] : 0;
    const double p = most_[node.a] + a, q = has_two_operands(node.op) ? most_[node.b] + b : 0;
    switch (node.op) {
      case Op::add:
      case Op::subtract:
        error[i] = a + b + 1.01 * u * (p + q);
        break;
      case Op::multiply:
        error[i] = a * q + b * p + 1.01 * u * p * q;
        break;
      default:
        error[i] = std::max(a, b);
    }
  }
  return 1.01 * error.back() + 0x1p-100;
}

}  // namespace msq
