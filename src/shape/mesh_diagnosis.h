// SPDX-License-Identifier: Apache-2.0
// Cleaning and diagnosis of triangle meshes.
#pragma once

#include "base/triangle_soup.h"
#include "shape/shape.h"

namespace msq {

/// Throws Error(mesh) unless there are triangles, all indices are in range and all coordinates of
/// used vertices are finite and at most 1e100 in magnitude (so that volumes stay finite).
void check_soup(const TriangleSoup& soup);

/// Merges vertices of equal coordinates (-0 counts as 0), drops vertices that no triangle uses and
/// triangles with fewer than three distinct ones. Returns how many triangles were dropped.
/// Collinear triangles with three distinct vertices stay: they close the surface between their
/// neighbours.
uint64_t weld(TriangleSoup& soup);

/// Bounds, volume, area and counts of a welded soup.
ShapeFacts diagnose(const TriangleSoup& soup);

}  // namespace msq
