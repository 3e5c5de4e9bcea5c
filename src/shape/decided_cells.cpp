// SPDX-License-Identifier: Apache-2.0
#include "shape/decided_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msq {

namespace {

constexpr double max_cells = uint64_t{1} << 18;
/// Along an axis.
constexpr double max_count = 512;
constexpr int8_t max_distance = 127;
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
  max_origin_ = 0x1p12 * magnitude;
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
  distances_.assign(cells, 1);
  uint64_t work = work_of_mesh + work_of_triangle * soup.triangles.size();
  JobPoll poll(job);
  for (const Triangle& triangle : soup.triangles) {
    poll();
    mark(soup, triangle, work);
    if (work > 0) continue;
    count_[0] = 0;
    distances_ = std::vector<Distance>();
    reservation_ = {};
    return;
  }
  decide(inside, poll);
  find_distances(poll);
}

/// Sets the sides of all cells that no triangle comes near.
void DecidedCells::decide(const std::function<bool(Vec3)>& inside, JobPoll& poll) {
  // Such cells of a row that are next to each other are on one side.
  for (uint32_t k = 0; k < count_[2]; ++k)
    for (uint32_t j = 0; j < count_[1]; ++j) {
      poll();
      Distance known = 0;
      for (uint32_t i = 0; i < count_[0]; ++i) {
        Distance& here = distances_[at(i, j, k)];
        if (here == 0) {
          known = 0;
          continue;
        }
        if (known == 0)
          known = inside({origin_.x + (i + 0.5) * size_.x, origin_.y + (j + 0.5) * size_.y,
                          origin_.z + (k + 0.5) * size_.z})
                      ? max_distance
                      : -max_distance;
        here = known;
      }
    }
}

/// The distance to the nearest cell of another side, in cells along the axis where they are
/// farthest apart: one pass from the first cell and one from the last, each over the neighbours
/// that it has passed (Rosenfeld and Pfaltz, "Distance functions on digital pictures", 1968).
void DecidedCells::find_distances(JobPoll& poll) {
  const auto pass = [&](int64_t step) {
    const auto place = [&](uint32_t n, uint32_t count) { return step > 0 ? n : count - 1 - n; };
    const auto exists = [&](int64_t n, uint32_t count) { return n >= 0 && n < count; };
    for (uint32_t z = 0; z < count_[2]; ++z)
      for (uint32_t y = 0; y < count_[1]; ++y) {
        poll();
        const int64_t k = place(z, count_[2]), j = place(y, count_[1]);
        for (uint32_t x = 0; x < count_[0]; ++x) {
          const int64_t i = place(x, count_[0]);
          Distance& here = distances_[at(i, j, k)];
          if (here == 0) continue;
          const Distance side = here > 0 ? 1 : -1;
          int distance = std::abs(here);
          // The 13 neighbours before this one in the order of the pass.
          for (int n = 0; n < 13 && distance > 1; ++n) {
            const int64_t u = i + step * (n % 3 - 1), v = j + step * (n / 3 % 3 - 1),
                          w = k + step * (n / 9 - 1);
            if (!exists(u, count_[0]) || !exists(v, count_[1]) || !exists(w, count_[2])) continue;
            distance = std::min(distance, std::max(0, side * distances_[at(u, v, w)]) + 1);
          }
          here = static_cast<Distance>(side * distance);
        }
      }
  };
  pass(1);
  pass(-1);
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
        if (!(std::abs(dot(normal, center - p[0])) > reach)) distances_[at(i, j, k)] = 0;
      }
}

DecidedCells::Side DecidedCells::side(Vec3 p) const {
  if (count_[0] == 0) return Side::unknown;
  const Distance distance = distances_[at(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2))];
  return distance == 0 ? Side::unknown : distance > 0 ? Side::inside : Side::outside;
}

bool DecidedCells::is_box_on(Distance side, Vec3 a, Vec3 b) const {
  uint32_t first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const uint32_t of_a = cell(a[axis], axis), of_b = cell(b[axis], axis);
    first[axis] = std::min(of_a, of_b);
    last[axis] = std::max(of_a, of_b);
    if (last[axis] - first[axis] > 1) return false;
  }
  for (uint32_t k = first[2]; k <= last[2]; ++k)
    for (uint32_t j = first[1]; j <= last[1]; ++j)
      for (uint32_t i = first[0]; i <= last[0]; ++i)
        if (side * distances_[at(i, j, k)] <= 0) return false;
  return true;
}

bool DecidedCells::is_on_one_side(const Ray& ray, double from, double to) const {
  if (count_[0] == 0 || !(max_magnitude(ray.origin) <= max_origin_)) return false;
  // Crosses at most the side of one cell along an axis.
  double step = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    if (ray.direction[axis] != 0)
      step = std::min(step, (1 - 0x1p-10) * size_[axis] / std::abs(ray.direction[axis]));
  Vec3 p = ray.at(from);
  for (Distance side = 0;;) {
    const Distance distance = distances_[at(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2))];
    if (side == 0) side = distance > 0 ? 1 : -1;
    // Unknown, or another side: rounding of a far ray has left the cells that were proved.
    if (side * distance <= 0) return false;
    const int cells = std::abs(distance) - 1;
    const double next = std::min(to, from + std::max(1, cells) * step);
    if (!(next > from)) return false;
    const Vec3 q = ray.at(next);
    if (cells == 0 && !is_box_on(side, p, q)) return false;
    if (next == to) return true;
    from = next;
    p = q;
  }
}

}  // namespace msq
