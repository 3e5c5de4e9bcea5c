// SPDX-License-Identifier: Apache-2.0
// First-in-first-out cache of per-cell data, limited in bytes.
// Source: paper, section "Set Queries for Ray-Casting".
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "base/memory.h"
#include "cell/neighbourhood.h"

namespace msq {

class CellData {
 public:
  virtual ~CellData() = default;
  virtual uint64_t bytes() const = 0;
};

class CellCache {
 public:
  struct Counters {
    uint64_t hits = 0, misses = 0, evictions = 0, bytes = 0, peak_bytes = 0;
  };

  CellCache(uint64_t limit, std::shared_ptr<MemoryBudget> budget)
      : limit_(limit), budget_(std::move(budget)) {}
  ~CellCache() { clear(); }

  /// The data of a cell of the structure with this id, built on a miss. No lock is held while it is
  /// built: two threads may then build the same cell, and the first to finish is kept. Data that
  /// does not fit is returned all the same, and not kept.
  std::shared_ptr<const CellData> fetch(
      uint64_t structure, CellIndex cell,
      const std::function<std::shared_ptr<const CellData>()>& build);

  void clear();
  /// Drops the cells of a structure.
  void drop(uint64_t structure);
  /// Drops the oldest cell, if there is one.
  bool drop_oldest();
  Counters counters() const;
  uint64_t limit() const { return limit_; }

 private:
  struct Key {
    uint64_t structure;
    CellIndex cell;
    friend bool operator==(const Key& a, const Key& b) {
      return a.structure == b.structure && a.cell == b.cell;
    }
  };
  struct KeyHash {
    size_t operator()(const Key& key) const;
  };
  struct Entry {
    std::shared_ptr<const CellData> data;
    uint64_t bytes;
  };

  void evict_oldest();

  const uint64_t limit_;
  const std::shared_ptr<MemoryBudget> budget_;
  mutable std::mutex mutex_;
  std::unordered_map<Key, Entry, KeyHash> entries_;
  std::deque<Key> order_;
  Counters counters_;
};

}  // namespace msq
