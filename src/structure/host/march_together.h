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
  bool is_settling;  ///< only membership is asked for
};

/// As RayMarch::find() for each search, of points inside. ask(points, inside, steps) says of each
/// point whether it is inside, and, of those outside that are not settling, up to how much farther
/// along the ray all is outside: those go on by that, and by no less than least_step.
template <class Ask>
void march_together(RaySearch* searches, size_t count, double least_step, double tolerance,
                    Ask&& ask) {
  std::vector<MarchPoint> points;
  std::vector<double> before(count), beyond(count);  // of the settling: outside, inside
  for (size_t i = 0; i < count; ++i) {
    searches[i].found = false;
    searches[i].normal = {};
    before[i] = searches[i].from;
    if (searches[i].from <= searches[i].to)
      points.push_back({static_cast<uint32_t>(i), searches[i].from, false});
  }
  std::vector<uint8_t> inside;
  std::vector<double> steps;
  while (!points.empty()) {
    inside.assign(points.size(), 1);
    steps.assign(points.size(), 0);
    ask(points, inside.data(), steps.data());
    size_t kept = 0;
    for (size_t n = 0; n < points.size(); ++n) {
      MarchPoint p = points[n];
      RaySearch& search = searches[p.search];
      double& low = before[p.search];
      double& high = beyond[p.search];
      if (inside[n]) {
        high = p.t;
      } else {
        low = p.t;
        if (!p.is_settling) {
          if (p.t >= search.to) continue;
          p.t = std::min(search.to, p.t + std::max(steps[n], least_step));
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

}  // namespace msq
