// SPDX-License-Identifier: Apache-2.0
// Draws rows of samples through any frustum, ball or half ball, in double precision: for parts that
// the fast kernels do not handle.
#pragma once

#include "structure/beams/beam.h"
#include "strut/raster_target.h"

namespace msq {

/// Sets the samples that the part for certain holds; what else it may hold becomes doubtful spans
/// of `number`. The target's margin: by how much, at most, positions and the predicate are off.
void draw_frustum(const RasterTarget& target, const Beam& beam, uint32_t number,
                  DoubtfulSpans& doubts);
/// The ball at an end, or the half of it; the beam must have it.
void draw_ball(const RasterTarget& target, const Beam& beam, bool is_at_b, uint32_t number,
               DoubtfulSpans& doubts);

}  // namespace msq
