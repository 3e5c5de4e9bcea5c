// SPDX-License-Identifier: Apache-2.0
// Numbers by id: a hash table with open addressing.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/id_hash.h"

namespace msq {

class IdTable {
 public:
  /// Forgets all ids and makes room for some.
  void reset(size_t expected) {
    slots_.assign(slots_for(expected), Slot{});
    count_ = 0;
  }
  /// The number of an id. If it is new, it becomes `number`, which is below 2^32 - 1.
  uint32_t find_or_add(Id id, uint32_t number) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = find(id);
    if (slot.number != none) return slot.number;
    ++count_;
    slot = {id, number};
    return number;
  }

  /// Bytes of a table with room for that many ids.
  static uint64_t bytes(size_t expected) { return slots_for(expected) * sizeof(Slot); }
  size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  static constexpr uint32_t none = ~uint32_t{0};
  struct Slot {
    Id id;
    uint32_t number = none;
  };

  static size_t slots_for(size_t expected) { return std::bit_ceil(2 * expected + 16); }

  void grow() {
    std::vector<Slot> old(std::max<size_t>(16, 2 * slots_.size()));
    old.swap(slots_);
    for (const Slot& moved : old)
      if (moved.number != none) find(moved.id) = moved;
  }
  /// The slot of an id, or the free one for it.
  Slot& find(Id id) {
    const size_t mask = slots_.size() - 1;
    size_t i = splitmix_finalise(id.low + 0x9e3779b97f4a7c15ULL * id.high) & mask;
    while (slots_[i].number != none && !(slots_[i].id == id)) i = (i + 1) & mask;
    return slots_[i];
  }

  std::vector<Slot> slots_;
  size_t count_ = 0;
};

}  // namespace msq
