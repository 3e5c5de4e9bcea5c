// SPDX-License-Identifier: Apache-2.0
#include "shape/host.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/borrowed.h"
#include "base/infinity.h"
#include "base/march_together.h"
#include "base/ray_normal.h"

namespace msq {

namespace {

/// Memory of a callback.
struct Batch {
  Vec3 points[host_batch];
  size_t index[host_batch];
  uint8_t answers[host_batch];
};

}  // namespace

HostShape::HostShape(HostShapeCalls calls, const Box3& bounds, bool is_concurrent)
    : calls_(std::move(calls)), is_concurrent_(is_concurrent) {
  facts_.bounds = bounds;
  facts_.volume = facts_.area = std::numeric_limits<double>::quiet_NaN();
}

bool HostShape::inside(Vec3 p) const {
  if (!bounds().contains(p)) return false;
  uint8_t inside;
  calls_.inside(&p, 1, &inside);
  return inside != 0;
}

void HostShape::find_inside(const Vec3* points, size_t count, uint8_t* inside) const {
  const Borrowed<Batch> batch;
  for (size_t next = 0; next < count;) {
    size_t size = 0;
    for (; next < count && size < host_batch; ++next) {
      inside[next] = 0;
      if (!bounds().contains(points[next])) continue;
      batch->points[size] = points[next];
      batch->index[size++] = next;
    }
    if (size == 0) continue;
    calls_.inside(batch->points, size, batch->answers);
    for (size_t i = 0; i < size; ++i) inside[batch->index[i]] = batch->answers[i] != 0;
  }
}

void HostShape::fill_rows(const RowBlock& block) const {
  struct Sample {
    uint64_t* row;
    uint64_t i;
  };
  std::vector<Vec3> points;
  std::vector<Sample> samples;
  uint8_t answers[host_batch];
  points.reserve(host_batch);
  samples.reserve(host_batch);
  const auto ask = [&] {
    if (points.empty()) return;
    calls_.inside(points.data(), points.size(), answers);
    for (size_t s = 0; s < samples.size(); ++s)
      if (answers[s]) set_bits(samples[s].row, samples[s].i, samples[s].i);
    points.clear();
    samples.clear();
  };
  for_each_row_in_bounds(block,
                         [&](double y, double z, uint64_t* row, uint64_t first, uint64_t end) {
                           for (uint64_t i = first; i < end; ++i) {
                             points.push_back({block.grid->x(i), y, z});
                             samples.push_back({row, i});
                             if (points.size() == host_batch) ask();
                           }
                         });
  ask();
}

double HostShape::distance_bound(Vec3 p) const {
  double bound;
  find_distance_bounds(&p, 1, &bound);
  return bound;
}

void HostShape::find_distance_bounds(const Vec3* points, size_t count, double* bounds) const {
  if (calls_.distance)
    for (size_t first = 0; first < count; first += host_batch)
      calls_.distance(points + first, std::min(host_batch, count - first), bounds + first);
  else
    std::fill_n(bounds, count, 0.0);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = points[i];
    if (!std::isfinite(bounds[i]))
      fail(Status::host, "the host's shape has the distance %g at (%g, %g, %g); it must be finite",
           bounds[i], p.x, p.y, p.z);
    const Vec3 gap = max(max(this->bounds().min - p, p - this->bounds().max), Vec3{});
    // Minus the rounding of the differences and of the length.
    bounds[i] = std::max(length(gap) * (1 - 0x1p-50), std::abs(bounds[i]));
  }
}

void HostShape::march_all(bool wanted, RaySearch* searches, size_t count, const Job* job) const {
  march_by_bounds(
      searches, count, min_ray_step(), [this](const RaySearch&) { return ray_tolerance(); }, job,
      [&](const Vec3* points, uint8_t* there, size_t n) {
        find_inside(points, n, there);
        for (size_t i = 0; i < n; ++i) there[i] = there[i] == static_cast<uint8_t>(wanted);
      },
      [&](const std::vector<MarchPoint>& queried, const Vec3* points, double* bounds) {
        find_distance_bounds(points, queried.size(), bounds);
      });
}

void HostShape::enter_all(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    if (!clip_to_box(s.ray, bounds(), s.from, s.to)) s.to = -infinity;
  }
  march_all(true, searches, count, job);
}

void HostShape::leave_all(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.t = s.from;
    if (!clip_to_box(s.ray, bounds(), s.from, s.to)) s.to = -infinity;
  }
  march_all(false, searches, count, job);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    if (!s.found && s.to > -infinity) s.t = s.to;
  }
}

void HostShape::find_normals(RaySearch* searches, size_t count) const {
  normals_by_membership(
      [this](const Vec3* points, uint8_t* inside, size_t n) { find_inside(points, n, inside); },
      searches, count, normal_distance(), [](const RaySearch&) { return true; });
}

void HostShape::describe(HashInput& input) const {
  input.kind("shape: host");
  user_.describe(input, "shape");
  input.point(bounds().min);
  input.point(bounds().max);
  input.integer(calls_.distance ? 1 : 0);
}

}  // namespace msq
