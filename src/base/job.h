// SPDX-License-Identifier: Apache-2.0
// Progress and cancellation of one long call.
#pragma once

#include <atomic>
#include <cstdint>

#include "base/call.h"
#include "base/ref.h"
#include "base/status.h"

namespace msq {

/// Counts of how the points of set queries were evaluated. Any thread may add to them.
struct QueryCounts {
  std::atomic<uint64_t> points{0};    ///< evaluated
  std::atomic<uint64_t> by_shape{0};  ///< of these, decided by the coarse shape alone
  /// Evaluated by structures, point by point and in groups: one count per point and structure.
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
  /// Is cancelled with its parent, which may be null and must outlive it.
  explicit Job(const Job* parent) : parent_(parent) {}

  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const {
    return cancelled_.load(std::memory_order_relaxed) || (parent_ && parent_->cancelled());
  }
  void set_progress(double fraction) { progress_.store(fraction, std::memory_order_relaxed); }
  /// As set_progress(), but never lowers the progress: for workers that report out of order.
  void raise_progress(double fraction) {
    double now = progress();
    while (now < fraction && !progress_.compare_exchange_weak(now, fraction)) {
    }
  }
  /// Counts of the last call.
  QueryCounts& counts() { return counts_; }
  const QueryCounts& counts() const { return counts_; }
  double progress() const { return progress_.load(std::memory_order_relaxed); }

 private:
  const Job* parent_ = nullptr;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
  QueryCounts counts_;
};

/// A part of a call. Its progress runs from one fraction of the call's progress to another.
struct JobPart {
  Job* job = nullptr;  ///< may be null
  double begin = 0, end = 1;

  void set_progress(double fraction) const {
    if (job) job->set_progress(begin + fraction * (end - begin));
  }
};

/// Marks the start and the successful end of a call in a job, which may be null. In between the job
/// is the thread's current job and stays alive: callbacks may release the host's last reference. A
/// call without a job goes on with that of the call of msq that it is part of, if any.
class JobScope {
 public:
  /// Throws Error(cancelled) if the current job is cancelled.
  explicit JobScope(Job* job);
  void done() {
    if (job_) job_->set_progress(1);
  }

 private:
  Ref<Job> job_;
  CurrentJob current_;
};

/// Throws Error(cancelled) if there is a job and it is cancelled.
inline void check_cancelled(const Job* job) {
  if (job && job->cancelled()) throw Error(Status::cancelled, "the job was cancelled");
}

/// The same for the current job, for long loops that do not know it. Takes a few nanoseconds.
inline void check_cancelled() {
  check_cancelled(current_job());
}

/// Calls check_cancelled() once per `interval` calls: 64 for loops whose rounds take up to some
/// microseconds, 1024 for each vertex and for each comparison of a sort.
template <uint32_t interval>
class PollEvery {
 public:
  explicit PollEvery(const Job* job) : job_(job) {}

  void operator()() {
    if (++calls_ % interval == 0) check_cancelled(job_);
  }

 private:
  const Job* job_;
  uint32_t calls_ = 0;
};
using JobPoll = PollEvery<64>;
using CancelPoll = PollEvery<1024>;

inline JobScope::JobScope(Job* job) : job_(job), current_(job ? job : current_job()) {
  if (job_) {
    job_->set_progress(0);
    job_->counts().clear();
  }
  check_cancelled();
}

}  // namespace msq
