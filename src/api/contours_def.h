// SPDX-License-Identifier: Apache-2.0
// Definitions of contours, read from the host's.
#pragma once

#include "msq.h"
#include "slice/contours.h"

namespace msq::api {

/// All but the height. Throws Error(argument).
ContourPlan read_contours(const msq_contours_def* def, const char* name);
/// The same for a slicer, which has a plane and a length scale.
ContourPlan read_slicer_contours(const msq_contours_def* def, const char* name);

}  // namespace msq::api
