// SPDX-License-Identifier: Apache-2.0
// Two lines in place of one, side by side.
#pragma once

#include "base/vec2.h"
#include "fill/polygon.h"

namespace msq {

Vec2 between(IntPoint from, IntPoint to);

/// The point p, moved by a vector and rounded.
IntPoint moved(IntPoint p, Vec2 by);

/// Of a line's end that may be on the border of a polygon: a point before it, towards `before`.
IntPoint short_of(IntPoint end, IntPoint before);

/// Where a line that leaves `corner` in direction `along`, moved aside by `aside` (positive: to the
/// left), meets the line that leaves it in direction `other`, as a vector from the corner. Where
/// they do not meet, or farther than `limit` from the corner: where the moved line begins.
/// Directions have length 1.
Vec2 corner_beside(Vec2 along, double aside, Vec2 other, double limit);

/// An open line, moved aside. Its first point moves by `aside_from`, its last by `aside_to`; those
/// between only if both are the same. Positive: to the left, seen along the line.
IntPath beside(const IntPath& line, double aside_from, double aside_to);

/// Whether the lines at a distance on both sides of an open line are within the polygon. An end
/// that is pointed stays where it is, and may be on the border.
bool fit_beside(const IntPath& line, double aside, bool is_from_pointed, bool is_to_pointed,
                const FillPolygon& polygon);

}  // namespace msq
