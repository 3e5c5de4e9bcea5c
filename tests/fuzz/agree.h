// SPDX-License-Identifier: Apache-2.0
// Whether what a model answers in one way is what it answers in another.
#pragma once

#include "fuzz.h"

namespace msq::fuzz {

/// Where a model is looked at, and how well it may be known.
struct Sight {
  double unit = 1;           ///< about the size of a cell
  double at[3] = {0, 0, 0};  ///< about the origin of the grids
  /// Rays may lose parts of the solid that are shorter than this, in units; 0: than rounding.
  double part = 1.0 / 16;
  /// The distance is that of the library; callbacks of the fuzzer promise theirs.
  bool has_distance = true;
};

/// Membership by point is the definition. Compares with it: arrays, grids, windows, strata, layers,
/// distances, materials, rays and onsets. Points are about the model and on the grid of `sight`.
/// Returns when a call is refused or the job is cancelled.
void check_model(Input& input, msq_context* context, const msq_model* model, const Sight& sight,
                 const Job& job);

}  // namespace msq::fuzz
