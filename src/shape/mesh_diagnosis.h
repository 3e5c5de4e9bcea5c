// SPDX-License-Identifier: Apache-2.0
// Cleaning and diagnosis of triangle meshes. All functions throw Error(cancelled) if the job, which
// may be null, is cancelled.
#pragma once

#include "base/job.h"
#include "base/triangle_soup.h"
#include "shape/shape.h"

namespace msq {

/// Throws Error(mesh) unless there are triangles, all indices are in range and all coordinates of
/// used vertices are finite and at most 1e100 in magnitude (so that volumes stay finite).
void check_soup(const TriangleSoup& soup, const Job* job);

/// Merges vertices of equal coordinates (-0 counts as 0), drops vertices that no triangle uses and
/// triangles with fewer than three distinct ones. Returns the number of dropped triangles.
/// Collinear triangles with three distinct vertices stay: they close the surface between their
/// neighbours.
uint64_t weld(TriangleSoup& soup, const Job* job);

/// The volume that caps add to an open surface. Pieces of surface, connected by common vertices,
/// whose caps have more than 3/4 of their area bound no volume; their caps do not count.
/// `vertices`: of the surface, for each vertex of the caps.
double volume_of_holes(const TriangleSoup& surface, const TriangleSoup& caps,
                       const std::vector<uint32_t>& vertices, const Box3& bounds);

/// Bounds, volume, area and counts of a welded soup.
ShapeFacts diagnose(const TriangleSoup& soup, const Job* job);

}  // namespace msq
