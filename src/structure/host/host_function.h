// SPDX-License-Identifier: Apache-2.0
// A functional structure whose function the host computes. The solid is where the onset is at most
// the level. The onset is the function of the position within the cell (network) or its magnitude
// (sheet).
//
// This is not a Functional: that one evaluates a tape, whose intervals, slopes and factors it
// derives and on which its rows and rays are built. Of the host's function only values and perhaps
// a range are known, in batches that cost a callback each.
#pragma once

#include <functional>
#include <vector>

#include "base/host.h"
#include "field/field.h"
#include "structure/common/max_clusters.h"
#include "structure/structure.h"

namespace msq {

struct HostFunctionCalls {
  /// The function at triples of angles, 2 pi times the position within the cell.
  std::function<void(const Vec3* angles, size_t count, double* values)> evaluate;
  /// Encloses it over a box of angles; may be empty.
  std::function<Interval(const Box3& angles)> range;
};

class HostFunction final : public Structure {
 public:
  /// `clusters`: number along an axis of the cell; 0: the most efficient number. `lipschitz`: with
  /// respect to angles; infinite if unknown. Evaluates the ranges of the clusters at once.
  HostFunction(const Neighbourhood& neighbourhood, HostFunctionCalls calls, bool is_sheet,
               Parameter level, int clusters, double lipschitz, bool is_concurrent);

  bool inside(Vec3 p) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  void keep_points(const Vec3* points, uint8_t* alive, size_t count) const override;
  BoxClass classify(const Box3& box) const override;
  bool knows_boxes() const override { return !clusters_.empty(); }
  /// Rays march together. If the slope and the level's slope are bounded, no part longer than the
  /// tolerance is missed.
  void enter(RaySearch* searches, size_t count, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  Vec3 normal(const Ray& ray, double t) const override;
  double min_ray_step() const override;
  bool is_periodic() const override { return true; }
  ThinWalls thin_walls() const override {
    return is_sheet_ || level_.is_constant() ? ThinWalls::uniform : ThinWalls::varying;
  }
  LineGraph wall_lines(const WallSection& section) const override;

  HostUser& user() { return user_; }
  bool is_sheet() const { return is_sheet_; }
  /// At points: of a sheet the function, of a network the function less the level.
  void differences(const Vec3* points, size_t count, double* values) const;

 private:
  void describe(HashInput& input) const override;
  /// The function at angles.
  void call(const Vec3* angles, size_t count, double* values) const;
  /// The onsets at angles.
  void evaluate(const Vec3* angles, size_t count, double* onsets) const;
  void build_clusters(double lipschitz);
  /// A length along a ray from t within which the onset, which differs from the level by `gap`,
  /// cannot reach the level. It ends at the border of the cell, where the onset may jump. 0 if the
  /// slope is not bounded.
  double steady_along(const Ray& ray, double t, double gap) const;
  /// A length along a ray from t, which is outside, within which all points are outside.
  double outside_along(const Ray& ray, double t, double gap) const;
  /// Sets the normals of the searches that were found.
  void find_normals(RaySearch* searches, size_t count) const;
  Interval onset_of(Interval function) const;
  int number(double angle) const;
  const Interval& cluster(int x, int y, int z) const {
    return clusters_[static_cast<size_t>((z * side_ + y) * side_ + x)];
  }

  HostUser user_;
  HostFunctionCalls calls_;
  bool is_sheet_, is_concurrent_;
  Parameter level_;
  double lipschitz_;                // of angles
  int side_;                        // of the clusters
  std::vector<Interval> clusters_;  // the onset in each; empty if nothing is known
};

}  // namespace msq
