// SPDX-License-Identifier: Apache-2.0
// Replaces the triangulation in builds without CGAL.
#include "base/status.h"
#include "structure/foam/paper/delaunay.h"

namespace msq {

bool can_triangulate() {
  return false;
}

std::vector<DelaunayFacet> delaunay_facets(const std::vector<Vec3>&) {
  fail(Status::unsupported, "this build of msq has no triangulation (MSQ_WITH_CGAL is off)");
}

}  // namespace msq
