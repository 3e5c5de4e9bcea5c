// SPDX-License-Identifier: Apache-2.0
// r-interval preprocessing of a strut lattice: the unit cell in n^3 clusters, each with the radii
// between which its points may differ and the struts that are nearest to one of them. Both how far
// a point is from the lattice and whether it is inside follow from these few. Source: paper,
// section "Preprocessing for Repeating Structures"; where it looks at the corners of clusters
// alone, these are bounds for all of their points.
//
// Let c be the centre of a cluster, h half its diagonal and g(s) the gap between c and the surface
// of strut s: the distance to the strut's axis less the strut's radius there, its factor times r.
// No point of the cluster has a gap to s that differs by more than h from that; so where g(t) + 2 h
// < g(s), s is the nearest to none of them. As g is linear in r, this holds for all r of an
// interval if it holds for both its ends. What is left of the struts is listed; clusters take it
// from lists of boxes that they are parts of. Struts that t rules out are looked for only with
// those t that are nearest to c at either end of the interval: so lists may be longer than they
// need be, and hold every strut that is nearest.
//
// At the least r at which a strut holds a point, that strut's gap is 0 and no other is less: the
// list holds it, too.
//
// No strut holds a point of the cluster where r is below the least (distance of s from c - h) /
// factor. As the distance to a segment is convex, its greatest over the cluster is at a corner:
// from the least (greatest distance of s) / factor on, one strut holds the whole cluster.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "field/field.h"
#include "structure/lattice/unit_cell.h"
#include "strut/segment.h"

namespace msq {

class StrutClusters {
 public:
  static constexpr int most_side = 64;

  /// `struts`: those of one factor next to each other. `radius`: holds every r that is asked for.
  /// `side`: n.
  StrutClusters(const std::vector<PeriodicStrut>& struts, Vec3 cell_size, Interval radius,
                int side);

  struct Cluster {
    /// All points are outside where r is below `outside`, inside from `inside` on; the rounding of
    /// LatticeStrut::holds() and of positions included.
    double outside, inside;
    uint32_t begin, end;
  };
  /// That of a point of the cell; fraction: from the cell's corner, in cell sizes.
  const Cluster& at(Vec3 fraction) const {
    return clusters_[static_cast<size_t>((number(fraction.z) * side_ + number(fraction.y)) * side_ +
                                         number(fraction.x))];
  }
  /// Whether a strut holds a point of the cell where the radius is r; `q` is fraction times the
  /// cell's size. The same as of all struts that can reach it, to the last bit.
  bool holds(Vec3 fraction, Vec3 q, double r) const {
    const Cluster& cluster = at(fraction);
    if (r < cluster.outside) return false;
    if (r >= cluster.inside) return true;
    for (uint32_t i = cluster.begin; i < cluster.end; ++i)
      if (struts_[entries_[i]].holds(q, r)) return true;
    return false;
  }

  /// The least r at which a strut holds a point of the cell, if it is one of those asked for; above
  /// all of those, maybe infinity, if there is none among them.
  double onset(Vec3 fraction, Vec3 q) const;
  /// The least gap, negative within a strut, of a point of the cell. At most reach() less the
  /// radius of the thickest strut.
  double gap(Vec3 fraction, Vec3 q, double r) const;
  /// Struts farther than that are not looked for, so that flat cells do not list more of their like
  /// than can be searched: 8 times the smallest cell size.
  double reach() const { return reach_; }

 private:
  /// Clusters [first, first + size) along each axis.
  struct Box {
    std::array<int, 3> first, size;
  };

  int number(double fraction) const {
    // A point that rounding puts next to its cluster is as near, to the slack of all bounds.
    return std::min(static_cast<int>(fraction * side_), side_ - 1);
  }
  void divide(const Box& box, const std::vector<uint32_t>& from);
  void set_radii(Cluster& cluster, Vec3 low, Vec3 high, const std::vector<uint32_t>& near) const;

  int side_;
  Vec3 cluster_size_;
  double reach_, slack_ = 0, most_factor_ = 0;
  Interval radius_;
  std::vector<LatticeStrut> struts_;  // of the tiling
  std::vector<Cluster> clusters_;
  std::vector<uint32_t> entries_;
};

}  // namespace msq
