// SPDX-License-Identifier: Apache-2.0
// The mean length of a structure's wall lines per area, in planes normal to z.
#pragma once

#include "structure/structure.h"

namespace msq {

/// Of a structure whose walls are uniform, in 1 / model unit. Where it repeats along the axes, from
/// 64 heights of one cell. Where it is periodic and turned, from 8 x 8 cells, those in the middle
/// counting more, at 61 or 64 heights. Otherwise from 32 x 32 cells at 32 heights. Throws
/// Error(unsupported) where there are no thin walls or they are not uniform, Error(limit) where no
/// line is found.
double mean_line_density(const Structure& structure);

}  // namespace msq
