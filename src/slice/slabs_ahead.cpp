// SPDX-License-Identifier: Apache-2.0
#include "slice/slabs_ahead.h"

#include <algorithm>

#include "query/membership.h"
#include "slice/layer_output.h"

namespace msq {

namespace {

/// Rows of samples that divide a row of pixels.
uint64_t rows_of_pixel(const SampleGrid& grid, const SlabsAhead::Bands& bands) {
  return grid.ny / bands.rows;
}

/// A single thread fills one slab, whose memory its caches then hold, when it is needed.
bool fills_ahead(const Model& model) {
  return model.executor().threads() > 1;
}

}  // namespace

SlabsAhead::SlabsAhead(const Model& model, const Scales& resolved,
                       const std::vector<SampleGrid>& grids, std::vector<GridUse> uses, Depth depth,
                       Bands bands, uint64_t first, uint64_t last, Job* job)
    : model_(model),
      resolved_(resolved),
      grids_(grids),
      uses_(std::move(uses)),
      first_(first),
      last_(last),
      depth_(depth),
      bands_(bands),
      piece_{first, first + depth.first},
      layer_(first),
      job_(job),
      is_ahead_(fills_ahead(model)),
      ahead_job_(job) {
  if (grids_.empty()) return;
  const bool is_one_slab = depth.others == last - first && bands.count() == 1;
  for (const SampleGrid& grid : grids_) {
    const uint64_t words = words_for(grid.nx) * rows_of_pixel(grid, bands) * bands.band_rows;
    layer_words_.push_back(words);
    const auto layers = [words](uint64_t count) {
      return GridSlab{std::make_unique_for_overwrite<uint64_t[]>(count * words),
                      std::make_unique<std::atomic<uint64_t>[]>(count),
                      {},
                      {}};
    };
    current_.push_back(layers(is_one_slab && is_ahead_ ? depth.first : depth.others));
    if (is_ahead_) next_.push_back(layers(is_one_slab ? depth.others - depth.first : depth.others));
  }
  fill(piece_, current_, job);
  start_next();
}

SlabsAhead::~SlabsAhead() {
  ahead_job_.cancel();
}

uint64_t SlabsAhead::bytes(const Model& model, const Scales& resolved,
                           const std::vector<SampleGrid>& grids,
                           const std::vector<RowRepeats>& repeats, Depth depth, Bands bands,
                           uint64_t layers) {
  const bool is_one_slab = depth.others == layers && bands.count() == 1;
  const uint64_t held = (is_one_slab || !fills_ahead(model) ? 1 : 2) * depth.others;
  uint64_t bytes = 0, scratch = 0;
  for (size_t g = 0; g < grids.size(); ++g) {
    const SampleGrid& grid = grids[g];
    const SampleGrid band = rows_of(grid, 0, rows_of_pixel(grid, bands) * bands.band_rows);
    const uint64_t layer_bytes = words_for(band.nx) * band.ny * sizeof(uint64_t);
    bytes += held * (layer_bytes + (repeats[g].any() ? RowFlips::max_bytes(layer_bytes) : 0));
    for (const uint64_t filled : {depth.first, depth.others})
      scratch = std::max(scratch, fill_slab_scratch_words(model, resolved, band, filled));
  }
  return bytes + scratch * sizeof(uint64_t);
}

void SlabsAhead::fill(const Piece& piece, Slab& slab, const Job* job) const {
  for (size_t g = 0; g < grids_.size(); ++g) {
    const uint64_t across = rows_of_pixel(grids_[g], bands_);
    const SampleGrid rows =
        rows_of(grids_[g], across * bands_.begin(piece.band), across * bands_.end(piece.band));
    FinishRows finish;
    if (uses_[g].is_as_bit_output) {
      std::atomic<uint64_t>* const inside = slab[g].inside.get();
      std::fill_n(inside, piece.end - piece.begin, uint64_t{0});
      finish = [inside, begin = piece.begin](const RowBlock& block, uint64_t times) {
        for (uint64_t k = block.z0; k < block.z1; ++k)
          inside[k - begin].fetch_add(
              times * finish_bit_rows(block.row(block.y0, k), block.rows() * block.row_stride),
              std::memory_order_relaxed);
      };
    }
    const RowRepeats repeats = uses_[g].repeats.of_rows(
        rows.first[1] - grids_[g].first[1], rows.first[1] - grids_[g].first[1] + rows.ny);
    slab[g].repeats = {};
    if (repeats.any()) {
      const bool takes_repeats = uses_[g].takes_repeats;
      if (takes_repeats) {
        slab[g].repeats = repeats;
        slab[g].flips.resize(std::max<uint64_t>(slab[g].flips.size(), piece.end - piece.begin));
      }
      fill_repeating_slab(model_, resolved_, rows, repeats, piece.begin, piece.end,
                          slab[g].words.get(), job, finish,
                          takes_repeats ? &slab[g].flips : nullptr);
      continue;
    }
    fill_slab(model_, resolved_, rows, piece.begin, piece.end, slab[g].words.get(), job, nullptr,
              finish);
  }
}

SlabsAhead::Piece SlabsAhead::after(const Piece& piece) const {
  if (piece.band + 1 < bands_.count()) return {piece.begin, piece.end, piece.band + 1};
  // All slabs but the first begin at a multiple of their height: what Slicer::plan_slabs() says of
  // whole cells holds for them.
  const uint64_t end = first_ + (piece.end - first_) / depth_.others * depth_.others;
  return {piece.end, std::min(last_, end + depth_.others)};
}

void SlabsAhead::start_next() {
  if (!is_ahead_) return;
  const Piece next = after(piece_);
  if (next.begin == last_) return;
  ahead_.emplace(model_.executor(), [this, next] {
    const CurrentJob current(&ahead_job_);
    fill(next, next_, &ahead_job_);
  });
}

void SlabsAhead::go_to(uint64_t layer, uint64_t band) {
  if (grids_.empty()) return;
  if (layer == piece_.end || band != piece_.band) {
    piece_ = after(piece_);
    if (is_ahead_) {
      ahead_->wait();
      ahead_.reset();
      std::swap(current_, next_);
    } else {
      fill(piece_, current_, job_);
    }
    start_next();
  }
  layer_ = layer;
}

}  // namespace msq
