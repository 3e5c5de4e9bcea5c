// SPDX-License-Identifier: Apache-2.0
// Triangles that close an open surface, and bounds of their solid angle.
//
// Surface and caps together have an integer winding number R + C, that of the +x ray through both.
// The generalised winding number of the surface is that minus the caps' solid angle over 4 pi. A
// hole's cap is small, and looks small from afar. If the error of the solid angle of all caps
// together is less than its distance to the next half, C minus the nearest integer equals
// BoundaryLoops::turns(), except for the sign.
//
// A tree of caps gives their solid angle. A node that is small compared with its distance is
// evaluated as a whole (Barill, Dickson, Schmidt, Levin and Jacobson, "Fast winding numbers for
// soups and clouds", 2018), here with proven bounds. About a node's centre c, let r = |c - p| and
// the caps be within rho of c. The first two terms of the Taylor series of the kernel (y - p) / |y
// - p|^3 have an error of at most 3 M / (r - rho)^4, M the integral of |y - c|^2 over the caps: the
// m-th derivatives of 1/r in any directions are at most m! / r^(m + 1). The gradient of the solid
// angle of caps of area A is at most 2 A / (r - rho)^3. It is also the field of a current along
// their edges (Biot and Savart), to which edges between two of the caps add nothing: at the
// distance d, an edge of length l adds at most the smaller of l / d^2 and 2 / d.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/triangle_soup.h"
#include "base/vec.h"
#include "shape/cap_sums.h"
#include "shape/loop_expansions.h"
#include "shape/open_edges.h"
#include "shape/triangle_bins.h"
#include "shape/triangle_rows.h"

namespace msq {

class Caps {
 public:
  /// `scale`: a power of two that makes the extent of the bounds about 1.
  Caps(const TriangleSoup& soup, const Loops& loops, const Box3& bounds, double scale);

  const TriangleSoup& soup() const { return soup_; }
  /// The contribution of the caps to the winding numbers of the +x ray.
  RowWinding count(Vec3 p) const { return count_crossings(soup_, columns_.at(p.y, p.z), p); }
  int64_t count_beyond(Vec3 p) const { return count(p).beyond; }
  /// The caps that may meet the plane.
  TriangleBins::Range at_height(double z) const { return sheets_.at(low_y_, z); }

  /// The fraction of the sphere of directions that the caps take.
  struct View {
    double turns;  ///< solid angle over 4 pi
    double error;  ///< bound of the error of that, and of the rounding of BoundaryLoops::turns()

    /// The nearest integer; and the solid angle that certainly remains to the next half.
    int64_t whole() const;
    double margin() const;
  };
  /// Nodes nearer than `opening` times their radius are opened.
  View view(Vec3 p, double opening) const;
  struct Nearby;
  /// Gathers the data that all points of a ball can share for their views.
  void gather(Vec3 centre, double radius, Nearby& near) const;
  void find_views(const Vec3* points, size_t count, const Nearby& near, View* views) const;
  /// Whether the generalised winding number of the mesh provably rounds to one number in a ball, if
  /// no triangle of the mesh is crossed. If `whole` is not null, also that no cap meets the ball
  /// and that *whole is the nearest integer at all points of it.
  bool is_steady_in(Vec3 centre, double radius, int64_t* whole) const;
  /// Lists the triangles that meet a ball, as vectors from its centre, scaled.
  void find_meeting(const Ball& ball, std::vector<std::array<Vec3, 3>>& found) const;
  double tolerance() const { return tolerance_; }

  uint64_t bytes() const;

 private:
  struct Node {
    Vec3 centre;
    double radius, area;
    double second_moment;
    Vec3 normal;        // integral of the normal
    double first[6];    // of (y - c) n: xx, yy, zz, and the sums of xy and yx, xz and zx, yz and zy
    uint32_t triangle;  // of a leaf
    uint32_t next;      // next node that is not below this one
    bool is_leaf;       // of one triangle

    /// The first two terms of the series, d from a point at the distance r.
    double solid_angle(Vec3 d, double r) const;
  };
  struct Run {
    uint32_t begin, end;
  };
  static constexpr uint32_t no_triangle = UINT32_MAX;
  /// Solid angle over 4 pi of far nodes, as a linear function in a ball, and its error there.
  struct FarView {
    double turns = 0, error = 0;
    double error_of_ball = 0;  // the part of the error that smaller nodes would leave
    Vec3 gradient;

    void add(const Node& node, Vec3 d, double r, double gap, double radius);
  };

  void build(std::vector<uint32_t>& order, Run run);
  Node node_of(const std::vector<uint32_t>& order, Run run) const;
  Vec3 corner(uint32_t triangle, int i) const {
    return soup_.vertices[soup_.triangles[triangle][i]] * scale_;
  }
  struct Sum;
  void look_at(uint32_t triangle, Vec3 p, Sum& sum) const;
  void find_neighbours();
  struct Slope;
  struct NearCaps;
  /// Adds a triangle to those near p. False if an edge of the mesh is within `clear`.
  bool look_near(uint32_t triangle, Vec3 p, double clear, NearCaps& near) const;
  Slope slope_of(NearCaps& near) const;
  /// As is_steady_in(), scaled; `unknown` if smaller nodes might prove it.
  enum class Steadiness { steady, unsteady, unknown };
  /// Calls visit(triangle) for those that meet a ball, scaled, until it returns false. Costs
  /// little: no solid angle is summed.
  template <class Visit>
  void for_each_meeting(Vec3 p, double radius, Visit&& visit) const;
  Steadiness look_about(Vec3 p, double radius, double opening, int64_t* whole) const;
  /// Calls far(node, vector to it, distance, lower bound on the distance from the ball about p to
  /// its caps) for nodes farther than opening times their radius plus `room`, and near(triangle)
  /// for triangles of other nodes, until one of these returns false.
  template <class Far, class Near>
  void for_each_part(Vec3 p, double opening, double room, double radius, Far&& far,
                     Near&& near) const;

  double scale_, low_y_;
  double tolerance_;  // of positions, scaled
  double rounding_;   // of sums over all caps
  TriangleSoup soup_;
  TriangleBins columns_, sheets_;
  std::vector<Node> nodes_;  // parents before children
  /// By triangle and edge, the triangle beyond it; no_triangle beyond edges of the mesh.
  std::vector<std::array<uint32_t, 3>> neighbours_;
};

struct Caps::Nearby {
  std::vector<uint32_t> nodes;
  std::vector<CapTriangle> triangles;
  Vec3 centre;  // scaled
  FarView far;  // of the other nodes
};

}  // namespace msq
