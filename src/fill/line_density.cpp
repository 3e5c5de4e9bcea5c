// SPDX-License-Identifier: Apache-2.0
#include "fill/line_density.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/job.h"

namespace msq {

namespace {

/// The length of the part of a line within a box.
double length_within(Vec2 a, Vec2 b, const Box2& box) {
  double from = 0, to = 1;
  const Vec2 way = b - a;
  const double at[2] = {a.x, a.y}, by[2] = {way.x, way.y};
  const double low[2] = {box.min.x, box.min.y}, high[2] = {box.max.x, box.max.y};
  for (int axis = 0; axis < 2; ++axis) {
    if (by[axis] == 0) {
      // Half-open, so that a line on the border is in one of two neighbours.
      if (at[axis] < low[axis] || at[axis] >= high[axis]) return 0;
      continue;
    }
    const double t = (low[axis] - at[axis]) / by[axis], u = (high[axis] - at[axis]) / by[axis];
    from = std::max(from, std::min(t, u));
    to = std::min(to, std::max(t, u));
  }
  return to > from ? (to - from) * length(way) : 0;
}

/// The weight of a place within the sample, 0 to 1 from its begin to its end: smooth, 0 at the ends
/// and 1 on average (Hann's window, squared). The integral of a wave of four and more periods in
/// the sample is less than 1 % of its height, wherever it begins.
double weight_at(double place) {
  const double s = std::sin(std::numbers::pi * place);
  return place > 0 && place < 1 ? 8.0 / 3 * s * s * s * s : 0;
}

/// The integral of the weights along a line, in steps of at most `step`.
double weight_along(Vec2 a, Vec2 b, const Box2& box, double step) {
  const double whole = length(b - a);
  const int parts = static_cast<int>(std::min(1e6, std::floor(whole / step))) + 1;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const Vec2 at = a + (b - a) * ((i + 0.5) / parts);
    sum += weight_at((at.x - box.min.x) / (box.max.x - box.min.x)) *
           weight_at((at.y - box.min.y) / (box.max.y - box.min.y));
  }
  return sum * whole / parts;
}

}  // namespace

double mean_line_density(const Structure& structure) {
  if (structure.thin_walls() != ThinWalls::none && !structure.is_on_grid())
    fail(Status::unsupported,
         "the structure is made of others and has no cell size of its own; calibrate these");
  if (structure.thin_walls() == ThinWalls::varying)
    fail(Status::unsupported,
         "the walls of the structure are denser in some places; calibrate it without the field, "
         "period or warp that does so");
  const Neighbourhood& grid = structure.neighbourhood();
  const std::array<int, 3> axes = grid.sample_axes();
  const bool is_turned = axes[0] < 0, repeats = structure.is_periodic() && !is_turned;
  // Where cells repeat in other directions than along the axes, a box with hard sides would hold
  // one wall more or fewer. Even heights through 8 cells of one size, of which 61 is no multiple,
  // are weighted likewise.
  const bool is_weighted = structure.is_periodic() && is_turned;
  const bool has_one_size = max_component(grid.cell_size) <= 1.001 * min_component(grid.cell_size);
  const bool is_even = is_weighted && has_one_size;
  const int heights = is_even ? 61 : structure.is_periodic() ? 64 : 32;
  Vec3 size = grid.cell_size;  // of the sample, in the model's frame
  if (is_turned)
    size = Vec3{1, 1, 1} * max_component(size);
  else
    for (int axis = 0; axis < 3; ++axis)
      size[axes[static_cast<size_t>(axis)]] = grid.cell_size[axis];
  size = size * (repeats ? 1.0 : structure.is_periodic() ? 8.0 : 32.0);
  const Vec3 low = grid.origin;
  const Box2 box = Box2{{low.x, low.y}, {low.x + size.x, low.y + size.y}};
  const double step = min_component(grid.cell_size) / 8;
  double sum = 0, weights = 0;
  for (int i = 0; i < heights; ++i) {
    check_cancelled();
    // Heights are even through one period, too. Through many periods of other cells they are at
    // places within the cells that are all different, by the golden section (Weyl), so that none is
    // favoured.
    const double turn = 0.6180339887498949 * (i + 1);
    const double part = is_even || repeats ? 0.381966 : turn - std::floor(turn);
    const double place = (i + part) / heights;
    const double z = low.z + place * size.z, weight = is_even ? weight_at(place) : 1;
    const LineGraph graph = structure.wall_lines({z, box, 1e-3 * min_component(grid.cell_size)});
    for (const auto& [a, b] : graph.lines) {
      const Vec2 from = graph.points[a], to = graph.points[b];
      sum +=
          weight * (is_weighted ? weight_along(from, to, box, step) : length_within(from, to, box));
    }
    weights += weight;
  }
  const double density = sum / (weights * (size.x * size.y));
  if (!(density > 0))
    fail(Status::limit, "no wall of the structure meets any of %d planes", heights);
  return density;
}

}  // namespace msq
