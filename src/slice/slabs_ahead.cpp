// SPDX-License-Identifier: Apache-2.0
#include "slice/slabs_ahead.h"

#include <algorithm>

#include "query/membership.h"

namespace msq {

namespace {

/// The first slab has this part of the layers of a slab: 1 / 8. The caller waits for it, and
/// workers fill the second one while it takes the first.
uint64_t shallow_part(uint64_t deep) {
  constexpr uint64_t first_slab_part = 8;
  return (deep + first_slab_part - 1) / first_slab_part;
}

}  // namespace

SlabsAhead::SlabsAhead(const Model& model, const Scales& resolved,
                       const std::vector<SampleGrid>& grids, uint64_t slab_layers, uint64_t first,
                       uint64_t last, Job* job)
    : model_(model),
      resolved_(resolved),
      grids_(grids),
      first_(first),
      last_(last),
      deep_(std::min(slab_layers, last - first)),
      shallow_(shallow_part(deep_)),
      begin_(first),
      end_(first + shallow_),
      layer_(first),
      ahead_job_(job) {
  if (grids_.empty()) return;
  const bool is_one_slab = deep_ == last_ - first_;
  for (const SampleGrid& grid : grids_) {
    const uint64_t words = words_for(grid.nx) * grid.ny;
    layer_words_.push_back(words);
    current_.emplace_back((is_one_slab ? shallow_ : deep_) * words);
    next_.emplace_back((is_one_slab ? deep_ - shallow_ : deep_) * words);
  }
  fill(begin_, end_, current_, job);
  start_next();
}

SlabsAhead::~SlabsAhead() {
  ahead_job_.cancel();
}

uint64_t SlabsAhead::bytes(const Model& model, const Scales& resolved,
                           const std::vector<SampleGrid>& grids, uint64_t slab_layers,
                           uint64_t layers) {
  const uint64_t deep = std::min(slab_layers, layers);
  uint64_t words = 0, scratch = 0;
  for (const SampleGrid& grid : grids) {
    words += (deep == layers ? deep : 2 * deep) * words_for(grid.nx) * grid.ny;
    for (const uint64_t filled : {shallow_part(deep), deep})
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
  const uint64_t end = std::min(last_, first_ + (end_ - first_) / deep_ * deep_ + deep_);
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
    end_ = std::min(last_, first_ + (end_ - first_) / deep_ * deep_ + deep_);
    start_next();
  }
  layer_ = layer;
}

}  // namespace msq
