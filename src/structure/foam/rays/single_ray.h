// SPDX-License-Identifier: Apache-2.0
// Single rays through a foam, from cell to cell: for so few rays per cell that packets of them
// spread over several cells.
#pragma once

#include <algorithm>

#include "base/grid_walk.h"
#include "structure/foam/rays/ray_struts.h"

namespace msq {

template <class Struts>
class SingleRay {
 public:
  SingleRay(const FoamData& foam, RayStruts<Struts>& struts, const Job* job)
      : scale_(foam.seeds().scale()), struts_(struts), job_(job) {}

  /// Continues from `from`; the ray meets nothing before.
  void walk(const FoamRay& ray, double from, RaySearch& search) {
    first_.clear();
    const auto at_end = [&ray] { return ray.at(ray.to); };
    walk_grid({ray.origin, ray.direction}, ray.at(from), at_end, scale_, from, ray.to, job_,
              [&](const int64_t(&index)[3], double in, double out) {
                const CellIndex cell{static_cast<int32_t>(index[0]), static_cast<int32_t>(index[1]),
                                     static_cast<int32_t>(index[2])};
                return !ends_in(cell, ray, in, out, search);
              });
  }

 private:
  void forget() {
    struts_.forget();
    first_.queried.clear();  // the ids now belong to others
  }

  /// Whether the ray meets a strut in a cell that it crosses from `in` to `out`.
  bool ends_in(CellIndex cell, const FoamRay& ray, double in, double out, RaySearch& search) {
    const float radius = struts_.radius_in(cell);
    if (radius < 0) return false;
    if (struts_.lists().is_full()) forget();
    const CapsuleView& list = struts_.lists().list(cell);
    // The list contains all struts that the ray may meet up to here.
    const double last = std::min(ray.to, out + 0.5 * ray_list_margin);
    const Vec3 place = ray.at(in);
    const int32_t at[3] = {cell.x, cell.y, cell.z};
    CapsuleRay near;
    for (int axis = 0; axis < 3; ++axis) {
      near.origin[axis] = static_cast<float>(place[axis] - at[axis] * scale_[axis]);
      near.direction[axis] = static_cast<float>(ray.direction[axis]);
    }
    near.to = static_cast<float>(last - in) + along_rounding;
    struts_.ask(ray, list, radius, near, in, first_);
    if (!first_.entry.is_met || first_.entry.t > last) return false;
    struts_.take(first_.entry, search);
    return true;
  }

  const Vec3 scale_;
  RayStruts<Struts>& struts_;
  const Job* const job_;
  FirstEntry first_;  // of the current ray
};

}  // namespace msq
