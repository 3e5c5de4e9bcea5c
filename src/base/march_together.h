// SPDX-License-Identifier: Apache-2.0
// Rays that march together, so that a host is asked for many points at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/ray.h"

namespace msq {

/// Where each of a set of searches is to be asked next.
struct MarchPoint {
  uint32_t search;
  double t;
  bool is_settling;  ///< only whether it is there is asked for
};

/// As RayMarch::find() for each search, of points that are `there`, inside or outside as the caller
/// has it: its normal is left to others. ask(points, there, steps) sets there[i], which is 1, to 0
/// where point i is not, and, of those that are not settling either, steps[i], which is 0, to how
/// much farther along the ray none is: those go on by that, and by no less than least_step.
template <class Ask>
void march_together(RaySearch* searches, size_t count, double least_step, double tolerance,
                    Ask&& ask) {
  std::vector<MarchPoint> points;
  std::vector<double> before(count), beyond(count);  // of the settling: not there, there
  std::vector<LeastStep> least(count);
  for (size_t i = 0; i < count; ++i) {
    searches[i].found = false;
    searches[i].normal = {};
    before[i] = searches[i].from;
    least[i] = LeastStep(least_step, tolerance, searches[i].from);
    if (searches[i].from <= searches[i].to)
      points.push_back({static_cast<uint32_t>(i), searches[i].from, false});
  }
  std::vector<uint8_t> there;
  std::vector<double> steps;
  while (!points.empty()) {
    there.assign(points.size(), 1);
    steps.assign(points.size(), 0);
    ask(points, there.data(), steps.data());
    size_t kept = 0;
    for (size_t n = 0; n < points.size(); ++n) {
      MarchPoint p = points[n];
      RaySearch& search = searches[p.search];
      double& low = before[p.search];
      double& high = beyond[p.search];
      if (there[n]) {
        high = p.t;
      } else {
        low = p.t;
        if (!p.is_settling) {
          if (p.t >= search.to) continue;
          p.t = std::min(search.to, p.t + std::max(steps[n], least[p.search].of_step(p.t)));
          if (p.t > low) points[kept++] = p;  // else steps vanish in rounding
          continue;
        }
      }
      const double middle = 0.5 * (low + high);
      if (high - low > tolerance && middle > low && middle < high) {
        points[kept++] = {p.search, middle, true};
        continue;
      }
      search.found = true;
      search.t = high;
    }
    points.resize(kept);
  }
}

/// The same, with membership asked of all points and then bounds of those that go on:
/// keep(points, there, count) as `ask` says, bound(asked, points, bounds) up to how far about each
/// point, or along its ray, none is there.
template <class Keep, class Bound>
void march_by_bounds(RaySearch* searches, size_t count, double least_step, double tolerance,
                     Keep&& keep, Bound&& bound) {
  std::vector<Vec3> points, near;
  std::vector<MarchPoint> going_on;
  std::vector<size_t> index;
  std::vector<double> bounds;
  const auto ask = [&](const std::vector<MarchPoint>& asked, uint8_t* there, double* steps) {
    points.clear();
    near.clear();
    going_on.clear();
    index.clear();
    for (const MarchPoint& p : asked) points.push_back(searches[p.search].ray.at(p.t));
    keep(points.data(), there, points.size());
    for (size_t i = 0; i < asked.size(); ++i) {
      if (there[i] || asked[i].is_settling) continue;
      near.push_back(points[i]);
      going_on.push_back(asked[i]);
      index.push_back(i);
    }
    if (near.empty()) return;
    bounds.assign(near.size(), 0);
    bound(going_on, near.data(), bounds.data());
    for (size_t i = 0; i < near.size(); ++i) steps[index[i]] = bounds[i];
  };
  march_together(searches, count, least_step, tolerance, ask);
}

}  // namespace msq
