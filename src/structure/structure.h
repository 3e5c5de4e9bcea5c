// SPDX-License-Identifier: Apache-2.0
// The contract of fine-scale structures (scales 1 and finer). inside() is the definition:
// everything else must agree with it bit for bit, and has a default that asks it. A new kind is a
// new folder beside this file that implements inside(), plus its constructor in src/api.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/job.h"
#include "base/ray.h"
#include "base/ref.h"
#include "base/sample_grid.h"
#include "base/signed_distance.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

enum class Coverage { mixed, outside, inside };

class Structure : public RefCounted {
 public:
  explicit Structure(const Neighbourhood& neighbourhood) : neighbourhood_(neighbourhood) {}

  const Neighbourhood& neighbourhood() const { return neighbourhood_; }
  double characteristic_length() const { return max_component(neighbourhood_.cell_size); }

  /// Membership of a point whose cell index is below max_cell_index; the boundary is inside.
  virtual bool inside(Vec3 p) const = 0;

  /// Whether any thread may ask it, several at once; otherwise only the thread that made the host's
  /// call. A structure with parameters asks them: their fields may be the host's.
  virtual bool is_concurrent() const { return true; }

  /// Signed distance of the same points: at most 0 where inside(p), positive elsewhere, and never
  /// larger in magnitude than the distance from p to the boundary of the solid.
  double distance(Vec3 p) const { return signed_distance(inside(p), clearance(p)); }

  /// A lower bound of the distance from a point to the boundary of the solid, on either side of it:
  /// finite, not negative, and with the rounding of this function and of inside() subtracted. But
  /// for that rounding it differs between two points by no more than their distance. A kind says
  /// where its bound is exact. With no bound the answer is 0, which is always right.
  virtual double clearance(Vec3) const { return 0; }

  /// Whether onset() is known.
  virtual bool has_onset() const { return false; }
  /// The least value of the parameter, radius or level, at which p is inside, were it the same
  /// everywhere; infinity where there is none, or where it is above onset_limit(). The comparison
  /// with the parameter is inside(p) but for rounding, 1e-9 of a cell at most.
  virtual double onset(Vec3) const { return std::numeric_limits<double>::infinity(); }
  /// The greatest value that the parameter may have.
  virtual double onset_limit() const { return std::numeric_limits<double>::infinity(); }
  /// Whether every cell is like every other, but for what fields do.
  virtual bool is_periodic() const { return false; }

  /// Sets alive[i] to 0 where points[i] is outside; looks only at points with alive[i] != 0, which
  /// are 1. Fewer than 2^32 points, in any order.
  virtual void keep_points(const Vec3* points, uint8_t* alive, size_t count) const;
  /// Whether keep_points is faster for points that share cells: then large sets come in groups, each
  /// from a box of few cells.
  virtual bool gains_by_groups() const { return false; }
  /// Into how many parts along each axis a cell is best divided for that; groups are from parts of
  /// cells only where these hold hundreds of points.
  virtual uint32_t group_parts() const { return 1; }
  /// Points of a group from which on keep_points is faster than asking each: as measured
  /// (docs/benchmarks.md).
  virtual uint64_t critical_count() const { return 1; }

  /// What is known of all points of a box together; `mixed` is always right. Asked of kinds that
  /// know_boxes() before their points are.
  virtual Coverage coverage(const Box3&) const { return Coverage::mixed; }
  virtual bool knows_boxes() const { return false; }

  /// For each search the first t in [from, to] at which the ray is inside, within ray_tolerance()
  /// past it; parts shorter than that may be overlooked. Points of the parts have a cell index below
  /// max_cell_index. Default: marches by clearance() and by least_ray_step().
  virtual void enter(RaySearch* searches, size_t count) const;
  /// A t up to which a ray that is inside at `from` stays inside: as far as is known at once, at
  /// most `to`. Default: as enter().
  virtual double leave(const Ray& ray, double from, double to) const;
  /// The outward normal, of length 1, where the ray enters at t; the direction back where there is
  /// none. Default: from membership around the point.
  virtual Vec3 normal(const Ray& ray, double t) const;
  /// Around a point, for normals by membership.
  double normal_distance() const { return 0x1p-12 * min_component(neighbourhood().cell_size); }
  double ray_tolerance() const { return 0x1p-36 * characteristic_length(); }
  /// Rays that march go on by no less than this, whatever clearance() says. Less only where
  /// clearance() is 0 nowhere but at the boundary.
  virtual double least_ray_step() const { return min_component(neighbourhood().cell_size) / 64; }

  /// Whether rows cost less in blocks of many layers, since what is found of a cell serves all of its
  /// samples in a block.
  virtual bool gains_by_layers() const { return false; }
  /// Clears the bits of samples that are outside. Stops early, by Error(cancelled), with the job.
  virtual void keep_rows(const RowBlock& block, const Job* job) const;

 protected:
  /// The first t in [from, to] at which membership is `wanted`, by clearance() and least_ray_step().
  bool march(bool wanted, const Ray& ray, double from, double to, double& t) const;

 private:
  Neighbourhood neighbourhood_;
};

}  // namespace msq
