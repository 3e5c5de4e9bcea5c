// SPDX-License-Identifier: Apache-2.0
// Points of sets that are compact, or of which no structure gains by grouping, are asked part by
// part. Others are grouped by boxes of cells, structure by structure and chunk by chunk; the
// buffers are those of one chunk, however many points there are.
#include "base/memory.h"
#include "base/run_parts.h"
#include "query/membership.h"
#include "query/point_groups.h"

namespace msq {

namespace {

/// Points grouped at a time. More share more of a cell's work (docs/benchmarks.md), but ask for 6
/// bytes each.
constexpr uint64_t most_in_chunk = uint64_t{1} << 21, least_in_chunk = 4096;
/// Points asked of the shape at a time.
constexpr uint64_t run = 4096;
static_assert(run <= PointGroups::most_in_group);

uint64_t working_bytes(uint64_t chunk, unsigned threads) {
  return PointGroups::bytes(chunk) +
         threads * PointGroups::most_in_group * (sizeof(Vec3) + sizeof(uint8_t));
}

/// As many points as the memory limit has room for, cached cells set aside; at least
/// least_in_chunk.
uint64_t chunk_of(const Context& context, uint64_t count, unsigned threads) {
  const MemoryBudget& budget = *context.budget;
  uint64_t chunk = std::clamp(count, least_in_chunk, most_in_chunk);
  if (budget.limit() == 0) return chunk;
  const uint64_t cached = context.cache.counters().bytes;
  const uint64_t others = budget.held() - std::min(cached, budget.held());
  const uint64_t room = budget.limit() - std::min(others, budget.limit());
  while (chunk > least_in_chunk && working_bytes(chunk, threads) > room)
    chunk = std::max(least_in_chunk, chunk / 2);
  return chunk;
}

/// alive[i] becomes what the shape answers.
void ask_shape(const Model& model, bool has_structures, const Vec3* points, uint8_t* alive,
               size_t count, Job* job) {
  model.shape().find_inside(points, count, alive);
  if (!job) return;
  uint64_t living = 0;
  for (size_t i = 0; i < count; ++i) living += alive[i];
  job->counts().points += count;
  job->counts().by_shape += has_structures ? count - living : count;
}

void ask_by_parts(const Model& model, const Scales& resolved, const PointSet& points,
                  const QueryPlan& plan, uint8_t* inside, Job* job) {
  run_parts(model.executor(), points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    const size_t count = part.positions.size();
    std::vector<uint8_t> alive(count);
    ask_points(model, resolved, plan, part.positions.data(), alive.data(), count, job);
    for (size_t i = 0; i < count; ++i) inside[part.numbers[i]] = alive[i];
  });
}

void ask_by_groups(const Model& model, const Scales& resolved, const PointSet& points,
                   const QueryPlan& plan, uint8_t* inside, Job* job) {
  const Context& context = model.context();
  const Executor& executor = model.executor();
  const uint64_t chunk = chunk_of(context, points.count(), executor.threads());
  const Reservation reservation(context.budget, working_bytes(chunk, executor.threads()),
                                "points grouped by cell");
  PointGroups groups(chunk);

  const uint64_t chunks = (points.count() + chunk - 1) / chunk;
  const double stages = static_cast<double>(chunks) * static_cast<double>(1 + resolved.size());
  double stage = 0;
  const auto next_stage = [&] {
    const double begin = stage++;
    return Interval{begin / stages, stage / stages};
  };
  for (uint64_t first = 0; first < points.count(); first += chunk) {
    const uint64_t count = std::min(chunk, points.count() - first);
    uint8_t* alive = inside + first;
    const uint64_t runs = (count + run - 1) / run;
    run_parts(executor, runs, job, next_stage(), [&](uint64_t r) {
      const uint64_t begin = r * run, size = std::min(count - begin, run);
      std::vector<Vec3> positions(size);
      points.read(first + begin, size, positions.data());
      ask_shape(model, true, positions.data(), alive + begin, size, job);
    });
    for (const Scale* scale : resolved) {
      if (!scale->structure->gains_by_groups()) {
        run_parts(executor, runs, job, next_stage(), [&](uint64_t r) {
          const uint64_t begin = r * run, size = std::min(count - begin, run);
          std::vector<Vec3> positions(size);
          points.read(first + begin, size, positions.data());
          ask_group(*scale, plan, positions.data(), alive + begin, size, job);
        });
        continue;
      }
      const uint32_t parts = plan.group_parts ? plan.group_parts : scale->structure->group_parts();
      groups.group(executor, scale->structure->neighbourhood(), points, first, count, alive, job,
                   parts);
      run_parts(executor, groups.size(), job, next_stage(), [&](uint64_t g) {
        const std::span<const uint32_t> group = groups[g];
        std::vector<Vec3> positions(group.size());
        points.gather(first, group, positions.data());
        std::vector<uint8_t> kept(group.size(), 1);
        ask_group(*scale, plan, positions.data(), kept.data(), group.size(), job);
        for (size_t k = 0; k < group.size(); ++k) alive[group[k]] = kept[k];
      });
    }
  }
}

}  // namespace

void ask_points(const Model& model, const Scales& resolved, const QueryPlan& plan,
                const Vec3* points, uint8_t* inside, size_t count, Job* job) {
  ask_shape(model, !resolved.empty(), points, inside, count, job);
  for (const Scale* scale : resolved) ask_group(*scale, plan, points, inside, count, job);
}

void set_membership(const Model& model, const Scales& resolved, const PointSet& points,
                    const QueryPlan& plan, uint8_t* inside, Job* job) {
  bool gains = false;
  for (const Scale* scale : resolved) gains |= scale->structure->gains_by_groups();
  if (points.count() == 0) return;
  model.prepare_skins(resolved);
  if (const SampleGrid* grid = points.as_grid(); grid && plan.method != QueryMethod::point)
    grid_membership(model, resolved, *grid, inside, job);
  else if (gains && !points.is_compact() && plan.method != QueryMethod::point)
    ask_by_groups(model, resolved, points, plan, inside, job);
  else
    ask_by_parts(model, resolved, points, plan, inside, job);
}

}  // namespace msq
