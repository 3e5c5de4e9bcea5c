// SPDX-License-Identifier: Apache-2.0
#include "shape/host.h"

#include <limits>
#include <vector>

namespace msq {

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
  Vec3 asked[host_batch];
  size_t index[host_batch];
  uint8_t answers[host_batch];
  for (size_t next = 0; next < count;) {
    size_t size = 0;
    for (; next < count && size < host_batch; ++next) {
      inside[next] = 0;
      if (!bounds().contains(points[next])) continue;
      asked[size] = points[next];
      index[size++] = next;
    }
    if (size == 0) continue;
    calls_.inside(asked, size, answers);
    for (size_t i = 0; i < size; ++i) inside[index[i]] = answers[i] != 0;
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

double HostShape::clearance(Vec3 p) const {
  const Vec3 gap = max(max(bounds().min - p, p - bounds().max), Vec3{});
  // Less the rounding of the differences and of the length.
  const double outside = length(gap) * (1 - 0x1p-50);
  if (!calls_.distance) return outside;
  double bound;
  calls_.distance(&p, 1, &bound);
  if (!std::isfinite(bound))
    fail(Status::host, "the host's shape has the distance %g at (%g, %g, %g); it must be finite",
         bound, p.x, p.y, p.z);
  return std::max(outside, std::abs(bound));
}

}  // namespace msq
