// SPDX-License-Identifier: Apache-2.0
// Detects functions that are periodic in a coordinate.
#pragma once

#include <array>
#include <vector>

#include "expression/tape.h"

namespace msq {

/// For each coordinate, whether the function of a tape, in exact arithmetic, has the period 2 pi
/// along it. If that is unknown, false.
std::array<bool, 3> repeats(const Tape& tape);

/// For a tape with period 2 pi along an axis: the growth of each node when that coordinate grows by
/// 2 pi, in units of 2 pi. NaN if unknown.
std::vector<double> growths(const Tape& tape, int axis);

}  // namespace msq
