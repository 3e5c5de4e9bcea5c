// SPDX-License-Identifier: Apache-2.0
// Everything is computed from the function at 65^3 points of the cell, by IEEE operations in one
// order: the same bits on every machine. The function is taken to be linear between neighbouring
// points: for the volume fractions along the lines of points, and for the area in the six
// tetrahedra of each cube of points (Doi and Koide, "An efficient method of triangulating
// equi-valued surfaces by using tetrahedral cells", 1991). The error of the area falls with the
// square of the distance of the points. So the area from every second point removes most of it
// (Richardson).
#include "structure/functional/wall_thickness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/status.h"
#include "expression/batch.h"

namespace msq {

namespace {

constexpr size_t steps = 64, points = steps + 1;
static_assert(points <= batch_points && steps % 2 == 0);
constexpr size_t level_steps = 512, thickness_steps = 512;

struct Samples {
  explicit Samples(const Tape& function) : values(points * points * points) {
    const Program program = compile(function);
    Batch batch(program);
    double angles[points + batch_padding] = {};
    for (size_t i = 0; i < points; ++i)
      angles[i] = two_pi * (static_cast<double>(i) / static_cast<double>(steps));
    batch.set_input(0, {angles, false});
    for (size_t k = 0; k < points; ++k)
      for (size_t j = 0; j < points; ++j) {
        batch.set_input(1, {angles + j, true});
        batch.set_input(2, {angles + k, true});
        batch.run(points);
        const Values row = batch.output(0);
        for (size_t i = 0; i < points; ++i) values[(k * points + j) * points + i] = row[i];
      }
  }

  std::vector<double> values;
};

/// The area, within a tetrahedron, of the plane where a linear function is 0.
double area_in(const Vec3 (&corner)[4], const double (&value)[4]) {
  size_t in[4], out[4], ins = 0, outs = 0;
  for (size_t i = 0; i < 4; ++i) (value[i] <= 0 ? in[ins++] : out[outs++]) = i;
  const auto crossing = [&](size_t a, size_t b) {
    return corner[a] + (corner[b] - corner[a]) * (value[a] / (value[a] - value[b]));
  };
  const auto triangle = [](Vec3 a, Vec3 b, Vec3 c) { return 0.5 * length(cross(b - a, c - a)); };
  if (ins == 0 || outs == 0) return 0;
  if (ins == 2) {
    const Vec3 a = crossing(in[0], out[0]), b = crossing(in[0], out[1]);
    const Vec3 c = crossing(in[1], out[1]), d = crossing(in[1], out[0]);
    return triangle(a, b, c) + triangle(a, c, d);
  }
  const size_t* const alone = ins == 1 ? in : out;
  const size_t* const others = ins == 1 ? out : in;
  return triangle(crossing(alone[0], others[0]), crossing(alone[0], others[1]),
                  crossing(alone[0], others[2]));
}

/// Uses every `stride`th point.
double area_of(const Samples& samples, Vec3 cell_size, size_t stride) {
  // The corners of a cube, bit a of their number for axis a, on the paths from corner 0 to corner
  // 7.
  constexpr int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7},
                                    {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};
  const Vec3 step = cell_size * (static_cast<double>(stride) / static_cast<double>(steps));
  double area = 0;
  for (size_t k = 0; k < steps; k += stride)
    for (size_t j = 0; j < steps; j += stride)
      for (size_t i = 0; i < steps; i += stride) {
        double value[8];
        bool has_in = false, has_out = false, is_known = true;
        for (size_t c = 0; c < 8; ++c) {
          const size_t x = i + (c & 1) * stride, y = j + (c >> 1 & 1) * stride,
                       z = k + (c >> 2) * stride;
          value[c] = samples.values[(z * points + y) * points + x];
          (value[c] <= 0 ? has_in : has_out) = true;
          is_known = is_known && std::isfinite(value[c]);
        }
        if (!has_in || !has_out || !is_known) continue;
        for (const auto& corners : tetrahedra) {
          Vec3 at[4];
          double of[4];
          for (int n = 0; n < 4; ++n) {
            const int c = corners[n];
            at[n] = Vec3{double(c & 1), double(c >> 1 & 1), double(c >> 2)} * step;
            of[n] = value[c];
          }
          area += area_in(at, of);
        }
      }
  return area;
}

/// Fractions of the cell with a magnitude of at most n / level_steps of `greatest`, for n from 0
/// on.
///
/// Each point stands for the nearer halves of the segments to its neighbours along one axis, that
/// of the largest change; changes along the others are in the points beside it. The fraction of a
/// segment between two values a < b with values of at most v is min(max((v - a) / (b - a), 0), 1):
/// a difference of two ramps, that from a and that from b, both of slope 1 / (b - a). The ramps
/// that begin below v sum to v times the sum of their slopes minus the sum of their slopes times
/// their starting values.
std::vector<double> fractions_of(const Samples& samples, double greatest) {
  const double unit = static_cast<double>(level_steps) / greatest;
  std::vector<double> slopes(2 * level_steps + 2), moments(slopes.size()), jumps(slopes.size());
  const auto add = [&](double from, double to, double weight) {
    const double a = std::min(from, to) * unit + double(level_steps);
    const double b = std::max(from, to) * unit + double(level_steps);
    // The first value, in units, at which a ramp counts.
    const auto after = [](double v) { return static_cast<size_t>(v) + 1; };
    if (b - a < 0x1p-10) {
      jumps[after(0.5 * (a + b))] += weight;
      return;
    }
    const double slope = weight / (b - a);
    slopes[after(a)] += slope;
    moments[after(a)] += slope * a;
    slopes[after(b)] -= slope;
    moments[after(b)] -= slope * b;
  };
  constexpr size_t strides[3] = {1, points, points * points};
  double total = 0;
  for (size_t n = 0; n < samples.values.size(); ++n) {
    const double* const at = samples.values.data() + n;
    const size_t index[3] = {n % points, n / points % points, n / points / points};
    double weight = 1, steepest = -1, before = *at, beyond = *at;
    bool is_border = false;  // along the chosen axis: then there is only one half
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_first = index[axis] == 0, is_last = index[axis] == steps;
      if (is_first || is_last) weight *= 0.5;
      const double low = is_first ? *at : 0.5 * (*at + *(at - strides[axis]));
      const double high = is_last ? *at : 0.5 * (*at + at[strides[axis]]);
      const double change = is_first  ? 2 * std::abs(high - *at)
                            : is_last ? 2 * std::abs(*at - low)
                                      : std::abs(*at - low) + std::abs(high - *at);
      if (!(change > steepest)) continue;  // also false if it is NaN
      steepest = change;
      before = low;
      beyond = high;
      is_border = is_first || is_last;
    }
    total += weight;
    if (!std::isfinite(*at) || !std::isfinite(steepest)) continue;
    if (is_border) {
      add(before, beyond, weight);
    } else {
      add(before, *at, 0.5 * weight);
      add(*at, beyond, 0.5 * weight);
    }
  }
  std::vector<double> at_most;  // in units from -level_steps on
  double slope = 0, moment = 0, jump = 0;
  for (size_t v = 0; v <= 2 * level_steps; ++v) {
    slope += slopes[v];
    moment += moments[v];
    jump += jumps[v];
    at_most.push_back(jump + slope * static_cast<double>(v) - moment);
  }
  at_most.back() += jumps.back();
  std::vector<double> fractions{0};
  for (size_t n = 1; n <= level_steps; ++n) {
    const double inside = (at_most[level_steps + n] - at_most[level_steps - n]) / total;
    fractions.push_back(std::clamp(inside, fractions.back(), 1.0));
  }
  return fractions;
}

}  // namespace

WallThickness::WallThickness(const Tape& function, Vec3 cell_size) {
  const Samples samples(function);
  area_ = (4 * area_of(samples, cell_size, 1) - area_of(samples, cell_size, 2)) / 3;
  double greatest = 0;
  for (double v : samples.values)
    if (std::isfinite(v)) greatest = std::max(greatest, std::abs(v));
  if (!(area_ > 0) || !std::isfinite(area_) || !(greatest > 0))
    fail(Status::argument,
         "thickness is given, but the function is 0 nowhere in the cell, so there are no walls");
  constexpr double least = 1e-300;  // smaller steps are not distinguished
  if (greatest < least)
    fail(Status::argument,
         "thickness is given, but the function reaches no more than %g in magnitude; it must reach "
         "%g",
         greatest, least);
  const std::vector<double> fractions = fractions_of(samples, greatest);
  const double volume = cell_size.x * cell_size.y * cell_size.z;
  most_ = fractions.back() * volume / area_;
  std::vector<Curve::Knot> by_level, by_thickness;
  for (size_t n = 0; n <= level_steps; ++n)
    by_level.push_back({double(n) * (greatest / double(level_steps)), fractions[n]});
  // Equal steps of the thickness: where it hardly grows with the level, the levels lie far apart.
  size_t n = 0;
  for (size_t knot = 0; knot <= thickness_steps; ++knot) {
    const double part = double(knot) / double(thickness_steps), wanted = fractions.back() * part;
    while (n + 1 < level_steps && fractions[n + 1] < wanted) ++n;
    const double step = fractions[n + 1] - fractions[n];
    const double beyond = step > 0 ? std::clamp((wanted - fractions[n]) / step, 0.0, 1.0) : 0;
    const double level = by_level[n].at + beyond * (by_level[n + 1].at - by_level[n].at);
    by_thickness.push_back({most_ * part, knot ? std::max(level, by_thickness.back().value) : 0.0});
  }
  fractions_ = Curve(std::move(by_level));
  levels_ = Curve(std::move(by_thickness));
}

}  // namespace msq
