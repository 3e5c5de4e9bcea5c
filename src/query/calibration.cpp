// SPDX-License-Identifier: Apache-2.0
#include "query/calibration.h"

#include <algorithm>
#include <atomic>
#include <functional>

#include "base/polled_sort.h"

namespace msq {

Calibration::Calibration(const Structure& structure, const StratifiedPoints& sample,
                         const Executor& executor, std::shared_ptr<MemoryBudget> budget, Job* job)
    : reservation_(std::move(budget), 2 * sample.count() * sizeof(double), "onsets of a sample"),
      per_cell_(sample.strata().per_cell),
      onsets_(sample.count()) {
  const uint64_t parts = sample.parts();
  std::atomic<uint64_t> done{0};
  executor.for_each(parts, [&](uint64_t index) {
    PointSet::Part part;
    sample.read_part(index, part);
    std::vector<double> found(part.numbers.size());
    structure.onsets(part.positions.data(), found.size(), found.data());
    for (size_t i = 0; i < found.size(); ++i) onsets_[part.numbers[i]] = found[i];
    const uint64_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (!job) return;
    job->counts().points += part.numbers.size();
    job->raise_progress(0.9 * static_cast<double>(now) / static_cast<double>(parts));
  });
  sorted_ = onsets_;
  CancelPoll poll(current_job());
  polled_sort(sorted_.begin(), sorted_.end(), std::less<>(), poll);
  const double most = std::min(structure.onset_limit(), std::numeric_limits<double>::max());
  reached_ = static_cast<uint64_t>(std::upper_bound(sorted_.begin(), sorted_.end(), most) -
                                   sorted_.begin());
}

double Calibration::parameter(double fraction) const {
  const double wanted = std::ceil(fraction * static_cast<double>(count()));
  // Rounding of the product must not lead beyond the last point.
  const uint64_t points = std::min(static_cast<uint64_t>(std::max(1.0, wanted)), reached_);
  return sorted_[points - 1];
}

Estimate Calibration::fraction(double parameter) const {
  StrataTally tally;
  for (size_t first = 0; first < onsets_.size(); first += per_cell_) {
    uint64_t hits = 0;
    for (uint64_t s = 0; s < per_cell_; ++s) hits += onsets_[first + s] <= parameter;
    tally.add(hits, per_cell_);
  }
  return tally.estimate(onsets_.size() / per_cell_, per_cell_);
}

}  // namespace msq
