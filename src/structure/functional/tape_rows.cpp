// SPDX-License-Identifier: Apache-2.0
#include "structure/functional/tape_rows.h"

namespace msq {

void keep_tape_rows(const Functional& structure, const RowBlock& block, const Job* job) {
  const SampleGrid& grid = *block.grid;
  const Parameter& level = structure.level();
  Batch batch(structure.program());
  double x[batch_points + batch_padding] = {}, angles[3][batch_points + batch_padding];
  double levels[batch_points + batch_padding] = {level.at({})};
  for (size_t axis = 0; axis < 3; ++axis) batch.set_input(axis, {angles[axis], false});
  uint64_t* words[batch_points / bits_per_word];
  const size_t row_words = block.row_words();
  for (uint64_t k = block.z0; k < block.z1; ++k) {
    check_cancelled(job);
    for (uint64_t j = block.y0; j < block.y1; ++j) {
      const double y = grid.y(j), z = grid.z(k);
      for (size_t next = 0; next < row_words;) {
        size_t size = 0;
        for (; next < row_words && size < batch_points; ++next) {
          uint64_t* word = block.row(j, k) + next;
          if (*word == 0) continue;
          words[size / bits_per_word] = word;
          for (size_t i = 0; i < bits_per_word; ++i, ++size) {
            x[size] = grid.x(next * bits_per_word + i);
            if (!level.is_constant()) levels[size] = level.at({x[size], y, z});
          }
        }
        structure.angles().find({x, false}, {&y, true}, {&z, true}, size,
                                {angles[0], angles[1], angles[2]});
        batch.run(size);
        uint64_t bits[batch_points / bits_per_word];
        compare_values(batch.output(0), {levels, level.is_constant()}, size, bits);
        for (size_t i = 0; i < size / bits_per_word; ++i) *words[i] &= bits[i];
      }
    }
  }
}

}  // namespace msq
