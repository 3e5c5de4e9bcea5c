// SPDX-License-Identifier: Apache-2.0
// The parts of a loop, shared by a varying number of threads. One thread alone does all parts.
//
// Each thread begins with its own share, a range of consecutive parts. When that is done it takes
// parts of the others' shares. Exceptions are kept for the caller: the thread library would
// allocate memory for them, and ends the process if that fails.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>

namespace msq {

class WorkShares {
 public:
  /// The parts [0, count), for about `threads` threads.
  WorkShares(uint64_t count, unsigned threads, const std::function<void(uint64_t)>& body)
      : body_(body), shares_(std::clamp<uint64_t>(std::min<uint64_t>(threads, count), 1, most)) {
    const uint64_t size = count / shares_, longer = count % shares_;
    uint64_t begin = 0;
    for (size_t s = 0; s < shares_; ++s) {
      share_[s].next.store(begin, std::memory_order_relaxed);
      share_[s].end = begin += size + (s < longer);
    }
  }

  /// The number of threads that have their own share.
  size_t shares() const { return shares_; }

  /// Does parts that no thread has begun, those of share `own` first, until there are none or one
  /// failed.
  void work(size_t own) noexcept {
    for (size_t s = 0; s < shares_; ++s) {
      Share& share = share_[(own + s) % shares_];
      while (share.next.load(std::memory_order_relaxed) < share.end) {
        const uint64_t part = share.next.fetch_add(1, std::memory_order_relaxed);
        if (part >= share.end) break;
        if (has_failed_.load(std::memory_order_relaxed)) return;
        try {
          body_(part);
        } catch (...) {
          if (!has_failed_.exchange(true)) error_ = std::current_exception();
        }
      }
    }
  }

  /// Rethrows the first exception, after all threads have left work().
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static constexpr size_t most = 16;
  struct alignas(64) Share {
    std::atomic<uint64_t> next{0};
    uint64_t end = 0;
  };

  const std::function<void(uint64_t)>& body_;
  const size_t shares_;
  std::atomic<bool> has_failed_{false};
  std::exception_ptr error_;
  Share share_[most];
};

}  // namespace msq
