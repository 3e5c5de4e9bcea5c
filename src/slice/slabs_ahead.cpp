// SPDX-License-Identifier: Apache-2.0
#include "slice/slabs_ahead.h"

#include <algorithm>

#include "query/membership.h"

namespace msq {

SlabsAhead::SlabsAhead(const Model& model, const Scales& resolved,
                       const std::vector<SampleGrid>& grids, Depth depth, uint64_t first,
                       uint64_t last, Job* job)
    : model_(model),
      resolved_(resolved),
      grids_(grids),
      first_(first),
      last_(last),
      depth_(depth),
      begin_(first),
      end_(first + depth.first),
      layer_(first),
      ahead_job_(job) {
  if (grids_.empty()) return;
  const bool is_one_slab = depth.others == last - first;
  for (const SampleGrid& grid : grids_) {
    const uint64_t words = words_for(grid.nx) * grid.ny;
    layer_words_.push_back(words);
    current_.emplace_back((is_one_slab ? depth.first : depth.others) * words);
    next_.emplace_back((is_one_slab ? depth.others - depth.first : depth.others) * words);
  }
  fill(begin_, end_, current_, job);
  start_next();
}

SlabsAhead::~SlabsAhead() {
  ahead_job_.cancel();
}

uint64_t SlabsAhead::bytes(const Model& model, const Scales& resolved,
                           const std::vector<SampleGrid>& grids, Depth depth, uint64_t layers) {
  uint64_t words = 0, scratch = 0;
  for (const SampleGrid& grid : grids) {
    words += (depth.others == layers ? 1 : 2) * depth.others * words_for(grid.nx) * grid.ny;
    for (const uint64_t filled : {depth.first, depth.others})
      scratch = std::max(scratch, fill_slab_scratch_words(model, resolved, grid, filled));
  }
  return (words + scratch) * sizeof(uint64_t);
}

void SlabsAhead::fill(uint64_t begin, uint64_t end, Slab& slab, const Job* job) const {
  for (size_t g = 0; g < grids_.size(); ++g)
    fill_slab(model_, resolved_, grids_[g], begin, end, slab[g].data(), job);
}

void SlabsAhead::start_next() {
  if (end_ == last_) return;
  // All slabs but the first begin at a multiple of their height: what Slicer::plan_slabs() says of
  // whole cells holds for them.
  const uint64_t end =
      std::min(last_, first_ + (end_ - first_) / depth_.others * depth_.others + depth_.others);
  ahead_.emplace(model_.executor(), [this, begin = end_, end] {
    const CurrentJob current(&ahead_job_);
    fill(begin, end, next_, &ahead_job_);
  });
}

void SlabsAhead::go_to(uint64_t layer) {
  if (grids_.empty()) return;
  if (layer == end_) {
    ahead_->wait();
    ahead_.reset();
    std::swap(current_, next_);
    begin_ = end_;
    end_ =
        std::min(last_, first_ + (end_ - first_) / depth_.others * depth_.others + depth_.others);
    start_next();
  }
  layer_ = layer;
}

}  // namespace msq
