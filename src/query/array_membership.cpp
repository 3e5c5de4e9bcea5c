// SPDX-License-Identifier: Apache-2.0
// Points in any order. Chunks of them are grouped by boxes of cells, structure by structure; the
// buffers are those of one chunk, however many points there are.
#include <atomic>

#include "base/memory.h"
#include "query/membership.h"
#include "query/point_groups.h"

namespace msq {

namespace {

/// Points grouped at a time. More share more of a cell's work (docs/benchmarks.md), but ask for 6
/// bytes each.
constexpr uint64_t most_in_chunk = uint64_t{1} << 21, least_in_chunk = 4096;
/// Points of a group lie anywhere in the host's array: they are called for so many ahead.
constexpr size_t ahead = 24;
/// Points asked at a time.
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

}  // namespace

void array_membership(const Model& model, const Scales& resolved, const PointArray& points,
                      uint8_t* inside, Job* job) {
  if (points.count == 0) return;
  model.prepare_skins(resolved);
  const Context& context = model.context();
  const Executor& executor = model.executor();
  bool is_grouped = false;
  for (const Scale* scale : resolved) is_grouped |= scale->structure->gains_by_groups();
  const uint64_t chunk =
      is_grouped ? chunk_of(context, points.count, executor.threads()) : most_in_chunk;
  Reservation reservation;
  if (is_grouped)
    reservation = Reservation(context.budget, working_bytes(chunk, executor.threads()),
                              "points grouped by cell");
  PointGroups groups(is_grouped ? chunk : 0);

  const uint64_t chunks = (points.count + chunk - 1) / chunk;
  const double stages = static_cast<double>(chunks) * static_cast<double>(1 + resolved.size());
  double stage = 0;
  // Calls work(i) for i in [0, count) and reports how far it is.
  const auto for_each = [&](uint64_t count, auto&& work) {
    std::atomic<uint64_t> done{0};
    executor.for_each(count, [&](uint64_t i) {
      check_cancelled(job);
      work(i);
      const uint64_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
      if (job && now % 64 == 0)
        job->raise_progress((stage + static_cast<double>(now) / static_cast<double>(count)) /
                            stages);
    });
    stage += 1;
    if (job) job->raise_progress(stage / stages);
  };

  for (uint64_t first = 0; first < points.count; first += chunk) {
    const uint64_t count = std::min(chunk, points.count - first);
    uint8_t* alive = inside + first;
    const uint64_t runs = (count + run - 1) / run;
    for_each(runs, [&](uint64_t r) {
      const uint64_t end = std::min(count, (r + 1) * run);
      std::vector<Vec3> positions;
      positions.reserve(run);
      for (uint64_t i = r * run; i < end; ++i) positions.push_back(points.at(first + i));
      model.shape().find_inside(positions.data(), positions.size(), alive + r * run);
    });
    for (const Scale* scale : resolved) {
      if (!scale->structure->gains_by_groups()) {
        for_each(runs, [&](uint64_t r) {
          const uint64_t begin = r * run, end = std::min(count, begin + run);
          std::vector<Vec3> positions;
          positions.reserve(end - begin);
          for (uint64_t i = begin; i < end; ++i) positions.push_back(points.at(first + i));
          scale->keep_points(positions.data(), alive + begin, positions.size());
        });
        continue;
      }
      groups.group(executor, scale->structure->neighbourhood(), points, first, count, alive, job);
      for_each(groups.size(), [&](uint64_t g) {
        const std::span<const uint32_t> group = groups[g];
        std::vector<Vec3> positions;
        positions.reserve(group.size());
        for (size_t k = 0; k < group.size(); ++k) {
          if (k + ahead < group.size()) points.prefetch(first + group[k + ahead]);
          positions.push_back(points.at(first + group[k]));
        }
        std::vector<uint8_t> kept(group.size(), 1);
        scale->keep_points(positions.data(), kept.data(), group.size());
        for (size_t k = 0; k < group.size(); ++k) alive[group[k]] = kept[k];
      });
    }
  }
}

}  // namespace msq
