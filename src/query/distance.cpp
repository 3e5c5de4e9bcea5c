// SPDX-License-Identifier: Apache-2.0
#include "query/distance.h"

#include <atomic>

namespace msq {

namespace {

/// Calls fill(first, end) for chunks of [0, count): milliseconds of work each, so that a cancelled
/// job ends soon.
template <class Fill>
void for_chunks(const Model& model, uint64_t count, Job* job, Fill&& fill) {
  constexpr uint64_t chunk = 1024;
  // Here, and not on a worker while the others wait.
  if (count > 0) model.shape().prepare_distance();
  const uint64_t chunks = count / chunk + (count % chunk != 0);
  std::atomic<uint64_t> done{0};
  model.executor().for_each(chunks, [&](uint64_t c) {
    check_cancelled(job);
    fill(c * chunk, std::min(count, (c + 1) * chunk));
    const uint64_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
    if (job) job->raise_progress(static_cast<double>(now) / static_cast<double>(chunks));
  });
}

}  // namespace

void array_distance(const Model& model, const Scales& resolved, const PointArray& points,
                    double* distance, Job* job) {
  for_chunks(model, points.count, job, [&](uint64_t first, uint64_t end) {
    for (uint64_t i = first; i < end; ++i) distance[i] = model.distance(points.at(i), resolved);
  });
}

void grid_distance(const Model& model, const Scales& resolved, const SampleGrid& grid,
                   double* distance, Job* job) {
  const uint64_t row = grid.nx, layer = grid.nx * grid.ny;
  for_chunks(model, layer * grid.nz, job, [&](uint64_t first, uint64_t end) {
    for (uint64_t i = first; i < end; ++i)
      distance[i] = model.distance(grid.at(i % row, i / row % grid.ny, i / layer), resolved);
  });
}

}  // namespace msq
