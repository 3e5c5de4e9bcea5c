// SPDX-License-Identifier: Apache-2.0
// Parts of beams as input of the fast kernels: component by component, so that several are set up
// at once.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/simd.h"
#include "structure/beams/beam.h"
#include "strut/raster_target.h"

namespace msq {

/// Kernels read whole vectors: up to `padding` entries past the count.
struct FrustumBatch {
  static constexpr size_t capacity = 64, padding = max_simd_doubles;

  size_t count = 0;
  double a[3][capacity + padding], b[3][capacity + padding];
  double radius_a[capacity + padding], radius_b[capacity + padding];
  uint32_t number[capacity];  ///< of the beam

  void push(const Beam& beam, uint32_t beam_number) {
    for (int axis = 0; axis < 3; ++axis) {
      a[axis][count] = beam.a[axis];
      b[axis][count] = beam.b[axis];
    }
    radius_a[count] = beam.radius_a;
    radius_b[count] = beam.radius_b;
    number[count++] = beam_number;
  }
};

/// Balls and half balls.
struct BallBatch {
  static constexpr size_t capacity = 128, padding = max_simd_doubles;

  size_t count = 0;
  double centre[3][capacity + padding], radius[capacity + padding];
  double out[3][capacity + padding];  ///< of length 1: on its side lies the half; 0 of whole balls
  uint32_t number[capacity];          ///< of the beam
  bool is_at_b[capacity];

  /// The ball or half ball at an end of a beam that has it.
  void push(const Beam& beam, bool at_b, uint32_t beam_number) {
    const Vec3 c = at_b ? beam.b : beam.a, ab = beam.b - beam.a;
    Vec3 normal;
    if ((at_b ? beam.cap_b : beam.cap_a) == BeamCap::hemisphere && beam.has_length())
      normal = ab * ((at_b ? 1 : -1) / length(ab));
    for (int axis = 0; axis < 3; ++axis) {
      centre[axis][count] = c[axis];
      out[axis][count] = normal[axis];
    }
    radius[count] = at_b ? beam.radius_b : beam.radius_a;
    is_at_b[count] = at_b;
    number[count++] = beam_number;
  }
};

/// Draw the parts as draw_frustum() and draw_ball() do, most of them in single precision. beams[n]:
/// beam n.
void draw_frusta(const RasterTarget& target, const FrustumBatch& batch, const Beam* beams,
                 DoubtfulSpans& doubts);
void draw_balls(const RasterTarget& target, const BallBatch& batch, const Beam* beams,
                DoubtfulSpans& doubts);

}  // namespace msq
