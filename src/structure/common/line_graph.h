// SPDX-License-Identifier: Apache-2.0
// The middle lines of a structure's thin walls in a plane of constant z: points, and straight lines
// between them. Walls meet where a point has three lines or more.
#pragma once

#include <array>
#include <cstdint>

#include "base/vec2.h"
#include "base/working_memory.h"

namespace msq {

/// What of the walls is wanted, in model coordinates.
struct WallSection {
  double z = 0;
  Box2 window;
  double tolerance = 0;  ///< greatest distance between the lines and curved walls; > 0
};

/// Whether a structure has thin walls, and whether the length of their lines per area is the same
/// everywhere on average.
enum class ThinWalls { none, uniform, varying };

struct LineGraph {
  CountedVector<Vec2> points;
  CountedVector<std::array<uint32_t, 2>> lines;

  /// Makes one point of those that are no farther apart than `distance` along either axis; drops
  /// lines that thereby have no length, or that occur twice.
  void weld(double distance);
  /// Fails with Status::limit if squares with this side cannot be numbered at the points: next
  /// numbers would be equal, from 2^53 on.
  void require_squares(double side) const;
};

}  // namespace msq
