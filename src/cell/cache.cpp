// SPDX-License-Identifier: Apache-2.0
#include "cell/cache.h"

#include <algorithm>

#include "cell/cell_hash.h"

namespace msq {

namespace {
// Hash node, queue node and shared_ptr block of one entry, rounded up.
constexpr uint64_t entry_overhead = 256;
}  // namespace

/// The reservation of a builder. Others may take it back until the cell is kept.
class CellCache::Room {
 public:
  Room(CellCache& cache, const Key& key, uint64_t expected_bytes) : cache_(cache) {
    std::lock_guard lock(cache_.mutex_);
    const auto known = cache_.structures_.find(key.structure);
    const uint64_t expected = known != cache_.structures_.end() ? known->second.cell_bytes
                              : expected_bytes                  ? expected_bytes + entry_overhead
                                                                : 0;
    const uint64_t wanted = std::min(expected, cache_.limit_);
    cache_.rooms_.push_back(this);
    if (cache_.make_room(wanted)) bytes_ = wanted;
  }
  ~Room() {
    std::lock_guard lock(cache_.mutex_);
    give_back();
    std::erase(cache_.rooms_, this);
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  // Called with the cache's mutex held:

  uint64_t bytes() const { return bytes_; }
  void give_back() {
    cache_.counters_.building_bytes -= bytes_;
    cache_.give_back(bytes_);
    bytes_ = 0;
  }
  /// Sets the size of the reservation; on failure it is unchanged.
  bool resize(uint64_t bytes) {
    if (bytes > bytes_) {
      if (!cache_.make_room(bytes - bytes_)) return false;
    } else {
      cache_.counters_.building_bytes -= bytes_ - bytes;
      cache_.give_back(bytes_ - bytes);
    }
    bytes_ = bytes;
    return true;
  }
  /// From now on its bytes belong to a kept cell.
  void become_kept() {
    cache_.counters_.building_bytes -= bytes_;
    bytes_ = 0;
  }

 private:
  CellCache& cache_;
  uint64_t bytes_ = 0;
};

CellCache::Key::Key(uint64_t of_structure, CellIndex of_cell)
    : structure(of_structure), cell(of_cell), hash(hash_of(of_cell, of_structure)) {}

CellCache::CellCache(uint64_t limit, std::shared_ptr<MemoryBudget> budget, CachePolicy policy)
    : limit_(limit), budget_(std::move(budget)), policy_(policy) {}

CellCache::Data CellCache::find(const Key& key) {
  Part& part = part_of(key);
  std::shared_lock lock(part.mutex);
  const auto found = part.table.find(key);
  if (found == part.table.end()) {
    part.misses.fetch_add(1, std::memory_order_relaxed);
    return nullptr;
  }
  part.hits.fetch_add(1, std::memory_order_relaxed);
  Entry& entry = found->second;
  // Stored only once: a cache line that is only read stays in the caches of all cores.
  if (!entry.is_fetched_again.load(std::memory_order_relaxed))
    entry.is_fetched_again.store(true, std::memory_order_relaxed);
  return entry.data;
}

bool CellCache::keeps(uint64_t structure, CellIndex cell) const {
  const Key key(structure, cell);
  const Part& part = part_of(key);
  std::shared_lock lock(part.mutex);
  return part.table.contains(key);
}

CellCache::Data CellCache::add(const Key& key, uint64_t expected_bytes,
                               const std::function<Data()>& build) {
  Room room(*this, key, expected_bytes);
  Data data = build();
  const uint64_t bytes = data->bytes() + entry_overhead;
  std::lock_guard lock(mutex_);
  return keep(key, std::move(data), bytes, room);
}

CellCache::Data CellCache::keep(const Key& key, Data data, uint64_t bytes, Room& room) {
  Part& part = part_of(key);
  if (const auto found = part.table.find(key); found != part.table.end()) {
    ++counters_.duplicates;
    return found->second.data;
  }
  if (bytes <= limit_) learn(key.structure, bytes);
  if (bytes > limit_ || !room.resize(bytes)) {
    ++counters_.unkept;
    return data;
  }
  const bool is_newcomer = policy_ == CachePolicy::segmented && !gone_.contains(key.hash);
  Queue& queue = is_newcomer ? newcomers_ : queue_;
  queue.push_back(nullptr);
  try {
    std::lock_guard lock(part.mutex);
    queue.back() = &*part.table.try_emplace(key, data, bytes).first;
  } catch (...) {
    queue.pop_back();
    throw;
  }
  queue.back()->second.is_newcomer = is_newcomer;
  if (is_newcomer) newcomer_bytes_ += bytes;
  room.become_kept();
  ++counters_.cells;
  ++structures_[key.structure].cells;
  return data;
}

/// Raises the expected size at once and lowers it slowly. So nearly all reservations are large
/// enough, and one huge cell does not make the other cells of its structure evict many for long.
void CellCache::learn(uint64_t structure, uint64_t bytes) {
  uint64_t& expected = structures_[structure].cell_bytes;
  expected = bytes >= expected ? bytes : expected - (expected - bytes) / 16;
}

/// Adds the bytes to those being built, after evicting other cells. Evicts nothing if even an empty
/// cache has no room: then the present cells are worth more.
bool CellCache::make_room(uint64_t bytes) {
  Counters& c = counters_;
  if (bytes == 0) return true;
  if (bytes > limit_ - c.building_bytes) return false;
  const uint64_t others = budget_->held() - std::min(budget_->held(), c.bytes);
  if (budget_->limit() && others + c.building_bytes + bytes > budget_->limit()) return false;
  while (c.bytes > limit_ - bytes)
    if (!evict()) return false;
  while (!budget_->try_take(bytes))
    if (!evict()) return false;
  c.bytes += bytes;
  c.building_bytes += bytes;
  c.peak_bytes = std::max(c.peak_bytes, c.bytes);
  return true;
}

bool CellCache::evict() {
  const bool newcomers_first = newcomer_bytes_ > limit_ / 10 || queue_.empty();
  return evict_of(newcomers_first ? newcomers_ : queue_) ||
         evict_of(newcomers_first ? queue_ : newcomers_);
}

/// Evicts the first cell of the queue that may go. Cells that are in use or spared move to the end,
/// so that they are not examined again and again.
bool CellCache::evict_of(Queue& queue) {
  for (size_t looks = 2 * queue.size(); looks > 0 && !queue.empty(); --looks) {
    const auto first = queue.begin();
    const size_t hash = (*first)->first.hash;
    Entry& entry = (*first)->second;
    const bool is_newcomer = entry.is_newcomer;
    const bool is_spared = policy_ == CachePolicy::segmented &&
                           entry.is_fetched_again.exchange(false, std::memory_order_relaxed);
    if (is_spared && is_newcomer) {
      entry.is_newcomer = false;
      newcomer_bytes_ -= entry.bytes;
      queue_.splice(queue_.end(), newcomers_, first);
    } else if (is_spared || !remove(first, false)) {
      queue.splice(queue.end(), queue, first);
    } else {
      ++counters_.evictions;
      if (is_newcomer && gone_.insert(hash).second) gone_queue_.push_back(hash);
      while (gone_queue_.size() > counters_.cells / 2) {
        gone_.erase(gone_queue_.front());
        gone_queue_.pop_front();
      }
      return true;
    }
  }
  return false;
}

bool CellCache::remove(Queue::iterator place, bool even_in_use) {
  const Key& key = (*place)->first;
  const Entry& entry = (*place)->second;
  // Other threads may release the cell at any time. A new use begins only in find(), under the
  // lock.
  const auto is_in_use = [&] { return !even_in_use && entry.data.use_count() > 1; };
  if (is_in_use()) return false;
  const uint64_t bytes = entry.bytes, structure = key.structure;
  const bool is_newcomer = entry.is_newcomer;
  {
    Part& part = part_of(key);
    Table::node_type node;  // destroyed with the part unlocked
    std::lock_guard lock(part.mutex);
    if (is_in_use()) return false;
    node = part.table.extract(key);
  }
  (is_newcomer ? newcomers_ : queue_).erase(place);
  if (is_newcomer) newcomer_bytes_ -= bytes;
  --counters_.cells;
  --structures_.find(structure)->second.cells;
  give_back(bytes);
  return true;
}

void CellCache::give_back(uint64_t bytes) {
  counters_.bytes -= bytes;
  budget_->give_back(bytes);
}

bool CellCache::drop_oldest() {
  std::lock_guard lock(mutex_);
  if (evict()) return true;
  for (Queue* queue : {&newcomers_, &queue_})
    if (!queue->empty()) {
      ++counters_.evictions;
      return remove(queue->begin(), true);
    }
  for (Room* room : rooms_)
    if (room->bytes() > 0) {
      room->give_back();
      return true;
    }
  return false;
}

void CellCache::drop(uint64_t structure) {
  std::lock_guard lock(mutex_);
  const auto known = structures_.find(structure);
  if (known == structures_.end()) return;
  const uint64_t& cells = known->second.cells;
  for (Queue* queue : {&newcomers_, &queue_})
    for (auto place = queue->begin(); cells > 0 && place != queue->end();) {
      const auto next = std::next(place);
      if ((*place)->first.structure == structure) remove(place, true);
      place = next;
    }
  structures_.erase(known);
}

void CellCache::clear() {
  std::lock_guard lock(mutex_);
  for (Queue* queue : {&newcomers_, &queue_})
    while (!queue->empty()) remove(queue->begin(), true);
  gone_.clear();
  gone_queue_.clear();
}

CellCache::Counters CellCache::counters() const {
  std::lock_guard lock(mutex_);
  Counters counters = counters_;
  for (const Part& part : parts_) {
    counters.hits += part.hits.load(std::memory_order_relaxed);
    counters.misses += part.misses.load(std::memory_order_relaxed);
  }
  return counters;
}

}  // namespace msq
