// SPDX-License-Identifier: Apache-2.0
// Functions that repeat by themselves.
#pragma once

#include <array>
#include <vector>

#include "expression/tape.h"

namespace msq {

/// For each coordinate whether the function that a tape stands for, in exact arithmetic, repeats
/// after 2 pi along it; erring towards no.
std::array<bool, 3> repeats(const Tape& tape);

/// What each node of a tape that repeats along an axis grows by when that coordinate grows by 2 pi,
/// in units of 2 pi; no number where that is not known.
std::vector<double> growths(const Tape& tape, int axis);

}  // namespace msq
