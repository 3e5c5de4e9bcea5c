// SPDX-License-Identifier: Apache-2.0
// Rows of samples in any direction, of functions whose rows cannot be tabulated: the tape is run at
// all samples, in double precision.
#pragma once

#include "structure/functional/functional.h"

namespace msq {

/// Clears the bits of samples that are outside.
void keep_tape_rows(const Functional& structure, const RowBlock& block, const Job* job);

}  // namespace msq
