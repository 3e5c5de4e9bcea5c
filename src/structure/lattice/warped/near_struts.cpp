// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/warped/near_struts.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"

namespace msq {

namespace {

/// Whether a segment meets a box; if in doubt, true.
bool meets(Vec3 a, Vec3 b, const Box3& box) {
  double low = 0, high = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::max(a[axis], b[axis]) < box.min[axis] || std::min(a[axis], b[axis]) > box.max[axis])
      return false;
    const double inverse = 1 / (b[axis] - a[axis]);
    if (!std::isfinite(inverse)) continue;
    const double one = (box.min[axis] - a[axis]) * inverse,
                 other = (box.max[axis] - a[axis]) * inverse;
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
  }
  return low <= high + 1e-9;
}

}  // namespace

NearStruts::NearStruts(const PlacedGraph& graph, CellIndex list, double widened, double reach) {
  const CellPlaces& places = graph.places();
  const Box3 bounds = places.list_bounds(list);
  box_ = bounds.grown(0.5 * widened);
  const Box3 all = bounds.grown(widened + reach * (1 + 1e-9));
  struct Near {
    Segment axis;
    double factor;
  };
  std::vector<Near> near;
  std::vector<Vec3> corners;
  places.for_each_cell(
      all, [&](const Box3& other) { return other.overlaps(all); },
      [&](CellIndex other) {
        check_cancelled();
        graph.place(other, corners);
        for (const PlacedGraph::Strut& s : graph.struts_of(other))
          if (graph.is_placed(corners, s) && meets(corners[s.a], corners[s.b], all))
            near.push_back({Segment(corners[s.a], corners[s.b]), s.factor});
      });
  std::stable_sort(near.begin(), near.end(),
                   [](const Near& s, const Near& t) { return s.factor > t.factor; });
  for (const Near& s : near) struts_.add(s.axis, s.factor);
  struts_.finish();
}

bool NearStruts::holds(Vec3 q, double r) const {
  for (size_t i = 0; i < struts_.size(); ++i)
    if (LatticeStrut{struts_.axis(i), struts_.factor(i)}.holds(q, r)) return true;
  return false;
}

}  // namespace msq
