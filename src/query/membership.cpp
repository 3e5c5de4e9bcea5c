// SPDX-License-Identifier: Apache-2.0
#include "query/membership.h"

#include <bit>
#include <cstring>

#include "base/memory.h"

namespace msq {

namespace {

/// Rows are restricted in tiles of about this many words: so few that the span raster's working
/// rows stay in a core's own cache, so many that few struts reach into several tiles.
constexpr uint64_t tile_words = uint64_t{1} << 17, tile_layers = 64, least_tile_rows = 16;

uint64_t tile_rows(const SampleGrid& grid, uint64_t layers, unsigned threads) {
  const uint64_t deep = std::max<uint64_t>(1, std::min(layers, tile_layers));
  const uint64_t fit = tile_words / (words_for(grid.nx) * deep);
  const uint64_t balanced = grid.ny / (4 * threads);  // several tiles for each thread
  return std::clamp<uint64_t>(std::min(fit, balanced), least_tile_rows,
                              std::max(least_tile_rows, grid.ny));
}

/// Bits that are set.
uint64_t samples_of(const RowBlock& block) {
  uint64_t samples = 0;
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (size_t w = 0; w < block.row_words(); ++w)
        samples += static_cast<uint64_t>(std::popcount(block.row(j, k)[w]));
  return samples;
}

}  // namespace

uint64_t fill_slab_scratch_words(const Model& model, const Scales& resolved, const SampleGrid& grid,
                                 uint64_t layers) {
  if (resolved.empty()) return 0;
  const unsigned threads = model.executor().threads();
  const uint64_t rows = std::min(grid.ny, tile_rows(grid, layers, threads));
  uint64_t tiles = 1;
  for (const Scale* scale : resolved)
    if (!scale->skin.is_none()) tiles = 2;
  return tiles * threads * words_for(grid.nx) * std::min(layers, tile_layers) * rows;
}

void fill_slab(const Model& model, const Scales& resolved, const SampleGrid& grid, uint64_t z0,
               uint64_t z1, uint64_t* words, const Job* job, QueryCounts* counts) {
  const size_t row_words = words_for(grid.nx);
  RowBlock slab;
  slab.grid = &grid;
  slab.y0 = 0;
  slab.y1 = grid.ny;
  slab.z0 = z0;
  slab.z1 = z1;
  slab.words = words;
  slab.row_stride = row_words;
  slab.layer_stride = row_words * grid.ny;
  const Executor& executor = model.executor();

  model.prepare_skins(resolved);
  executor.for_each(z1 - z0, [&](uint64_t layer) {
    check_cancelled(job);
    RowBlock block = slab;
    block.z0 = z0 + layer;
    block.z1 = block.z0 + 1;
    block.words = slab.row(0, block.z0);
    std::memset(block.words, 0, slab.layer_stride * sizeof(uint64_t));
    model.shape().fill_rows(block);
    if (counts) {
      const uint64_t points = grid.nx * grid.ny;
      counts->points += points;
      counts->by_shape += resolved.empty() ? points : points - samples_of(block);
    }
  });
  if (resolved.empty()) return;

  const uint64_t rows = tile_rows(grid, z1 - z0, executor.threads());
  const uint64_t across = (grid.ny + rows - 1) / rows;
  const uint64_t deep = (z1 - z0 + tile_layers - 1) / tile_layers;
  // In the same order in each slab: what two slabs share is then found again after as many cells as
  // one slab is high, which the cache must hold at least (docs/benchmarks.md).
  executor.for_each(across * deep, [&](uint64_t tile) {
    check_cancelled(job);
    RowBlock block = slab;
    block.y0 = tile % across * rows;
    block.y1 = std::min(grid.ny, block.y0 + rows);
    block.z0 = z0 + tile / across * tile_layers;
    block.z1 = std::min(z1, block.z0 + tile_layers);
    block.words = slab.row(block.y0, block.z0);
    for (const Scale* scale : resolved) {
      if (const uint64_t living = counts ? samples_of(block) : 0) counts->add_group(living);
      scale->keep_rows(block, job);
    }
  });
}

void grid_membership(const Model& model, const Scales& resolved, const SampleGrid& grid,
                     uint8_t* inside, Job* job) {
  const size_t row_words = words_for(grid.nx);
  const uint64_t layer_words = row_words * grid.ny;
  // Slabs of at most 16 MiB, or a layer.
  const uint64_t slab_layers =
      std::clamp<uint64_t>((uint64_t{2} << 20) / layer_words, 1, std::min<uint64_t>(grid.nz, 64));
  const Reservation reservation(
      model.context().budget,
      (slab_layers * layer_words + fill_slab_scratch_words(model, resolved, grid, slab_layers)) *
          sizeof(uint64_t),
      "a slab of the grid");
  std::vector<uint64_t> words(slab_layers * layer_words);
  for (uint64_t z0 = 0; z0 < grid.nz; z0 += slab_layers) {
    const uint64_t z1 = std::min(grid.nz, z0 + slab_layers);
    fill_slab(model, resolved, grid, z0, z1, words.data(), job, job ? &job->counts() : nullptr);
    model.executor().for_each((z1 - z0) * grid.ny, [&](uint64_t r) {
      const uint64_t* row = words.data() + r * row_words;
      uint8_t* out = inside + (z0 * grid.ny + r) * grid.nx;
      for (uint64_t i = 0; i < grid.nx; ++i)
        out[i] = row[i / bits_per_word] >> (i % bits_per_word) & 1;
    });
    if (job) job->set_progress(static_cast<double>(z1) / static_cast<double>(grid.nz));
  }
}

}  // namespace msq
