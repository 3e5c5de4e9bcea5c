// SPDX-License-Identifier: Apache-2.0
// A shape that the host computes: membership of points in a box, and optionally a bound of the
// distance.
#pragma once

#include <functional>

#include "base/host.h"
#include "shape/shape.h"

namespace msq {

struct HostShapeCalls {
  /// Sets inside[i] to nonzero if points[i] is inside.
  std::function<void(const Vec3* points, size_t count, uint8_t* inside)> inside;
  /// Lower bounds on the distance to the boundary, of either sign; may be empty.
  std::function<void(const Vec3* points, size_t count, double* bounds)> distance;
};

class HostShape final : public Shape {
 public:
  HostShape(HostShapeCalls calls, const Box3& bounds, bool is_concurrent);

  bool inside(Vec3 p) const override;
  void find_inside(const Vec3* points, size_t count, uint8_t* inside) const override;
  bool is_concurrent() const override { return is_concurrent_; }
  void fill_rows(const RowBlock& block) const override;
  /// Rays march together, so that the host evaluates many points per callback.
  bool gains_by_rays() const override { return true; }
  void enter_all(RaySearch* searches, size_t count, const Job* job) const override;
  void leave_all(RaySearch* searches, size_t count, const Job* job) const override;
  void find_normals(RaySearch* searches, size_t count) const override;
  /// The host's bounds may jump.
  bool has_steady_distance() const override { return !calls_.distance; }

  HostUser& user() { return user_; }

 protected:
  double distance_bound(Vec3 p) const override;

 private:
  void describe(HashInput& input) const override;
  /// Sets bounds[i] to distance_bound(points[i]).
  void find_distance_bounds(const Vec3* points, size_t count, double* bounds) const;
  /// As RayMarch::find() for each search.
  void march_all(bool wanted, RaySearch* searches, size_t count, const Job* job) const;

  HostUser user_;
  HostShapeCalls calls_;
  bool is_concurrent_;
};

}  // namespace msq
