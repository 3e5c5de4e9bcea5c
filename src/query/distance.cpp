// SPDX-License-Identifier: Apache-2.0
#include "query/distance.h"

#include "base/memory.h"
#include "base/run_parts.h"
#include "query/point_order.h"

namespace msq {

namespace {

/// Points sorted at a time. In the unit cube, neighbours of so many are 1/32 apart.
constexpr uint64_t max_in_run = 32768, min_in_run = PointSet::max_in_part;
constexpr uint64_t bytes_of_point = sizeof(Vec3) + PointOrder::bytes_of_point;

void ask_point(const Model& model, const Scales& resolved, uint64_t i, Vec3 p, double& distance,
               Job* job) {
  if (i % 16 == 0) check_cancelled(job);
  distance = model.distance(p, resolved);
}

void count_points(uint64_t count, Job* job) {
  if (!job) return;
  job->counts().points += count;
  job->counts().by_point += count;
}

void ask_by_parts(const Model& model, const Scales& resolved, const PointSet& points,
                  double* distance, Job* job) {
  run_parts(model.executor(), points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    for (size_t i = 0; i < part.numbers.size(); ++i)
      ask_point(model, resolved, i, part.positions[i], distance[part.numbers[i]], job);
    count_points(part.numbers.size(), job);
  });
}

/// Each run is sorted, so that searches of a boundary find what the last ones used in the
/// processor's caches. Lattices and foams would gain nothing.
void ask_by_runs(const Model& model, const Scales& resolved, const PointSet& points, uint64_t run,
                 double* distance, Job* job) {
  const uint64_t count = points.count(), runs = count / run + (count % run != 0);
  run_parts(model.executor(), runs, job, {0, 1}, [&](uint64_t index) {
    const uint64_t first = index * run, size = std::min(run, count - first);
    std::vector<Vec3> positions(size);
    points.read(first, size, positions.data());
    PointOrder order;
    uint64_t i = 0;
    for (const uint64_t number : order.sort(positions))
      ask_point(model, resolved, i++, positions[number], distance[first + number], job);
    count_points(size, job);
  });
}

}  // namespace

void set_distance(const Model& model, const Scales& resolved, const PointSet& points,
                  double* distance, Job* job) {
  if (points.count() == 0) return;
  // Here, so that no worker prepares while the others wait.
  model.shape().prepare_distance(job);
  const bool gains = !points.is_compact() && model.shape().boundary_search();
  if (!gains) return ask_by_parts(model, resolved, points, distance, job);
  const uint64_t threads = model.executor().threads();
  uint64_t run = std::clamp(points.count() / (4 * threads), min_in_run, max_in_run);
  // Short runs, which need as little as parts do, are not counted.
  const uint64_t bytes = threads * run * bytes_of_point;
  MemoryBudget& budget = *model.context().budget;
  Reservation reservation;
  if (run > min_in_run && budget.try_take(bytes))
    reservation = Reservation::adopt(model.context().budget, bytes);
  else
    run = min_in_run;
  ask_by_runs(model, resolved, points, run, distance, job);
}

}  // namespace msq
