// SPDX-License-Identifier: Apache-2.0
// The distance from a point to the nearest of many triangles, by a tree of bounds.
//
// It is a binary tree; each node is split at the median centre along its longest extent. So it is
// balanced: its depth is the logarithm of the number of triangles, for any triangles. The search
// visits the nearer child first, and no node that is farther than the best so far. A node's
// triangles lie in a box, and in a round cylinder along their mean normal. Larsen, Gottschalk, Lin
// and Manocha ("Fast proximity queries with swept sphere volumes", 1999) show how much bounds gain
// that fit a surface. A box is as thick as its patch is wide, and far from a smooth surface very
// many boxes are about as near as the nearest; the cylinder is flat.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "base/ray.h"
#include "base/vec.h"
#include "shape/boundary_search.h"

namespace msq {

/// The corner a, and the vectors from it to the other two.
struct TreeTriangle {
  Vec3 a, u, v;

  TreeTriangle(Vec3 a, Vec3 b, Vec3 c) : a(a), u(b - a), v(c - a) {}
};

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
  /// The nearest triangle; the search starts from one that may be near.
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
  /// Source: Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
  bool first_crossing(const Ray& ray, double from, double to, double margin,
                      Crossing& crossing) const;

  /// Bound of the positive error of distance() due to the shape of the triangles, in addition to
  /// 2^-47 of itself and of the coordinates.
  double excess() const { return excess_; }

  uint64_t bytes() const {
    return triangles_.capacity() * sizeof(TreeTriangle) + nodes_.capacity() * sizeof(Node);
  }
  /// Bytes needed to build a tree of that many triangles.
  static uint64_t bytes_to_build(uint64_t triangles);

 private:
  struct Bound {
    Box3 box;
    // The cylinder.
    Vec3 centre, normal;  // the normal of length 1, or 0 if there is no mean
    double half_height, radius;

    /// If the result would exceed best, it may be any number above best.
    double distance_squared(Vec3 p, double best) const;
  };
  struct Node {
    Bound bound[2];
    uint32_t child[2];  // node, or first triangle of a leaf
    uint32_t count[2];  // triangles of a leaf; 0 for a node
  };
  struct Run {
    uint32_t begin, end;
  };

  static Bound bound_of(const std::vector<uint32_t>& order,
                        const std::vector<TreeTriangle>& triangles, Run range, CancelPoll& poll);
  /// Searches triangles nearer than sqrt(best). found(triangle, squared distance) returns the
  /// square of the limit for the next ones, 0 to stop.
  template <class Found>
  void search(Vec3 p, double best, Found&& found) const;
  uint32_t build(std::vector<uint32_t>& order, const std::vector<TreeTriangle>& triangles,
                 Run range, CancelPoll& poll);

  std::vector<TreeTriangle> triangles_;  // leaf by leaf
  std::vector<Node> nodes_;
  double excess_ = 0;
};

}  // namespace msq
