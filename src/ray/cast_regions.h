// SPDX-License-Identifier: Apache-2.0
// Rays through a model of regions: each is cut where its points come to belong to another region,
// and in each part cast through that region alone.
#pragma once

#include <vector>

#include "ray/cast.h"

namespace msq {

/// As cast_batch(), of a model that has regions.
void cast_through_regions(const Model& model, const Scales& resolved,
                          std::vector<RaySearch>& searches, std::vector<RayHit>& hits,
                          HitDetail detail, const Job* job);

}  // namespace msq
