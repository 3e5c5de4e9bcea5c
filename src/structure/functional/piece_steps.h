// SPDX-License-Identifier: Apache-2.0
// How far rays advance on pieces over which the onset is bounded (expression/ray_bounds.h): many
// rays at once, in vectors.
#pragma once

#include <cstddef>

#include "expression/ray_bounds.h"

namespace msq {

/// The levels over the pieces: value + [low, high] s, + above or - below, s being a length.
struct PieceLevels {
  static constexpr size_t lanes = RayBatch::lanes;
  double value[lanes] = {}, low[lanes] = {}, high[lanes] = {}, above[lanes] = {}, below[lanes] = {};
};

struct PieceSteps {
  static constexpr size_t lanes = RayBatch::lanes;
  double most[lanes] = {};  ///< in: the maximum step, positive
  /// Out: the step that is proven not to change membership; 0 if there is none.
  double step[lanes] = {};
  /// Out: the gap between the onset and the level at the start, and its slope, errors subtracted.
  double gap[lanes] = {}, slope[lanes] = {};

  /// `wanted`: the rays search membership; otherwise its end. s of the bounds is in units of
  /// `cell`.
  void find(bool wanted, const RayBatch::Bounds& bounds, const PieceLevels& levels, double cell,
            size_t count);
};

}  // namespace msq
