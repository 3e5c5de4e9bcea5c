// SPDX-License-Identifier: Apache-2.0
// Struts written into the rows of a layer.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "field/field.h"
#include "structure/lattice/column_sets.h"
#include "structure/lattice/row_struts.h"

namespace msq {

/// A radius that ends of struts are found for: `radius` and the row's own, times the strut's
/// factor, plus `margin`.
struct RowLevel {
  double radius, margin;
};

/// Some rows of a layer, and as many columns as ColumnSets take. Positions are in the cell, in
/// model units from its corner.
struct RowTask {
  const RowStruts* struts;
  const ColumnSets* columns;
  const double* x;  ///< of columns
  const double* y;  ///< of rows, padded by a vector
  double z;         ///< of the layer
  size_t rows;
  size_t words;                  ///< of a row
  const uint64_t* const* alive;  ///< each row's; null for a row to leave out

  /// Section by section of so many words (2, 4 or 8) of a row, the level whose struts hold all that
  /// is inside (outer) or nothing else (inner).
  static constexpr size_t least_section_words = 2;
  static constexpr size_t most_sections =
      ColumnSets::most_parts * ColumnSets::part_words / least_section_words;
  static constexpr size_t most_levels = most_sections + 1;
  size_t section_words;
  std::vector<RowLevel> levels;
  size_t outer[most_sections], inner[most_sections];
  size_t widest;  ///< the level of the thickest struts
  /// The row's own part of the radius, padded likewise; null: 0.
  const double* of_row;

  /// The radius at a sample, within `margin`: that of `field`, or if null the row's own and
  /// radius + slope * column.
  const Parameter* field;
  double radius, slope;
  const double *sample_x, *sample_y;  ///< model coordinates
  double sample_z;
  double margin;

  /// Rows of columns->parts() whole parts.
  uint64_t* inside;
  size_t row_words() const { return columns->parts() * ColumnSets::part_words; }
  size_t sections() const { return row_words() / section_words; }
};

/// A sample for the predicate to decide.
struct LeftSample {
  uint32_t row, column;
  friend auto operator<=>(const LeftSample&, const LeftSample&) = default;
};

/// Sets the bits of samples that struts hold for certain; adds those that are within the margin of
/// a surface to `left`, some of them more than once.
void mark_inside(const RowTask& task, std::vector<LeftSample>& left);

}  // namespace msq
