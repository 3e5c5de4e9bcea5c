// SPDX-License-Identifier: Apache-2.0
// Cache of per-cell data, limited in bytes, for any number of threads.
// Sources: paper, section "Set Queries for Ray-Casting" (first in, first out); Yang, Zhang, Qiu,
// Yue and Rashmi, "FIFO queues are all you need for cache eviction", SOSP 2023 (segmented).
//
// The limit bounds, at every moment, the sum of two things: the bytes of the kept cells, and the
// bytes that builders of cells have reserved. A builder reserves bytes before it begins, as many as
// recent cells of its structure took. Other cells are evicted for that. A cell that turns out
// larger than its reservation is counted in full once it is built. Cells in use are not evicted,
// since that would free no memory, and so the limit covers them too. Only cells for which no bytes
// could be reserved are beyond the limit. They are built anyway, for one caller, and are deleted
// when that caller releases them.
//
// Locks: hits share the lock of their part of the table. That lock is exclusive only to enter or
// remove one cell, never while one is built or destroyed. Misses meet at the queue, whose mutex is
// held for the bookkeeping and the destruction of evicted cells.
//
// If two threads miss the same cell, both build it, and the first to finish is kept. Waiting for
// the other thread would save little (half a build on average, and rarely: docs/decisions/017) and
// could wait forever: builders may be callbacks of the host that call msq again, and a thread that
// waits for its own loops takes other work, which may need the very cell that it is building.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/memory.h"
#include "cell/neighbourhood.h"

namespace msq {

/// The destructor may run under the cache's mutex and must not use the cache.
class CellData {
 public:
  virtual ~CellData() = default;
  virtual uint64_t bytes() const = 0;
};

/// Which cells are evicted. Both policies skip cells in use.
enum class CachePolicy {
  fifo,      ///< the oldest
  segmented  ///< of newcomers, which have a tenth of the limit, the oldest that was fetched once
};

class CellCache {
 public:
  struct Counters {
    uint64_t hits = 0, misses = 0, evictions = 0;
    uint64_t bytes = 0, peak_bytes = 0;
    uint64_t building_bytes = 0;  ///< of `bytes`, those reserved for cells being built
    uint64_t cells = 0;           ///< kept now
    uint64_t duplicates = 0;      ///< built while another thread had built the cell
    uint64_t unkept = 0;          ///< built, but no bytes could be reserved
  };
  using Data = std::shared_ptr<const CellData>;

  CellCache(uint64_t limit, std::shared_ptr<MemoryBudget> budget,
            CachePolicy policy = CachePolicy::fifo);
  ~CellCache() { clear(); }

  /// Returns the data of a cell of the structure with this id. On a miss build() makes it, with no
  /// lock held. `expected_bytes` is the size of the first cells, until the cache has seen actual
  /// sizes.
  template <class Build>
  Data fetch(uint64_t structure, CellIndex cell, Build&& build, uint64_t expected_bytes = 0) {
    const Key key(structure, cell);
    if (Data data = find(key)) return data;
    return add(key, expected_bytes, std::ref(build));
  }

  /// Whether the data of a cell is kept now. This is no fetch: it changes neither the counters nor
  /// which cells are evicted.
  bool keeps(uint64_t structure, CellIndex cell) const;

  void clear();
  /// Drops the cells of a structure. Searches the cells of other structures until all are found.
  void drop(uint64_t structure);
  /// Frees memory: drops a cell, in use or not, or takes back a reservation. Returns false if there
  /// is nothing left.
  bool drop_oldest();
  Counters counters() const;
  uint64_t limit() const { return limit_; }

 private:
  struct Key {
    Key(uint64_t of_structure, CellIndex of_cell);
    friend bool operator==(const Key& a, const Key& b) {
      return a.structure == b.structure && a.cell == b.cell;
    }
    uint64_t structure;
    CellIndex cell;
    size_t hash;
  };
  struct KeyHash {
    size_t operator()(const Key& key) const { return key.hash; }
  };
  struct Entry {
    Entry(Data what, uint64_t size) : data(std::move(what)), bytes(size) {}
    const Data data;
    const uint64_t bytes;
    std::atomic<bool> is_fetched_again{false};  // since it was entered or last spared
    bool is_newcomer = false;
  };
  using Table = std::unordered_map<Key, Entry, KeyHash>;
  /// Nodes of the tables; the first is the next candidate for eviction.
  using Queue = std::list<Table::pointer>;
  /// A part of the table. To add or remove an entry, a thread holds both mutex_ and this part's
  /// lock exclusively. So either lock is enough to read.
  struct alignas(64) Part {
    mutable std::shared_mutex mutex;
    Table table;
    std::atomic<uint64_t> hits{0}, misses{0};
  };
  class Room;

  Part& part_of(const Key& key) { return parts_[key.hash >> 58]; }
  const Part& part_of(const Key& key) const { return parts_[key.hash >> 58]; }
  Data find(const Key& key);
  Data add(const Key& key, uint64_t expected_bytes, const std::function<Data()>& build);
  Data keep(const Key& key, Data data, uint64_t bytes, Room& room);
  void learn(uint64_t structure, uint64_t bytes);
  bool make_room(uint64_t bytes);
  bool evict();
  bool evict_of(Queue& queue);
  bool remove(Queue::iterator place, bool even_in_use);
  void give_back(uint64_t bytes);

  const uint64_t limit_;
  const std::shared_ptr<MemoryBudget> budget_;
  const CachePolicy policy_;
  std::array<Part, 64> parts_;
  /// Guards all members below.
  mutable std::mutex mutex_;
  /// Segmented policy: newcomers that are fetched again, or come back soon, move to the queue.
  /// There a repeated fetch spares a cell once.
  Queue queue_, newcomers_;
  uint64_t newcomer_bytes_ = 0;
  /// Keys, by hash, of the last evicted newcomers, half as many as there are cells.
  std::unordered_set<size_t> gone_;
  std::deque<size_t> gone_queue_;
  std::vector<Room*> rooms_;
  struct OfStructure {
    uint64_t cell_bytes = 0;  // expected size of its next cell
    uint64_t cells = 0;       // kept now
  };
  std::unordered_map<uint64_t, OfStructure> structures_;
  Counters counters_;  // except hits and misses
};

}  // namespace msq
