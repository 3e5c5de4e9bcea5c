// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/graded_walls.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/status.h"
#include "field/gradient.h"
#include "field/map.h"
#include "structure/functional/wall_thickness.h"

namespace msq {

namespace {

// Factors of 2^(1/4) between sizes and of 2^(1/8) between positions.
constexpr double size_step = 1.189207115002721, position_step = 1.0905077326652577;

/// Number of factors of `step` that a ratio of at least 1 holds, rounded up. The C library's
/// logarithm is not the same on every machine.
int steps_in(double ratio, double step) {
  int steps = 0;
  for (; ratio > 1 + 1e-9; ratio /= step) ++steps;
  return steps;
}

}  // namespace

Parameter graded_wall_level(const Tape& function, const Neighbourhood& grid,
                            const GradedPeriod& period, double thickness) {
  // The share of the cell that walls of a thickness fill has the same level in cells of any size.
  std::optional<WallThickness> first;
  std::vector<Curve::Knot> shares;  // of walls of that thickness, by frequency
  const int steps = steps_in(period.most() / period.least(), size_step);
  double next = period.least();
  for (int n = 0; n <= steps; ++n, next *= size_step) {
    const double frequency = n == steps ? period.most() : next;
    Vec3 size = grid.cell_size;
    size[period.axis()] = 1 / frequency;
    const WallThickness walls(function, size);
    if (thickness > walls.most())
      fail(Status::argument,
           "thickness is %g; walls of %g fill all of the cells where the period has a size of %g",
           thickness, walls.most(), 1 / frequency);
    if (!first) first = walls;
    shares.push_back({frequency, thickness / walls.most()});
  }
  const Curve share_of(std::move(shares));
  const auto level_at = [&](double s) {
    return first->levels()(first->most() * share_of(period.frequency(s)));
  };
  std::vector<Curve::Knot> levels;
  for (size_t i = 0; i < period.knots(); ++i) {
    const double from = period.position(i);
    int parts = 1;
    double way = 0;
    if (i + 1 < period.knots()) {
      way = period.position(i + 1) - from;
      const double ratio = period.frequency(from) / period.frequency(period.position(i + 1));
      parts = 1 + steps_in(std::max(ratio, 1 / ratio), position_step);
    }
    for (int part = 0; part < parts; ++part) {
      const double s = from + way * (double(part) / parts);
      if (levels.empty() || s > levels.back().at) levels.push_back({s, level_at(s)});
    }
  }
  const double begin = levels.front().at, end = levels.back().at;
  if (!(end > begin) || steps == 0) return Parameter(levels.front().value);
  Vec3 from, to;
  from[period.axis()] = begin;
  to[period.axis()] = end;
  return Parameter(Ref<const Field>(
      make_ref<MapField>(Ref<const Field>(make_ref<GradientField>(grid.from_grid(from), begin,
                                                                  grid.from_grid(to), end)),
                         Curve(std::move(levels)))));
}

}  // namespace msq
