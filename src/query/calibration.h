// SPDX-License-Identifier: Apache-2.0
// The curve between a structure's parameter and its volume fraction, from one sample of onsets. A
// point is inside where its onset is at most the parameter. So the fraction at a parameter is the
// share of onsets up to it, and the sorted onsets are the curve.
#pragma once

#include <vector>

#include "base/job.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "query/estimate.h"
#include "query/stratified_points.h"
#include "structure/structure.h"

namespace msq {

class Calibration {
 public:
  /// Evaluates the onset of every point of the sample. Takes 16 bytes per point. The structure must
  /// have onsets, and a cell at least 2 points.
  Calibration(const Structure& structure, const StratifiedPoints& sample, const Executor& executor,
              std::shared_ptr<MemoryBudget> budget, Job* job);

  /// The volume fraction at the maximum parameter.
  double max_fraction() const { return fraction_of(reached_); }
  /// The minimum parameter with at least this fraction, which must be at most max_fraction(). For
  /// 0, the minimum onset.
  double parameter(double fraction) const;
  /// The fraction at a parameter.
  Estimate fraction(double parameter) const;
  uint64_t count() const { return onsets_.size(); }

 private:
  double fraction_of(uint64_t points) const {
    return static_cast<double>(points) / static_cast<double>(count());
  }

  Reservation reservation_;
  uint64_t per_cell_;
  std::vector<double> onsets_, sorted_;  // by number; ascending
  uint64_t reached_;                     // onsets that are finite and within the limit
};

}  // namespace msq
