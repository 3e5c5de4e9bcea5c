// SPDX-License-Identifier: Apache-2.0
// What rows of samples along an axis of a lattice's grid are drawn from.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace msq {

struct RowTask;
struct LeftSample;

/// The parts of a cell that rows are drawn from, convex, each with its factor of the radius.
struct RowParts {
  std::array<double, 3> cell_size;
  double extent = 0;  ///< maximum magnitude of coordinates of parts' surfaces and of the cell
  double error = 0;   ///< of parts' distances, beyond the rounding of coordinates up to `extent`
  double min_factor = 0, max_factor = 0;

  virtual ~RowParts() = default;
  /// Sets the bits of samples that are certainly in parts. Adds those within the margin of a
  /// surface to `left`, some of them more than once.
  virtual void mark_inside(const RowTask& task, std::vector<LeftSample>& left) const = 0;

  // For rows that are kept with what they were drawn from.
  /// Whether the other parts are equal to these.
  virtual bool draws_as(const RowParts& other) const = 0;
  virtual std::unique_ptr<const RowParts> copy() const = 0;
  /// Held beside the object.
  virtual size_t bytes() const = 0;
};

}  // namespace msq
