// SPDX-License-Identifier: Apache-2.0
#include "structure/common/sampled_rows.h"

#include <bit>

namespace msq {

namespace {

/// Tiles of one word's width, so that the points of a batch lie close together.
constexpr uint64_t tile_rows = 16, tile_layers = 8;
/// Patches of a tile, and the minimum number of samples of a box whose coverage is evaluated.
constexpr unsigned patch_bits = 16;
constexpr uint64_t patch_rows = 4, patch_layers = 4, critical_samples = 16;

uint64_t half_of(uint64_t begin, uint64_t end, uint64_t step) {
  const uint64_t steps = (end - begin + step - 1) / step;
  return begin + steps / 2 * step;
}

}  // namespace

void SampledRows::keep() {
  const Region all{0, block_.row_words(), block_.y0, block_.y1, block_.z0, block_.z1};
  if (structure_.knows_boxes()) {
    if (block_.rows() && block_.layers()) halve(all);
    return;
  }
  for (uint64_t z = all.z0; z < all.z1; z += tile_layers)
    for (uint64_t y = all.y0; y < all.y1; y += tile_rows)
      for (uint64_t w = 0; w < all.w1; ++w)
        keep_tile(
            {w, w + 1, y, std::min(y + tile_rows, all.y1), z, std::min(z + tile_layers, all.z1)});
}

void SampledRows::halve(const Region& r) {
  const uint64_t across = r.w1 - r.w0, rows = (r.y1 - r.y0 + tile_rows - 1) / tile_rows,
                 deep = (r.z1 - r.z0 + tile_layers - 1) / tile_layers;
  if (across == 1 && rows == 1 && deep == 1) return keep_tile(r);
  const BoxClass known =
      classify(r.w0 * bits_per_word, std::min(r.w1 * bits_per_word, block_.grid->nx) - 1, r.y0,
               r.y1, r.z0, r.z1);
  if (known == BoxClass::inside) return;
  if (known == BoxClass::outside) {
    for (uint64_t k = r.z0; k < r.z1; ++k)
      for (uint64_t j = r.y0; j < r.y1; ++j)
        std::fill(block_.row(j, k) + r.w0, block_.row(j, k) + r.w1, 0);
    return;
  }
  Region low = r, high = r;
  if (across >= rows && across >= deep)
    low.w1 = high.w0 = half_of(r.w0, r.w1, 1);
  else if (rows >= deep)
    low.y1 = high.y0 = half_of(r.y0, r.y1, tile_rows);
  else
    low.z1 = high.z0 = half_of(r.z0, r.z1, tile_layers);
  halve(low);
  halve(high);
}

void SampledRows::keep_tile(const Region& tile) {
  points_.clear();
  samples_.clear();
  if (!structure_.knows_boxes()) {
    collect({tile.w0, tile.y0, tile.y1, tile.z0, tile.z1, 0, ~uint64_t{0}});
    return ask();
  }
  for (uint64_t z = tile.z0; z < tile.z1; z += patch_layers)
    for (uint64_t y = tile.y0; y < tile.y1; y += patch_rows)
      for (unsigned bit = 0; bit < bits_per_word; bit += patch_bits) {
        const Patch patch{tile.w0,
                          y,
                          std::min(y + patch_rows, tile.y1),
                          z,
                          std::min(z + patch_layers, tile.z1),
                          bit,
                          ((uint64_t{1} << patch_bits) - 1) << bit};
        if (!keep_patch(patch)) collect(patch);
      }
  ask();
}

bool SampledRows::keep_patch(const Patch& patch) {
  uint64_t samples = 0;
  for (uint64_t k = patch.z0; k < patch.z1; ++k)
    for (uint64_t j = patch.y0; j < patch.y1; ++j)
      samples += static_cast<uint64_t>(std::popcount(block_.row(j, k)[patch.w] & patch.mask));
  if (samples < critical_samples) return samples == 0;
  const uint64_t first = patch.w * bits_per_word + patch.first_bit;
  const BoxClass known =
      classify(first, std::min<uint64_t>(first + patch_bits, block_.grid->nx) - 1, patch.y0,
               patch.y1, patch.z0, patch.z1);
  if (known == BoxClass::outside)
    for (uint64_t k = patch.z0; k < patch.z1; ++k)
      for (uint64_t j = patch.y0; j < patch.y1; ++j) block_.row(j, k)[patch.w] &= ~patch.mask;
  return known != BoxClass::mixed;
}

BoxClass SampledRows::classify(uint64_t first, uint64_t last, uint64_t y0, uint64_t y1, uint64_t z0,
                               uint64_t z1) const {
  check_cancelled(job_);
  const SampleGrid& grid = *block_.grid;
  return structure_.classify({grid.at(first, y0, z0), grid.at(last, y1 - 1, z1 - 1)});
}

void SampledRows::collect(const Patch& patch) {
  for (uint64_t k = patch.z0; k < patch.z1; ++k)
    for (uint64_t j = patch.y0; j < patch.y1; ++j) {
      uint64_t* word = block_.row(j, k) + patch.w;
      for (uint64_t rest = *word & patch.mask; rest; rest &= rest - 1) {
        const unsigned bit = static_cast<unsigned>(std::countr_zero(rest));
        points_.push_back(block_.grid->at(patch.w * bits_per_word + bit, j, k));
        samples_.push_back({word, bit});
      }
    }
}

void SampledRows::ask() {
  if (points_.empty()) return;
  check_cancelled(job_);
  alive_.assign(points_.size(), 1);
  structure_.keep_points(points_.data(), alive_.data(), points_.size());
  for (size_t i = 0; i < samples_.size(); ++i)
    if (!alive_[i]) *samples_[i].word &= ~(uint64_t{1} << samples_[i].bit);
}

}  // namespace msq
