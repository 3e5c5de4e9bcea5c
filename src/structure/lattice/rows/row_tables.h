// SPDX-License-Identifier: Apache-2.0
// What the rows of a lattice along its grid have in common, kept between calls. All layers of a
// slicer have the same columns and rows, and so have the tiles of a layer the same columns: to sort
// them takes longer than to draw a layer of few struts.
#pragma once

#include <cmath>
#include <deque>
#include <memory>
#include <utility>
#include <vector>

#include "cell/neighbourhood.h"
#include "structure/common/column_sets.h"
#include "structure/lattice/rows/row_kernel.h"

namespace msq {

class RowTables {
 public:
  /// Samples [begin, end) along an axis, and the line of cells that they lie in. Tables of equal
  /// lines are equal, bit for bit: positions in the cell depend on these numbers alone.
  struct Line {
    double cells_from, direction, cell_size;  ///< of the grid of cells, along the samples' axis
    double from, spacing;
    uint64_t first;  ///< index of sample 0
    uint64_t base;   ///< where columns are counted from
    uint64_t begin, end;
    double same;  ///< of classes

    friend bool operator==(const Line&, const Line&) = default;
  };

  struct Columns {
    std::vector<double> positions;  ///< in the cell, in model units, of columns from `base` on
    std::vector<double> samples;    ///< x of these columns
    ColumnSets sets;
    UnrolledColumns unrolled;  ///< all of them

    size_t bytes() const {
      return (positions.capacity() + samples.capacity()) * sizeof(double) + sets.bytes();
    }
  };

  /// Rows or layers by their position in the cell.
  struct Classes {
    std::vector<uint64_t> members;  ///< members of all classes, class by class
    std::vector<size_t> first;      ///< of each class, and the end of the last
    std::vector<double> positions;  ///< of each class, padded by a vector

    size_t count() const { return first.size() - 1; }
    size_t bytes() const {
      return (members.capacity() + first.capacity() + positions.capacity()) * sizeof(uint64_t);
    }
  };

  /// What rows of one layer are drawn from, with a constant radius.
  struct DrawnFrom {
    const RowParts* parts;
    Line columns;
    double radius;
    double z;  ///< of the layer, in the cell
    const double* rows;
    size_t count;  ///< of rows

    /// Whether what is drawn from one serves the other: the parts, columns and layer are equal,
    /// and no row is more than `same` off.
    static bool serves(const DrawnFrom& one, const DrawnFrom& other, double same) {
      if (one.z != other.z || one.count != other.count || one.radius != other.radius ||
          !(one.columns == other.columns) || !one.parts->draws_as(*other.parts))
        return false;
      for (size_t row = 0; row < one.count; ++row)
        if (!(std::abs(one.rows[row] - other.rows[row]) <= same)) return false;
      return true;
    }
  };
  struct DrawnRows {
    std::vector<uint64_t> words;   ///< samples that are certainly inside
    std::vector<LeftSample> left;  ///< for the predicate
  };

  /// Rows that repeat along y: the tiles of a layer after the first one find them drawn. Null if
  /// there are none.
  const DrawnRows* drawn(const DrawnFrom& from, double same) const {
    for (const Drawn& entry : drawn_)
      if (DrawnFrom::serves(entry.from, from, same)) return &entry.rows;
    return nullptr;
  }
  /// To be drawn: the words are of any value.
  DrawnRows make_drawn(size_t words) {
    DrawnRows made;
    while (!drawn_.empty() &&
           (drawn_.size() == max_tables || drawn_bytes_ + words * sizeof(uint64_t) > max_drawn)) {
      drawn_bytes_ -= drawn_.front().bytes();
      made = std::move(drawn_.front().rows);
      drawn_.pop_front();
    }
    made.words.resize(words);
    made.left.clear();
    return made;
  }
  const DrawnRows& keep_drawn(const DrawnFrom& from, DrawnRows&& rows) {
    drawn_.emplace_back(from, std::move(rows));
    drawn_bytes_ += drawn_.back().bytes();
    return drawn_.back().rows;
  }
  static constexpr size_t max_drawn = size_t{1} << 20;  ///< bytes

  template <class Make>
  std::shared_ptr<const Columns> columns(const Line& line, Make&& make) {
    return columns_.find(line, make);
  }
  template <class Make>
  std::shared_ptr<const Classes> classes(const Line& line, Make&& make) {
    return classes_.find(line, make);
  }
  size_t bytes() const { return columns_.bytes() + classes_.bytes() + drawn_bytes_; }

 private:
  /// A call looks through all of them.
  static constexpr size_t max_tables = 64;

  /// The latest tables; together, without the last, they have at most so many bytes.
  template <class Table, size_t max_bytes>
  class Latest {
   public:
    template <class Make>
    std::shared_ptr<const Table> find(const Line& line, Make&& make) {
      for (const Entry& entry : entries_)
        if (entry.line == line) return entry.table;
      Entry made{line, std::make_shared<const Table>(make())};
      while (!entries_.empty() &&
             (entries_.size() == max_tables || bytes_ + made.table->bytes() > max_bytes)) {
        bytes_ -= entries_.front().table->bytes();
        entries_.pop_front();
      }
      entries_.push_back(made);
      bytes_ += made.table->bytes();
      return made.table;
    }
    size_t bytes() const { return bytes_; }

   private:
    struct Entry {
      Line line;
      std::shared_ptr<const Table> table;
    };
    std::deque<Entry> entries_;
    size_t bytes_ = 0;
  };

  /// With copies of what it is drawn from.
  struct Drawn {
    std::unique_ptr<const RowParts> parts;
    std::vector<double> positions;
    DrawnFrom from;
    DrawnRows rows;

    Drawn(const DrawnFrom& original, DrawnRows&& drawn)
        : parts(original.parts->copy()),
          positions(original.rows, original.rows + original.count),
          from(original),
          rows(std::move(drawn)) {
      from.parts = parts.get();
      from.rows = positions.data();
    }
    Drawn(const Drawn&) = delete;
    size_t bytes() const {
      return (rows.words.capacity() + positions.capacity()) * sizeof(uint64_t) +
             rows.left.capacity() * sizeof(LeftSample) + parts->bytes();
    }
  };

  Latest<Columns, size_t{6} << 20> columns_;  // those of rows of 65536 samples
  Latest<Classes, size_t{1} << 20> classes_;
  std::deque<Drawn> drawn_;
  size_t drawn_bytes_ = 0;
};

}  // namespace msq
