// SPDX-License-Identifier: Apache-2.0
// The points of a set query: an array of the host, a regular grid, a stratified sample. Workers
// take them in parts; only arrays are stored anywhere.
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

  /// Numbers and positions of points: a part of the set.
  struct Part {
    std::vector<uint64_t> numbers;
    std::vector<Vec3> positions;
  };
  static constexpr uint64_t most_in_part = 4096;
  /// How many parts there are, and one of them: at most most_in_part points. Each point is in one.
  virtual uint64_t parts() const = 0;
  virtual void read_part(uint64_t index, Part& part) const = 0;
  /// Whether the points of a part lie as close together as so many points of the set can;
  /// otherwise grouping by cell brings together what is near.
  virtual bool is_compact() const = 0;
  /// Whether the positions are the host's, which may be anything; generated ones are finite.
  virtual bool is_given() const { return false; }
  /// The grid that the set is, if it is one.
  virtual const SampleGrid* as_grid() const { return nullptr; }
};

}  // namespace msq
