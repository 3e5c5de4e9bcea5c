// SPDX-License-Identifier: Apache-2.0
// The task of drawing parts into the rows of a layer.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "base/simd.h"
#include "field/field.h"
#include "structure/common/column_sets.h"
#include "structure/lattice/rows/row_parts.h"

namespace msq {

/// A radius for which ends of struts are computed: `radius` plus the row's own, times the strut's
/// factor, plus `margin`.
struct RowLevel {
  double radius, margin;
};

/// The columns on the unrolled line of cells, on which a strut and its copies lie a cell apart.
/// Positions are in model units.
struct UnrolledColumns {
  double zero;   ///< the position of column 0
  double width;  ///< from a column to the next; negative if positions decrease
  double off;    ///< maximum distance of a column, modulo the cell, from where these numbers put it
  double first, last;  ///< columns that may be alive

  /// Rounding of column numbers.
  static constexpr double slack = 1e-9;
  double position(double column) const { return zero + column * width; }
  double column(double position) const { return (position - zero) / width; }
};

/// Some rows of a layer, and as many columns as ColumnSets take. Positions are in the cell, in
/// model units from its corner.
struct RowTask {
  const ColumnSets* columns;
  const double* x;  ///< of columns
  const double* y;  ///< of rows, padded by a vector
  double z;         ///< of the layer
  size_t rows;
  size_t words;                  ///< of a row
  const uint64_t* const* alive;  ///< for each row; null for a row to leave out

  /// For each section of that many words (2, 4 or 8) of a row: the outer level, whose struts
  /// contain all samples inside, and the inner one, whose struts contain no others.
  static constexpr size_t min_section_words = 2;
  static constexpr size_t max_sections =
      ColumnSets::max_parts * ColumnSets::part_words / min_section_words;
  static constexpr size_t max_levels = max_sections + 1;
  size_t section_words;
  std::vector<RowLevel> levels;
  size_t outer[max_sections], inner[max_sections];
  size_t widest;  ///< the level of the thickest struts
  /// All sections have the same levels.
  bool is_even() const {
    for (size_t section = 1; section < sections(); ++section)
      if (outer[section] != outer[0] || inner[section] != inner[0]) return false;
    return true;
  }
  /// The row's own part of the radius, padded likewise; null: 0.
  const double* of_row;
  /// Null, or the radius is linear along the rows, and of_row is set. Then each copy of a strut may
  /// be drawn for itself, which pays if few cells are in a row.
  const UnrolledColumns* unrolled;

  /// The radius at a sample, within `margin`: that of `field` or, if null, the row's own and radius
  /// + slope * column.
  const Parameter* field;
  double radius, slope;
  const double *sample_x, *sample_y;  ///< model coordinates
  double sample_z;
  double margin;

  /// Rows of columns->parts() whole parts, and room for one more word.
  uint64_t* inside;
  size_t row_words() const { return columns->parts() * ColumnSets::part_words; }
  size_t sections() const { return row_words() / section_words; }
};

/// A sample for the predicate to decide.
struct LeftSample {
  uint32_t row, column;
  friend auto operator<=>(const LeftSample&, const LeftSample&) = default;
};

/// Memory for drawing rows; on the heap, because it is too large for the stacks of a host's
/// threads.
struct RowWorkspace {
  /// For a vector of rows, level by level, the buckets of the interval's ends; empty if high < low.
  alignas(64) int32_t low[RowTask::max_levels][max_simd_doubles];
  alignas(64) int32_t high[RowTask::max_levels][max_simd_doubles];
  // Samples of a row to compare with a strut.
  static constexpr size_t most = ColumnSets::max_parts * ColumnSets::part_words * 64;
  uint64_t doubtful[most / 64 + 1];
  uint32_t first_column[most / 64 + 1];
  uint32_t column[most + max_simd_doubles];
  alignas(64) double x[most + max_simd_doubles], r[most + max_simd_doubles];
  std::vector<Vec3> positions;
  // Copies of a strut along the rows, by its end a: column, and radius without the row's own.
  static constexpr size_t max_copies = 512;
  alignas(8 * max_simd_doubles) double copy_column[max_copies + max_simd_doubles];
  alignas(8 * max_simd_doubles) double copy_radius[max_copies + max_simd_doubles];
};

}  // namespace msq
