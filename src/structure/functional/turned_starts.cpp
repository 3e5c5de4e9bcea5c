// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/turned_starts.h"

#include <cmath>

#include "structure/functional/row_kernels.h"

namespace msq {

TurnedStarts::TurnedStarts(const Functional& structure, const RowBlock& block, double place)
    : structure_(structure), form_(*structure.form()), block_(block), grid_(*block.grid) {
  const size_t waves = form_.waves().size();
  for (size_t wave = 0; wave < waves; ++wave)
    for (const bool is_cosine : {true, false}) {
      const auto part = static_cast<Part>(2 * wave + is_cosine);
      for (size_t w = 0; w < stride(); ++w)
        word_steps_.push_back(w < block_.row_words()
                                  ? step(part, 0, static_cast<double>(w * bits_per_word) + place)
                                  : 0);
    }
  for (size_t wave = 0; wave < waves; ++wave)
    for (uint64_t row = 0; row < max_group_rows; ++row) {
      const auto part = static_cast<Part>(2 * wave);
      const auto rows = static_cast<double>(row);
      row_steps_.push_back({step(static_cast<Part>(part + 1), 1, rows), step(part, 1, rows)});
    }
  starts_.resize(2 * waves * stride());
  group_starts_.resize(waves);
}

double TurnedStarts::step(Part part, int axis, double samples) const {
  const Neighbourhood& cells = structure_.neighbourhood();
  const TrigonometricForm::Wave& wave = form_.waves()[part / 2];
  // The direction along the grid's axis, in cells per sample.
  const double along = cells.rotation.m[static_cast<size_t>(3 * axis + wave.axis)] *
                       grid_.spacing[axis] / cells.cell_size[wave.axis];
  // Whole turns are removed before precision is lost.
  const double turns = along * samples * wave.frequency;
  return apply(part % 2 ? Op::cosine : Op::sine, angle_of(turns - std::round(turns)), 0);
}

// A coordinate in the grid, in cells, as the definition computes it, is a sum of three products
// divided by the cell size. So its error is within a dozen roundings, of 2^-53 of the sum of
// magnitudes. The same holds for that of a row's first sample. The angle between the two and its
// sine and cosine have a few more roundings; 2^-47 is 64 of them.
double TurnedStarts::angle_error() const {
  const Neighbourhood& cells = structure_.neighbourhood();
  const Box3 box = block_.box();
  const double most =
      3 * (max_magnitude(box.min) + max_magnitude(box.max) + max_magnitude(cells.origin) +
           bits_per_word * grid_.spacing.x + grid_.magnitude());
  const double in_cells = 1 + most / min_component(cells.cell_size);
  return two_pi * 0x1p-47 * in_cells;
}

void TurnedStarts::find(const RowGroup& group, size_t row, const std::vector<uint32_t>& words) {
  const uint64_t after = group.y(row) - group.y0;
  if (after == 0) {
    const Vec3 p = grid_.at(uint64_t{words[0]} * bits_per_word, group.y0, group.z(row));
    double angles[3][batch_padding];
    find_angles(structure_.neighbourhood(), {&p.x, true}, {&p.y, true}, {&p.z, true}, 1,
                {angles[0], angles[1], angles[2]});
    for (size_t n = 0; n < group_starts_.size(); ++n) {
      const TrigonometricForm::Wave& wave = form_.waves()[n];
      const double angle = wave.frequency * angles[wave.axis][0];
      group_starts_[n] = {apply(Op::sine, angle, 0), apply(Op::cosine, angle, 0)};
    }
  }
  float* to = starts_.data();
  const double* steps = word_steps_.data();
  for (size_t n = 0; n < group_starts_.size(); ++n) {
    const auto [sine, cosine] = group_starts_[n];
    const auto [c, s] = row_steps_[n * max_group_rows + after];
    turn_angle(sine * c + cosine * s, cosine * c - sine * s, steps, steps + stride(), words.size(),
               to, to + stride());
    to += 2 * stride();
    steps += 2 * stride();
  }
}

}  // namespace msq
