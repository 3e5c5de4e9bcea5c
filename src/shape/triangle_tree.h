// SPDX-License-Identifier: Apache-2.0
// The distance from a point to the nearest of many triangles, by a tree of bounds.
//
// A node has up to eight children, and a leaf is a block of eight triangles: as many are evaluated
// at once (triangle_search.h). The triangles are halved again and again at the median centre along
// the longest extent, up to blocks. All nodes are full except for the last ones, so the depth is
// the logarithm of the number of triangles, for any triangles. The search visits the nearest child
// first, and no child that is provably farther than the best so far. A child's triangles lie in a
// box, and in a round cylinder along their mean normal. Larsen, Gottschalk, Lin and Manocha ("Fast
// proximity queries with swept sphere volumes", 1999) show how much bounds gain that fit a surface.
// A box is as thick as its patch is wide, and far from a smooth surface very many boxes are about
// as near as the nearest; the cylinder is flat.
//
// The result is the minimum of TreeTriangle::distance_squared() over all triangles, with its bits.
// Proof: let M be the largest coordinate of the triangles. TreeTriangle::distance_squared() is the
// square of the distance D of a point of the triangle, and the bound that of the distance B of a
// volume which contains the triangle. Each computes less than 100 sums, products and roots of
// numbers up to 8 (D + M), so rounding changes it by less than 2^-43 (D + M). As B would be at most
// D without rounding, it is at most D (1 + 2^-42) + 2^-42 M. Since (x + y)^2 is at most x^2 (1 + h)
// + y^2 (1 + 1/h), here with h = 2^-21, its square is less than D^2 (1 + 2^-20) + 2^-62 M^2.
// Children whose squared bound reaches that, with the best so far as D, have no nearer triangle,
// and none as near.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/ray.h"
#include "base/vec.h"
#include "shape/boundary_search.h"
#include "shape/triangle_search.h"

namespace msq {

class TriangleTree {
 public:
  /// Takes at least one triangle. Coordinates are around 1 in magnitude, so that fourth powers
  /// neither overflow nor underflow. Throws Error(cancelled) if the job, which may be null, is
  /// cancelled.
  TriangleTree(std::vector<TreeTriangle> triangles, const Job* job);

  double distance(Vec3 p) const;

  using Range = BoundarySearch::Range;
  struct Nearest {
    double distance;
    Vec3 point;  ///< of the triangle
    uint32_t triangle;
  };
  /// The nearest triangle, the one of the lowest number among equals; the search starts from one
  /// that may be near.
  Nearest nearest(Vec3 p, uint32_t start) const;
  /// The range of the distance to the nearest triangle; `start` becomes a triangle whose distance
  /// is in that range.
  Range compare(Vec3 p, double low, double high, uint32_t& start) const;
  struct Crossing {
    double t;
    Vec3 normal;  ///< of the triangle, of any length
  };
  /// Finds the first t in [from, to] at which a ray crosses a triangle, or passes it at less than
  /// `margin`. Returns false if there is none. Skips triangles in whose plane the ray runs.
  /// Of triangles crossed at the same t, takes the one of the lowest number.
  bool first_crossing(const Ray& ray, double from, double to, double margin,
                      Crossing& crossing) const;

  /// Bound of the positive error of distance() due to the shape of the triangles, in addition to
  /// 2^-47 of itself and of the coordinates.
  double excess() const { return excess_; }

  uint64_t bytes() const {
    return blocks_.capacity() * sizeof(TriangleBlock) + nodes_.capacity() * sizeof(BoundNode);
  }
  /// Bytes needed to build a tree of that many triangles.
  static uint64_t bytes_to_build(uint64_t triangles);

 private:
  struct Build;

  TreeTriangle triangle(uint32_t i) const { return blocks_[i / tree_width].at(i % tree_width); }
  TriangleTreeView view() const { return {nodes_.data(), blocks_.data(), slack_}; }

  std::vector<TriangleBlock> blocks_;
  std::vector<BoundNode> nodes_;
  double excess_ = 0, slack_ = 0;
};

}  // namespace msq
