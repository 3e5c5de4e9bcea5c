// SPDX-License-Identifier: Apache-2.0
// Membership of points that a method asks about as it goes: a few, or many at once.
#pragma once

#include <cstdint>
#include <vector>

#include "base/job.h"
#include "model/model.h"

namespace msq {

/// inside[i] becomes 0 or 1. Points must be finite. Neither the progress nor the counts of a job
/// change.
void find_inside(const Model& model, const Scales& resolved, const std::vector<Vec3>& points,
                 std::vector<uint8_t>& inside, const Job* job);

}  // namespace msq
