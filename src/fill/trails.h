// SPDX-License-Identifier: Apache-2.0
// The fewest paths that hold each of some lines once, with little travel between them.
#pragma once

#include "fill/polygon.h"

namespace msq {

/// Paths in the order in which they are printed.
using Tour = CountedVector<IntPath>;

/// Which lines are printed twice.
struct LinePairs {
  double distance = 0;                   ///< between the two; 0: none is printed twice
  const FillPolygon* polygon = nullptr;  ///< not NULL with a distance
};

/// Lines meet where their ends have the same coordinates. An odd number of lines at a point makes
/// it the end of a path in any case. These points are matched so that partners are near; with the
/// ways between partners as lines that are not printed, every point has an even number of lines,
/// and what is connected is one closed tour (Edmonds and Johnson, "Matching, Euler tours and the
/// Chinese postman", 1973). Its paths are half as many as these points: fewer are not possible, and
/// the matching is all their travel. At a point, lines that are most nearly straight are joined as
/// far as tours stay whole. An open tour begins after its longest way; one without ways is a closed
/// path. Closed lines are tours of their own.
///
/// With pairs, a line that ends at a junction of an odd number of lines and at another point with
/// an odd number is printed twice, side by side, shortest first: then neither point is the end of a
/// path. Lines at these points are joined to one of the two each. Where a pair ends at no other
/// line the two meet. Both lines of a pair are within the polygon.
///
/// Paths shorter than `min_length` are left out. So is a shorter line between two points with odd
/// numbers of lines, at least 3: these points then are no longer ends of paths. Shortest lines are
/// left out first.
CountedVector<Tour> find_trails(CountedVector<IntPath> lines, double min_length,
                                const LinePairs& pairs = {});

}  // namespace msq
