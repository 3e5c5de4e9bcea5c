// SPDX-License-Identifier: Apache-2.0
// Rows, distances and rays of open meshes with the rule `automatic`: a point is inside if the
// generalised winding number, rounded half up, is not 0 (open_mesh.h).
#include <algorithm>
#include <limits>
#include <vector>

#include "base/job.h"
#include "shape/mesh.h"
#include "shape/triangle_rows.h"
#include "shape/whole_parts.h"

namespace msq {

uint64_t Mesh::layers_together() const {
  return open_ ? WholeParts::layers : 1;
}

void Mesh::fill_open_rows(const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const Box3& box = facts_.bounds;
  const uint64_t first = grid.first_x_from(box.min.x);
  const uint64_t end = grid.first_x_from<true>(box.max.x);
  const auto row_from = [&](uint64_t j) { return std::clamp(j, block.y0, block.y1); };
  const uint64_t first_row = row_from(grid.first_y_from(box.min.y));
  const uint64_t end_row = row_from(grid.first_y_from<true>(box.max.y));
  if (first >= end || first_row >= end_row) return;

  uint64_t first_layer = block.z0, end_layer = block.z1;
  while (first_layer < end_layer && grid.z(first_layer) < box.min.z) ++first_layer;
  while (first_layer < end_layer && grid.z(end_layer - 1) > box.max.z) --end_layer;
  // Of mesh and caps, by rows of the block.
  struct LayerCrossings {
    std::vector<uint32_t> row_ends;
    std::vector<RowCrossing> sorted;
  };
  const auto fill_row = [&](const WholeParts& parts, LayerCrossings& layer, uint64_t j,
                            uint64_t k) {
    check_cancelled();
    const uint64_t r = j - block.y0;
    RowCrossing* const row_begin = layer.sorted.data() + (r ? layer.row_ends[r - 1] : 0);
    RowCrossing* const row_end = layer.sorted.data() + layer.row_ends[r];
    std::sort(row_begin, row_end,
              [](const RowCrossing& a, const RowCrossing& b) { return a.x < b.x; });
    uint64_t* const row = block.row(j, k);
    for (uint64_t i = first, next; i < end; i = next) {
      const int64_t whole = parts.run(i, j, k, next);
      if (whole == WholeParts::not_proven) {
        for (; i < next; ++i)
          if (inside(grid.at(i, j, k))) set_bits(row, i, i);
      } else if (whole != 0 || row_begin != row_end) {
        fill_between(row_begin, row_end, grid, i, next, row,
                     [whole](int64_t winding) { return winding != whole; });
      }
    }
  };
  std::vector<RowCrossing> crossings;
  std::vector<LayerCrossings> layers(std::min(end_layer - first_layer, WholeParts::layers));
  for (uint64_t k0 = first_layer; k0 < end_layer; k0 += WholeParts::layers) {
    const uint64_t k1 = std::min(end_layer, k0 + WholeParts::layers);
    for (uint64_t k = k0; k < k1; ++k) {
      LayerCrossings& layer = layers[k - k0];
      crossings.clear();
      add_crossings(soup_, sheets_.at(box.min.y, grid.z(k)), block, k, crossings);
      add_crossings(open_->caps().soup(), open_->caps().at_height(grid.z(k)), block, k, crossings);
      sort_by_row(crossings, block.rows(), layer.row_ends, layer.sorted);
    }
    WholeParts parts(*open_, grid, {{first, first_row, k0}, {end, end_row, k1}});
    for (uint64_t j0 = first_row; j0 < end_row; j0 += WholeParts::band) {
      parts.set(j0);
      for (uint64_t k = k0; k < k1; ++k)
        for (uint64_t j = j0; j < std::min(end_row, j0 + WholeParts::band); ++j)
          fill_row(parts, layers[k - k0], j, k);
    }
  }
}

// Where the point lies in the box of the mesh, and in the solid, the box's faces bound that too.
// Outside the box, the solid is no nearer than the box; where the winding number is 0, no nearer
// than where that changes.
double Mesh::open_distance_bound(Vec3 p) const {
  const double of_triangles = boundary().distance_bound(p);
  const Vec3 low = facts_.bounds.min - p, high = p - facts_.bounds.max;
  const Vec3 gap = max(low, high);
  const bool is_in_box = max_component(gap) <= 0;
  const double of_box =
      (is_in_box ? -max_component(gap) : length(max(gap, Vec3{}))) * (1 - 0x1p-50);
  if (is_in_box && of_triangles == 0) return 0;
  const int64_t winding =
      count_crossings(soup_, columns_.at(p.y, p.z), p).beyond + open_->correction(p);
  if (winding != 0 && !is_in_box) return of_box;
  double bound = std::min(of_triangles, open_->distance_bound(p, winding, of_triangles));
  if (winding != 0) bound = std::min(bound, of_box);
  return is_in_box ? bound : std::max(bound, of_box);
}

// Between two crossings of triangles membership changes only where the winding number passes a
// half. A step is as long as that is proven not to, by a ball about it, else by the course of the
// winding number, and no less than LeastStep has it, which bounds their number. Next to a half no
// ball is small enough for the bounds of caps: there the course decides.
bool Mesh::find_between(const Ray& ray, double from, double to, bool wanted, double& t,
                        LeastStep& least, JobPoll& poll) const {
  const double tolerance = ray_tolerance();
  const auto is_wanted = [&](double at) { return inside(ray.at(at)) == wanted; };
  const auto is_steady = [&](double at, double step) {
    return open_->is_steady_in(ray.at(at + 0.5 * step), (0.5 + 0x1p-20) * step + tolerance);
  };
  if (is_wanted(from)) {
    t = from;
    return true;
  }
  double growth = 2;  // of a step that is proven at once
  for (double at = from, step = to - from; at < to; step *= growth) {
    poll();
    const double min_now = least.of_step(at);
    step = std::min(step, to - at);
    const double first = step;
    size_t tries = open_->tries_before_way();
    for (; step > min_now && !is_steady(at, step); step *= 0.5) {
      const bool is_last = open_->knows_way() && 0.5 * step <= min_now;
      if (tries > 0 && !is_last) {
        --tries;
        continue;
      }
      const Vec3 p = ray.at(at);
      const int64_t beyond = count_crossings(soup_, columns_.at(p.y, p.z), p).beyond;
      step = std::min(to - at, open_->steady_way(p, ray.direction, beyond));
      break;
    }
    growth = step < first ? 1 : 2;
    step = std::max(step, min_now);
    const double next = std::min(to, at + step);
    if (!(next > at)) return false;  // steps vanish in rounding
    if (is_wanted(next)) {
      t = bisect(at, next, tolerance, is_wanted);
      return true;
    }
    at = next;
  }
  return false;
}

// A triangle is crossed at one t, and each search begins behind the last crossing: there are no
// more rounds than triangles.
bool Mesh::find_along_open(const Ray& ray, double from, double to, bool wanted, double& t,
                           const Job* job) const {
  const double tolerance = ray_tolerance();
  LeastStep least(tolerance, tolerance, from);
  JobPoll poll(job);
  double at = from, crossing = from;
  bool crosses = true;
  for (double search_from = from - tolerance; crosses; search_from = at) {
    poll();
    const double before = crossing;
    Vec3 normal;
    crosses = boundary().first_crossing(ray, search_from, to, tolerance, crossing, normal);
    // What is crossed where the ray begins may be found a little before it.
    if (crosses) crossing = std::max(crossing, from);
    if (find_between(ray, at, crosses ? std::max(at, crossing - tolerance) : to, wanted, t, least,
                     poll)) {
      if (t == at && inside(ray.at(before)) == wanted) t = before;
      return true;
    }
    // Crossings closer than the tolerance are one.
    at = std::max(crossing + tolerance,
                  std::nextafter(crossing, std::numeric_limits<double>::infinity()));
    crosses = crosses && at <= to;
  }
  return false;
}

}  // namespace msq
