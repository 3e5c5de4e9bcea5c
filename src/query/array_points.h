// SPDX-License-Identifier: Apache-2.0
// The host's array as a set of points; its parts are consecutive runs.
#pragma once

#include "query/point_array.h"
#include "query/point_set.h"

namespace msq {

class ArrayPoints final : public PointSet {
 public:
  explicit ArrayPoints(const PointArray& array) : array_(array) {}

  uint64_t count() const override { return array_.count; }
  void read(uint64_t first, uint64_t count, Vec3* out) const override;
  void gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const override;
  uint64_t parts() const override;
  void read_part(uint64_t index, Part& part) const override;
  bool is_compact() const override { return false; }
  bool is_given() const override { return true; }

 private:
  PointArray array_;
};

}  // namespace msq
