// SPDX-License-Identifier: Apache-2.0
#include "structure/common/warp_shell.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/infinity.h"
#include "base/unit.h"

namespace msq {

namespace {

/// A ray as the radius sees it: nearest to the axis, or to the point, at `middle`, at the distance
/// `near`.
struct Passage {
  double speed, middle, near;

  Passage(const Warp& warp, const Ray& ray) {
    Vec3 at = warp.grid().to_grid(ray.origin);
    Vec3 way = warp.grid().rotation.apply_inverse(ray.direction);
    if (warp.kind() == Warp::Kind::cylindrical) at.z = way.z = 0;
    speed = length(way);
    middle = speed > 0 ? -dot(at, way) / (speed * speed) : 0;
    near = length(at + way * middle);
  }
  /// How far from the middle the ray is at a radius; below 0 if it never is.
  double half(double radius) const {
    if (radius < near) return -1.0;
    return speed > 0 ? std::sqrt((radius - near) * (radius + near)) / speed : infinity;
  }
};

}  // namespace

double WarpShell::distance_within(Vec3 p) const {
  const double r = warp_.radius(p), inner = warp_.shell().inner;
  return std::min(inner > 0 ? r - inner : infinity, warp_.outer() - r);
}

KeptPoint WarpShell::kept(Vec3 p) const {
  const double r = warp_.radius(p);
  return {warp_.is_in_shell(r),
          std::min(std::abs(r - warp_.shell().inner), std::abs(warp_.outer() - r))};
}

RayParts WarpShell::parts_of(const Ray& ray, double from, double to, double tolerance) const {
  const Passage passage(warp_, ray);
  const double middle = passage.middle, out = passage.half(warp_.outer()),
               in = warp_.shell().inner > 0 ? passage.half(warp_.shell().inner) : -1;
  RayParts parts;
  if (out < 0 || from > to) return parts;
  const auto add = [&](double first, double last) {
    add_part(parts, first, last, from, to, tolerance, [&](double t) { return holds(ray.at(t)); });
  };
  if (in > 0) {
    add(middle - out, middle - in);
    add(middle + in, middle + out);
  } else {
    add(middle - out, middle + out);
  }
  return parts;
}

double WarpShell::follow(const Ray& ray, double t, double to, double tolerance) const {
  return follow_part(t, to, tolerance, [&](double at) { return holds(ray.at(at)); });
}

Vec3 WarpShell::normal(Vec3 p) const {
  Vec3 g = warp_.grid().to_grid(p);
  if (warp_.kind() == Warp::Kind::cylindrical) g.z = 0;
  const double r = length(g);
  const bool is_inner = r - warp_.shell().inner < warp_.outer() - r;
  return warp_.grid().rotation.apply(unit_along(g) * (is_inner ? -1.0 : 1.0));
}

bool WarpShell::keep_rows(const RowBlock& block, const Job* job) const {
  JobPoll poll(job);
  bool is_any = false;
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      poll();
      is_any |= keep_row(*block.grid, j, k, block.row(j, k));
    }
  return is_any;
}

// A sample is decided by where it is in the row, except those whose radius is one of the shell's up
// to rounding.
bool WarpShell::keep_row(const SampleGrid& grid, uint64_t j, uint64_t k, uint64_t* row) const {
  const size_t words = words_for(grid.nx);
  if (std::all_of(row, row + words, [](uint64_t w) { return w == 0; })) return false;
  const auto decide = [&](uint64_t first, uint64_t end) {
    for (uint64_t i = first; i < end; ++i) {
      uint64_t& word = row[i / bits_per_word];
      const uint64_t bit = uint64_t{1} << i % bits_per_word;
      if (word & bit && !holds(grid.at(i, j, k))) word &= ~bit;
    }
  };
  const auto clear = [&](uint64_t first, uint64_t end) {
    for (uint64_t i = first; i < end;) {
      const uint64_t bit = i % bits_per_word,
                     count = std::min<uint64_t>(bits_per_word - bit, end - i);
      row[i / bits_per_word] &= ~(~uint64_t{0} >> (bits_per_word - count) << bit);
      i += count;
    }
  };
  const Vec3 start = grid.at(0, j, k);
  const double extent = grid.x(grid.nx - 1) - start.x;
  const Ray ray{start, {1, 0, 0}};
  const Passage passage(warp_, ray);
  constexpr double steep = 1e-3;
  // Of radii, with what the nearest point is off where the row is steep.
  const double slack = 0x1p4 * warp_.slack(start, 2 * extent);
  if (passage.speed > 0 && passage.speed < steep) {
    decide(0, grid.nx);
  } else {
    // [first, last) of the samples within a radius that surely are, or may be.
    struct Range {
      uint64_t first, last;
    };
    const auto within = [&](double radius) -> Range {
      const double half = passage.half(radius);
      if (half < 0) return {0, 0};
      if (half == infinity) return {0, grid.nx};
      const double at = start.x + passage.middle;
      const Range range{grid.first_x_from(at - half), grid.first_x_from<true>(at + half)};
      return range.first < range.last ? range : Range{0, 0};
    };
    const double inner = warp_.shell().inner, outer = warp_.outer();
    // Outwards: what is beyond the greater range is outside, what is in the smaller one inside.
    const auto keep = [&](double radius, bool keeps_within) {
      const Range sure = within(radius - slack), may = within(radius + slack);
      const bool has_sure = sure.first < sure.last;
      if (keeps_within) {
        clear(0, may.first);
        clear(may.last, grid.nx);
      } else if (has_sure) {
        clear(sure.first, sure.last);
      }
      if (!has_sure) return decide(may.first, may.last);
      decide(may.first, sure.first);
      decide(sure.last, may.last);
    };
    if (outer < infinity) keep(outer, true);
    if (inner > 0) keep(inner, false);
  }
  return std::any_of(row, row + words, [](uint64_t w) { return w != 0; });
}

}  // namespace msq
