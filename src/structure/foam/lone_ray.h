// SPDX-License-Identifier: Apache-2.0
// Single rays through a foam, from cell to cell: where so few rays come through a cell that packets
// of them spread over several.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "structure/foam/ray_struts.h"

namespace msq {

template <class Struts>
class LoneRay {
 public:
  LoneRay(const Foam& foam, RayStruts<Struts>& struts)
      : scale_(foam.seeds().scale()), struts_(struts) {}

  /// Goes on from `from`, before which the ray meets nothing.
  void walk(const FoamRay& ray, double from, RaySearch& search) {
    const Vec3 begin = ray.at(from);
    first_.clear();
    int32_t cell[3];
    double inverse[3], next[3];  // next: where the ray leaves the cell across an axis
    const auto leaves = [&](int axis) {
      if (!(std::abs(ray.direction[axis]) > 1e-200)) return std::numeric_limits<double>::infinity();
      const double plane = (cell[axis] + (ray.direction[axis] > 0)) * scale_[axis];
      return (plane - ray.origin[axis]) * inverse[axis];
    };
    for (int axis = 0; axis < 3; ++axis) {
      cell[axis] = static_cast<int32_t>(std::floor(begin[axis] / scale_[axis]));
      inverse[axis] = 1 / ray.direction[axis];
      next[axis] = leaves(axis);
    }
    while (true) {
      const int axis =
          next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
      const double out = next[axis];
      if (ends_in({cell[0], cell[1], cell[2]}, ray, from, out, search)) return;
      if (!(out < ray.to)) return;
      cell[axis] += ray.direction[axis] > 0 ? 1 : -1;
      next[axis] = leaves(axis);
      from = std::max(from, out);
    }
  }

 private:
  void forget() {
    struts_.forget();
    first_.asked.clear();  // those ids are of others by now
  }

  /// Whether the ray meets a strut in a cell, which it is in from `in` to `out`.
  bool ends_in(CellIndex cell, const FoamRay& ray, double in, double out, RaySearch& search) {
    const float radius = struts_.radius_in(cell);
    if (radius < 0) return false;
    if (struts_.lists().is_full()) forget();
    const CapsuleView& list = struts_.lists().list(cell);
    // Up to where the list holds all that the ray may meet.
    const double last = std::min(ray.to, out + 0.5 * ray_list_margin);
    const Vec3 place = ray.at(in);
    const int32_t at[3] = {cell.x, cell.y, cell.z};
    CapsuleRay near;
    for (int axis = 0; axis < 3; ++axis) {
      near.origin[axis] = static_cast<float>(place[axis] - at[axis] * scale_[axis]);
      near.direction[axis] = static_cast<float>(ray.direction[axis]);
    }
    near.to = static_cast<float>(last - in) + 4e-6f;  // room for roundings
    struts_.ask(ray, list, radius, near, first_);
    if (!first_.entry.is_met || first_.entry.t > last) return false;
    struts_.take(first_.entry, search);
    return true;
  }

  const Vec3 scale_;
  RayStruts<Struts>& struts_;
  FirstEntry first_;  // of the ray at hand
};

}  // namespace msq
