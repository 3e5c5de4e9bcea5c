// SPDX-License-Identifier: Apache-2.0
// Beams and balls as struts of a graph. The coordinates of an end name its node.
#pragma once

#include <memory>

#include "structure/beams/beams.h"
#include "structure/common/struts.h"

namespace msq {

/// Refers to the beams.
std::unique_ptr<StrutParts> beam_struts(const Beams& beams, const StrutSelection& selection);

}  // namespace msq
