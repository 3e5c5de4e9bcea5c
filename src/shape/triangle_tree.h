// SPDX-License-Identifier: Apache-2.0
// The distance from a point to the nearest of many triangles, by a tree of bounds.
//
// A binary tree, each node split at the median centre along its longest extent: balanced, so that
// its depth is the logarithm of the number of triangles whatever they are. The nearer child first,
// and none that is farther than the best so far. A node's triangles lie in a box, and in a round
// cylinder along their mean normal. Larsen, Gottschalk, Lin and Manocha ("Fast proximity queries
// with swept sphere volumes", 1999) show how much bounds gain that fit a surface: a box is as thick
// as its patch is wide, and far from a smooth surface a great many are about as near as the
// nearest; the cylinder is flat.
#pragma once

#include <cstdint>
#include <vector>

#include "base/ray.h"
#include "base/vec.h"
#include "shape/boundary_search.h"

namespace msq {

/// The corner a, and the other two from it.
struct TreeTriangle {
  Vec3 a, u, v;

  TreeTriangle(Vec3 a, Vec3 b, Vec3 c) : a(a), u(b - a), v(c - a) {}
};

class TriangleTree {
 public:
  /// At least one triangle; their coordinates are around 1 in magnitude, so that fourth powers
  /// neither overflow nor vanish.
  explicit TriangleTree(std::vector<TreeTriangle> triangles);

  double distance(Vec3 p) const;

  using Range = BoundarySearch::Range;
  struct Nearest {
    double distance;
    Vec3 point;  ///< of the triangle
    uint32_t triangle;
  };
  /// The nearest triangle, from one that may be near on.
  Nearest nearest(Vec3 p, uint32_t start) const;
  /// Where the distance to the nearest triangle lies; `start` becomes one that is as near as that.
  Range compare(Vec3 p, double low, double high, uint32_t& start) const;
  struct Crossing {
    double t;
    Vec3 normal;  ///< of the triangle, of any length
  };
  /// The first t in [from, to] at which a ray crosses a triangle, or passes it at less than
  /// `margin`; false if there is none. Triangles in whose plane the ray runs are left out.
  /// Source: Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
  bool first_crossing(const Ray& ray, double from, double to, double margin,
                      Crossing& crossing) const;

  /// Bound of what distance() may be too large for the shape of the triangles, beside 2^-47 of
  /// itself and of the coordinates.
  double excess() const { return excess_; }

  uint64_t bytes() const {
    return triangles_.capacity() * sizeof(TreeTriangle) + nodes_.capacity() * sizeof(Node);
  }
  /// Taken while a tree of so many triangles is built.
  static uint64_t bytes_to_build(uint64_t triangles);

 private:
  struct Bound {
    Box3 box;
    // The cylinder.
    Vec3 centre, normal;  // the normal of length 1, or 0 where there is no mean
    double half_height, radius;

    /// Or, of more than best, any number above best.
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
                        const std::vector<TreeTriangle>& triangles, Run range);
  /// Looks for triangles nearer than sqrt(best): found(triangle, squared distance) returns the
  /// square of what the next must be nearer than, 0 to stop.
  template <class Found>
  void search(Vec3 p, double best, Found&& found) const;
  uint32_t build(std::vector<uint32_t>& order, const std::vector<TreeTriangle>& triangles,
                 Run range);

  std::vector<TreeTriangle> triangles_;  // leaf by leaf
  std::vector<Node> nodes_;
  double excess_ = 0;
};

}  // namespace msq
