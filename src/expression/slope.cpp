// SPDX-License-Identifier: Apache-2.0
// Each node has three bounds: the enclosure of its computed values (enclosure.cpp), enclosures of
// the derivatives of its true value, and a bound of the difference of the two values. An IEEE
// operation loses u = 2^-53 of its result. Sines, cosines, exponentials, logarithms and
// hyperbolic tangents lose up to 2^-50, angles up to 2^-49 (elementary-inl.h). Every interval of
// true values is widened by 2^-50 of its ends, which exceeds the rounding of the few operations
// that compute it.
#include "expression/slope.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/borrowed.h"
#include "base/infinity.h"
#include "base/job.h"
#include "expression/enclosure.h"

namespace msq {

namespace {

constexpr double u = 0x1p-53, of_function = 0x1p-50, least = 0x1p-1000;
constexpr double max_sine_argument = 0x1p19;

double max_magnitude(Interval v) {
  return std::max(std::abs(v.low), std::abs(v.high));
}
/// The minimum magnitude of the numbers of an interval.
double distance_from_zero(Interval v) {
  return std::max({0.0, v.low, -v.high});
}
Interval widened(Interval v, double by = 0) {
  return {v.low - by - 0x1p-50 * std::abs(v.low) - least,
          v.high + by + 0x1p-50 * std::abs(v.high) + least};
}
/// Most derivatives of nodes are zero: those along other axes.
bool is_zero(Interval v) {
  return v.low == 0 && v.high == 0;
}
Interval sum(Interval a, Interval b) {
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  return widened({a.low + b.low, a.high + b.high});
}
Interval negative(Interval a) {
  return {-a.high, -a.low};
}
Interval product_of(Interval a, Interval b) {
  if (is_zero(a) || is_zero(b)) return {0, 0};
  const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, t = a.high * b.high;
  return widened(
      {std::min(std::min(p, q), std::min(r, t)), std::max(std::max(p, q), std::max(r, t))});
}
/// 1 / a for an interval without 0.
Interval inverse(Interval a) {
  return widened({1 / a.high, 1 / a.low});
}
Interval hull(Interval a, Interval b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// A node over a box.
struct Part {
  Interval value;  // of its true values
  Interval along[3];
  double error = 0;
};

class Differentiation {
 public:
  /// The root's part; null if something is unbounded.
  const Part* over(const Tape& tape, const Interval (&box)[3], double coordinate_error) {
    Interval wider[3];
    for (int i = 0; i < 3; ++i) wider[i] = widened(box[i], coordinate_error);
    coordinate_error_ = coordinate_error;
    enclose(tape, wider, computed_);
    parts_.resize(tape.nodes.size());
    for (uint32_t i = 0; i < parts_.size(); ++i)
      if (!find(tape.nodes[i], i)) return nullptr;
    return &parts_.back();
  }

 private:
  bool find(const Node& node, uint32_t i) {
    Part& part = parts_[i];
    part.along[0] = part.along[1] = part.along[2] = {0, 0};
    part.error = 0;
    if (!is_bounded(computed_[i])) return false;
    if (node.op == Op::constant) {
      part.value = {node.value, node.value};
      return true;
    }
    if (node.op < Op::add) {
      part.value = computed_[i];
      part.along[static_cast<int>(node.op) - static_cast<int>(Op::x)] = {1, 1};
      part.error = coordinate_error_;
      return true;
    }
    const Part& a = parts_[node.a];
    const Part& b = parts_[has_two_operands(node.op) ? node.b : node.a];
    const double rounding = u * max_magnitude(computed_[i]) + least;
    switch (node.op) {
      case Op::add:
      case Op::subtract:
        for (int k = 0; k < 3; ++k)
          part.along[k] = sum(a.along[k], node.op == Op::add ? b.along[k] : negative(b.along[k]));
        part.error = a.error + b.error + rounding;
        break;
      case Op::multiply:
        for (int k = 0; k < 3; ++k)
          part.along[k] = sum(product_of(a.value, b.along[k]), product_of(b.value, a.along[k]));
        part.error = a.error * max_magnitude(b.value) + b.error * max_magnitude(a.value) +
                     a.error * b.error + rounding;
        break;
      case Op::divide: {
        const double divisor =
            std::min(distance_from_zero(b.value), distance_from_zero(computed_[node.b]));
        if (!(divisor > 0)) return false;
        const Interval by = inverse(b.value), quotient = product_of(a.value, by);
        for (int k = 0; k < 3; ++k)
          part.along[k] =
              product_of(sum(a.along[k], negative(product_of(quotient, b.along[k]))), by);
        part.error = (a.error + max_magnitude(quotient) * b.error) / divisor + rounding;
        break;
      }
      case Op::minimum:
      case Op::maximum: {
        const Interval &p = a.value, &q = b.value;
        const bool is_a = node.op == Op::minimum ? p.high < q.low : p.low > q.high;
        const bool is_b = node.op == Op::minimum ? q.high < p.low : q.low > p.high;
        for (int k = 0; k < 3; ++k)
          part.along[k] = is_a ? a.along[k] : is_b ? b.along[k] : hull(a.along[k], b.along[k]);
        part.error = std::max(a.error, b.error);
        break;
      }
      case Op::arctangent: {
        // a is y and b is x. Across the negative x axis the angle jumps.
        const Interval &y = a.value, &x = b.value;
        const double nearest = std::hypot(distance_from_zero(x), distance_from_zero(y));
        const double square = (1 - 0x1p-50) * nearest * nearest;
        if ((x.low <= 0 && y.low <= 0 && y.high >= 0) || !(square > 0x1p-900)) return false;
        const Interval over{0, 1 / square};
        const double most = (1 + 0x1p-40) / nearest;
        // Each of x / (x x + y y) and y / (x x + y y) is at most 1 / nearest.
        const auto factor = [&](Interval v) {
          const Interval all = product_of(v, over);
          return Interval{std::max(all.low, -most), std::min(all.high, most)};
        };
        const Interval by = factor(x), ax = factor(y);
        for (int k = 0; k < 3; ++k)
          part.along[k] = sum(product_of(by, a.along[k]), negative(product_of(ax, b.along[k])));
        part.error = (a.error + b.error) * most + 4 * of_function;
        break;
      }
      case Op::hypotenuse: {
        // Its gradient is a unit vector; where both are 0, any vector of length 1 or less.
        const double nearest =
            std::hypot(distance_from_zero(a.value), distance_from_zero(b.value)) * (1 - 0x1p-50);
        const auto factor = [&](Interval v) {
          if (!(nearest > 0)) return Interval{v.low < 0 ? -1.0 : 0.0, v.high > 0 ? 1.0 : 0.0};
          const Interval all = product_of(v, {0, 1 / nearest});
          return Interval{std::max(all.low, -1.0), std::min(all.high, 1.0)};
        };
        const Interval p = factor(a.value), q = factor(b.value);
        for (int k = 0; k < 3; ++k)
          part.along[k] = sum(product_of(p, a.along[k]), product_of(q, b.along[k]));
        part.error = a.error + b.error + 4 * rounding + 0x1p-500;
        break;
      }
      // Steps: true and computed operands must be on one side of each.
      case Op::less:
        if (!(a.value.high < b.value.low || a.value.low >= b.value.high)) return false;
        break;
      case Op::floor:
        if (std::floor(a.value.low) != std::floor(a.value.high)) return false;
        break;
      case Op::keep:
      case Op::drop: {
        const bool is_above = a.value.low > 0.5;
        if (!is_above && !(a.value.high <= 0.5)) return false;
        if (is_above != (node.op == Op::keep)) break;
        for (int k = 0; k < 3; ++k) part.along[k] = b.along[k];
        part.error = b.error;
        break;
      }
      case Op::tangent_hyperbolic: {
        // The slope is 1 - v v.
        const Interval v = widened(computed_[i], a.error + of_function);
        const double low = distance_from_zero(v), high = max_magnitude(v);
        const Interval slope{std::max(0.0, 1 - high * high - 0x1p-50), 1 - low * low + 0x1p-50};
        for (int k = 0; k < 3; ++k) part.along[k] = product_of(a.along[k], slope);
        part.error = a.error + of_function;
        break;
      }
      case Op::negate:
        for (int k = 0; k < 3; ++k) part.along[k] = negative(a.along[k]);
        part.error = a.error;
        break;
      case Op::absolute:
        for (int k = 0; k < 3; ++k)
          part.along[k] = a.value.low > 0    ? a.along[k]
                          : a.value.high < 0 ? negative(a.along[k])
                                             : hull(a.along[k], negative(a.along[k]));
        part.error = a.error;
        break;
      case Op::square_root: {
        if (!(a.value.low > 0)) return false;
        const double lowest = std::sqrt(a.value.low) * (1 - 0x1p-50);
        const Interval roots{lowest, std::sqrt(a.value.high) * (1 + 0x1p-50)};
        for (int k = 0; k < 3; ++k)
          part.along[k] = product_of(a.along[k], product_of({0.5, 0.5}, inverse(roots)));
        part.error = a.error / lowest + rounding;
        break;
      }
      case Op::sine:
      case Op::cosine: {
        if (max_magnitude(a.value) > max_sine_argument) return false;
        const Interval cosines = enclose_result(Op::cosine, a.value, a.value, false);
        const Interval sines = enclose_result(Op::sine, a.value, a.value, false);
        for (int k = 0; k < 3; ++k)
          part.along[k] = product_of(a.along[k], node.op == Op::sine ? cosines : negative(sines));
        part.error = a.error + of_function;
        break;
      }
      case Op::exponential: {
        if (!(a.error < 0.5)) return false;
        const double most = max_magnitude(computed_[i]) + least;
        part.error = most * (4 * a.error + 2 * of_function) + least;
        const Interval values = widened(computed_[i], part.error);
        for (int k = 0; k < 3; ++k) part.along[k] = product_of(a.along[k], values);
        break;
      }
      case Op::logarithm:
        if (!(a.value.low > 0)) return false;
        for (int k = 0; k < 3; ++k) part.along[k] = product_of(a.along[k], inverse(a.value));
        part.error = 2 * a.error / std::min(a.value.low, computed_[node.a].low) +
                     of_function * (1 + max_magnitude(computed_[i]));
        break;
      default:
        return false;
    }
    part.error *= 1 + 0x1p-40;  // the rounding of these bounds
    part.value = widened(computed_[i], part.error);
    return is_bounded(part.value) && is_bounded(part.along[0]) && is_bounded(part.along[1]) &&
           is_bounded(part.along[2]);
  }

  double coordinate_error_ = 0;
  std::vector<Enclosure> computed_;
  std::vector<Part> parts_;
};

/// A part of the box, and its slopes.
struct Piece {
  Interval box[3];
  double least = 0, most = infinity, error = infinity;
  uint32_t number = 0;  // makes all pieces distinct in the order
};

bool is_flatter(const Piece& a, const Piece& b) {
  return a.most < b.most || (a.most == b.most && a.number < b.number);
}

void find_slopes(Differentiation& differentiation, const Tape& tape, Vec3 scale,
                 double coordinate_error, Piece& piece) {
  piece.least = 0;
  piece.most = piece.error = infinity;
  const Part* root = differentiation.over(tape, piece.box, coordinate_error);
  if (!root) return;
  double low = 0, high = 0;
  for (int k = 0; k < 3; ++k) {
    const double a = distance_from_zero(root->along[k]) * scale[k];
    const double b = max_magnitude(root->along[k]) * scale[k];
    low += a * a;
    high += b * b;
  }
  piece.least = std::sqrt(low);
  piece.most = std::sqrt(high) * (1 + 0x1p-50) + least;
  piece.error = root->error;
}

}  // namespace

Slope bound_slope(const Tape& tape, const Interval (&box)[3], Vec3 scale, double coordinate_error) {
  // About ten milliseconds of work. Parts that are unbounded after so many bisections stay
  // unbounded.
  const size_t pieces = std::clamp<size_t>((1 << 18) / tape.nodes.size(), 256, 8192);
  constexpr double narrow = 0x1p-8, near = 1 + 0x1p-6;

  Differentiation differentiation;
  std::vector<Piece> heap;  // the steepest first
  uint32_t count = 0;
  const auto add = [&](Piece piece) {
    check_cancelled();
    piece.number = ++count;
    find_slopes(differentiation, tape, scale, coordinate_error, piece);
    heap.push_back(piece);
    std::push_heap(heap.begin(), heap.end(), is_flatter);
  };

  add({{box[0], box[1], box[2]}});
  while (heap.size() < pieces && !(heap[0].most <= near * heap[0].least)) {
    const Piece whole = heap[0];
    int widest = 0;
    double widths[3];
    for (int k = 0; k < 3; ++k) {
      widths[k] = (whole.box[k].high - whole.box[k].low) / (box[k].high - box[k].low);
      if (widths[k] > widths[widest]) widest = k;
    }
    if (whole.most == infinity && widths[widest] <= narrow) break;
    std::pop_heap(heap.begin(), heap.end(), is_flatter);
    heap.pop_back();
    Piece half = whole;
    const double middle = 0.5 * (whole.box[widest].low + whole.box[widest].high);
    half.box[widest].high = middle;
    add(half);
    half.box[widest] = {middle, whole.box[widest].high};
    add(half);
  }
  Slope slope{heap[0].most, 0};
  for (const Piece& piece : heap) slope.error = std::max(slope.error, piece.error);
  return slope;
}

Slope enclose_slope(const Tape& tape, const Interval (&box)[3], Vec3 scale,
                    double coordinate_error) {
  const Borrowed<Differentiation> differentiation;
  Piece piece{{box[0], box[1], box[2]}};
  find_slopes(*differentiation, tape, scale, coordinate_error, piece);
  return {piece.most, piece.error};
}

std::optional<Derivatives> enclose_derivatives(const Tape& tape, const Interval (&box)[3]) {
  const Borrowed<Differentiation> differentiation;
  const Part* root = differentiation->over(tape, box, 0);
  if (!root) return {};
  return Derivatives{root->value, {root->along[0], root->along[1], root->along[2]}, root->error};
}

}  // namespace msq
