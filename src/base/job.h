// SPDX-License-Identifier: Apache-2.0
// Progress and cancellation of one long call.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/ref.h"
#include "base/status.h"

namespace msq {

/// What answered the points of a set query. Any thread adds to it.
struct QueryCounts {
  std::atomic<uint64_t> points{0};    ///< answered
  std::atomic<uint64_t> by_shape{0};  ///< of these, by the coarse shape alone
  /// Asked of structures, one by one and in groups: one for each point and structure.
  std::atomic<uint64_t> by_point{0}, by_set{0};
  std::atomic<uint64_t> groups{0};

  void add_group(uint64_t living) {
    by_set += living;
    ++groups;
  }
  void add(const QueryCounts& other) {
    points += other.points;
    by_shape += other.by_shape;
    by_point += other.by_point;
    by_set += other.by_set;
    groups += other.groups;
  }
  void clear() {
    for (std::atomic<uint64_t>* count : {&points, &by_shape, &by_point, &by_set, &groups})
      *count = 0;
  }
};

class Job : public RefCounted {
 public:
  Job() = default;
  /// Cancelled with its parent, which may be null and must outlive it.
  explicit Job(const Job* parent) : parent_(parent) {}

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const {
    return cancelled_.load(std::memory_order_relaxed) || (parent_ && parent_->cancelled());
  }
  void set_progress(double fraction) { progress_.store(fraction, std::memory_order_relaxed); }
  /// As set_progress(), but never back: for workers that report out of order.
  void raise_progress(double fraction) {
    double now = progress();
    while (now < fraction && !progress_.compare_exchange_weak(now, fraction)) {
    }
  }
  /// Of the last call.
  QueryCounts& counts() { return counts_; }
  const QueryCounts& counts() const { return counts_; }
  double progress() const { return progress_.load(std::memory_order_relaxed); }

 private:
  const Job* parent_ = nullptr;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
  QueryCounts counts_;
};

/// Marks a call's begin and its successful end in a job, which may be null. The job stays alive in
/// between: callbacks may release the host's last reference.
class JobScope {
 public:
  /// Throws Error(cancelled) if the job is cancelled.
  explicit JobScope(Job* job);
  void done() {
    if (job_) job_->set_progress(1);
  }

 private:
  Ref<Job> job_;
};

/// Throws Error(cancelled) if there is a job and it is cancelled.
inline void check_cancelled(const Job* job) {
  if (job && job->cancelled()) throw Error(Status::cancelled, "the job was cancelled");
}

inline JobScope::JobScope(Job* job) : job_(job) {
  if (job_) {
    job_->set_progress(0);
    job_->counts().clear();
  }
  check_cancelled(job);
}

}  // namespace msq
