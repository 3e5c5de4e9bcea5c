// SPDX-License-Identifier: Apache-2.0
// What warped cells fill, as a solid: the shell between the radii of a warp, or the box of a
// sampled map. What of a structure is beyond it does not count.
#pragma once

#include "base/hash_input.h"
#include "base/ray.h"
#include "base/sample_grid.h"
#include "structure/common/kept_lines.h"
#include "structure/common/ray_parts.h"
#include "structure/structure.h"

namespace msq {

class CellShell {
 public:
  virtual ~CellShell() = default;

  /// The definition.
  virtual bool holds(Vec3 p) const = 0;
  /// The distance of a point in the shell from its boundary; of others, less than 0, that from the
  /// shell. Its error is below slack(); the boundary's is as large.
  virtual double distance_within(Vec3 p) const = 0;
  /// A bound on the displacement by rounding of points within that distance of p.
  virtual double slack(Vec3 p, double distance) const = 0;
  virtual BoxClass classify(const Box3& box) const = 0;
  /// The parts of a ray, of those in [from, to], in the shell.
  virtual RayParts parts_of(const Ray& ray, double from, double to, double tolerance) const = 0;
  /// At a point of the boundary, outwards.
  virtual Vec3 normal(Vec3 p) const = 0;
  /// Whether a line from a to b has a point in the shell, up to rounding.
  virtual bool meets(Vec3 a, Vec3 b) const = 0;
  virtual void describe(HashInput& input) const = 0;

  /// Of a line in a plane: whether a point of it stays.
  KeptPoint kept(Vec3 p) const;
  /// A t up to `to` up to which the ray stays in the shell, from the end of one of its parts on.
  double follow(const Ray& ray, double t, double to, double tolerance) const;
  /// Clears the bits of samples that are outside. Returns whether any is left.
  bool keep_rows(const RowBlock& block, const Job* job) const;

 protected:
  /// A row of samples whose bits are cleared where they are outside.
  class Row {
   public:
    Row(const CellShell& shell, const SampleGrid& grid, uint64_t j, uint64_t k, uint64_t* bits)
        : shell_(shell), grid_(grid), j_(j), k_(k), bits_(bits) {}

    const SampleGrid& grid() const { return grid_; }
    Vec3 start() const { return grid_.at(0, j_, k_); }
    /// The distance of the last sample from the first.
    double extent() const { return grid_.x(grid_.nx - 1) - grid_.x(0); }
    bool has_any() const;
    /// Samples [first, end): by the definition; all.
    void decide(uint64_t first, uint64_t end);
    void clear(uint64_t first, uint64_t end);

   private:
    const CellShell& shell_;
    const SampleGrid& grid_;
    const uint64_t j_, k_;
    uint64_t* const bits_;
  };
  virtual void keep_row(Row& row) const = 0;
};

}  // namespace msq
