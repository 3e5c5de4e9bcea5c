// SPDX-License-Identifier: Apache-2.0
#include "query/distance.h"

#include <atomic>

namespace msq {

void set_distance(const Model& model, const Scales& resolved, const PointSet& points,
                  double* distance, Job* job) {
  // Here, and not on a worker while the others wait.
  if (points.count() > 0) model.shape().prepare_distance();
  const uint64_t parts = points.parts();
  std::atomic<uint64_t> done{0};
  model.executor().for_each(parts, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    for (size_t i = 0; i < part.numbers.size(); ++i) {
      // Few at a time, milliseconds of work, so that a cancelled job ends soon.
      if (i % 1024 == 0) check_cancelled(job);
      distance[part.numbers[i]] = model.distance(part.positions[i], resolved);
    }
    const uint64_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (!job) return;
    job->counts().points += part.numbers.size();
    job->counts().by_point += part.numbers.size();
    job->raise_progress(static_cast<double>(now) / static_cast<double>(parts));
  });
}

}  // namespace msq
