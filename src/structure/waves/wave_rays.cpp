// SPDX-License-Identifier: Apache-2.0
#include "structure/waves/wave_rays.h"

#include <algorithm>
#include <cmath>

#include "base/infinity.h"
#include "base/pi.h"
#include "structure/waves/wave_kernels.h"

namespace msq {

WaveRay::WaveRay(const Waves& solid, const Ray& ray) : solid_(solid), ray_(ray) {
  const Neighbourhood& grid = solid.neighbourhood();
  const Vec3 along = grid.rotation.apply_inverse(ray.direction);
  rate_ = {along.x / grid.cell_size.x, along.y / grid.cell_size.y, along.z / grid.cell_size.z};
  double powers = 0;
  for (size_t i = 0; i < solid.waves().count(); ++i) {
    const double square = dot(solid.waves().wave(i), rate_) * dot(solid.waves().wave(i), rate_);
    powers += square * square;
  }
  const double turn = two_pi * two_pi;
  // The directions of waves and ray are rounded.
  const double rounding = 0x1p-30 * dot(rate_, rate_) * dot(rate_, rate_);
  fourth_ = (1 + 0x1p-30) * turn * turn / 24 *
            (solid.waves().amplitude() * powers + solid.waves().most() * rounding);
}

double WaveRay::positive_until(double gap, double first, double second, double third,
                               double most) const {
  constexpr int max_steps = 24;
  double s = 0;
  for (int n = 0; n < max_steps && s < most; ++n) {
    const double q = most - s;
    const double value = gap + s * (first + s * (second / 2 + s * (third / 6 - s * fourth_)));
    if (!(value > 0)) break;
    const double slope = first + s * (second + s * (third / 2 - s * 4 * fourth_));
    const double bend =
        std::abs(second + s * third) + std::abs(third) * q + 12 * fourth_ * most * most;
    const double root = std::sqrt(slope * slope + 2 * bend * value), divisor = root - slope;
    double step = divisor > 0 ? std::min(q, 2 * value / divisor) : q;
    // With a positive slope the difference loses digits; the other form of the root does not.
    if (slope > 0) step = std::min(step, (1 + 0x1p-31) * (root + slope) / bend);
    s += (1 - 0x1p-30) * step;
    if (step < 0x1p-12 * s || step == q) break;
  }
  return s;
}

bool WaveRay::find(bool wanted, double from, double to, double& t, const Job* job) const {
  if (!(from <= to)) return false;
  const double tolerance = solid_.ray_tolerance(ray_, to);
  const double cell = min_component(solid_.neighbourhood().cell_size);
  const double error =
      4 * solid_.error(std::max(max_coordinate(ray_, to), max_coordinate(ray_, from)));
  const Parameter& level = solid_.level();
  const double steepest = level.lipschitz();
  LeastStep least(tolerance, tolerance, from);
  double before = from, at = from, span = cell;
  for (uint32_t n = 0;; ++n) {
    if (n % 64 == 0) check_cancelled(job);
    const Vec3 p = ray_.at(at);
    const WaveExpansion g = expand_waves(solid_.waves(), solid_.position(p), rate_);
    const double limit = level.at(p);
    const bool is_inside = (solid_.is_sheet() ? std::abs(g.value) : g.value) <= limit;
    if (is_inside == wanted) {
      t = at - before > tolerance
              ? bisect(before, at, tolerance,
                       [&](double s) { return solid_.inside(ray_.at(s)) == wanted; })
              : at;
      return true;
    }
    if (at >= to) return false;
    // The gaps of which the first to close ends the way: sign g - limit, or limit - sign g.
    const auto way = [&](double sign, Interval levels, double slope, double most) {
      const double gap = (wanted ? sign * g.value - levels.high : levels.low - sign * g.value);
      const double by = wanted ? sign : -sign;
      return positive_until(gap - error, by * g.first - slope, by * g.second, by * g.third, most);
    };
    // Beyond, the remainder exceeds the gap anyway.
    const double far = std::sqrt(std::sqrt(std::max(0.25, std::abs(g.value - limit)) / fourth_));
    double step = 0;
    for (;;) {
      const double most = std::min({span, far, to - at});
      Interval levels{limit, limit};
      double slope = 0;
      if (!level.is_constant()) {
        if (steepest < infinity) {
          const Interval range = level.range(Box3{p, p});
          const double off = 2 * (range.high - range.low);
          levels = {limit - off, limit + off};
          slope = steepest;
        } else {
          levels = level.range(box_of(ray_, at, at + most));
        }
      }
      if (!solid_.is_sheet())
        step = way(1, levels, slope, most);
      else if (wanted)
        step = way(g.value > 0 ? 1 : -1, levels, slope, most);
      else
        step = std::min(way(1, levels, slope, most), way(-1, levels, slope, most));
      if (step > 0 || steepest < infinity || most <= 16 * tolerance) break;
      span = 0.25 * most;
    }
    span = std::min(cell, 4 * std::max(step, 16 * tolerance));
    before = at + step;
    at = std::min(to, at + std::max(step, least.of_step(at)));
    if (before > at) before = at;
  }
}

}  // namespace msq
