// SPDX-License-Identifier: Apache-2.0
#include "field/curve.h"

#include <algorithm>
#include <cmath>

namespace msq {

Curve::Curve(std::vector<Knot> knots) : knots_(std::move(knots)) {
  for (size_t i = 1; i < knots_.size(); ++i) lipschitz_ = std::max(lipschitz_, slope_to(i));
}

double Curve::slope_to(size_t i) const {
  const Knot &a = knots_[i - 1], &b = knots_[i];
  // Rounded up by more than the three operations lose.
  return std::abs(b.value - a.value) / (b.at - a.at) * (1 + 0x1p-50);
}

Interval Curve::slopes(Interval over) const {
  const size_t begin = knots_to(over.low), end = knots_to(over.high);
  Interval slopes{0, 0};
  bool is_first = begin > 0 && end < knots_.size();  // otherwise the curve is constant somewhere
  for (size_t i = std::max<size_t>(begin, 1); i < std::min(end + 1, knots_.size()); ++i) {
    const double slope = std::copysign(slope_to(i), knots_[i].value - knots_[i - 1].value);
    slopes = is_first ? Interval{slope, slope}
                      : Interval{std::min(slopes.low, slope), std::max(slopes.high, slope)};
    is_first = false;
  }
  return slopes;
}

double Curve::lipschitz(Interval over) const {
  double most = 0;
  const size_t end = std::min(knots_to(over.high) + 1, knots_.size());
  for (size_t i = std::max<size_t>(knots_to(over.low), 1); i < end; ++i)
    most = std::max(most, slope_to(i));
  return most;
}

size_t Curve::knots_to(double v) const {
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), v,
                                      [](double at, const Knot& knot) { return at < knot.at; });
  return static_cast<size_t>(above - knots_.begin());
}

double Curve::operator()(double v) const {
  const size_t n = knots_to(v);
  if (n == 0) return knots_.front().value;
  if (n == knots_.size()) return knots_.back().value;
  const Knot &a = knots_[n - 1], &b = knots_[n];
  // Each operation rounds monotonically, so the result is monotone; the clamp limits it to b.
  const double value = a.value + (v - a.at) / (b.at - a.at) * (b.value - a.value);
  return std::clamp(value, std::min(a.value, b.value), std::max(a.value, b.value));
}

Interval Curve::range(Interval over) const {
  const double first = (*this)(over.low), last = (*this)(over.high);
  Interval range{std::min(first, last), std::max(first, last)};
  for (size_t i = knots_to(over.low), end = knots_to(over.high); i < end; ++i) {
    range.low = std::min(range.low, knots_[i].value);
    range.high = std::max(range.high, knots_[i].value);
  }
  return range;
}

void Curve::describe(HashInput& input) const {
  static_assert(sizeof(Knot) == 2 * sizeof(double));
  input.list(&knots_[0].at, 2 * knots_.size());
}

}  // namespace msq
