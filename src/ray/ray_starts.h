// SPDX-License-Identifier: Apache-2.0
// Where rays come near the bounds of a shape, in vectors of rays; and where they cross a shape that
// is a box.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/ray.h"

namespace msq {

/// What the rays of a model have in common. They are followed up to `beyond` past their ends.
struct StartBoxes {
  Box3 bounds, near;  ///< of the shape; and with rounding of points of rays
  double beyond;
  bool has_box;  ///< whether the shape is the box `box`, and crossings of it are wanted
  Box3 box;
  double tolerance;  ///< of entries into it
};

/// Up to `most` rays; lanes beyond their number are arbitrary.
struct RayStarts {
  static constexpr size_t most = 16;

  uint32_t miss = 0;     ///< those that do not meet the bounds
  uint32_t begin = 0;    ///< those that begin there within rounding; of the rest nothing is known
  uint32_t crosses = 0;  ///< of those that begin, those whose way through the box is known
  alignas(64) double offset[most];              ///< t where they meet the bounds
  alignas(64) double origin[3][most];           ///< the point there; from there on:
  alignas(64) double end[most];                 ///< t where they leave the bounds, or end
  alignas(64) double enter[most], leave[most];  ///< as Shape::cross() of the box
};

/// Starts `count` rays, at most RayStarts::most. The numbers are those of clip_to_box() and
/// Shape::cross(), to the last bit.
void start_rays(const RaySearch* searches, size_t count, const StartBoxes& boxes,
                RayStarts& starts);

}  // namespace msq
