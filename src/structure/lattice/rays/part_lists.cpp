// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/rays/part_lists.h"

#include <algorithm>

#include "base/job.h"
#include "structure/lattice/cell/may_reach.h"

namespace msq {

namespace {

/// Parts are halved until they list that few struts on average: a vector or two.
constexpr size_t few_struts = 8;
constexpr int max_parts = 8;

}  // namespace

CellParts::CellParts(const std::vector<LatticeStrut>& near, Vec3 cell_size, double most) {
  std::vector<std::vector<uint32_t>> lists(1), halves;  // by part
  for (uint32_t i = 0; i < near.size(); ++i) lists[0].push_back(i);
  size_t listed = near.size();
  while (listed > few_struts * lists.size() && parts_ < max_parts) {
    const int sides = 2 * parts_;
    const Vec3 size = cell_size * (1.0 / sides);
    const double slack = 1e-6 * max_component(cell_size);
    halves.assign(lists.size() * 8, {});
    listed = 0;
    for (int z = 0; z < sides; ++z)
      for (int y = 0; y < sides; ++y)
        for (int x = 0; x < sides; ++x) {
          check_cancelled();
          const Vec3 low = Vec3{double(x), double(y), double(z)} * size;
          const Box3 box = Box3{low, low + size}.grown(slack);
          auto& list = halves[static_cast<size_t>((z * sides + y) * sides + x)];
          for (const uint32_t i :
               lists[static_cast<size_t>((z / 2 * parts_ + y / 2) * parts_ + x / 2)])
            if (may_reach(near[i].axis, box, near[i].factor * most)) list.push_back(i);
          listed += list.size();
        }
    parts_ = sides;
    lists.swap(halves);
  }
  for (const std::vector<uint32_t>& list : lists) {
    const auto begin = static_cast<uint32_t>(struts_.size());
    for (const uint32_t i : list) struts_.add(near[i].axis, near[i].factor);
    runs_.push_back({begin, static_cast<uint32_t>(struts_.size())});
    max_struts_ = std::max(max_struts_, list.size());
  }
  struts_.finish();
}

}  // namespace msq
