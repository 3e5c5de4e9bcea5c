// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam: one jittered seed per neighbourhood cell, a pure function of cell index and
// seed number.
//
// Positions are in foam units: the largest cell size is 1, and a cell measures `scale` (1, 1, 1 if
// cells are cubes). They are relative to a nearby cell, so they are small numbers: with cubic
// cells, fractions are multiples of 2^-21 and differences of seeds are exact.
//
// With a weight W > 0, each seed has a sphere of a hashed radius r < W, and the cells are those of
// the power diagram: a point belongs to the seed s of least power |p - s|^2 - r^2 (Imai, Iri and
// Murota, "Voronoi diagram in the Laguerre geometry and its applications", 1985). The power plus
// W^2 is the squared distance, in a space of four dimensions, of p from the seed lifted to the
// height sqrt(W^2 - r^2) above that of p (Aurenhammer, "Power diagrams", 1987). So all that is said
// of distances in Voronoi diagrams holds of the lifted distance sqrt(|p - s|^2 + lift), with lift =
// W^2 - r^2 >= 0: it changes with p by no more than p does, and is no less than |p - s|. Without a
// weight, lifts are 0.
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
  /// `weight`: in foam units, at most the smallest component of the scale.
  FoamSeeds(uint64_t seed, double jitter, Vec3 scale, double weight = 0)
      : key_(splitmix_finalise(seed + 1)),
        jitter_(static_cast<int64_t>(std::floor(jitter * 0x1p31))),
        scale_(scale),
        weight_squared_(weight * weight),
        empty_radius_(std::sqrt(dot(scale, scale) + weight_squared_)) {}

  friend bool operator==(const FoamSeeds& a, const FoamSeeds& b) {
    return a.key_ == b.key_ && a.jitter_ == b.jitter_ && a.scale_ == b.scale_ &&
           a.weight_squared_ == b.weight_squared_;
  }

  Vec3 scale() const { return scale_; }
  /// The scale follows from the grid.
  void describe(HashInput& input) const {
    input.integer(key_);
    input.integer(static_cast<uint64_t>(jitter_));
    if (!is_weighted()) return;
    input.text("weight");
    input.number(weight_squared_);
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

  bool is_weighted() const { return weight_squared_ > 0; }
  /// The lift of a seed with these bits: W^2 (1 - u^2), for the radius W u of its sphere. u has
  /// random bits of its own. u^2 and 1 - u^2 are exact.
  double lift(uint64_t bits) const {
    const double u = static_cast<double>(splitmix_finalise(bits ^ weight_stream) >> 43) * 0x1p-21;
    return weight_squared_ * (1 - u * u);
  }

  /// Maximum distance, lifted, of a point from its nearest seed: the seed of its own cell is within
  /// the cell's diagonal, and its lift is at most W^2. So it is at most 2, and so is the distance
  /// of any point of a seed's cell from the seed.
  double empty_radius() const { return empty_radius_; }

 private:
  static constexpr uint64_t weight_stream = 0x776569676874;  // the bytes "weight"

  /// 0.5 without jitter. Otherwise 21 random bits around 0.5, scaled by the jitter and rounded down
  /// to a multiple of 2^-21: in [0, 1).
  double fraction(uint64_t bits) const {
    const int64_t centred = static_cast<int64_t>(bits & 0x1fffff) - 0x100000;
    return static_cast<double>(0x100000 + ((centred * jitter_) >> 31)) * 0x1p-21;
  }

  uint64_t key_;
  int64_t jitter_;  // of 2^31
  Vec3 scale_;
  double weight_squared_;
  double empty_radius_;
};

/// A seed of a power diagram, or of a Voronoi diagram if its lift is 0.
struct LiftedSeed {
  Vec3 place;
  double lift;
};

// Of seeds with and without lifts: the squared distance, lifted, and the position.
inline double squared_from(Vec3 seed, Vec3 q) {
  const Vec3 d = seed - q;
  return dot(d, d);
}
inline double squared_from(const LiftedSeed& seed, Vec3 q) {
  return squared_from(seed.place, q) + seed.lift;
}
inline Vec3 place_of(Vec3 seed) {
  return seed;
}
inline Vec3 place_of(const LiftedSeed& seed) {
  return seed.place;
}

}  // namespace msq
