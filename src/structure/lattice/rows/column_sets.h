// SPDX-License-Identifier: Apache-2.0
// The columns of samples that lie in an interval of the cell, as bits.
//
// If rows run along an axis of the grid, a strut and its copies along the rows contain the samples
// whose position in their cell lies in one interval, in any cell. Positions in the cell are the
// same for every row. So the columns are sorted by them once: for each of `buckets` equal pieces of
// the cell there is the set of the columns before it. The columns between two positions of the cell
// are then the difference of two sets, a few machine words, for any number of cells in a row and
// any spacing of samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace msq {

class ColumnSets {
 public:
  /// Columns are sorted in parts of this many words, so that the sets stay in a core's own cache.
  static constexpr size_t part_words = 8, max_parts = 8;
  static constexpr int32_t buckets = 4096;

  /// Of columns [first, end), at most max_parts parts from column 0 on; fractions[i]: the position
  /// of column i in its cell, 0 to 1.
  ColumnSets(const double* fractions, size_t first, size_t end);

  size_t parts() const { return parts_; }
  size_t bytes() const {
    return numbers_.capacity() * sizeof(uint16_t) + sets_.capacity() * sizeof(uint64_t);
  }
  /// The columns of a part that lie in the buckets before `bucket`, which counts modulo `buckets`.
  const uint64_t* before(int32_t bucket, size_t part) const {
    const size_t place = static_cast<size_t>(bucket & (buckets - 1));
    return sets_.data() + numbers_[place * parts_ + part] * part_words;
  }

 private:
  size_t parts_;
  std::vector<uint16_t> numbers_;  // of the sets, by bucket and part
  std::vector<uint64_t> sets_;     // the columns of a part in the order of the buckets
};

}  // namespace msq
