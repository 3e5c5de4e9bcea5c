// SPDX-License-Identifier: Apache-2.0
// Areas and centroids of the faces of a Voronoi cell, from its edges: each edge of a face spans a
// triangle with one corner of the face, and these triangles fill it.
//
// Error. A vertex lies on its three planes n . x = |n|^2 / 2, and beyond no other, within 1e-10
// (voronoi_cell.cpp). Within the plane of a face, the line of another plane is off by that over the
// length of the part of n along the face. Cells in which this is below 0.01 for an edge are
// refused, so that lines are off by 1e-8. So are cells with vertices farther than 2: the others'
// faces lie in circles of radius 2, with a perimeter of 13 at most. So areas are off by less than
// face_area_error, and centroids by less than centroid_error().
#pragma once

#include <vector>

#include "structure/foam/edges/voronoi_cell.h"
#include "structure/foam/walls/wall_face.h"

namespace msq {

class FaceAreas {
 public:
  /// After cell.walk(). False if they are not known.
  bool find(const VoronoiCell& cell);
  /// Whether the plane of a neighbour, by number, has an edge.
  bool has_edge(size_t plane) const { return sums_[plane].is_begun; }
  WallFace face(size_t plane) const { return sums_[plane].face(); }

 private:
  struct Sum {
    bool is_begun = false;
    Vec3 corner;
    double area = 0;
    Vec3 moment;  // three times that, about the corner

    void add(Vec3 v, Vec3 w);
    WallFace face() const;
  };
  std::vector<Sum> sums_;
};

}  // namespace msq
