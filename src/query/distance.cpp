// SPDX-License-Identifier: Apache-2.0
#include "query/distance.h"

#include "base/run_parts.h"

namespace msq {

void set_distance(const Model& model, const Scales& resolved, const PointSet& points,
                  double* distance, Job* job) {
  // Here, so that no worker prepares while the others wait.
  if (points.count() > 0) model.shape().prepare_distance(job);
  run_parts(model.executor(), points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    for (size_t i = 0; i < part.numbers.size(); ++i) {
      if (i % 16 == 0) check_cancelled(job);
      distance[part.numbers[i]] = model.distance(part.positions[i], resolved);
    }
    if (!job) return;
    job->counts().points += part.numbers.size();
    job->counts().by_point += part.numbers.size();
  });
}

}  // namespace msq
