// SPDX-License-Identifier: Apache-2.0
#include "query/membership.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "base/borrowed.h"
#include "base/memory.h"
#include "shape/primitive.h"

namespace msq {

namespace {

/// Rows are restricted in tiles of about this many words: small enough that the span raster's
/// working rows stay in a core's own cache, large enough that few struts reach into several tiles.
constexpr uint64_t tile_words = uint64_t{1} << 17, tile_layers = 64, min_tile_rows = 16;
/// A smaller cache loses the cells that neighbouring tiles share before the second tile comes, so
/// both build them. Then one tile for each thread, even if it exceeds a core's cache, costs less.
constexpr uint64_t min_cache_of_tiles = uint64_t{2} << 20;

}  // namespace

uint64_t rows_of_tile(const Model& model, const Scales& scales, const SampleGrid& grid,
                      uint64_t layers) {
  const unsigned threads = model.executor().threads();
  const bool shares_cells = std::any_of(scales.begin(), scales.end(), [](const Scale* scale) {
    return scale->structure->gains_by_layers();
  });
  const bool is_cached = !shares_cells || model.context().cache.limit() >= min_cache_of_tiles;
  const uint64_t deep = std::max<uint64_t>(1, std::min(layers, tile_layers));
  const uint64_t fit = (is_cached ? 1 : 8) * tile_words / (words_for(grid.nx) * deep);
  // Several tiles for each of several threads.
  const uint64_t balanced =
      is_cached && threads > 1 ? grid.ny / (4 * threads) : (grid.ny + threads - 1) / threads;
  return std::clamp<uint64_t>(std::min(fit, balanced), min_tile_rows,
                              std::max(min_tile_rows, grid.ny));
}

namespace {

/// The number of set bits.
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
  if (!model.regions().empty()) {
    uint64_t most = 0;
    for (size_t r = 0; r < model.regions().size(); ++r)
      most = std::max(
          most, fill_slab_scratch_words(*model.regions()[r], resolved.regions[r], grid, layers));
    return most + 2 * words_for(grid.nx) * grid.ny * layers;
  }
  if (resolved.empty()) return 0;
  const unsigned threads = model.executor().threads();
  const uint64_t rows = std::min(grid.ny, rows_of_tile(model, resolved, grid, layers));
  uint64_t tiles = 1;
  for (const Scale* scale : resolved)
    tiles =
        std::max(tiles, (scale->skin.is_none() ? uint64_t{1} : 2) + scale->structure->row_copies());
  return tiles * threads * words_for(grid.nx) * std::min(layers, tile_layers) * rows;
}

namespace {

/// Rows of a block, tightly packed in memory of their own.
RowBlock copy_of(const RowBlock& block, uint64_t* words) {
  RowBlock copy = block;
  copy.words = words;
  copy.row_stride = block.row_words();
  copy.layer_stride = copy.row_stride * block.rows();
  return copy;
}

/// All rows of a slab of layers, tightly packed.
RowBlock slab_of(const SampleGrid& grid, uint64_t z0, uint64_t z1, uint64_t* words) {
  RowBlock slab;
  slab.grid = &grid;
  slab.y0 = 0;
  slab.y1 = grid.ny;
  slab.z0 = z0;
  slab.z1 = z1;
  slab.words = words;
  slab.row_stride = words_for(grid.nx);
  slab.layer_stride = slab.row_stride * grid.ny;
  return slab;
}

/// The rows and layers of a slab that meet a box; false if there are none.
bool clip_to_box(const RowBlock& slab, const Box3& box, RowBlock& part) {
  const SampleGrid& grid = *slab.grid;
  part = slab;
  part.y0 = std::max(slab.y0, grid.first_y_from(box.min.y));
  part.y1 = std::min(slab.y1, grid.first_y_from<true>(box.max.y));
  part.z0 = std::max(slab.z0, grid.first_z_from(box.min.z));
  part.z1 = std::min(slab.z1, grid.first_z_from<true>(box.max.z));
  if (part.y0 >= part.y1 || part.z0 >= part.z1) return false;
  part.words = slab.row(part.y0, part.z0);
  return grid.first_x_from(box.min.x) < grid.first_x_from<true>(box.max.x);
}

bool has_samples(const RowBlock& block) {
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (size_t w = 0; w < block.row_words(); ++w)
        if (block.row(j, k)[w]) return true;
  return false;
}

/// The samples of a shape, a few layers at a time.
void fill_shape(const Shape& shape, const RowBlock& block) {
  const uint64_t together = shape.layers_together();
  for (uint64_t k = block.z0; k < block.z1; k += together) {
    RowBlock layers = block;
    layers.words = block.row(block.y0, k);
    layers.z0 = k;
    layers.z1 = std::min(block.z1, k + together);
    for (uint64_t n = layers.z0; n < layers.z1; ++n)
      std::memset(layers.row(block.y0, n), 0, block.rows() * block.row_stride * sizeof(uint64_t));
    shape.fill_rows(layers);
  }
}

uint64_t points_of(const RowBlock& block) {
  return block.grid->nx * block.rows() * block.layers();
}

/// fill_shape(), counted.
void fill_shape(const Model& model, const Scales& resolved, const RowBlock& block,
                QueryCounts* counts) {
  fill_shape(model.shape(), block);
  if (!counts) return;
  const uint64_t points = points_of(block);
  counts->points += points;
  counts->by_shape += resolved.empty() ? points : points - samples_of(block);
}

/// Of the samples of the shape, keeps those of each scale in turn. `are_all_in_shape`: all are,
/// though no bits say so.
void keep_scales(const Scales& resolved, const RowBlock& tile, bool are_all_in_shape,
                 const Job* job, QueryCounts* counts) {
  for (const Scale* scale : resolved) {
    const bool draws = are_all_in_shape && scale == resolved.front();
    if (const uint64_t living = !counts ? 0 : draws ? points_of(tile) : samples_of(tile))
      counts->add_group(living);
    draws ? scale->draw_rows(tile, job) : scale->keep_rows(tile, job);
  }
}

/// The samples of a model that is one region.
void fill_tile(const Model& model, const Scales& resolved, const RowBlock& tile, const Job* job,
               QueryCounts* counts) {
  const bool are_all_in_shape = !resolved.empty() && model.shape().holds_block(tile);
  if (!are_all_in_shape)
    fill_shape(model, resolved, tile, counts);
  else if (counts)
    counts->points += points_of(tile);
  keep_scales(resolved, tile, are_all_in_shape, job, counts);
}

/// Tiles of the rows of a block, one after the other in the order of a slab's.
template <class Visit>
void for_each_tile(const RowBlock& block, uint64_t rows, const Executor& executor, const Job* job,
                   Visit&& visit) {
  const uint64_t across = (block.rows() + rows - 1) / rows;
  const uint64_t deep = (block.layers() + tile_layers - 1) / tile_layers;
  executor.for_each(across * deep, [&](uint64_t n) {
    check_cancelled(job);
    RowBlock tile = block;
    tile.y0 = block.y0 + n % across * rows;
    tile.y1 = std::min(block.y1, tile.y0 + rows);
    tile.z0 = block.z0 + n / across * tile_layers;
    tile.z1 = std::min(block.z1, tile.z0 + tile_layers);
    if (block.words) tile.words = block.row(tile.y0, tile.z0);
    visit(tile);
  });
}

/// The samples of each region that no region before it has are filled by themselves, in the rows
/// that meet its box.
void fill_regions(const Model& model, const Scales& resolved, const RowBlock& block,
                  const Executor& executor, const Job* job, QueryCounts* counts) {
  const uint64_t size = block.row_words() * block.rows() * block.layers();
  std::vector<uint64_t> taken_words(size), own_words(size);
  for (uint64_t k = block.z0; k < block.z1; ++k)
    std::fill_n(block.row(block.y0, k), block.rows() * block.row_stride, 0);
  const RowBlock taken = copy_of(block, taken_words.data());
  const RowBlock own = copy_of(block, own_words.data());
  if (counts) {
    counts->points += points_of(block);
    counts->by_shape += points_of(block);
  }
  for (size_t r = 0; r < model.regions().size(); ++r) {
    const Model& region = *model.regions()[r];
    const Scales& scales = resolved.regions[r];
    RowBlock rows;
    if (!clip_to_box(own, region.bounds(), rows)) continue;
    executor.for_each(rows.layers(), [&](uint64_t layer) {
      check_cancelled(job);
      RowBlock part = rows;
      part.z0 = rows.z0 + layer;
      part.z1 = part.z0 + 1;
      part.words = rows.row(rows.y0, part.z0);
      fill_shape(region.shape(), part);
      for (uint64_t j = part.y0; j < part.y1; ++j) {
        uint64_t* found = part.row(j, part.z0);
        uint64_t* before = taken.row(j, part.z0);
        for (size_t w = 0; w < part.row_stride; ++w) {
          const uint64_t in_shape = found[w];
          found[w] &= ~before[w];
          before[w] |= in_shape;
        }
      }
    });
    const uint64_t at_once = rows_of_tile(model, scales, *rows.grid, rows.layers());
    for_each_tile(rows, at_once, executor, job, [&](const RowBlock& tile) {
      if (!has_samples(tile)) return;
      if (counts && !scales.empty()) counts->by_shape -= samples_of(tile);
      keep_scales(scales, tile, false, job, counts);
      for (uint64_t k = tile.z0; k < tile.z1; ++k)
        for (uint64_t j = tile.y0; j < tile.y1; ++j) {
          uint64_t* row = block.row(j, k);
          const uint64_t* kept = tile.row(j, k);
          for (size_t w = 0; w < tile.row_stride; ++w) row[w] |= kept[w];
        }
    });
  }
}

}  // namespace

void fill_slab(const Model& model, const Scales& resolved, const SampleGrid& grid, uint64_t z0,
               uint64_t z1, uint64_t* words, const Job* job, QueryCounts* counts,
               const FinishRows& finish) {
  const RowBlock slab = slab_of(grid, z0, z1, words);
  const Executor& executor = model.executor();
  const auto for_each_layer = [&](uint64_t together, const auto& visit) {
    executor.for_each((z1 - z0 + together - 1) / together, [&](uint64_t n) {
      check_cancelled(job);
      RowBlock block = slab;
      block.z0 = z0 + n * together;
      block.z1 = std::min(z1, block.z0 + together);
      block.words = slab.row(0, block.z0);
      visit(block);
    });
  };
  model.prepare_skins(resolved, job);
  if (!model.regions().empty()) {
    fill_regions(model, resolved, slab, executor, job, counts);
    if (finish) for_each_layer(1, [&](const RowBlock& block) { finish(block, 1); });
    return;
  }

  const bool is_by_tile = fills_by_tile(model, resolved);
  if (!is_by_tile) {
    // Threads take equal shares of the layers.
    const uint64_t at_once = model.shape().layers_together() * executor.threads();
    const uint64_t parts = executor.threads() * ((z1 - z0 + at_once - 1) / at_once);
    for_each_layer((z1 - z0 + parts - 1) / parts, [&](const RowBlock& block) {
      fill_shape(model, resolved, block, counts);
      if (resolved.empty() && finish) finish(block, 1);
    });
  }
  if (resolved.empty()) return;

  // In the same order in each slab: what two slabs share is then found again after as many cells as
  // one slab is high, which the cache must hold at least (docs/benchmarks.md).
  const uint64_t rows = rows_of_tile(model, resolved, grid, slab.layers());
  for_each_tile(slab, rows, executor, job, [&](const RowBlock& block) {
    if (is_by_tile)
      fill_tile(model, resolved, block, job, counts);
    else
      keep_scales(resolved, block, false, job, counts);
    if (finish) finish(block, 1);
  });
}

bool fills_by_tile(const Model& model, const Scales& resolved) {
  return model.regions().empty() && !resolved.empty() && model.shape().fills_rows_apart();
}

void fill_tiles(const Model& model, const Scales& resolved, const SampleGrid& grid, uint64_t z0,
                uint64_t z1, uint64_t rows_together, const Job* job, const FinishRows& finish) {
  static_assert(min_tile_rows % 16 == 0);
  model.prepare_skins(resolved, job);
  const RowBlock slab = slab_of(grid, z0, z1, nullptr);
  const uint64_t rows = rows_of_tile(model, resolved, grid, slab.layers());
  for_each_tile(slab, rows - rows % rows_together, model.executor(), job,
                [&](const RowBlock& tile) {
                  const Borrowed<std::vector<uint64_t>> words;
                  const size_t size = tile.row_words() * tile.rows() * tile.layers();
                  if (words->size() < size) words->resize(size);
                  const RowBlock block = copy_of(tile, words->data());
                  fill_tile(model, resolved, block, job, nullptr);
                  finish(block, 1);
                });
}

uint64_t fill_tiles_words(const Model& model, const Scales& resolved, const SampleGrid& grid,
                          uint64_t layers) {
  const uint64_t rows = std::min(grid.ny, rows_of_tile(model, resolved, grid, layers));
  return fill_slab_scratch_words(model, resolved, grid, layers) +
         model.executor().threads() * words_for(grid.nx) * std::min(layers, tile_layers) * rows;
}

void fill_rows_of_slab(const Model& model, const Scales& resolved, const SampleGrid& grid,
                       uint64_t z0, uint64_t z1, uint64_t y0, uint64_t y1, uint64_t* words,
                       const Job* job) {
  const Executor this_thread(1);
  for (uint64_t begin = z0; begin < z1; begin += tile_layers) {
    RowBlock tile = slab_of(grid, z0, z1, words);
    tile.words = tile.row(y0, begin);
    tile.y0 = y0;
    tile.y1 = y1;
    tile.z0 = begin;
    tile.z1 = std::min(z1, begin + tile_layers);
    if (!model.regions().empty()) {
      fill_regions(model, resolved, tile, this_thread, job, nullptr);
      continue;
    }
    fill_tile(model, resolved, tile, job, nullptr);
    check_cancelled(job);
  }
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
