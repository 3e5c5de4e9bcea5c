// SPDX-License-Identifier: Apache-2.0
#include "structure/common/column_sets.h"

#include <algorithm>
#include <array>

#include "base/sample_grid.h"

namespace msq {

namespace {

constexpr size_t part_columns = ColumnSets::part_words * bits_per_word;

/// A column of a part, and the bucket that contains it; sorts by the bucket.
uint32_t key_of(double fraction, size_t column) {
  const auto bucket = static_cast<int32_t>(fraction * ColumnSets::buckets);
  return static_cast<uint32_t>(std::min(bucket, ColumnSets::buckets - 1)) * part_columns +
         static_cast<uint32_t>(column);
}

}  // namespace

ColumnSets::ColumnSets(const double* fractions, size_t first, size_t end)
    : parts_((end + part_columns - 1) / part_columns), numbers_(buckets * parts_) {
  sets_.reserve((end - first + parts_) * part_words);
  std::array<uint32_t, part_columns> keys;
  for (size_t part = 0; part < parts_; ++part) {
    size_t count = 0;
    for (size_t i = std::max(first, part * part_columns);
         i < std::min(end, (part + 1) * part_columns); ++i)
      keys[count++] = key_of(fractions[i], i - part * part_columns);
    std::sort(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count));
    std::array<uint64_t, part_words> set{};
    uint32_t bucket = 0;
    for (size_t n = 0;;) {
      const uint32_t next = n < count ? keys[n] / part_columns + 1 : buckets;
      const auto number = static_cast<uint16_t>(sets_.size() / part_words);
      for (; bucket < next; ++bucket) numbers_[bucket * parts_ + part] = number;
      sets_.insert(sets_.end(), set.begin(), set.end());
      if (n == count) break;
      for (; n < count && keys[n] / part_columns + 1 == next; ++n) {
        const uint32_t column = keys[n] % part_columns;
        set[column / bits_per_word] |= uint64_t{1} << (column % bits_per_word);
      }
    }
  }
}

}  // namespace msq
