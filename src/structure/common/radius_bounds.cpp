// SPDX-License-Identifier: Apache-2.0
#include "structure/common/radius_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/pi.h"

namespace msq {

namespace {

/// The time that bounds of the slopes in a box take, that a strut's bounds take, and that the range
/// in a box takes, as a number of samples in doubt.
constexpr double slopes_cost = 32, strut_cost = 1, range_cost = 16;
/// Struts are not halved again if more than this part of the samples is still in doubt.
constexpr double max_left = 0.85;

Vec3 magnitude(Vec3 v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

}  // namespace

/// A batch and what is known so far.
struct RadiusBounds::Work {
  StrutBatch& batch;
  double factor;
  Interval range;         // of all radii
  bool is_known = false;  // at_middle
  double at_middle[StrutBatch::capacity];
  double most_departure[StrutBatch::capacity];  // at any point in a strut's reach
  size_t order[StrutBatch::capacity];  // of the struts, so that those of a part are near each other

  /// Orders struts begin ... end - 1 along the longest side of their box, as far as halves need.
  void divide(size_t begin, size_t half, size_t end, Vec3 extent) {
    const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : extent.y >= extent.z ? 1 : 2;
    std::nth_element(order + begin, order + half, order + end, [&](size_t i, size_t j) {
      const double a = batch.a[axis][i] + batch.b[axis][i];
      const double b = batch.a[axis][j] + batch.b[axis][j];
      return a < b || (a == b && i < j);
    });
  }
  Vec3 middle(size_t i) const { return (batch.from(i) + batch.to(i)) * 0.5; }
  Box3 box(size_t i) const {
    return {min(batch.from(i), batch.to(i)), max(batch.from(i), batch.to(i))};
  }
};

RadiusBounds::RadiusBounds(const Parameter& radius, double margin, const SampleGrid& grid,
                           const Box3& samples)
    : radius_(radius), margin_(margin) {
  Vec3 step = grid.spacing;
  if (grid.heights) step.z = grid.spacing.x;  // or any other
  samples_ = {samples.min - step * 0.5, samples.max + step * 0.5};
  per_volume_ = 1 / (step.x * step.y * step.z);
}

void RadiusBounds::set(StrutBatch& batch, double factor) const {
  const Interval range{factor * radius_.range().low, factor * radius_.range().high};
  batch.linear = false;
  std::fill_n(batch.low, batch.count, range.low);
  std::fill_n(batch.high, batch.count, range.high);
  if (radius_.is_constant() || batch.count == 0) return;
  std::fill_n(batch.at_a, batch.count, 0.5 * (range.low + range.high));
  const double departure = 0.5 * (range.high - range.low) + 0x1p-46 * range.high;
  std::fill_n(batch.departure, batch.count, departure);
  for (auto* slopes : {&batch.gradient, &batch.spread})
    for (auto& slope : *slopes) std::fill_n(slope, batch.count, 0.0);
  Work work{batch, factor, range, false, {}, {}, {}};
  std::fill_n(work.most_departure, batch.count, departure);
  std::iota(work.order, work.order + batch.count, size_t{0});
  bound(work, 0, batch.count, std::numeric_limits<double>::infinity());
}

void RadiusBounds::bound(Work& work, size_t begin, size_t end, double before) const {
  Box3 all = work.box(work.order[begin]);
  for (size_t n = begin + 1; n < end; ++n) {
    const Box3 box = work.box(work.order[n]);
    all = {min(all.min, box.min), max(all.max, box.max)};
  }
  const std::optional<Slopes> slopes = radius_.slopes(all.grown(reach(work.range.high)));
  if (slopes) use_slopes(work, *slopes, begin, end);
  double in_doubt[StrutBatch::capacity], left = 0;
  for (size_t n = begin; n < end; ++n) {
    const size_t i = work.order[n];
    left += in_doubt[i] = doubts(work.batch, i);
  }
  const size_t count = end - begin;
  const double cost = 2 * (slopes_cost + strut_cost * static_cast<double>(count));
  if (count > 1 && left > cost && (!slopes || left < max_left * before)) {
    const size_t half = begin + count / 2;
    work.divide(begin, half, end, all.extent());
    double first = 0;
    for (size_t n = begin; n < half; ++n) first += in_doubt[work.order[n]];
    bound(work, begin, half, first);
    bound(work, half, end, left - first);
    return;
  }
  if (slopes) return;
  for (size_t n = begin; n < end; ++n)
    if (in_doubt[work.order[n]] > range_cost) use_range(work, work.order[n]);
}

/// The distance from a strut of all that it contains at most, for its maximum radius.
double RadiusBounds::reach(double radius) const {
  return (radius + margin_) * (1 + 1e-6);
}

void RadiusBounds::use_slopes(Work& work, const Slopes& slopes, size_t begin, size_t end) const {
  StrutBatch& batch = work.batch;
  if (!work.is_known) {
    Vec3 middles[StrutBatch::capacity];
    for (size_t i = 0; i < batch.count; ++i) middles[i] = work.middle(i);
    radius_.values(middles, batch.count, work.at_middle);
    for (size_t i = 0; i < batch.count; ++i) work.at_middle[i] *= work.factor;
    work.is_known = true;
  }
  const Vec3 least = slopes.between.min * work.factor, most = slopes.between.max * work.factor;
  constexpr double steepest = 0.99 * StrutBatch::max_slope;
  const Vec3 bound{steepest, steepest, steepest};
  const Vec3 gradient = min(max((least + most) * 0.5, bound * -1), bound);
  const Vec3 apart = max(most - gradient, gradient - least), spread = min(apart, bound);
  const Vec3 steep = max(magnitude(least), magnitude(most)), slope = magnitude(gradient);
  const double rounding = 2 * work.factor * slopes.rounding;
  const auto grown = [](Vec3 v, double by) { return v + Vec3{by, by, by}; };
  for (size_t n = begin; n < end; ++n) {
    const size_t i = work.order[n];
    const double middle = work.at_middle[i];
    const Vec3 ab = batch.to(i) - batch.from(i), half = magnitude(ab) * 0.5;
    // First the strut's maximum radius, then the departure within that reach.
    const double high = std::min(
        work.range.high,
        (middle + dot(steep, grown(half, reach(work.range.high)))) * (1 + 0x1p-40) + rounding);
    const Vec3 around = grown(half, reach(high));
    const double along = dot(slope, around);
    const double at_middle = dot(apart, around) * 0x1p-40 + dot(apart - spread, around) + rounding +
                             0x1p-46 * (middle + along);
    const double departure = dot(spread, around) + at_middle;
    if (!(departure < work.most_departure[i])) continue;
    batch.linear = true;
    work.most_departure[i] = departure;
    batch.departure[i] = at_middle;
    batch.at_a[i] = middle - 0.5 * dot(gradient, ab);
    for (int axis = 0; axis < 3; ++axis) {
      batch.gradient[axis][i] = gradient[axis];
      batch.spread[axis][i] = spread[axis];
    }
    batch.low[i] = std::max(work.range.low, middle - along - departure);
    batch.high[i] = std::min(high, middle + along + departure);
  }
}

void RadiusBounds::use_range(Work& work, size_t strut) const {
  StrutBatch& batch = work.batch;
  const Interval range = radius_.range(work.box(strut).grown(reach(work.range.high)));
  batch.low[strut] = std::max(batch.low[strut], work.factor * range.low);
  batch.high[strut] = std::min(batch.high[strut], work.factor * range.high);
  const double middle = 0.5 * (batch.low[strut] + batch.high[strut]);
  const double departure = 0.5 * (batch.high[strut] - batch.low[strut]) + 0x1p-46 * middle;
  if (departure > work.most_departure[strut]) return;
  work.most_departure[strut] = departure;
  batch.departure[strut] = departure;
  batch.at_a[strut] = middle;
  for (int axis = 0; axis < 3; ++axis) batch.gradient[axis][strut] = batch.spread[axis][strut] = 0;
}

double RadiusBounds::doubts(const StrutBatch& batch, size_t strut) const {
  // The volume between the two shells, and the part of it where samples are.
  const Vec3 a = batch.from(strut), b = batch.to(strut);
  const double radius = batch.high[strut];
  const Box3 all = Box3{min(a, b), max(a, b)}.grown(radius);
  double part = per_volume_;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = all.max[axis] - all.min[axis];
    const double within =
        std::min(all.max[axis], samples_.max[axis]) - std::max(all.min[axis], samples_.min[axis]);
    if (within < size) part *= std::max(within, 0.0) / size;
  }
  // Halfway from the middle to an end, and at the surface.
  const double departure =
      batch.departure_at(strut, magnitude(b - a) * 0.25 + Vec3{radius, radius, radius});
  return 4 * pi * radius * (length(b - a) + 2 * radius) * departure * part;
}

}  // namespace msq
