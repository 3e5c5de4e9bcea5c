// SPDX-License-Identifier: Apache-2.0
// The contract of fine-scale structures (scales 1 and finer). inside() is the definition:
// everything else must agree with it bit for bit, and has a default that asks it. A new kind is a
// new folder beside this file that implements inside(), plus its constructor in src/api.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/job.h"
#include "base/ref.h"
#include "base/sample_grid.h"
#include "base/vec.h"
#include "cell/neighbourhood.h"

namespace msq {

class Structure : public RefCounted {
 public:
  explicit Structure(const Neighbourhood& neighbourhood) : neighbourhood_(neighbourhood) {}

  const Neighbourhood& neighbourhood() const { return neighbourhood_; }
  double characteristic_length() const { return max_component(neighbourhood_.cell_size); }

  /// Membership of a point whose cell index is below max_cell_index; the boundary is inside.
  virtual bool inside(Vec3 p) const = 0;

  /// Sets alive[i] to 0 where points[i] is outside; looks only at points with alive[i] != 0, which
  /// are 1. Fewer than 2^32 points, in any order.
  virtual void keep_points(const Vec3* points, uint8_t* alive, size_t count) const;
  /// Whether keep_points is faster for points that share cells: then large sets come in groups, each
  /// from a box of few cells.
  virtual bool gains_by_groups() const { return false; }

  /// Clears the bits of samples that are outside. Stops early, by Error(cancelled), with the job.
  virtual void keep_rows(const RowBlock& block, const Job* job) const;

 private:
  Neighbourhood neighbourhood_;
};

}  // namespace msq
