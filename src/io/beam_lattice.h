// SPDX-License-Identifier: Apache-2.0
// The beams and balls of a file, and what they are clipped by.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/triangle_soup.h"
#include "base/vec.h"
#include "io/transform.h"

namespace msq {

/// Which part of the beams is kept: all, or that inside or outside a mesh.
enum class Clipping : uint8_t { none = 0, inside = 1, outside = 2 };

struct BeamLattice {
  std::vector<Vec3> nodes;
  std::vector<std::array<uint32_t, 2>> beams;
  std::vector<std::array<double, 2>> radii;
  /// Numbers of BeamCap.
  std::vector<std::array<uint8_t, 2>> caps;
  std::vector<uint32_t> balls;
  std::vector<double> ball_radii;
  /// Shorter beams count for nothing.
  double min_length = 0;
  Clipping clipping = Clipping::none;
  /// Empty without clipping.
  TriangleSoup clip;

  /// Of beams and balls.
  uint64_t size() const { return beams.size() + balls.size(); }
  uint64_t bytes() const;

  /// Drops beams shorter than min_length, then nodes that are not used.
  void drop_unused();
  /// Appends the beams and balls of another lattice, as placed by a transform. Lengths are
  /// multiplied by `scale`, the transform's.
  void append(const BeamLattice& other, const Transform& transform, double scale);
};

/// By how much a transform scales all lengths. Throws Error(unsupported) if it scales lengths along
/// some directions by more than 1e-4 more than along others, because beams would not stay round.
double scale_of(const Transform& transform);

}  // namespace msq
