// SPDX-License-Identifier: Apache-2.0
// Rays through a model: where each first meets the solid.
// Source: paper, section "Set Queries for Ray-Casting": scale by scale, each asked only within the
// parts of the ray that the scales above it hold.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/job.h"
#include "base/ray.h"
#include "cell/neighbourhood.h"
#include "model/model.h"

namespace msq {

struct RayHit {
  double t = 0;
  int32_t scale = -1;  ///< whose surface was hit; -1: none was
  bool starts_inside = false;
  Vec3 normal;
  CellIndex cell;  ///< of the finest scale, at the hit
};

/// Calls ray_of(i) for i in [0, count) and take(i, hit) for what the ray meets, in batches of rays
/// that follow each other, in parallel. t is from the ray's origin on.
void cast_rays(const Model& model, const Scales& resolved, uint64_t count,
               const std::function<RaySearch(uint64_t)>& ray_of,
               const std::function<void(uint64_t, const RayHit&)>& take, Job* job);

}  // namespace msq
