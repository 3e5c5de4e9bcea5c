// SPDX-License-Identifier: Apache-2.0
#include "query/inside_points.h"

#include "query/array_points.h"
#include "query/membership.h"

namespace msq {

void find_inside(const Model& model, const Scales& resolved, const std::vector<Vec3>& points,
                 std::vector<uint8_t>& inside, const Job* job) {
  /// Fewer are not worth sorting by cell.
  constexpr size_t few = 256;
  inside.resize(points.size());
  if (points.empty()) return;
  check_cancelled(job);
  Job part(job);
  if (points.size() < few) {
    ask_points(model, resolved, {}, points.data(), inside.data(), points.size(), &part);
    return;
  }
  PointArray array;
  array.data = reinterpret_cast<const unsigned char*>(points.data());
  array.count = points.size();
  array.stride = sizeof(Vec3);
  set_membership(model, resolved, ArrayPoints(array), {}, inside.data(), &part);
}

}  // namespace msq
