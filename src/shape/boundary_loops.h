// SPDX-License-Identifier: Apache-2.0
// The generalised winding number of an open surface, from the loops that bound it.
//
// Source: Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside segmentation using
// generalized winding numbers", 2013. w(p) is the sum of the solid angles of all triangles about p
// over 4 pi. It is an integer where a surface is closed. Where it is not, w is smooth except at the
// triangles.
//
// It is computed without a sum over triangles. From each open edge, sweep a strip along -x to
// infinity. Seen from p, the strips end in one point, the direction -x. So surface and strips
// together wrap the sphere of directions an integer number R of times: as often as the ray in any
// direction meets them. The ray along +x meets no strip. Hence
//
//     w = R - S,   R the winding number of the +x ray (mesh.h), 4 pi S the strips' solid angles,
//
// and S is a sum over open edges alone. The strip from an edge a b is the spherical triangle with
// corners -x, a, b. Write the direction of a as a pair (u, v), a real and a complex number, whose
// ratio v / u = (a_y + i a_z) / (|a| - a_x) is its stereographic projection. Half the strip's solid
// angle is then the argument of u_a u_b + conj(v_a) v_b. By HalfAngles, S is an integer number of
// turns and a rest in (-1/2, 1/2]. So R minus the turns is w rounded to an integer, half up,
// without an arc tangent.
//
// R jumps where the row of p passes an open edge that lies beyond p. There p lies on the edge's
// strip, and S jumps by the same amount. The side of the edge on which the row lies decides both,
// by the comparison of the row rule itself, so that rounding cannot separate them. If a coordinate
// of p equals that of a vertex, the row rule takes the vertex for lower in z, then in y; signs of
// zeros express that here.
//
// Rounding: differences of coordinates are exact to 2^-53 of themselves, hence so are the numbers,
// to a few such units of |X_a| |X_b|. The error of the argument of an edge is at most 2^-49 (1 + L
// / d) for an edge of length L at the distance d.
#pragma once

#include <cstdint>
#include <vector>

#include "base/triangle_soup.h"
#include "base/vec.h"
#include "shape/loop_expansions.h"
#include "shape/open_edges.h"

namespace msq {

class BoundaryLoops {
 public:
  /// `scale`: a power of two that makes the coordinates' extent about 1.
  BoundaryLoops(const TriangleSoup& soup, const Loops& loops, double scale);

  size_t edges() const { return vertices_.size(); }

  /// The whole turns of S. The winding number of the +x ray minus these is w rounded half up.
  int64_t turns(Vec3 p) const;

  /// Properties of w near a point, from each loop as a whole.
  struct Level {
    int64_t turns;
    double rest;          ///< 2 pi S is rest + 2 pi turns, the rest in (-pi, pi]
    double error;         ///< bound of the rounding of 4 pi w here and nearby
    double nearest;       ///< distance to the nearest edge
    double slope;         ///< bound of the gradient of 4 pi w: the sum of min(L / d^2, 2 / d)
    double nearest_loop;  ///< distance to the nearest ball around a loop; 0 in a ball
    double view;          ///< bound of the solid angle of the loops: the sum of A / d^2
  };
  /// Lengths are scaled.
  Level level(Vec3 p) const;
  /// The winding number along a ray from p.
  struct Course {
    int64_t turns;
    double rest;     ///< as in Level
    double error;    ///< bound of the rounding of 4 pi w at p and up to nearest / 4 from it
    double nearest;  ///< distance to the nearest edge
    double along;    ///< derivative of 4 pi w along the ray at p
    double slack;    ///< bound of the error of that
    double bend;     ///< bound of its second derivative, up to nearest / 4 from p
  };
  /// Lengths are scaled; the direction has length 1. Points of the ray are known to `rounding`.
  Course course(Vec3 p, Vec3 direction, double rounding) const;
  /// S about the centres of balls. Points of these are known to `rounding`, scaled.
  void expand(const Ball* balls, size_t count, double rounding, Expansion* made) const;
  /// The gradient of w except for its length.
  Vec3 gradient(Vec3 p) const;

  uint64_t bytes() const {
    return vertices_.capacity() * sizeof(Vec3) + loops_.capacity() * sizeof(Loop) +
           starts_.capacity() * sizeof starts_[0];
  }

 private:
  struct Loop {
    Vec3 centre;          // scaled
    double radius, area;  // of a ball about it, and of triangles in it that it bounds
  };

  /// Calls visit(from, to, their corners) for the edges of a loop.
  template <class Visit>
  void for_each_edge(size_t loop, Vec3 p, Visit&& visit) const;

  double scale_;
  std::vector<uint64_t> starts_;  // loop i is vertices_[starts_[i]] up to [starts_[i + 1]]
  std::vector<Vec3> vertices_;    // loop after loop, as the mesh has them
  std::vector<Loop> loops_;
};

}  // namespace msq
