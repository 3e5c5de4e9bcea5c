// SPDX-License-Identifier: Apache-2.0
// Set queries of material: membership first, then the channels of the points inside, material by
// material. Source: paper, section "Multiscale Shape-Material Modeling API".
#pragma once

#include <string_view>
#include <vector>

#include "query/membership.h"

namespace msq {

/// Throws Error(argument), which begins with `purpose`, unless each point inside has a material.
void require_material(const Model& model, const Scales& resolved, const char* purpose);

/// Sets ids[i] to the id of point i's material, 0 outside, and values[i * channels + c] to that of
/// channel c, 0 if the material has no such channel. Every point must have a material: see
/// require_material().
void set_material(const Model& model, const Scales& resolved, const PointSet& points,
                  const QueryPlan& plan, const std::vector<std::string_view>& channels,
                  uint32_t* ids, double* values, Job* job);

}  // namespace msq
