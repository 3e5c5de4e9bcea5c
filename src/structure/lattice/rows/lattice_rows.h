// SPDX-License-Identifier: Apache-2.0
// Rows of samples that run along an axis of a lattice's grid.
#pragma once

#include <functional>
#include <vector>

#include "base/borrowed.h"
#include "base/job.h"
#include "base/sample_grid.h"
#include "cell/neighbourhood.h"
#include "structure/common/repeating_structure.h"
#include "structure/lattice/rows/row_kernel.h"
#include "structure/lattice/rows/row_tables.h"

namespace msq {

class LatticeRows {
 public:
  /// The rows of a block stand for those some periods after them, too
  /// (RepeatingStructure::row_period()).
  struct Repeats {
    uint64_t period = 0, end = 0;
    RowFlips* flips = nullptr;
  };

  /// axis[i]: the axis of the grid parallel to axis i of the samples.
  LatticeRows(const Neighbourhood& grid, const std::array<int, 3>& axis, const RowParts& parts,
              const Parameter& radius, const RowBlock& block)
      : LatticeRows(grid, axis, parts, radius, block, Repeats()) {}
  LatticeRows(const Neighbourhood& grid, const std::array<int, 3>& axis, const RowParts& parts,
              const Parameter& radius, const RowBlock& block, const Repeats& repeats);

  /// RepeatingStructure::row_period(), for a constant radius.
  static uint64_t row_period(const Neighbourhood& grid, const std::array<int, 3>& axis,
                             const RowParts& parts, const SampleGrid& samples, uint64_t y0,
                             uint64_t y1);

  /// Clears the bits of samples that are outside; inside(p) decides the doubtful samples. Returns
  /// false and does nothing where rounding of positions moves a linear radius so far that rows tell
  /// nothing.
  bool keep(const Job* job, const std::function<bool(Vec3)>& inside);

 private:
  static constexpr size_t window_words = ColumnSets::max_parts * ColumnSets::part_words;

  /// Columns that are drawn at a time.
  struct Window {
    size_t first_word;
    uint64_t base, begin, end;  ///< its first column; the columns that may be alive
    size_t words;
    const RowTables::Columns& columns;
    const RowTables::Line& line;  ///< of the columns
    /// All columns of the table may be alive.
    bool is_whole() const { return line.begin == begin && line.end == end; }
  };
  using Classes = RowTables::Classes;
  struct Bit {
    uint64_t* word;
    uint64_t mask;
  };

  /// Positions of columns, rows or layers in their cell: 0 to 1.
  std::vector<double> positions(int axis, uint64_t first, uint64_t end) const;
  /// Of samples along an axis, for the tables that are kept.
  RowTables::Line line(int axis, uint64_t begin, uint64_t end) const;
  RowTables::Columns make_columns(uint64_t base, uint64_t begin, uint64_t end) const;
  UnrolledColumns unroll(const std::vector<double>& x, size_t first) const;
  Classes make_classes(int axis, uint64_t begin, uint64_t end, double same) const;
  void keep_window(size_t first_word, const Job* job, const std::function<bool(Vec3)>& inside);
  void keep_rows(const Window& window, uint64_t begin, uint64_t end, const Job* job,
                 const std::function<bool(Vec3)>& inside);
  void set_levels(RowTask& task, const Window& window, const Classes& rows, uint64_t k);
  void set_linear(RowTask& task, const Window& window, const Classes& rows, uint64_t k);
  void set_whole_rows(RowTask& task, Interval radii, double margin) const;
  bool may_draw_copies(const RowTask& task, const UnrolledColumns& columns) const;
  size_t section_words(double columns, double change) const;

  const Neighbourhood& cells_;
  const std::array<int, 3>& axis_;
  const RowParts& parts_;
  const Parameter& radius_;
  const RowBlock& block_;
  const Repeats repeats_;
  const Borrowed<RowTables> tables_;
  const SampleGrid& grid_;
  double same_, margin_, level_margin_;
  uint64_t i0_ = 0, i1_ = 0, j0_ = 0, j1_ = 0, k0_ = 0, k1_ = 0;  // bounds of all samples alive
  Vec3 gradient_;
  bool is_linear_ = false;
  std::vector<double> of_row_;
  UnrolledColumns unrolled_{};  // of a window
  std::vector<LeftSample> left_once_;
  size_t asked_ = 0;
};

}  // namespace msq
