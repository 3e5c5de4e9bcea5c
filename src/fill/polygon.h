// SPDX-License-Identifier: Apache-2.0
// A polygon with holes in whole coordinates, and lines cut by it.
//
// Which sides of the polygon a line crosses is exact, also where it runs through corners and along
// sides: products of 128 bits, and ties as if the polygon were shifted by (e, e^2) for an e that is
// smaller than all else (Edelsbrunner and Muecke, "Simulation of simplicity", 1990). A shift of the
// whole changes no topology, so along a closed line as many crossings lead in as out. Where the
// crossing is is rounded to whole coordinates.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/working_memory.h"

namespace msq {

struct IntPoint {
  int64_t x = 0, y = 0;

  friend bool operator==(IntPoint a, IntPoint b) { return a.x == b.x && a.y == b.y; }
};

struct IntPath {
  CountedVector<IntPoint> points;
  bool is_closed = false;  ///< the last point is joined to the first, and differs from it
};

double distance(IntPoint a, IntPoint b);
double length_of(const IntPath& path);

class FillPolygon {
 public:
  /// In magnitude: doubles hold what is smaller, and products fit.
  static constexpr int64_t max_coordinate = int64_t{1} << 53;

  using Rings = CountedVector<CountedVector<IntPoint>>;

  /// Rings whose coordinates are at most max_coordinate in magnitude, at least one, each with at
  /// least 3 points. Even-odd: holes may run either way.
  explicit FillPolygon(const Rings& rings);

  IntPoint min() const { return min_; }
  IntPoint max() const { return max_; }
  bool inside(IntPoint p) const;
  /// Appends the parts of a path within the polygon, in order. Ends at the border are rounded.
  /// Coordinates of the path are at most 2^60 in magnitude.
  void cut(const IntPath& path, CountedVector<IntPath>& parts) const;

 private:
  struct Side {
    IntPoint from, to;
  };
  /// Ascending positions, 0 to 1, along the line from a to b.
  void find_crossings(IntPoint a, IntPoint b, CountedVector<double>& found) const;
  size_t band(int64_t y) const;

  IntPoint min_, max_;
  CountedVector<Side> sides_;
  double band_height_ = 1;
  CountedVector<uint32_t> starts_, members_;  // sides by horizontal band
};

}  // namespace msq
