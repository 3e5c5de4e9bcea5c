// SPDX-License-Identifier: Apache-2.0
// The points nearest to a point, by a grid of squares.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vec2.h"
#include "base/working_memory.h"

namespace msq {

class NearPoints {
 public:
  /// Memory is proportional to the number of points, at any distances between them.
  explicit NearPoints(const CountedVector<Vec2>& points);

  /// The numbers of up to `count` of the points that are nearest to p, nearest first; of equally
  /// near ones the least number first. Without removed ones.
  void find(Vec2 p, size_t count, CountedVector<uint32_t>& found);
  void remove(uint32_t point);

 private:
  struct Found {
    double squared;
    uint32_t point;

    friend bool operator<(const Found& a, const Found& b) {
      return a.squared != b.squared ? a.squared < b.squared : a.point < b.point;
    }
  };

  long column(double x) const;
  long row(double y) const;
  void look(long column, long row, Vec2 p, size_t count);

  const CountedVector<Vec2>& points_;
  Vec2 low_;
  double side_ = 1;
  long columns_ = 1, rows_ = 1;
  CountedVector<uint32_t> starts_, counts_, members_;  // by square
  CountedVector<Found> found_;
};

}  // namespace msq
