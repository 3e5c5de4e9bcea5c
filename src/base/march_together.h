// SPDX-License-Identifier: Apache-2.0
// Rays that march together, so that a host evaluates many points per callback.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/ray.h"

namespace msq {

/// The next point to evaluate for one of a set of searches.
struct MarchPoint {
  uint32_t search;
  double t;
  bool is_settling;  ///< only membership is needed
};

/// As RayMarch::find() for each search. It finds points that are `there`: the caller decides
/// whether that means inside or outside. It does not compute normals. ask(points, there, steps)
/// sets there[i], which is 1, to 0 if point i is not there. For those points that are not settling
/// either, it sets steps[i], which is 0, to a length along the ray within which no point is there.
/// The march continues by that length, but at least by min_step and by the search's tolerance,
/// tolerance_of(search).
template <class Tolerance, class Ask>
void march_together(RaySearch* searches, size_t count, double min_step, Tolerance&& tolerance_of,
                    const Job* job, Ask&& ask) {
  std::vector<MarchPoint> points;
  std::vector<double> before(count), beyond(count);  // of the settling searches: not there, there
  std::vector<double> tolerances(count);
  std::vector<LeastStep> least(count);
  for (size_t i = 0; i < count; ++i) {
    const double tolerance = tolerances[i] = tolerance_of(searches[i]);
    searches[i].found = false;
    searches[i].normal = {};
    before[i] = searches[i].from;
    least[i] = LeastStep(std::max(min_step, tolerance), tolerance, searches[i].from);
    if (searches[i].from <= searches[i].to)
      points.push_back({static_cast<uint32_t>(i), searches[i].from, false});
  }
  std::vector<uint8_t> there;
  std::vector<double> steps;
  while (!points.empty()) {
    check_cancelled(job);
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
          if (p.t > low) points[kept++] = p;  // otherwise steps vanish in rounding
          continue;
        }
      }
      const double middle = 0.5 * (low + high);
      if (high - low > tolerances[p.search] && middle > low && middle < high) {
        points[kept++] = {p.search, middle, true};
        continue;
      }
      search.found = true;
      search.t = high;
    }
    points.resize(kept);
  }
}

/// The same, but evaluates the membership of all points first, then bounds for those that continue.
/// keep(points, there, count) works as `ask` does. bound(queried, points, bounds) sets bounds[i] to
/// a radius around point i, or a length along its ray, within which no point is there.
template <class Tolerance, class Keep, class Bound>
void march_by_bounds(RaySearch* searches, size_t count, double min_step, Tolerance&& tolerance_of,
                     const Job* job, Keep&& keep, Bound&& bound) {
  std::vector<Vec3> points, near;
  std::vector<MarchPoint> going_on;
  std::vector<size_t> index;
  std::vector<double> bounds;
  const auto ask = [&](const std::vector<MarchPoint>& queried, uint8_t* there, double* steps) {
    points.clear();
    near.clear();
    going_on.clear();
    index.clear();
    for (const MarchPoint& p : queried) points.push_back(searches[p.search].ray.at(p.t));
    keep(points.data(), there, points.size());
    for (size_t i = 0; i < queried.size(); ++i) {
      if (there[i] || queried[i].is_settling) continue;
      near.push_back(points[i]);
      going_on.push_back(queried[i]);
      index.push_back(i);
    }
    if (near.empty()) return;
    bounds.assign(near.size(), 0);
    bound(going_on, near.data(), bounds.data());
    for (size_t i = 0; i < near.size(); ++i) steps[index[i]] = bounds[i];
  };
  march_together(searches, count, min_step, tolerance_of, job, ask);
}

}  // namespace msq
