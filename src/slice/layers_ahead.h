// SPDX-License-Identifier: Apache-2.0
// Layers that are requested one by one, filled together. Many structures take two or three times as
// long for single layers as for those of a slab, which share the struts that pass through them. So
// calls that ask for layer after layer get their bits from blocks of layers that are filled ahead.
//
// A block begins where a call requests the layer after one that was requested lately. It has twice
// the layers of the block before it, so less is filled than twice what is requested, and at most as
// many as a slab. All blocks together have at most the layers of two slabs, as a run
// has. A block goes when its layers are taken, when nobody has requested it for long, or when
// others need the memory.
//
// A block is filled in parts, tiles of rows. Each call that needs a layer of the block takes parts
// until none is left, so threads of the host that ask for neighbouring layers at once fill them
// together. Where the last parts are still being filled by other calls, a call waits for them
// about as long as parts take. After that it fills its layer by itself: to wait without a limit
// could be to wait for ever, since the call that fills a part may be suspended below this one on
// the stack of the same thread (a host's parallel_for may take up any work while it waits).
//
// The lock is held for bookkeeping only. No call waits for another one's layers to be filled unless
// it has helped to fill them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "base/job.h"
#include "base/sample_grid.h"
#include "cell/context.h"
#include "model/model.h"

namespace msq {

class LayersAhead final : public SpareMemory {
 public:
  /// Of the samples of a slicer, whose slabs have this many layers. All arguments must outlive
  /// this.
  LayersAhead(const Model& model, const Scales& resolved, const SampleGrid& samples,
              uint64_t slab_layers);
  ~LayersAhead() override;

  /// Whether single layers of a model cost more than those of a slab, as they do with structures.
  static bool pays(const Scales& resolved) { return !resolved.empty(); }

  /// Writes the bits of a layer, as fill_slab() does. Returns false if the layer is to be filled by
  /// itself.
  bool take(uint64_t layer, uint64_t* words, const Job* job);

  bool give_way() override;

 private:
  struct Block;
  using BlockRef = std::shared_ptr<Block>;

  /// The block of a layer, a new one where it pays; null if there is none.
  BlockRef block_for(uint64_t layer);
  BlockRef find(uint64_t layer) const;
  BlockRef make_block(uint64_t layer);
  bool follows(uint64_t layer) const;
  void drop_old();
  uint64_t layers_before(uint64_t layer) const;
  /// Fills parts until there are none to begin, or one failed.
  void fill(Block& block, std::atomic<bool>& has_failed, const Job* job) const;
  void fill_part(Block& block, uint64_t part, const Job* job) const;
  void note_taken(const BlockRef& block);

  const Model& model_;
  const Scales& resolved_;
  const SampleGrid& samples_;
  const uint64_t slab_layers_, layer_words_;

  std::mutex mutex_;  ///< guards all below
  std::vector<BlockRef> blocks_;
  uint64_t calls_ = 0;
  /// The last layers that were requested.
  std::array<uint64_t, 64> asked_;
  /// Where the last blocks ended, and their layers.
  struct Ended {
    uint64_t end = 0, layers = 0;
  };
  std::array<Ended, 16> ended_;
  uint64_t made_ = 0;
};

}  // namespace msq
