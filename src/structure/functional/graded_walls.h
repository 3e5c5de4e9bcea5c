// SPDX-License-Identifier: Apache-2.0
// The level of a sheet whose walls keep their mean thickness while the size of its cells varies.
#pragma once

#include "cell/graded_period.h"
#include "cell/neighbourhood.h"
#include "expression/tape.h"
#include "field/field.h"

namespace msq {

/// A field along the axis of the period: at each position the level of WallThickness for cells of
/// the size there. It is computed for sizes a factor of 2^(1/4) apart. Between these the area per
/// volume, which lies between a constant and a multiple of 1 / size, is linear in 1 / size: within
/// 0.3 %. Throws Error(argument) if walls fill all of some cells.
Parameter graded_wall_level(const Tape& function, const Neighbourhood& grid,
                            const GradedPeriod& period, double thickness);

}  // namespace msq
