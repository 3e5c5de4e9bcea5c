// SPDX-License-Identifier: Apache-2.0
// The points of a set query: an array of the host, a regular grid, or a stratified sample. Workers
// take them in parts; only arrays are stored.
// Source: paper, section "Structured and Unstructured Set Queries".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/sample_grid.h"
#include "base/vec.h"

namespace msq {

class PointSet {
 public:
  virtual ~PointSet() = default;

  virtual uint64_t count() const = 0;
  /// Points first ... first + count - 1, in the order of their numbers.
  virtual void read(uint64_t first, uint64_t count, Vec3* out) const = 0;
  /// Points first + numbers[i].
  virtual void gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const = 0;

  /// A part of the set: numbers and positions of its points.
  struct Part {
    std::vector<uint64_t> numbers;
    std::vector<Vec3> positions;
  };
  static constexpr uint64_t max_in_part = 4096;
  /// The number of parts, and one part: at most max_in_part points. Each point is in exactly one
  /// part.
  virtual uint64_t parts() const = 0;
  virtual void read_part(uint64_t index, Part& part) const = 0;
  /// Whether the points of a part lie as close together as that many points of the set can. If not,
  /// grouping by cell brings neighbours together.
  virtual bool is_compact() const = 0;
  /// Whether the positions are the host's, with arbitrary values. Generated positions are finite.
  virtual bool is_given() const { return false; }
  /// A box that contains all points, with rounding. Returns false if the points would have to be
  /// read.
  virtual bool find_bounds(Box3&) const { return false; }
  /// The set as a grid, if it is one.
  virtual const SampleGrid* as_grid() const { return nullptr; }
};

}  // namespace msq
