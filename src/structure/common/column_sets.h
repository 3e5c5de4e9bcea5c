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

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace msq {

class ColumnSets {
 public:
  /// Columns are sorted in parts of this many words, so that the sets stay in a core's own cache.
  static constexpr size_t part_words = 8, max_parts = 8;
  static constexpr int32_t buckets = 16384;

  /// Of columns [first, end), at most max_parts parts from column 0 on; fractions[i]: the position
  /// of column i in its cell, 0 to 1.
  ColumnSets(const double* fractions, size_t first, size_t end);

  size_t parts() const { return parts_; }
  size_t bytes() const {
    return numbers_.capacity() * sizeof(uint16_t) + sets_.capacity() * sizeof(uint64_t);
  }
  /// The columns in some buckets: the difference of two sets.
  struct Range {
    const uint16_t *from, *to;  ///< the numbers of the sets, by part
    uint64_t flip;              ///< is exclusive-ored too: all bits of a range that wraps around
  };
  /// Buckets [begin, end) of the unrolled line of the cell.
  Range range(int32_t begin, int32_t end) const {
    if (end - begin >= buckets) return {numbers_.data(), numbers_.data(), ~uint64_t{0}};
    const auto from = static_cast<uint32_t>(begin) % buckets,
               to = static_cast<uint32_t>(std::max(begin, end)) % buckets;
    return {numbers_.data() + from * parts_, numbers_.data() + to * parts_,
            to < from ? ~uint64_t{0} : 0};
  }
  /// The words of all sets, by their numbers.
  const uint64_t* sets() const { return sets_.data(); }

 private:
  size_t parts_;
  std::vector<uint16_t> numbers_;  // of the sets, by bucket and part
  std::vector<uint64_t> sets_;     // the columns of a part in the order of the buckets
};

}  // namespace msq
