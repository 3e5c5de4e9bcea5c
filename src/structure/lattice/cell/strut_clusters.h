// SPDX-License-Identifier: Apache-2.0
// r-interval preprocessing of a lattice of struts or plates: the unit cell in n^3 clusters. Each
// has the radii between which its points may differ, and the struts that are nearest to one of its
// points. These few struts give both the distance of a point from the lattice and its membership.
// Source: paper, section "Preprocessing for Repeating Structures". The paper examines only the
// corners of clusters; these are bounds for all of their points.
//
// The gap between a point and strut s is the distance to the strut's axis minus the strut's radius,
// which is its factor times r. If the maximum gap to t in a cluster is less than the minimum gap to
// s there, s is not the nearest to any of its points. As gaps are linear in r, this holds for all r
// of an interval if it holds for both its ends. The remaining struts are listed; clusters take
// their lists from those of boxes that contain them. A strut s is only compared with those t whose
// maximum gap is smallest at either end of the interval. So lists may be longer than necessary, but
// contain every strut that is nearest.
//
// Distances f to an axis in a box differ from that of its centre c by at most half its diagonal.
// That is a weak bound for a long box, as in slender cells. For those, more is used: f is convex,
// so its maximum is at a corner. Its minimum is at least 2 f(c) minus that, as f(p) + f(2 c - p) >=
// 2 f(c), and at least the distance between the box and the box of the axis.
//
// At the minimum r at which a strut contains a point, that strut's gap is 0 and no other gap is
// less: so the list contains this strut, too.
//
// No strut contains a point of the cluster if r is below the minimum of (distance of s from c - h)
// / factor. As the distance to a segment is convex, its maximum over the cluster is at a corner.
// From the minimum of (maximum distance of s) / factor on, one strut contains the whole cluster.
//
// Lists have at most about `max_entries` in all, or max_of_cluster for each cluster: if they
// would have more, n is halved. (A cluster that lies on both sides of a plane of nodes lists more
// than those beside the plane, hence halves.) If the clusters of a box would each list most of the
// box's struts, they share its list.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "field/field.h"
#include "structure/lattice/cell/plate_cell.h"
#include "structure/lattice/cell/unit_cell.h"
#include "strut/segment.h"

namespace msq {

/// Of struts (PeriodicStrut) or plates (PeriodicPlate), which are here called struts, too: all that
/// is used of an axis is that it is convex.
template <class Periodic>
class PartClusters {
 public:
  using Part = decltype(std::declval<Periodic>().placed(Vec3{}, Vec3{}));
  static constexpr size_t max_entries = size_t{1} << 20, max_of_cluster = 32;

  /// `struts`: those of one factor are adjacent. `radius`: contains every r that is queried.
  /// `side`: maximum n. May take long: polls the current job.
  PartClusters(const std::vector<Periodic>& struts, Vec3 cell_size, Interval radius, int side);

  struct Cluster {
    /// All points are outside if r is below `outside`, and inside from `inside` on. The rounding of
    /// LatticePart::holds() and of positions is included.
    double outside, inside;
    uint32_t begin, end;
  };
  /// The cluster of a point of the cell; fraction: from the cell's corner, in cell sizes.
  const Cluster& at(Vec3 fraction) const {
    return clusters_[static_cast<size_t>((number(fraction.z) * side_ + number(fraction.y)) * side_ +
                                         number(fraction.x))];
  }
  /// Whether a strut contains a point of the cell for radius r; `q` is fraction times the cell's
  /// size. The same result as with all struts that can reach the point, to the last bit.
  bool holds(Vec3 fraction, Vec3 q, double r) const {
    const Cluster& cluster = at(fraction);
    if (r < cluster.outside) return false;
    if (r >= cluster.inside) return true;
    for (uint32_t i = cluster.begin; i < cluster.end; ++i)
      if (struts_[entries_[i]].holds(q, r)) return true;
    return false;
  }

  /// The minimum r at which a strut contains a point of the cell, if it is in the interval of
  /// radii. Otherwise a value above that interval, possibly infinity.
  double onset(Vec3 fraction, Vec3 q) const;
  /// The minimum gap of a point of the cell; negative within a strut. At most reach() minus the
  /// radius of the thickest strut.
  double gap(Vec3 fraction, Vec3 q, double r) const;
  /// Struts farther than this are left out, so that the lists of flat cells stay short enough to
  /// search: 8 times the smallest cell size.
  double reach() const { return reach_; }
  /// Memory.
  size_t bytes() const {
    return struts_.capacity() * sizeof struts_[0] + clusters_.capacity() * sizeof clusters_[0] +
           entries_.capacity() * sizeof entries_[0];
  }

 private:
  /// Clusters [first, first + size) along each axis.
  struct Box {
    std::array<int, 3> first, size;
  };

  int number(double fraction) const {
    // Rounding may put a point next to its cluster. It is still as near, within the slack of all
    // bounds.
    return std::min(static_cast<int>(fraction * side_), side_ - 1);
  }
  void find_struts(const std::vector<Periodic>& struts, Vec3 cell_size);
  Box3 place(const Box& box) const;
  /// A box of the size of a cluster in the middle of a box.
  Box3 middle_of(const Box3& box) const;
  /// The struts of a list that may be nearest to a point of a box.
  std::vector<uint32_t> nearest(const Box3& box, const std::vector<uint32_t>& from) const;
  /// Returns false and finds nothing if lists would have too many entries.
  bool divide(const Box& box, const std::vector<uint32_t>& from);
  /// The cluster for a box and its list.
  Cluster cluster_of(const Box3& box, const std::vector<uint32_t>& list);

  int side_ = 1;
  Vec3 cluster_size_;
  double reach_, slack_, max_factor_ = 0;
  Interval radius_;
  std::vector<Part> struts_;  // of the tiling
  std::vector<Cluster> clusters_;
  std::vector<uint32_t> entries_;
};

extern template class PartClusters<PeriodicStrut>;
extern template class PartClusters<PeriodicPlate>;
using StrutClusters = PartClusters<PeriodicStrut>;
using PlateClusters = PartClusters<PeriodicPlate>;

}  // namespace msq
