// SPDX-License-Identifier: Apache-2.0
// The face of the Voronoi diagram between two seeds, as a convex polygon in the plane between them.
#pragma once

#include <vector>

#include "base/vec.h"

namespace msq {

/// Foam units.
struct WallFace {
  double area = 0;
  Vec3 middle;  ///< the centroid
};

/// Faces of less area are taken for none: rounding may make them, or leave them out.
constexpr double min_face_area = 1e-8;
/// How far areas and centroids of bricks may be off (face_areas.h).
constexpr double face_area_error = 2e-7;
inline double centroid_error(double area) {
  return 4 * face_area_error / area;
}

class FacePolygon {
 public:
  /// The square about the midpoint of the seeds a and b, in their plane, with sides of twice
  /// `half`.
  void start(Vec3 a, Vec3 b, double half);
  /// Cuts off what is nearer to another seed than to a.
  void cut(Vec3 other);
  bool is_empty() const { return corners_.size() < 3; }
  template <class Visit>
  void for_each_corner(const Visit& visit) const {
    for (const Corner& corner : corners_) visit(place(corner));
  }
  WallFace face() const;

  size_t bytes() const { return 2 * corners_.capacity() * sizeof(Corner); }

 private:
  struct Corner {
    double u, w;
  };
  Vec3 place(const Corner& corner) const { return centre_ + u_ * corner.u + w_ * corner.w; }

  Vec3 a_, b_, centre_, u_, w_;
  std::vector<Corner> corners_, kept_;
  std::vector<double> over_;
};

}  // namespace msq
