// SPDX-License-Identifier: Apache-2.0
// Progress and cancellation of one long call.
#pragma once

#include <atomic>

#include "base/ref.h"
#include "base/status.h"

namespace msq {

class Job : public RefCounted {
 public:
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  void set_progress(double fraction) { progress_.store(fraction, std::memory_order_relaxed); }
  double progress() const { return progress_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
};

/// Throws Error(cancelled) if there is a job and it is cancelled.
inline void check_cancelled(const Job* job) {
  if (job && job->cancelled()) throw Error(Status::cancelled, "the job was cancelled");
}

}  // namespace msq
