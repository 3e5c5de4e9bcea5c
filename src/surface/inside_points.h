// SPDX-License-Identifier: Apache-2.0
// Membership of points that a mesh asks for one by one, and places between them where it changes.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "model/model.h"

namespace msq {

/// inside[i] becomes 0 or 1. Points must be finite.
void find_inside(const Model& model, const Scales& resolved, const std::vector<Vec3>& points,
                 std::vector<uint8_t>& inside, const Job* job);

/// A way from a point inside to one outside; neither is asked about.
struct BoundaryWay {
  Vec3 inside, outside;
  Vec3 middle() const { return (inside + outside) * 0.5; }
};
/// Halves the ways `rounds` times, so that each still leads from inside to outside.
void halve(const Model& model, const Scales& resolved, std::vector<BoundaryWay>& ways, int rounds,
           const Job* job);

}  // namespace msq
