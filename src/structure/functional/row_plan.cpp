// SPDX-License-Identifier: Apache-2.0
// The error of the linear form, u = 2^-24 and v = 2^-53. Both the tape and the linear form start
// from a sum of products of tables and row values. Let M bound the sum of their magnitudes
// (`most`). The tape, and the coefficients in double precision, compute that sum with at most as
// many roundings along any product as there are operations. So each is within n v M of it, if n
// counts all operations and more. In single precision, coefficient, table entry and product are
// rounded once each, and the sum of t products and the constant at most t times. So that is within
// (t + 3) u M of the sum of the rounded coefficients times the tables. Factors of 5/4 cover the
// squares of u and v; products that underflow are below 2^-120 together.
#include "structure/functional/row_plan.h"

#include <cmath>
#include <map>
#include <optional>

#include "expression/enclosure.h"

namespace msq {

namespace {

constexpr size_t max_terms = 16;

/// A sum of coefficients times tables, plus a constant; coefficients and constant are nodes that
/// depend on the row alone.
struct LinearForm {
  std::map<uint32_t, uint32_t> coefficients;  // by table
  uint32_t constant;
  double most;  // of the sum of the magnitudes of all products
};

class Splitter {
 public:
  Splitter(const Tape& tape, const std::array<int, 3>& sample_axis) : count_(tape.nodes.size()) {
    const Interval cell{0, two_pi};
    enclose(tape, {cell, cell, cell}, enclosures_);
    std::vector<uint32_t> number(count_);
    for (size_t i = 0; i < count_; ++i) {
      const Node& node = tape.nodes[i];
      if (node.op == Op::constant) {
        number[i] = builder_.constant(node.value);
      } else if (node.op < Op::add) {
        const int axis = static_cast<int>(node.op) - static_cast<int>(Op::x);
        number[i] = builder_.coordinate(axis);
        coordinates_[static_cast<size_t>(axis)] = number[i];
      } else {
        number[i] =
            builder_.apply(node.op, number[node.a], has_two_operands(node.op) ? number[node.b] : 0);
      }
    }
    // A tape's nodes are distinct already, so they keep their numbers.
    for (size_t i = 0; i < builder_.size(); ++i) {
      const Node& node = builder_[static_cast<uint32_t>(i)];
      unsigned axes = 0;
      if (node.op >= Op::add) {
        axes = axes_[node.a] | (has_two_operands(node.op) ? axes_[node.b] : 0);
      } else if (node.op != Op::constant) {
        axes = 1u << sample_axis[static_cast<size_t>(node.op) - static_cast<size_t>(Op::x)];
      }
      axes_.push_back(axes);
    }
  }

  bool is_of_row(uint32_t i) const { return (axes_[i] & 1) == 0; }
  bool is_of_table(uint32_t i) const { return axes_[i] == 1; }
  uint32_t root() const { return static_cast<uint32_t>(count_ - 1); }
  const Node& node(uint32_t i) const { return builder_[i]; }
  size_t size() const { return builder_.size(); }
  uint32_t zero() { return builder_.constant(0); }

  /// Deeper tapes have none, so that stacks hold.
  std::optional<LinearForm> linear(uint32_t i, int depth = 0) {
    constexpr int max_depth = 512;
    if (depth > max_depth) return std::nullopt;
    if (is_of_row(i)) return LinearForm{{}, i, most(i)};
    if (is_of_table(i)) return LinearForm{{{i, builder_.constant(1)}}, zero(), most(i)};
    const Node node = builder_[i];
    switch (node.op) {
      case Op::add:
      case Op::subtract: {
        std::optional<LinearForm> a = linear(node.a, depth + 1), b = linear(node.b, depth + 1);
        if (!a || !b) return std::nullopt;
        for (const auto& [table, coefficient] : b->coefficients) {
          const auto found = a->coefficients.try_emplace(table, zero()).first;
          found->second = builder_.apply(node.op, found->second, coefficient);
        }
        a->constant = builder_.apply(node.op, a->constant, b->constant);
        a->most += b->most;
        return checked(a);
      }
      case Op::negate:
        return scaled(linear(node.a, depth + 1), builder_.constant(-1), 1);
      case Op::multiply:
        if (is_of_row(node.b)) return scaled(linear(node.a, depth + 1), node.b, most(node.b));
        if (is_of_row(node.a)) return scaled(linear(node.b, depth + 1), node.a, most(node.a));
        return std::nullopt;
      default:
        return std::nullopt;
    }
  }

  using WaveTable = RowPlan::WaveTable;

  std::optional<std::vector<WaveTable>> wave(const std::vector<uint32_t>& tables) const {
    std::vector<WaveTable> found;
    for (const uint32_t table : tables) {
      const std::optional<WaveTable> one = wave_table(table);
      if (!one) return std::nullopt;
      found.push_back(*one);
    }
    return found;
  }

  Program compile(const std::vector<uint32_t>& inputs, const std::vector<uint32_t>& outputs) const {
    std::vector<Node> nodes;
    for (uint32_t i = 0; i < builder_.size(); ++i) nodes.push_back(builder_[i]);
    return msq::compile(nodes, inputs, outputs);
  }
  Program compile(const std::vector<uint32_t>& outputs) const {
    return compile({coordinates_.begin(), coordinates_.end()}, outputs);
  }

 private:
  std::optional<WaveTable> wave_table(uint32_t i) const {
    double factor = 1;
    for (;;) {
      const Node& node = builder_[i];
      const auto is_constant = [&](uint32_t n) { return builder_[n].op == Op::constant; };
      if (node.op == Op::sine || node.op == Op::cosine) {
        const Op angle = builder_[node.a].op;
        if (angle != Op::x && angle != Op::y && angle != Op::z) return std::nullopt;
        return WaveTable{node.op == Op::sine, factor};
      }
      if (node.op == Op::negate) {
        factor = -factor;
        i = node.a;
      } else if (node.op == Op::multiply && is_constant(node.a)) {
        factor *= builder_[node.a].value;
        i = node.b;
      } else if (node.op == Op::multiply && is_constant(node.b)) {
        factor *= builder_[node.b].value;
        i = node.a;
      } else {
        return std::nullopt;
      }
    }
  }
  double most(uint32_t i) const {
    const Enclosure& e = enclosures_[i];
    return std::max(std::abs(e.low), std::abs(e.high));
  }
  static std::optional<LinearForm> checked(std::optional<LinearForm> form) {
    if (form && form->coefficients.size() > max_terms) return std::nullopt;
    return form;
  }
  std::optional<LinearForm> scaled(std::optional<LinearForm> form, uint32_t factor, double most) {
    if (!form) return form;
    for (auto& [table, coefficient] : form->coefficients)
      coefficient = builder_.apply(Op::multiply, coefficient, factor);
    form->constant = builder_.apply(Op::multiply, form->constant, factor);
    form->most *= most;
    return form;
  }

  size_t count_;
  TapeBuilder builder_;
  std::array<uint32_t, 3> coordinates_{UINT32_MAX, UINT32_MAX, UINT32_MAX};
  std::vector<Enclosure> enclosures_;
  std::vector<unsigned> axes_;  // of the samples, that a node of the tape depends on, as bits
};

}  // namespace

RowPlan::RowPlan(const Tape& tape, const std::array<int, 3>& sample_axis) {
  Splitter splitter(tape, sample_axis);
  const uint32_t root = splitter.root();
  is_absolute = splitter.node(root).op == Op::absolute && !splitter.is_of_row(root);
  const std::optional<LinearForm> form =
      splitter.linear(is_absolute ? splitter.node(root).a : root);
  if (form && form->most < 1e30) {
    is_linear = true;
    std::vector<uint32_t> bases, values;
    for (const auto& [table, coefficient] : form->coefficients) {
      bases.push_back(table);
      values.push_back(coefficient);
    }
    values.push_back(form->constant);
    wave = splitter.wave(bases);
    tables = splitter.compile(bases);
    rows = splitter.compile(values);
    most_ = form->most;
    operations_ = 8 * static_cast<double>(splitter.size());
    return;
  }
  is_absolute = false;

  // The operands of the samples' own nodes.
  std::vector<uint32_t> bases, values;
  std::vector<bool> is_listed(root + 1);
  const auto list = [&](uint32_t i) {
    if (is_listed[i] || splitter.node(i).op == Op::constant) return;
    is_listed[i] = true;
    if (splitter.is_of_table(i)) bases.push_back(i);
    if (splitter.is_of_row(i)) values.push_back(i);
  };
  if (splitter.is_of_table(root) || splitter.is_of_row(root)) {
    list(root);
  } else {
    for (uint32_t i = 0; i <= root; ++i) {
      const Node& node = splitter.node(i);
      if (node.op < Op::add || splitter.is_of_table(i) || splitter.is_of_row(i)) continue;
      list(node.a);
      if (has_two_operands(node.op)) list(node.b);
    }
  }
  tables = splitter.compile(bases);
  rows = splitter.compile(values);
  bases.insert(bases.end(), values.begin(), values.end());
  samples = splitter.compile(bases, {root});
}

double RowPlan::slack(size_t terms, double magnitude) const {
  const double all = static_cast<double>(tables.outputs.size() + terms);
  return 1.25 * (most_ + magnitude) * ((all + 3) * 0x1p-24 + operations_ * 0x1p-53) + 0x1p-120;
}

}  // namespace msq
