// SPDX-License-Identifier: Apache-2.0
// Struts cut to a shape: the parts of their centre lines that are inside.
#pragma once

#include "base/job.h"
#include "shape/shape.h"
#include "structure/common/struts.h"

namespace msq {

/// Appends the pieces of the struts of `list` that are inside the shape, strut by strut from a to
/// b. The job may be null.
void cut_struts(const Shape& shape, const StrutRadii& radii, const StrutList& list,
                StrutList& pieces, const Job* job);

}  // namespace msq
