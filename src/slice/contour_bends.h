// SPDX-License-Identifier: Apache-2.0
// Which pieces of the boundary may bend by more than a tolerance, many at a time: the test with
// which ContourDetails begins.
#pragma once

#include <cstddef>
#include <cstdint>

namespace msq {

/// Sets bit i of `bits` where the boundary may bend by more than `tolerance` between point i and
/// the next one, as points i - 1 and i + 2 tell; also where a point that is nearer than `close` to
/// its neighbour tells little about that, and at some pieces near both ends of the points. Writes
/// the words of `count` bits.
void find_bends(const double* x, const double* y, size_t count, double tolerance, double close,
                uint64_t* bits);

}  // namespace msq
