// SPDX-License-Identifier: Apache-2.0
// Kernels of a tree of triangles: eight bounds or triangles at a time, in vectors of doubles.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/ray.h"
#include "shape/tree_triangle.h"

namespace msq {

/// Children of a node, triangles of a block.
constexpr uint32_t tree_width = 8;

/// Numbers beyond the last triangle repeat it.
struct alignas(64) TriangleBlock {
  double a[3][tree_width], u[3][tree_width], v[3][tree_width];
  double inverse_normal_squared[tree_width];
  double inverse_edge_squared[3][tree_width];  // of u, v and w

  void set(uint32_t i, const TreeTriangle& t);
  TreeTriangle at(uint32_t i) const;
};

/// What bounds the triangles of each child: a box, and a round cylinder.
struct alignas(64) BoundNode {
  double min[3][tree_width], max[3][tree_width];
  double centre[3][tree_width], normal[3][tree_width];  // normals of length 1, or 0
  double half_height[tree_width], radius[tree_width];
  uint32_t child[tree_width];  // a node, or a block and block_bit
  uint32_t count;

  static constexpr uint32_t block_bit = uint32_t{1} << 31;
};

/// The tree as the kernels see it.
struct TriangleTreeView {
  const BoundNode* nodes;  // the first is the root
  const TriangleBlock* blocks;
  /// A bound proves only distances whose square exceeds best (1 + 2^-20) + this (triangle_tree.h).
  double slack;
};

/// For trees of up to 2^32 triangles: each of up to 11 levels leaves seven children waiting.
constexpr size_t max_waiting = 128;

/// A child that is still to be searched, and a lower bound of what is sought in it.
struct Waiting {
  double bound;
  uint32_t child;
};
/// Adds the children of a node whose bits are set; the one of the lowest bound is the last. Returns
/// how many wait then.
inline size_t add_waiting(Waiting* waiting, size_t count, const BoundNode& node, uint32_t bits,
                          const double* bounds) {
  const size_t first = count;
  for (; bits; bits &= bits - 1) {
    const uint32_t i = static_cast<uint32_t>(std::countr_zero(bits));
    size_t place = count++;
    for (; place > first && waiting[place - 1].bound < bounds[i]; --place)
      waiting[place] = waiting[place - 1];
    waiting[place] = {bounds[i], node.child[i]};
  }
  return count;
}

struct NearestTriangle {
  double squared = std::numeric_limits<double>::infinity();
  uint32_t triangle = UINT32_MAX;
};
/// Finds the nearest triangle, the one of the lowest number among equals, if `nearest` is none or
/// one of them at first.
void find_nearest(const TriangleTreeView& tree, Vec3 p, NearestTriangle& nearest);

struct TriangleBelow {
  double low_squared, high_squared;
  bool is_below_low = false, is_below_high = false;
  uint32_t triangle = 0;  // that is, if either
};
/// Finds a triangle nearer than low, or if there is none, one nearer than high. `found`: what is
/// known at first.
void find_below(const TriangleTreeView& tree, Vec3 p, TriangleBelow& found);

/// The bits of the children whose boxes, grown by the margin, a ray meets in [from, to] or within
/// rounding of it; entry[i] becomes the t at which it may enter box i. `entry` is aligned to 64
/// bytes.
uint32_t meet_boxes(const BoundNode& node, const Ray& ray, double from, double to, double margin,
                    double (&entry)[tree_width]);

/// The bits of the triangles of a block that a ray crosses in [from, to], or passes at less than
/// `margin`; at[i] becomes the t of triangle i. The same for all targets of SIMD. Leaves out
/// triangles in whose plane the ray runs. `at` is aligned to 64 bytes.
/// Source: Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
uint32_t meet_triangles(const TriangleBlock& block, const Ray& ray, double from, double to,
                        double margin, double (&at)[tree_width]);

}  // namespace msq
