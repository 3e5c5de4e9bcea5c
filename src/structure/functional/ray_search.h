// SPDX-License-Identifier: Apache-2.0
// Where rays enter and leave functional structures.
//
// Rays go on together, a piece at a time. Over each piece the onset and the level are enclosed
// (expression/ray_bounds.h), and a ray goes as far as that proves that membership stays as it is:
// towards a surface that it will cross, steps shrink as those of Newton's method do; past one that
// it only grazes they are as long as the gap allows. Where they come below the tolerance the ray
// goes on by that. So no part that is longer than the tolerance is overlooked, but where nothing is
// known of the function (it is no number, or has a pole or an infinite slope) or of the level: a
// ray that stays there goes on by steps that grow to `most_blind_step`.
#pragma once

#include <vector>

#include "expression/ray_bounds.h"
#include "structure/functional/functional.h"

namespace msq {

class FunctionalRays {
 public:
  /// In smallest cell sizes.
  static constexpr double most_blind_step = 0x1p-10;

  explicit FunctionalRays(const Functional& solid);

  /// The first t in [from, to] of each search at which membership is `wanted`, and the normal of
  /// the cell's border where that is what the ray goes over there; else 0.
  void find(bool wanted, RaySearch* searches, size_t count);
  /// Fills in the other normals of searches that were found; 0 where the onset does not change.
  void find_normals(RaySearch* searches, size_t count);

 private:
  static constexpr size_t lanes = RayBatch::lanes;

  struct Live {
    uint32_t search;
    uint32_t blind_steps = 0;  // one after the other
    int border = -1;           // axis of the cell's border that the last step went over
    double t, span;
    double before;  // membership is not known to be as it was between that and t
    double error;   // of angles
    Vec3 rates;     // of angles
  };
  /// The level over a piece: value + [low, high] s, + above or - below.
  struct Level {
    double value = 0, low = 0, high = 0, above = 0, below = 0;
    bool is_vague = false;  // known by ranges; shorter pieces may have less of them
  };

  void start(uint32_t number, const RaySearch& search);
  /// Whether the search goes on.
  bool advance(bool wanted, RaySearch& search, Live& live, size_t lane,
               const RayBatch::Bounds& bounds);
  void set_piece(const RaySearch& search, const Live& live, size_t lane);
  void locate(const RaySearch* searches, const Live* live, size_t count);
  Level level_over(const Ray& ray, double t, double span, double value) const;

  const Functional& solid_;
  const Neighbourhood& grid_;
  const Parameter& level_;
  const double tolerance_;
  const double cell_;  // the smallest size
  RayBatch batch_;
  RayBatch::Pieces pieces_;
  std::vector<Live> live_;
  // By lane:
  Vec3 points_[lanes];
  double border_[lanes];    // how far the next one is that the function does not repeat over
  int border_axis_[lanes];  // its axis
  bool is_clear_[lanes];    // of borders, rounding included
  double levels_[lanes];
};

}  // namespace msq
