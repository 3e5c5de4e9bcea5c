// SPDX-License-Identifier: Apache-2.0
// Searches for the nearest part of a boundary that go from point to point: each starts from a part
// that was near to the last one, which leaves little to look through.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace msq {

/// Of the closed set that Shape::depth() is the distance to; distances are within depth_error(), of
/// points no farther from the shape's bounds than some times their size.
class BoundarySearch {
 public:
  struct Foot {
    double distance;
    Vec3 point;  ///< of the set, at that distance
    uint32_t part;
  };
  /// The nearest point of the set. `start`: any part, such as that of a point nearby; 0 at first.
  virtual Foot nearest(Vec3 p, uint32_t start) const = 0;
  /// Where the distance to the set lies: below `low`, from there on but below `high`, or beyond.
  enum class Range { below, between, beyond };
  /// `part` is where to start, and becomes a part that is as near as the answer says.
  virtual Range compare(Vec3 p, double low, double high, uint32_t& part) const = 0;

 protected:
  ~BoundarySearch() = default;
};

}  // namespace msq
