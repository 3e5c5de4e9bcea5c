// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam: one jittered seed per neighbourhood cell, a pure function of cell index and
// seed number.
//
// Positions are in foam units: the largest cell size is 1, and a cell measures `scale` (1, 1, 1 if
// cells are cubes). They are relative to a nearby cell, so they are small numbers: with cubic
// cells, fractions are multiples of 2^-21 and differences of seeds are exact.
#pragma once

#include <cstdint>

#include "base/hash_input.h"
#include "base/random.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

/// Slack for the rounding of distances in the choice of seeds, foam units; additional seeds never
/// change the result.
constexpr double near_slack = 1e-9;

class FoamSeeds {
 public:
  FoamSeeds(uint64_t seed, double jitter, Vec3 scale)
      : key_(splitmix_finalise(seed + 1)),
        jitter_(static_cast<int64_t>(std::floor(jitter * 0x1p31))),
        scale_(scale) {}

  friend bool operator==(const FoamSeeds& a, const FoamSeeds& b) {
    return a.key_ == b.key_ && a.jitter_ == b.jitter_ && a.scale_ == b.scale_;
  }

  Vec3 scale() const { return scale_; }
  /// The scale follows from the grid.
  void describe(HashInput& input) const {
    input.integer(key_);
    input.integer(static_cast<uint64_t>(jitter_));
  }
  /// In units of 2^-31: 0 to 2^31.
  int64_t jitter() const { return jitter_; }

  /// The seed of cell `home` + (dx, dy, dz), relative to the corner of `home`.
  Vec3 at(CellIndex home, int dx, int dy, int dz) const {
    return in_row(row_key(home, dy, dz), home, dx, dy, dz);
  }

  /// The same for several cells of a row; computes the row's key once.
  uint64_t row_key(CellIndex home, int dy, int dz) const {
    const uint64_t y = static_cast<uint32_t>(home.y + dy), z = static_cast<uint32_t>(home.z + dz);
    return splitmix_finalise(key_ ^ (y | z << 32));
  }
  Vec3 in_row(uint64_t row_key, CellIndex home, int dx, int dy, int dz) const {
    const Vec3 f = fractions(splitmix_output(row_key, static_cast<uint32_t>(home.x + dx)));
    return Vec3{dx + f.x, dy + f.y, dz + f.z} * scale_;
  }

  /// The random bits of a cell, and the position in its box, of size 1, of a seed with these bits.
  uint64_t bits(CellIndex cell) const {
    return splitmix_output(row_key(cell, 0, 0), static_cast<uint32_t>(cell.x));
  }
  Vec3 fractions(uint64_t bits) const {
    return {fraction(bits), fraction(bits >> 21), fraction(bits >> 42)};
  }

  /// Maximum distance of a point from its nearest seed: the seed of its own cell is within the
  /// cell's diagonal.
  double empty_radius() const { return length(scale_); }

 private:
  /// 0.5 without jitter. Otherwise 21 random bits around 0.5, scaled by the jitter and rounded down
  /// to a multiple of 2^-21: in [0, 1).
  double fraction(uint64_t bits) const {
    const int64_t centred = static_cast<int64_t>(bits & 0x1fffff) - 0x100000;
    return static_cast<double>(0x100000 + ((centred * jitter_) >> 31)) * 0x1p-21;
  }

  uint64_t key_;
  int64_t jitter_;  // of 2^31
  Vec3 scale_;
};

}  // namespace msq
