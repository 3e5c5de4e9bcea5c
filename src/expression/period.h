// SPDX-License-Identifier: Apache-2.0
// Functions that repeat by themselves.
#pragma once

#include <array>

#include "expression/tape.h"

namespace msq {

/// For each coordinate whether the function that a tape stands for, in exact arithmetic, repeats
/// after 2 pi along it; erring towards no.
std::array<bool, 3> repeats(const Tape& tape);

}  // namespace msq
