// SPDX-License-Identifier: Apache-2.0
// The point query of stretched foams (seeds/stretch.h), which is their definition: the seeds
// around a point are found, and lines cut, in the space of the diagram, and distances are those of
// model space.
//
// Which seeds matter to the edges within R of a point q. The ball of radius R about q in model
// space lies, in the space of the diagram, in the ball of radius R / (least factor), so the seeds
// within d0 + 2 R / (least factor) do (point.cpp). Of these, a seed matters only if the plane
// between it and the nearest seed, moved back to model space, is within R of q (onset.h). A plane
// n . x = c of the diagram is (n / factor) . X = c there.
#pragma once

#include <vector>

#include "structure/foam/point/edges_near.h"
#include "structure/foam/seeds/stretch.h"

namespace msq {

/// Maximum error of an onset, in foam units: as onset_slack in diagram units.
inline double stretched_slack(const Stretch& stretch) {
  return 1e-9 * stretch.max_factor();
}

/// Whether the point q (foam units, from the corner of `cell`) is within `radius` of an edge.
bool stretched_point_inside(const Stretch& stretch, CellIndex cell, Vec3 q, double radius);
/// Distance from that point to the nearest edge.
double stretched_onset(const Stretch& stretch, CellIndex cell, Vec3 q);
/// find_edges_near() of a stretched foam; lines in foam units.
void find_stretched_edges_near(const Stretch& stretch, CellIndex cell, Vec3 q, double radius,
                               std::vector<NearEdge>& struts);

}  // namespace msq
