// SPDX-License-Identifier: Apache-2.0
#include "query/array_points.h"

#include <algorithm>

namespace msq {

void ArrayPoints::read(uint64_t first, uint64_t count, Vec3* out) const {
  for (uint64_t i = 0; i < count; ++i) out[i] = array_.at(first + i);
}

void ArrayPoints::gather(uint64_t first, std::span<const uint32_t> numbers, Vec3* out) const {
  // They lie anywhere in the array, so each is prefetched this many points ahead.
  constexpr size_t ahead = 24;
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (i + ahead < numbers.size()) array_.prefetch(first + numbers[i + ahead]);
    out[i] = array_.at(first + numbers[i]);
  }
}

uint64_t ArrayPoints::parts() const {
  return array_.count / max_in_part + (array_.count % max_in_part != 0);
}

void ArrayPoints::read_part(uint64_t index, Part& part) const {
  const uint64_t first = index * max_in_part;
  const uint64_t size = std::min(max_in_part, array_.count - first);
  part.numbers.resize(size);
  for (uint64_t i = 0; i < size; ++i) part.numbers[i] = first + i;
  part.positions.resize(size);
  read(first, size, part.positions.data());
}

}  // namespace msq
