// SPDX-License-Identifier: Apache-2.0
// Which cells a cache of so many bytes would keep: policies replayed on a trace of fetches.
// Sources: CLOCK: Corbato 1968. SIEVE: Zhang et al., "SIEVE is simpler than LRU", NSDI 2024.
// S3-FIFO: Yang et al., "FIFO queues are all you need for cache eviction", SOSP 2023. MIN: Belady,
// "A study of replacement algorithms", 1966, which knows the future and bounds what any policy
// could reach (exactly so for cells of one size).
#pragma once

#include <cstdint>
#include <deque>
#include <list>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace bench {

struct Fetch {
  uint32_t cell;  // number of the cell in the trace
  uint64_t bytes;
};
using Trace = std::vector<Fetch>;

class Policy {
 public:
  virtual ~Policy() = default;
  /// Whether the cell is there; otherwise it comes in and others go.
  virtual bool fetch(const Fetch& fetch) = 0;
};

/// FIFO, LRU, CLOCK and SIEVE: one queue, the newest at its end.
class QueuePolicy : public Policy {
 public:
  enum class Kind { fifo, lru, clock, sieve };
  QueuePolicy(Kind kind, uint64_t limit) : kind_(kind), limit_(limit), hand_(queue_.end()) {}

  bool fetch(const Fetch& fetch) override {
    if (const auto found = table_.find(fetch.cell); found != table_.end()) {
      found->second->is_fetched_again = true;
      if (kind_ == Kind::lru) queue_.splice(queue_.end(), queue_, found->second);
      return true;
    }
    if (fetch.bytes > limit_) return false;
    while (bytes_ + fetch.bytes > limit_) evict();
    table_[fetch.cell] = queue_.insert(queue_.end(), {fetch, false});
    bytes_ += fetch.bytes;
    return false;
  }

 private:
  struct Entry {
    Fetch fetch;
    bool is_fetched_again;
  };

  void evict() {
    auto victim = kind_ == Kind::sieve && hand_ != queue_.end() ? hand_ : queue_.begin();
    if (kind_ == Kind::clock)
      while (victim->is_fetched_again) {
        victim->is_fetched_again = false;
        queue_.splice(queue_.end(), queue_, victim);
        victim = queue_.begin();
      }
    if (kind_ == Kind::sieve)
      while (victim->is_fetched_again) {
        victim->is_fetched_again = false;
        if (++victim == queue_.end()) victim = queue_.begin();
      }
    hand_ = std::next(victim);
    bytes_ -= victim->fetch.bytes;
    table_.erase(victim->fetch.cell);
    queue_.erase(victim);
  }

  const Kind kind_;
  const uint64_t limit_;
  uint64_t bytes_ = 0;
  std::list<Entry> queue_;
  std::list<Entry>::iterator hand_;
  std::unordered_map<uint32_t, std::list<Entry>::iterator> table_;
};

/// A tenth for newcomers; those fetched again, or lately thrown out, go to the main queue.
class S3Fifo : public Policy {
 public:
  /// `most`: up to which fetches are counted. `gone`: newcomers that are remembered, by the cells
  /// that are there.
  S3Fifo(uint64_t limit, int most, double gone) : limit_(limit), most_(most), gone_(gone) {}

  bool fetch(const Fetch& fetch) override {
    if (const auto found = table_.find(fetch.cell); found != table_.end()) {
      if (found->second < most_) ++found->second;
      return true;
    }
    if (fetch.bytes > limit_) return false;
    while (small_.bytes + main_.bytes + fetch.bytes > limit_) evict();
    (ghosts_.count(fetch.cell) ? main_ : small_).push(fetch);
    table_[fetch.cell] = 0;
    return false;
  }

 private:
  struct Queue {
    std::deque<Fetch> cells;
    uint64_t bytes = 0;
    void push(const Fetch& fetch) {
      cells.push_back(fetch);
      bytes += fetch.bytes;
    }
    Fetch pop() {
      const Fetch first = cells.front();
      cells.pop_front();
      bytes -= first.bytes;
      return first;
    }
  };

  void evict() {
    if (!small_.cells.empty() && (small_.bytes * 10 >= limit_ || main_.cells.empty())) {
      const Fetch first = small_.pop();
      if (table_[first.cell] > 0) {
        table_[first.cell] = 0;
        main_.push(first);
        return;
      }
      table_.erase(first.cell);
      add_ghost(first.cell);
      return;
    }
    const Fetch first = main_.pop();
    if (table_[first.cell] > 0) {
      --table_[first.cell];
      main_.push(first);
      return;
    }
    table_.erase(first.cell);
  }

  void add_ghost(uint32_t cell) {
    if (!ghosts_.insert(cell).second) return;
    ghost_queue_.push_back(cell);
    while (static_cast<double>(ghost_queue_.size()) > gone_ * static_cast<double>(table_.size())) {
      ghosts_.erase(ghost_queue_.front());
      ghost_queue_.pop_front();
    }
  }

  const uint64_t limit_;
  const int most_;
  const double gone_;
  Queue small_, main_;
  std::unordered_map<uint32_t, int> table_;
  std::deque<uint32_t> ghost_queue_;
  std::unordered_set<uint32_t> ghosts_;
};

/// Throws out what is not needed for longest.
class Belady : public Policy {
 public:
  Belady(const Trace& trace, uint64_t limit) : limit_(limit), next_(trace.size()) {
    std::unordered_map<uint32_t, size_t> later;
    for (size_t i = trace.size(); i-- > 0;) {
      const auto found = later.find(trace[i].cell);
      next_[i] = found == later.end() ? trace.size() + i : found->second;
      later[trace[i].cell] = i;
    }
  }

  bool fetch(const Fetch& fetch) override {
    const size_t next = next_[at_++];
    const auto found = table_.find(fetch.cell);
    const bool is_there = found != table_.end();
    if (is_there) {
      order_.erase({found->second, fetch.cell});
    } else {
      if (fetch.bytes > limit_) return false;
      while (bytes_ + fetch.bytes > limit_) {
        const auto last = std::prev(order_.end());
        if (last->first <= next) return false;
        bytes_ -= bytes_of_[last->second];
        table_.erase(last->second);
        order_.erase(last);
      }
      bytes_ += fetch.bytes;
      bytes_of_[fetch.cell] = fetch.bytes;
    }
    table_[fetch.cell] = next;
    order_.insert({next, fetch.cell});
    return is_there;
  }

 private:
  const uint64_t limit_;
  uint64_t bytes_ = 0;
  size_t at_ = 0;
  std::vector<size_t> next_;
  std::set<std::pair<size_t, uint32_t>> order_;
  std::unordered_map<uint32_t, size_t> table_;
  std::unordered_map<uint32_t, uint64_t> bytes_of_;
};

inline const std::vector<std::string>& policy_names() {
  static const std::vector<std::string> names{"FIFO",  "segmented", "S3-FIFO", "CLOCK",
                                              "SIEVE", "LRU",       "MIN"};
  return names;
}

inline std::unique_ptr<Policy> make_policy(const std::string& name, const Trace& trace,
                                           uint64_t limit) {
  using Kind = QueuePolicy::Kind;
  if (name == "FIFO") return std::make_unique<QueuePolicy>(Kind::fifo, limit);
  if (name == "CLOCK") return std::make_unique<QueuePolicy>(Kind::clock, limit);
  if (name == "SIEVE") return std::make_unique<QueuePolicy>(Kind::sieve, limit);
  if (name == "LRU") return std::make_unique<QueuePolicy>(Kind::lru, limit);
  if (name == "S3-FIFO") return std::make_unique<S3Fifo>(limit, 3, 1.0);
  if (name == "segmented") return std::make_unique<S3Fifo>(limit, 1, 0.5);
  return std::make_unique<Belady>(trace, limit);
}

/// Share of the fetches that find their cell.
inline double hit_rate(const std::string& name, const Trace& trace, uint64_t limit) {
  const auto policy = make_policy(name, trace, limit);
  uint64_t hits = 0;
  for (const Fetch& fetch : trace) hits += policy->fetch(fetch);
  return static_cast<double>(hits) / static_cast<double>(trace.size());
}

}  // namespace bench
