// SPDX-License-Identifier: Apache-2.0
// The parts of a long call, in parallel, with cancellation and progress.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "base/interval.h"
#include "base/job.h"
#include "base/parallel.h"

namespace msq {

/// Calls work(i) for i in [0, count), in parallel and in any order. Meanwhile the progress of the
/// job, which may be null, runs from low to high of `progress`.
template <class Work>
void run_parts(const Executor& executor, uint64_t count, Job* job, Interval progress, Work&& work) {
  constexpr uint64_t max_reports = 1024;
  const uint64_t between = std::max<uint64_t>(1, count / max_reports);
  std::atomic<uint64_t> done{0};
  if (job) job->raise_progress(progress.low);
  executor.for_each(count, [&](uint64_t i) {
    check_cancelled(job);
    work(i);
    const uint64_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (!job || now % between != 0) return;
    const double part = static_cast<double>(now) / static_cast<double>(count);
    job->raise_progress(progress.low + part * (progress.high - progress.low));
  });
  if (job) job->raise_progress(progress.high);
}

}  // namespace msq
