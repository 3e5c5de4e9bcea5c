// SPDX-License-Identifier: Apache-2.0
// Foam slices from edges that are each built once and written as spans.
#pragma once

#include "structure/foam/foam.h"

namespace msq {

/// Structure::keep_rows for foams.
void direct_keep_rows(const Foam& foam, const RowBlock& block, const Job* job);

}  // namespace msq
