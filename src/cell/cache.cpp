// SPDX-License-Identifier: Apache-2.0
#include "cell/cache.h"

#include <algorithm>

#include "base/random.h"

namespace msq {

namespace {
// Hash node, key, queue slot and shared_ptr block of one entry, rounded up.
constexpr uint64_t entry_overhead = 192;
}  // namespace

size_t CellCache::KeyHash::operator()(const Key& key) const {
  const uint64_t yz = static_cast<uint32_t>(key.cell.y) |
                      static_cast<uint64_t>(static_cast<uint32_t>(key.cell.z)) << 32;
  return splitmix_output(splitmix_finalise(yz) ^ key.structure, static_cast<uint32_t>(key.cell.x));
}

std::shared_ptr<const CellData> CellCache::fetch(
    uint64_t structure, CellIndex cell,
    const std::function<std::shared_ptr<const CellData>()>& build) {
  const Key key{structure, cell};
  {
    std::lock_guard lock(mutex_);
    if (const auto found = entries_.find(key); found != entries_.end()) {
      ++counters_.hits;
      return found->second.data;
    }
    ++counters_.misses;
  }
  std::shared_ptr<const CellData> data = build();
  const uint64_t bytes = data->bytes() + entry_overhead;
  if (bytes > limit_) return data;

  std::lock_guard lock(mutex_);
  if (const auto found = entries_.find(key); found != entries_.end()) return found->second.data;
  // If not even an empty cache would make room for it, the cells at hand are worth more.
  const uint64_t others = budget_->held() - std::min(budget_->held(), counters_.bytes);
  if (budget_->limit() && others + bytes > budget_->limit()) return data;
  while (counters_.bytes > limit_ - bytes) evict_oldest();
  while (!budget_->try_take(bytes)) {
    if (order_.empty()) return data;
    evict_oldest();
  }
  try {
    entries_.emplace(key, Entry{data, bytes});
    order_.push_back(key);
  } catch (...) {
    entries_.erase(key);
    budget_->give_back(bytes);
    throw;
  }
  counters_.bytes += bytes;
  counters_.peak_bytes = std::max(counters_.peak_bytes, counters_.bytes);
  return data;
}

void CellCache::evict_oldest() {
  const auto found = entries_.find(order_.front());
  counters_.bytes -= found->second.bytes;
  budget_->give_back(found->second.bytes);
  ++counters_.evictions;
  entries_.erase(found);
  order_.pop_front();
}

bool CellCache::drop_oldest() {
  std::lock_guard lock(mutex_);
  if (order_.empty()) return false;
  evict_oldest();
  return true;
}

void CellCache::drop(uint64_t structure) {
  std::lock_guard lock(mutex_);
  std::erase_if(order_, [&](const Key& key) {
    if (key.structure != structure) return false;
    const auto found = entries_.find(key);
    counters_.bytes -= found->second.bytes;
    budget_->give_back(found->second.bytes);
    entries_.erase(found);
    return true;
  });
}

void CellCache::clear() {
  std::lock_guard lock(mutex_);
  budget_->give_back(counters_.bytes);
  counters_.bytes = 0;
  entries_.clear();
  order_.clear();
}

CellCache::Counters CellCache::counters() const {
  std::lock_guard lock(mutex_);
  return counters_;
}

}  // namespace msq
