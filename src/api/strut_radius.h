// SPDX-License-Identifier: Apache-2.0
// The radius of struts in a host's definition.
#pragma once

#include "cell/neighbourhood.h"
#include "field/field.h"
#include "msq.h"

namespace msq::api {

/// Throws Error where it makes no sense, and where it reaches more than `max_cells` of the
/// smallest cell size for a strut of the greatest factor.
Parameter read_radius(const msq_param& radius, const Neighbourhood& grid, double max_cells,
                      double max_factor = 1);

}  // namespace msq::api
