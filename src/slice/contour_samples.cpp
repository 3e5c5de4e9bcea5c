// SPDX-License-Identifier: Apache-2.0
#include "slice/contour_samples.h"

#include <algorithm>
#include <vector>

#include "base/memory.h"
#include "base/sample_grid.h"
#include "query/membership.h"

namespace msq {

namespace {

/// Words of a band of rows that are found at a time where the plane is not normal to z: 16 MiB, and
/// no more than a quarter of the memory limit.
uint64_t band_words(const MemoryBudget& budget) {
  constexpr uint64_t most = uint64_t{1} << 21;
  return budget.limit() ? std::min(most, budget.limit() / 4 / sizeof(uint64_t)) : most;
}

}  // namespace

// Where the plane is normal to y or x, rows of the block are layers of the engine's grid: with one
// row of samples, or with rows of one sample.
void for_sample_rows(const Model& model, const Scales& resolved, const LayerPlane& plane,
                     const SampleBlock& block, const Job* job,
                     const std::function<void(uint64_t j, const uint64_t* words)>& visit) {
  if (block.across == 0 || block.rows == 0) return;
  const bool is_x = plane.axis == 0, is_z = plane.axis == 2;
  SampleGrid grid;
  grid.origin = plane.at(block.u, block.v);
  grid.spacing =
      LayerPlane{plane.axis, block.v_step * plane.unit, plane.unit}.at(block.u_step, block.v_step);
  grid.nx = is_x ? 1 : block.across;
  grid.ny = is_z ? block.rows : is_x ? block.across : 1;
  grid.nz = is_z ? 1 : block.rows;
  const size_t row_words = words_for(grid.nx), layer_words = row_words * grid.ny;
  if (is_z) {
    std::vector<uint64_t> words(layer_words);
    fill_slab(model, resolved, grid, 0, 1, words.data(), job);
    for (uint64_t j = 0; j < block.rows; ++j) visit(j, words.data() + j * row_words);
    return;
  }
  const std::shared_ptr<MemoryBudget>& budget = model.context().budget;
  const uint64_t deep = std::clamp<uint64_t>(band_words(*budget) / layer_words, 1, block.rows);
  const Reservation held(budget,
                         (layer_words * deep + words_for(block.across) +
                          fill_slab_scratch_words(model, resolved, grid, deep)) *
                             sizeof(uint64_t),
                         "the rows of a plane");
  std::vector<uint64_t> words(layer_words * deep), packed(words_for(block.across));
  for (uint64_t k0 = 0; k0 < block.rows; k0 += deep) {
    const uint64_t k1 = std::min(block.rows, k0 + deep);
    fill_slab(model, resolved, grid, k0, k1, words.data(), job);
    for (uint64_t k = k0; k < k1; ++k) {
      const uint64_t* row = words.data() + (k - k0) * layer_words;
      if (is_x) {
        std::fill(packed.begin(), packed.end(), 0);
        for (uint64_t j = 0; j < block.across; ++j) packed[j / 64] |= row[j] << (j % 64);
        row = packed.data();
      }
      visit(k, row);
    }
  }
}

}  // namespace msq
