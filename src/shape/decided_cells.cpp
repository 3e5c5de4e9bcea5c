// SPDX-License-Identifier: Apache-2.0
#include "shape/decided_cells.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

constexpr double max_cells = uint64_t{1} << 18;
/// Along an axis.
constexpr double max_count = 512;
/// Cells of triangles' boxes that are examined, at most: a number, and so many per triangle.
constexpr uint64_t work_of_mesh = uint64_t{1} << 24, work_of_triangle = 64;

}  // namespace

DecidedCells::DecidedCells(const TriangleSoup& soup, const Box3& bounds,
                           const std::function<bool(Vec3)>& inside,
                           const std::shared_ptr<MemoryBudget>& budget, const Job* job)
    : origin_(bounds.min) {
  const Vec3 extent = bounds.extent();
  const double longest = std::max({extent.x, extent.y, extent.z});
  double magnitude = longest;
  for (int axis = 0; axis < 3; ++axis)
    magnitude = std::max({magnitude, std::abs(bounds.min[axis]), std::abs(bounds.max[axis])});
  margin_ = 0x1p-30 * magnitude;
  // Cubes, about as many as there may be.
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) volume *= std::max(extent[axis], longest / max_count);
  const double side = std::cbrt(volume / max_cells);
  for (int axis = 0; axis < 3; ++axis) {
    const double count = side > 0 ? std::clamp(std::floor(extent[axis] / side), 1.0, max_count) : 1;
    count_[axis] = static_cast<uint32_t>(count);
    size_[axis] = extent[axis] / count;
    scale_[axis] = size_[axis] > 0 ? 1 / size_[axis] : 0;
    // Cells must be much larger than rounding.
    if (!(size_[axis] > 16 * margin_)) count_[0] = 0;
  }
  if (count_[0] == 0) return;
  const size_t cells = size_t{count_[0]} * count_[1] * count_[2];
  if (!budget->try_take(cells)) {
    count_[0] = 0;
    return;
  }
  reservation_ = Reservation::adopt(budget, cells);
  sides_.assign(cells, Side::outside);
  uint64_t work = work_of_mesh + work_of_triangle * soup.triangles.size();
  JobPoll poll(job);
  for (const Triangle& triangle : soup.triangles) {
    poll();
    mark(soup, triangle, work);
    if (work > 0) continue;
    count_[0] = 0;
    sides_ = {};
    reservation_ = {};
    return;
  }
  // Free cells of a row that are next to each other are on one side.
  for (uint32_t k = 0; k < count_[2]; ++k)
    for (uint32_t j = 0; j < count_[1]; ++j) {
      poll();
      Side known = Side::unknown;
      for (uint32_t i = 0; i < count_[0]; ++i) {
        Side& here = sides_[at(i, j, k)];
        if (here == Side::unknown) {
          known = Side::unknown;
          continue;
        }
        if (known == Side::unknown)
          known = inside({origin_.x + (i + 0.5) * size_.x, origin_.y + (j + 0.5) * size_.y,
                          origin_.z + (k + 0.5) * size_.z})
                      ? Side::inside
                      : Side::outside;
        here = known;
      }
    }
}

/// Makes the cells unknown that a triangle's box and its plane come near.
void DecidedCells::mark(const TriangleSoup& soup, const Triangle& triangle, uint64_t& work) {
  Vec3 p[3];
  for (size_t n = 0; n < 3; ++n) p[n] = soup.vertices[triangle[n]];
  const Vec3 low = min(p[0], min(p[1], p[2])), high = max(p[0], max(p[1], p[2]));
  uint32_t first[3], last[3];
  uint64_t cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = cell(low[axis] - 2 * margin_, axis);
    last[axis] = cell(high[axis] + 2 * margin_, axis);
    cells *= last[axis] - first[axis] + 1;
  }
  work -= std::min(work, cells);
  if (work == 0) return;
  const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
  // Half the width of a cell along the normal, and as much again as rounding needs.
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis)
    reach += std::abs(normal[axis]) * (0.5 * size_[axis] + 4 * margin_);
  // The error of the normal, which is long only where the triangle is no needle.
  reach += 0x1p-46 * length(p[1] - p[0]) * length(p[2] - p[0]) *
           (length(high - low) + size_.x + size_.y + size_.z);
  for (uint32_t k = first[2]; k <= last[2]; ++k)
    for (uint32_t j = first[1]; j <= last[1]; ++j)
      for (uint32_t i = first[0]; i <= last[0]; ++i) {
        const Vec3 center{origin_.x + (i + 0.5) * size_.x, origin_.y + (j + 0.5) * size_.y,
                          origin_.z + (k + 0.5) * size_.z};
        if (!(std::abs(dot(normal, center - p[0])) > reach)) sides_[at(i, j, k)] = Side::unknown;
      }
}

DecidedCells::Side DecidedCells::side(Vec3 a, Vec3 b) const {
  if (count_[0] == 0) return Side::unknown;
  uint32_t first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t of_a = cell(a[axis], axis), of_b = cell(b[axis], axis);
    first[axis] = std::min(of_a, of_b);
    last[axis] = std::max(of_a, of_b);
    if (last[axis] - first[axis] > 1) return Side::unknown;
  }
  const Side side = sides_[at(first[0], first[1], first[2])];
  for (uint32_t k = first[2]; k <= last[2]; ++k)
    for (uint32_t j = first[1]; j <= last[1]; ++j)
      for (uint32_t i = first[0]; i <= last[0]; ++i)
        if (sides_[at(i, j, k)] != side) return Side::unknown;
  return side;
}

}  // namespace msq
