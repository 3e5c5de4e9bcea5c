// SPDX-License-Identifier: Apache-2.0
// Triangles binned by their y and z extent, as compressed rows.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/triangle_soup.h"

namespace msq {

/// The number of triangles to a power, from 1 to the maximum: how many bins pay.
uint32_t bins_for(uint64_t triangles, double power, uint32_t maximum);

class TriangleBins {
 public:
  TriangleBins() = default;
  /// At most max_y by max_z bins, fewer if long triangles would fill too many of them: the total
  /// stays below about 8 entries per triangle. Throws Error(cancelled) if the job, which may be
  /// null, is cancelled.
  TriangleBins(const TriangleSoup& soup, const Box3& bounds, uint32_t max_y, uint32_t max_z,
               const Job* job);

  struct Range {
    const uint32_t *first, *last;
    const uint32_t* begin() const { return first; }
    const uint32_t* end() const { return last; }
  };
  /// The triangles whose y, z box may contain a point within the bounds, each once.
  Range at(double y, double z) const {
    const size_t bin = static_cast<size_t>(bin_z(z)) * ny_ + bin_y(y);
    return {entries_.data() + starts_[bin], entries_.data() + starts_[bin + 1]};
  }
  uint64_t bytes() const {
    return entries_.capacity() * sizeof(uint32_t) + starts_.capacity() * sizeof(uint64_t);
  }

 private:
  // Monotone in the coordinate, hence a triangle's bins enclose those of its points.
  static uint32_t bin(double v, double origin, double scale, uint32_t count) {
    const double b = (v - origin) * scale;
    return b <= 0 ? 0 : b >= count ? count - 1 : static_cast<uint32_t>(b);
  }
  uint32_t bin_y(double y) const { return bin(y, y0_, y_scale_, ny_); }
  uint32_t bin_z(double z) const { return bin(z, z0_, z_scale_, nz_); }
  void set_counts(const Box3& bounds, uint32_t ny, uint32_t nz);

  uint32_t ny_ = 1, nz_ = 1;
  double y0_ = 0, z0_ = 0, y_scale_ = 0, z_scale_ = 0;
  std::vector<uint64_t> starts_;
  std::vector<uint32_t> entries_;
};

}  // namespace msq
