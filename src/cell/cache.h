// SPDX-License-Identifier: Apache-2.0
// Cache of per-cell data, limited in bytes, for any number of threads.
// Sources: paper, section "Set Queries for Ray-Casting" (first in, first out); Yang, Zhang, Qiu,
// Yue and Rashmi, "FIFO queues are all you need for cache eviction", SOSP 2023 (segmented).
//
// What the limit covers: at every moment the cells that are kept and the room that builders of
// cells have set aside take no more bytes than it. A builder sets room aside before it begins, as
// much as cells of its structure lately took; others go for that. A cell that turns out larger than
// its room is counted in full from when it is built. Cells in use are not evicted, as that would
// free nothing, so that the limit covers them too. Beyond it are only cells that no room was found
// for: they are built all the same, for one caller, and are gone when that lets go of them.
//
// Who waits for whom: hits share a lock of their part of the table with each other, and it is held
// alone only to enter or remove one cell, never while one is built or destroyed. Misses meet at
// the queue, a mutex that is held for the bookkeeping and the destruction of evicted cells.
//
// Two threads that miss the same cell both build it, and the first to finish is kept. To wait for
// the other would win little (half a build on average, and rarely: docs/decisions/017) and could
// wait for ever: builders may be callbacks of the host that call msq again, and a thread that waits
// for its own loops takes up other work, which may ask for the very cell that it is building.
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

/// Its destructor may run under the cache's mutex and must not ask the cache.
class CellData {
 public:
  virtual ~CellData() = default;
  virtual uint64_t bytes() const = 0;
};

/// Which cells make room. Those in use are passed over by either.
enum class CachePolicy {
  fifo,      ///< the oldest
  segmented  ///< of newcomers, which have a tenth of the limit, the oldest that was fetched once
};

class CellCache {
 public:
  struct Counters {
    uint64_t hits = 0, misses = 0, evictions = 0;
    uint64_t bytes = 0, peak_bytes = 0;
    uint64_t building_bytes = 0;  ///< of `bytes`, what is set aside for cells being built
    uint64_t cells = 0;           ///< kept now
    uint64_t duplicates = 0;      ///< built, when another thread had built the cell meanwhile
    uint64_t unkept = 0;          ///< built, when no room was found
  };
  using Data = std::shared_ptr<const CellData>;

  CellCache(uint64_t limit, std::shared_ptr<MemoryBudget> budget,
            CachePolicy policy = CachePolicy::fifo);
  ~CellCache() { clear(); }

  /// The data of a cell of the structure with this id; on a miss build() makes it, with no lock
  /// held. `expected_bytes`: of the first cells, until the cache has seen how large they are.
  template <class Build>
  Data fetch(uint64_t structure, CellIndex cell, Build&& build, uint64_t expected_bytes = 0) {
    const Key key(structure, cell);
    if (Data data = find(key)) return data;
    return add(key, expected_bytes, std::ref(build));
  }

  void clear();
  /// Drops the cells of a structure; looks through those of others until it has them all.
  void drop(uint64_t structure);
  /// Gives way: drops a cell, in use or not, or takes back what is set aside for one. False if
  /// there is nothing left.
  bool drop_oldest();
  Counters counters() const;
  uint64_t limit() const { return limit_; }

  /// For measurements: what is called at the end of each fetch, on its thread, with the bytes that
  /// the cell takes in the cache. To be set while nothing is fetched.
  using Observer = std::function<void(uint64_t structure, CellIndex cell, uint64_t bytes)>;
  void observe(Observer observer) { observer_ = std::move(observer); }

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
    std::atomic<bool> is_fetched_again{false};  // since it came, or was last spared
    bool is_newcomer = false;
  };
  using Table = std::unordered_map<Key, Entry, KeyHash>;
  /// Of nodes of the tables, the next to go first.
  using Queue = std::list<Table::pointer>;
  /// A part of the table. Entries are added and removed by whoever holds both mutex_ and the part's
  /// alone, so that either is enough to read.
  struct alignas(64) Part {
    mutable std::shared_mutex mutex;
    Table table;
    std::atomic<uint64_t> hits{0}, misses{0};
  };
  class Room;

  Part& part_of(const Key& key) { return parts_[key.hash >> 58]; }
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
  Observer observer_;
  std::array<Part, 64> parts_;
  /// Of all below.
  mutable std::mutex mutex_;
  /// Segmented: newcomers that are fetched again, or come back soon, join the queue, where being
  /// fetched again spares a cell once.
  Queue queue_, newcomers_;
  uint64_t newcomer_bytes_ = 0;
  /// Keys, by hash, of the last newcomers that went, half as many as there are cells.
  std::unordered_set<size_t> gone_;
  std::deque<size_t> gone_queue_;
  std::vector<Room*> rooms_;
  struct OfStructure {
    uint64_t cell_bytes = 0;  // to expect of its next cell
    uint64_t cells = 0;       // kept now
  };
  std::unordered_map<uint64_t, OfStructure> structures_;
  Counters counters_;  // but hits and misses
};

}  // namespace msq
