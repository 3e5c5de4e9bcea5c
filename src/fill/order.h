// SPDX-License-Identifier: Apache-2.0
// An order of paths with little travel between them.
#pragma once

#include "fill/trails.h"

namespace msq {

/// The paths of all tours in one order. First each tour is followed by the one that begins nearest
/// to its end: they may be reversed, and closed paths begin at any of their points. The first
/// begins nearest to `start`; of equally near ones the first given is taken. Then runs of paths are
/// reversed or moved as long as that shortens the travel (Or, "Traveling salesman-type
/// combinatorial problems", 1976; Croes, "A method for solving traveling-salesman problems", 1958).
/// Moves are bounded, so that the time grows about as the number of paths.
CountedVector<IntPath> order_paths(CountedVector<Tour> tours, IntPoint start);

}  // namespace msq
