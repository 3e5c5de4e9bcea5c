// SPDX-License-Identifier: Apache-2.0
// An order of paths with little travel between them.
#pragma once

#include <vector>

#include "fill/polygon.h"

namespace msq {

/// Each path is followed by the one that begins nearest to its end: open ones may be reversed,
/// closed ones begin at any of their points. The first begins nearest to `start`. Of equally near
/// ones the first given is taken.
void order_paths(std::vector<IntPath>& paths, IntPoint start);

}  // namespace msq
