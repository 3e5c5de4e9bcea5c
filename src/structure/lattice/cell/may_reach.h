// SPDX-License-Identifier: Apache-2.0
// Which struts can contain a point of a cell.
#pragma once

#include "base/vec.h"
#include "strut/segment.h"

namespace msq {

/// Whether a segment comes within radius of a box; if in doubt, true.
bool may_reach(const Segment& s, const Box3& box, double radius);

}  // namespace msq
