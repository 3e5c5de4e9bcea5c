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

/// Whether rows become pixels of another size, so that a slab has no room for their samples.
bool keeps_no_samples(const RowOutput* output) {
  return output && output->pixel_bytes() > 0;
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
  for (size_t g = 0; g < grids_.size(); ++g) {
    const uint64_t across = rows_of_pixel(grids_[g], bands);
    const SampleGrid band = rows_of(grids_[g], 0, across * bands.band_rows);
    const uint64_t words = bytes_of_rows(band, across, uses_[g].output) / sizeof(uint64_t);
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

uint64_t SlabsAhead::bytes_of_rows(const SampleGrid& rows, uint64_t across,
                                   const RowOutput* output) {
  return output ? layer_stride(output->pixel_bytes(), rows.nx / across) * (rows.ny / across)
                : words_for(rows.nx) * rows.ny * sizeof(uint64_t);
}

SlabsAhead::~SlabsAhead() {
  ahead_job_.cancel();
}

uint64_t SlabsAhead::bytes(const Model& model, const Scales& resolved,
                           const std::vector<SampleGrid>& grids, const std::vector<GridUse>& uses,
                           Depth depth, Bands bands, uint64_t layers) {
  const bool is_one_slab = depth.others == layers && bands.count() == 1;
  const uint64_t held = (is_one_slab || !fills_ahead(model) ? 1 : 2) * depth.others;
  uint64_t bytes = 0, scratch = 0;
  for (size_t g = 0; g < grids.size(); ++g) {
    const uint64_t across = rows_of_pixel(grids[g], bands);
    const SampleGrid band = rows_of(grids[g], 0, across * bands.band_rows);
    const uint64_t layer_bytes = bytes_of_rows(band, across, uses[g].output);
    bytes += held * (layer_bytes + (uses[g].repeats.any() ? RowFlips::max_bytes(layer_bytes) : 0));
    for (const uint64_t filled : {depth.first, depth.others})
      scratch = std::max(scratch, keeps_no_samples(uses[g].output)
                                      ? fill_tiles_words(model, resolved, band, filled)
                                      : fill_slab_scratch_words(model, resolved, band, filled));
  }
  return bytes + scratch * sizeof(uint64_t);
}

void SlabsAhead::fill(const Piece& piece, Slab& slab, const Job* job) const {
  for (size_t g = 0; g < grids_.size(); ++g) fill_grid(g, piece, slab[g], job);
}

void SlabsAhead::fill_grid(size_t g, const Piece& piece, GridSlab& slab, const Job* job) const {
  const GridUse& use = uses_[g];
  const uint64_t across = rows_of_pixel(grids_[g], bands_);
  const SampleGrid rows =
      rows_of(grids_[g], across * bands_.begin(piece.band), across * bands_.end(piece.band));
  FinishRows finish;
  if (use.output) {
    const uint64_t width = rows.nx / across;
    std::fill_n(slab.inside.get(), piece.end - piece.begin, uint64_t{0});
    finish = [&slab, &use, &piece, across, width, layer_words = layer_words_[g],
              stride = layer_stride(use.output->pixel_bytes(), width)](const RowBlock& block,
                                                                       uint64_t times) {
      for (uint64_t k = block.z0; k < block.z1; ++k) {
        uint64_t* const layer = slab.words.get() + (k - piece.begin) * layer_words;
        uint8_t* const out = reinterpret_cast<uint8_t*>(layer) + block.y0 / across * stride;
        slab.inside[k - piece.begin].fetch_add(
            times *
                use.output->write_rows(block.row(block.y0, k), width, block.rows() / across, out),
            std::memory_order_relaxed);
      }
    };
  }
  slab.repeats = {};
  if (keeps_no_samples(use.output)) {
    fill_tiles(model_, resolved_, rows, piece.begin, piece.end, across, job, finish);
    return;
  }
  const RowRepeats repeats = use.repeats.of_rows(rows.first[1] - grids_[g].first[1],
                                                 rows.first[1] - grids_[g].first[1] + rows.ny);
  if (!repeats.any()) {
    fill_slab(model_, resolved_, rows, piece.begin, piece.end, slab.words.get(), job, nullptr,
              finish);
    return;
  }
  if (use.takes_repeats) {
    slab.repeats = repeats;
    slab.flips.resize(std::max<uint64_t>(slab.flips.size(), piece.end - piece.begin));
  }
  fill_repeating_slab(model_, resolved_, rows, repeats, piece.begin, piece.end, slab.words.get(),
                      job, finish, use.takes_repeats ? &slab.flips : nullptr);
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
