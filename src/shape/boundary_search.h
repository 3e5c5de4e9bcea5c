// SPDX-License-Identifier: Apache-2.0
// Searches for the nearest part of a boundary, from point to point. Each starts from a part that
// was near the last point, so it examines few others.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace msq {

/// Searches the closed set whose distance is Shape::depth(). The error of distances is at most
/// depth_error(), for points whose distance from the shape's bounds is at most a few times their
/// size.
class BoundarySearch {
 public:
  struct Foot {
    double distance;
    Vec3 point;  ///< of the set, at that distance
    uint32_t part;
  };
  /// The nearest point of the set. `start`: any part, for example that of a nearby point; 0 at
  /// first.
  virtual Foot nearest(Vec3 p, uint32_t start) const = 0;
  /// The range of the distance to the set: below `low`, from `low` to below `high`, or at least
  /// `high`.
  enum class Range { below, between, beyond };
  /// `part` is the part to start from. It is set to a part whose distance is in the returned range.
  virtual Range compare(Vec3 p, double low, double high, uint32_t& part) const = 0;

 protected:
  ~BoundarySearch() = default;
};

}  // namespace msq
