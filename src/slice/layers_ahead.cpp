// SPDX-License-Identifier: Apache-2.0
#include "slice/layers_ahead.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>

#include "query/membership.h"

namespace msq {

namespace {

using Clock = std::chrono::steady_clock;

constexpr uint64_t none = UINT64_MAX;
/// A block that none of this many calls requested is dropped.
constexpr uint64_t max_idle_calls = 256;
/// Parts of a block, so that several threads have enough of them.
constexpr uint64_t min_parts = 8;
constexpr uint64_t min_part_rows = 32;

}  // namespace

struct LayersAhead::Block {
  uint64_t first = 0, end = 0;  ///< layers
  uint64_t part_rows = 0, parts = 0;
  std::unique_ptr<uint64_t[]> words;  ///< each part clears its rows
  Reservation reservation;

  std::mutex mutex;  ///< guards the next ones
  std::condition_variable is_part_done;
  uint64_t begun = 0, done = 0;
  std::vector<uint64_t> left;  ///< parts whose filling failed
  Clock::duration longest{0};  ///< of parts

  // Guarded by the mutex of LayersAhead:
  uint64_t last_call = 0;
  uint64_t taken = 0;

  uint64_t layers() const { return end - first; }
  bool is_filled() {
    const std::lock_guard lock(mutex);
    return done == parts;
  }
  /// A part to fill; `none` if there is none.
  uint64_t begin_part() {
    const std::lock_guard lock(mutex);
    if (!left.empty()) {
      const uint64_t part = left.back();
      left.pop_back();
      return part;
    }
    return begun < parts ? begun++ : none;
  }
  void end_part(Clock::duration took) {
    const std::lock_guard lock(mutex);
    longest = std::max(longest, took);
    if (++done == parts) is_part_done.notify_all();
  }
  void leave_part(uint64_t part) {
    const std::lock_guard lock(mutex);
    left.push_back(part);  // has room
    is_part_done.notify_all();
  }
  /// Waits until all parts are done; false if that takes too long, or a part is left to fill.
  bool wait(const Job* job) {
    using std::chrono::milliseconds;
    std::unique_lock lock(mutex);
    const Clock::time_point latest = Clock::now() + 4 * longest + milliseconds(50);
    while (done < parts && left.empty() && Clock::now() < latest) {
      is_part_done.wait_for(lock, milliseconds(5));
      check_cancelled(job);
    }
    return done == parts;
  }
};

LayersAhead::LayersAhead(const Model& model, const Scales& resolved, const SampleGrid& samples,
                         uint64_t slab_layers)
    : model_(model),
      resolved_(resolved),
      samples_(samples),
      slab_layers_(slab_layers),
      layer_words_(words_for(samples.nx) * samples.ny) {
  asked_.fill(none);
  model_.context().add_spare(*this);
}

LayersAhead::~LayersAhead() {
  model_.context().remove_spare(*this);
}

bool LayersAhead::take(uint64_t layer, uint64_t* words, const Job* job) {
  const BlockRef block = block_for(layer);
  if (!block) return false;
  if (!block->is_filled()) {
    model_.prepare_skins(resolved_, job);
    const Executor& executor = model_.executor();
    std::atomic<bool> has_failed{false};
    executor.for_each(std::min<uint64_t>(executor.threads(), block->parts),
                      [&](uint64_t) { fill(*block, has_failed, job); });
    if (!block->wait(job)) {
      note_taken(block);
      return false;
    }
  }
  std::memcpy(words, block->words.get() + (layer - block->first) * layer_words_,
              layer_words_ * sizeof(uint64_t));
  note_taken(block);
  return true;
}

void LayersAhead::fill(Block& block, std::atomic<bool>& has_failed, const Job* job) const {
  while (!has_failed) {
    const uint64_t part = block.begin_part();
    if (part == none) return;
    const Clock::time_point start = Clock::now();
    try {
      fill_part(block, part, job);
    } catch (...) {
      has_failed = true;
      block.leave_part(part);
      throw;
    }
    block.end_part(Clock::now() - start);
  }
}

void LayersAhead::fill_part(Block& block, uint64_t part, const Job* job) const {
  check_cancelled(job);
  const uint64_t y0 = part * block.part_rows;
  fill_rows_of_slab(model_, resolved_, samples_, block.first, block.end, y0,
                    std::min(samples_.ny, y0 + block.part_rows), block.words.get(), job);
}

LayersAhead::BlockRef LayersAhead::block_for(uint64_t layer) {
  const std::lock_guard lock(mutex_);
  ++calls_;
  drop_old();
  BlockRef block = find(layer);
  if (!block && follows(layer)) block = make_block(layer);
  asked_[calls_ % asked_.size()] = layer;
  if (block) block->last_call = calls_;
  return block;
}

LayersAhead::BlockRef LayersAhead::find(uint64_t layer) const {
  for (const BlockRef& block : blocks_)
    if (layer >= block->first && layer < block->end) return block;
  return nullptr;
}

bool LayersAhead::follows(uint64_t layer) const {
  return layer > 0 && std::find(asked_.begin(), asked_.end(), layer - 1) != asked_.end();
}

LayersAhead::BlockRef LayersAhead::make_block(uint64_t layer) {
  uint64_t held = 0, next = samples_.nz;
  for (const BlockRef& block : blocks_) {
    held += block->layers();
    if (block->first > layer) next = std::min(next, block->first);
  }
  // What a run has room for, shared with those who ask elsewhere.
  const uint64_t room = 2 * slab_layers_ - std::min(2 * slab_layers_, held);
  const uint64_t count = std::min(
      {2 * layers_before(layer), slab_layers_, std::max(room / 2, uint64_t{1}), next - layer});
  if (count < 2) return nullptr;
  const std::shared_ptr<MemoryBudget>& budget = model_.context().budget;
  const uint64_t scratch = fill_slab_scratch_words(model_, resolved_, samples_, count);
  const uint64_t bytes = (count * layer_words_ + scratch) * sizeof(uint64_t);
  // The cells of the cache are worth more than layers ahead.
  if (budget->limit() && bytes > (budget->limit() - std::min(budget->limit(), budget->held())) / 4)
    return nullptr;
  auto block = std::make_shared<Block>();
  block->first = layer;
  block->end = layer + count;
  const uint64_t rows = rows_of_tile(model_, resolved_, samples_, count);
  block->part_rows =
      std::clamp((samples_.ny + min_parts - 1) / min_parts, std::min(rows, min_part_rows), rows);
  block->parts = (samples_.ny + block->part_rows - 1) / block->part_rows;
  block->left.reserve(block->parts);
  blocks_.reserve(blocks_.size() + 1);
  if (!budget->try_take(bytes)) return nullptr;
  block->reservation = Reservation::adopt(budget, bytes);
  block->words = std::make_unique_for_overwrite<uint64_t[]>(count * layer_words_);
  blocks_.push_back(block);
  ended_[made_++ % ended_.size()] = {block->end, count};
  return block;
}

/// Of the block that ends where a layer begins; 1 if there is none.
uint64_t LayersAhead::layers_before(uint64_t layer) const {
  for (const Ended& of : ended_)
    if (of.end == layer && of.layers) return of.layers;
  return 1;
}

void LayersAhead::drop_old() {
  std::erase_if(blocks_,
                [&](const BlockRef& block) { return calls_ - block->last_call > max_idle_calls; });
}

/// A layer of the block is not requested any more.
void LayersAhead::note_taken(const BlockRef& block) {
  const std::lock_guard lock(mutex_);
  if (++block->taken == block->layers()) std::erase(blocks_, block);
}

bool LayersAhead::give_way() {
  const std::lock_guard lock(mutex_);
  // Calls hold the blocks that they fill and copy from.
  const auto unused = std::find_if(blocks_.begin(), blocks_.end(),
                                   [](const BlockRef& block) { return block.use_count() == 1; });
  if (unused == blocks_.end()) return false;
  blocks_.erase(unused);
  return true;
}

}  // namespace msq
