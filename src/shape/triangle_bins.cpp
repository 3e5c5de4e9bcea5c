// SPDX-License-Identifier: Apache-2.0
#include "shape/triangle_bins.h"

#include <algorithm>
#include <cmath>

namespace msq {

uint32_t bins_for(uint64_t triangles, double power, uint32_t maximum) {
  return static_cast<uint32_t>(std::clamp(std::pow(static_cast<double>(triangles), power), 1.0,
                                          static_cast<double>(maximum)));
}

void TriangleBins::set_counts(const Box3& bounds, uint32_t ny, uint32_t nz) {
  const Vec3 e = bounds.extent();
  ny_ = e.y > 0 ? std::max(1u, ny) : 1;
  nz_ = e.z > 0 ? std::max(1u, nz) : 1;
  y0_ = bounds.min.y;
  z0_ = bounds.min.z;
  // An extent so small that its inverse is not finite gets one bin: every coordinate maps to it.
  y_scale_ = ny_ > 1 ? ny_ / e.y : 0;
  z_scale_ = nz_ > 1 ? nz_ / e.z : 0;
  if (!std::isfinite(y_scale_)) ny_ = 1, y_scale_ = 0;
  if (!std::isfinite(z_scale_)) nz_ = 1, z_scale_ = 0;
}

TriangleBins::TriangleBins(const TriangleSoup& soup, const Box3& bounds, uint32_t max_y,
                           uint32_t max_z, const Job* job) {
  CancelPoll poll(job);
  struct Bins {
    uint32_t y0, y1, z0, z1;
  };
  const auto bins_of = [&](const Triangle& t) {
    poll();
    const Vec3 &a = soup.vertices[t[0]], &b = soup.vertices[t[1]], &c = soup.vertices[t[2]];
    const Vec3 low = min(min(a, b), c), high = max(max(a, b), c);
    return Bins{bin_y(low.y), bin_y(high.y), bin_z(low.z), bin_z(high.z)};
  };
  const uint64_t most = 8 * static_cast<uint64_t>(soup.triangles.size()) + 4096;
  uint64_t total = 0;
  for (set_counts(bounds, max_y, max_z);; set_counts(bounds, ny_ / 2, nz_ / 2)) {
    total = 0;
    for (const Triangle& t : soup.triangles) {
      const Bins b = bins_of(t);
      total += static_cast<uint64_t>(b.y1 - b.y0 + 1) * (b.z1 - b.z0 + 1);
    }
    if (total <= most || (ny_ == 1 && nz_ == 1)) break;
  }
  starts_.assign(static_cast<size_t>(ny_) * nz_ + 1, 0);
  entries_.resize(total);
  const auto for_each_bin = [&](const Triangle& t, auto&& visit) {
    const Bins b = bins_of(t);
    for (uint32_t z = b.z0; z <= b.z1; ++z)
      for (uint32_t y = b.y0; y <= b.y1; ++y) visit(static_cast<size_t>(z) * ny_ + y);
  };
  for (const Triangle& t : soup.triangles) for_each_bin(t, [&](size_t bin) { ++starts_[bin + 1]; });
  for (size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<uint64_t> next(starts_.begin(), starts_.end() - 1);
  for (uint32_t i = 0; i < soup.triangles.size(); ++i)
    for_each_bin(soup.triangles[i], [&](size_t bin) { entries_[next[bin]++] = i; });
}

}  // namespace msq
