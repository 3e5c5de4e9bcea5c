// SPDX-License-Identifier: Apache-2.0
// Set queries of material: membership first, then the channels of the points inside, material by
// material. Source: paper, section "Multiscale Shape-Material Modeling API".
#pragma once

#include <string_view>
#include <vector>

#include "query/membership.h"

namespace msq {

/// ids[i] becomes the id of point i's material, 0 outside; values[i * channels + c] that of
/// channel c, 0 where the material has no such channel. Every point has a material: see
/// Model::has_material().
void set_material(const Model& model, const Scales& resolved, const PointSet& points,
                  const QueryPlan& plan, const std::vector<std::string_view>& channels,
                  uint32_t* ids, double* values, Job* job);

}  // namespace msq
