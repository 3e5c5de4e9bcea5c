// SPDX-License-Identifier: Apache-2.0
// Fill lines: the middle lines of a structure's thin walls at a height, cut by a polygon, as paths
// for a nozzle.
#pragma once

#include <cstdint>
#include <vector>

#include "base/memory.h"
#include "base/ref.h"
#include "cell/context.h"
#include "fill/polygon.h"
#include "structure/structure.h"

namespace msq {

struct FillPlan {
  FillPolygon::Rings rings;
  /// Coordinate c is at origin + c * scale in the model.
  Vec2 origin;
  double scale = 1;
  double z = 0;
  double tolerance = 0;        ///< model units, > 0
  double min_length = 0;       ///< model units
  double pair_distance = 0;    ///< model units
  double corner_distance = 0;  ///< model units
  bool is_int32 = false;       ///< of the points that result
};

/// The paths, in arrays.
class Fill final : public RefCounted {
 public:
  /// Throws Error(unsupported) where the structure has no thin walls. The calling thread has an
  /// account of working memory.
  Fill(Context& context, const Structure& structure, const FillPlan& plan);

  bool is_int32() const { return is_int32_; }
  const void* points() const {
    return is_int32_ ? static_cast<const void*>(points32_.data()) : points64_.data();
  }
  uint64_t point_count() const { return starts_.back(); }
  /// Number of the first point of each path, and that of all points.
  const std::vector<uint64_t>& starts() const { return starts_; }
  const std::vector<uint8_t>& closed() const { return closed_; }
  /// Of all paths, and of the ways between them, in model units.
  double length() const { return length_; }
  double travel() const { return travel_; }

 private:
  void store(const CountedVector<IntPath>& paths, double scale);

  bool is_int32_;
  std::vector<int32_t> points32_;
  std::vector<int64_t> points64_;
  std::vector<uint64_t> starts_{0};
  std::vector<uint8_t> closed_;
  double length_ = 0, travel_ = 0;
  Reservation memory_;
};

}  // namespace msq
