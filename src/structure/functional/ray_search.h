// SPDX-License-Identifier: Apache-2.0
// Where rays enter and leave functional structures.
//
// Rays advance together, one piece at a time. Over each piece the onset and the level are enclosed
// (expression/ray_bounds.h), and a ray advances as far as that proves that membership does not
// change. Towards a surface that the ray will cross, steps shrink like those of Newton's method;
// past a surface that it only grazes, they are as long as the gap allows. If steps get shorter than
// the tolerance, the ray advances by the tolerance. So no part longer than the tolerance is missed.
//
// There are three exceptions. If nothing is known of the function (it is NaN, or has a pole or an
// infinite slope) or of the level, a ray that stays there advances by steps that grow to
// `max_blind_step`. So does a ray that runs along a surface, up to rounding, for about 10^4
// tolerances. If a function is so steep that about 10^3 proven steps advance by less than 2^-12 of
// a cell, steps grow to that length in as many steps.
#pragma once

#include "expression/ray_bounds.h"
#include "structure/functional/functional.h"
#include "structure/functional/piece_steps.h"

namespace msq {

class FunctionalRays {
 public:
  /// In smallest cell sizes.
  static constexpr double max_blind_step = 0x1p-10;

  /// The job may be null.
  FunctionalRays(const Functional& solid, const Job* job);

  /// For each search, finds the first t in [from, to] at which membership is `wanted`. If the ray
  /// crosses the cell's border there, sets the border's normal; otherwise 0. Stops early, by
  /// Error(cancelled), with the job.
  void find(bool wanted, RaySearch* searches, size_t count);
  /// Sets the other normals of searches that were found; 0 where the onset does not change.
  void find_normals(RaySearch* searches, size_t count);

 private:
  static constexpr size_t lanes = RayBatch::lanes;

  /// A ray in progress, in a lane.
  struct Live {
    uint32_t search = 0;
    uint32_t blind_steps = 0;  // consecutive ones
    uint32_t near_steps = 0;   // consecutive ones within rounding of a surface
    uint32_t rounds = 0;
    int border = -1;  // axis of the cell's border that the last step crossed
    double t = 0, span = 0;
    double before = 0;                // membership may have changed between that and t
    double error = 0, off = 0;        // of angles; of positions
    double tolerance = 0;             // of the ray
    double least = 0, looked_at = 0;  // the minimum step, and the ray's t when that was chosen
    Vec3 along;                       // the direction in the grid
    Vec3 rates;                       // of angles at t, per smallest cell size
  };
  /// Bound on the error of the positions of points of a ray.
  double position_error(const RaySearch& search) const;
  double angle_error(const RaySearch& search, double position_error) const;
  void start(uint32_t number, const RaySearch& search, Live& live) const;
  void count_round(Live& live) const;
  double step_unproven(Live& live, bool is_known, bool is_apart, bool is_vague,
                       double tolerance) const;
  /// Puts what all pieces of a ray share into its lane.
  void set_ray(size_t lane);
  void set_no_borders();
  void set_pieces(const RaySearch* searches, size_t count);
  /// Returns whether the search continues.
  bool advance(bool wanted, RaySearch& search, Live& live, size_t lane,
               const RayBatch::Bounds& bounds);
  bool is_settled(bool wanted, const RaySearch& search, size_t lane,
                  const RayBatch::Bounds& bounds) const;
  void set_piece(const RaySearch& search, Live& live, size_t lane);
  void grade(const RaySearch& search, Live& live, size_t lane);
  void bend(const RaySearch& search, Live& live, size_t lane);
  void follow(const RaySearch& search, Live& live, size_t lane);
  /// The normal of a border of the cell at which the ray enters, in [t - 2 tolerances, t + 2
  /// tolerances]; 0 if there is none.
  Vec3 border_normal(const Ray& ray, double t) const;
  /// The normal by the slope; where the function may jump, or has no value beyond, and the slope is
  /// not that of the boundary, an estimate by points all around.
  Vec3 checked_normal(const RaySearch& search, Vec3 by_slope, double steepness) const;
  /// The gradients by angles, from bounds; the middle where a kink leaves an interval.
  void bound_gradients(const RaySearch* searches, size_t count, Vec3* gradients);
  /// Sets points_, levels_ and the coordinates of pieces_ for the lanes below `count`.
  void locate(const RaySearch* searches, size_t count);
  /// Sets levels_ over the lane's piece.
  void set_level(const Ray& ray, double t, double span, size_t lane);

  const Functional& solid_;
  const Job* const job_;
  const Neighbourhood& grid_;
  const Parameter& level_;
  const double tolerance_;
  const double cell_;    // the smallest size
  const Vec3 cells_;     // that over the size along each axis
  const bool is_plain_;  // the function repeats along straight axes: pieces have no borders
  RayBatch batch_;
  RayBatch::Pieces pieces_;
  // By lane:
  Live live_[lanes];
  Vec3 points_[lanes];
  double places_[3][lanes + batch_padding] = {};  // the same by axis
  double border_[lanes];    // distance to the next border across which the function is not periodic
  int border_axis_[lanes];  // its axis
  bool is_clear_[lanes];    // of borders, rounding included
  bool is_vague_[lanes];    // shorter pieces have smaller errors
  PieceLevels levels_;
  bool is_level_vague_[lanes] = {};  // known by ranges; shorter pieces may have narrower ones
  PieceSteps steps_;
  double max_rates_[3][lanes];  // of angles, where they differ along a piece
};

}  // namespace msq
