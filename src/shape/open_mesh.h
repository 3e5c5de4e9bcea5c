// SPDX-License-Identifier: Apache-2.0
// Corrects the winding number of the +x ray for an open mesh: the result is its generalised winding
// number, rounded to an integer half up. BoundaryLoops::turns() is the definition. Caps avoid the
// sum over all open edges if they prove its result.
#pragma once

#include "base/memory.h"
#include "shape/boundary_loops.h"
#include "shape/caps.h"
#include "shape/whole_field.h"

namespace msq {

class OpenMesh {
 public:
  /// Takes a welded soup and its bounding box.
  OpenMesh(const TriangleSoup& soup, const Box3& bounds);

  const Caps& caps() const { return caps_; }
  double volume_of_holes() const { return volume_of_holes_; }
  uint64_t bytes() const { return loops_.bytes() + caps_.bytes(); }
  /// Bytes needed to build one from a soup with that many triangles and open edges.
  static uint64_t bytes_to_build(uint64_t triangles, uint64_t edges);

  /// The winding number of a point minus that of the +x ray.
  int64_t correction(Vec3 p) const;
  /// Whether, within this distance of p, the winding number is everywhere that of the +x ray
  /// through mesh and caps minus one number, `whole`.
  bool is_whole_about(Vec3 p, double distance, int64_t& whole) const;
  /// Not known of any where there are so many edges that bounds by the tree are faster.
  void expand(const Ball* balls, size_t count, Expansion* made) const;
  /// As is_whole_about(), point by point, from an expansion about the ball. False if too little is
  /// known.
  bool find_field(const Ball& ball, const Expansion& of_loops, WholeField& field) const;
  /// As is_whole_about(), at a point with an expansion about it. False if rounding decides, and on
  /// a cap: rows have crossings with caps, and where one is at a sample, the numbers before and
  /// behind it count, but caps are no boundary.
  bool find_whole(Vec3 p, const Expansion& of_loops, int64_t& whole) const;
  /// Whether the winding number is provably constant there, if no triangle is crossed.
  bool is_steady_in(Vec3 centre, double radius) const {
    return caps_.is_steady_in(centre, radius, nullptr);
  }
  /// How many times a step is tried by is_steady_in() before steady_way(), a sum over all edges, is
  /// worth its while.
  size_t tries_before_way() const { return 1 + loops_.edges() / 1024; }
  /// Whether it is also worth its while where no step can be proven by is_steady_in().
  bool knows_way() const { return loops_.edges() <= max_way_edges; }
  /// A lower bound of the distance from p, whose winding number is `winding`, to where that is 0 on
  /// one side and not 0 on the other, as long as no triangle is crossed; where that is above `max`,
  /// any number above it. Where is_steady(), that of two points differs by no more than the way
  /// between them.
  double distance_bound(Vec3 p, int64_t winding, double max) const;
  /// How far along a ray from p the winding number, there `beyond` of the +x ray, stays 0, or other
  /// than 0, as long as no triangle is crossed.
  double steady_way(Vec3 p, Vec3 direction, int64_t beyond) const;
  bool is_steady() const { return loops_.edges() <= max_steady_edges; }
  /// Normal to where the winding number is what it is at p; 0 where none is known.
  Vec3 normal(Vec3 p) const;

 private:
  OpenMesh(const TriangleSoup& soup, const Loops& loops, const Box3& bounds, double scale);

  /// Up to this number of edges, the sum is as fast as the methods that avoid it.
  static constexpr size_t few_edges = 24;
  /// Up to this number of edges, computing the bounds is worth a sum over all edges.
  static constexpr size_t max_steady_edges = 4096;
  static constexpr size_t max_way_edges = 65536;
  /// Up to this number of edges, expansions are faster than bounds by the tree. What expand_loops()
  /// adds for rounding covers sums of so many terms.
  static constexpr size_t max_expanded_edges = 1024;

  double scale_;
  double rounding_;  // of positions, scaled
  BoundaryLoops loops_;
  Caps caps_;
  double volume_of_holes_;
};

}  // namespace msq
