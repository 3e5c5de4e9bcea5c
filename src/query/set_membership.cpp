// SPDX-License-Identifier: Apache-2.0
// Sets of points are evaluated part by part if they are compact, or if no structure gains by
// grouping. Other sets are grouped by boxes of cells, structure by structure and chunk by chunk.
// The buffers have the size of one chunk, for any number of points.
#include "base/memory.h"
#include "base/run_parts.h"
#include "query/membership.h"
#include "query/point_groups.h"

namespace msq {

namespace {

/// Points grouped at a time. Larger groups share more of a cell's work (docs/benchmarks.md), but
/// each point takes 6 bytes.
constexpr uint64_t max_in_chunk = uint64_t{1} << 21, min_in_chunk = 4096;
/// Points evaluated by the shape at a time.
constexpr uint64_t run = 4096;
static_assert(run <= PointGroups::max_in_group);

uint64_t working_bytes(uint64_t chunk, unsigned threads) {
  return PointGroups::bytes(chunk) +
         threads * PointGroups::max_in_group * (sizeof(Vec3) + sizeof(uint8_t));
}

/// As many points as the memory limit allows, not counting cached cells; at least min_in_chunk.
uint64_t chunk_of(const Context& context, uint64_t count, unsigned threads) {
  const MemoryBudget& budget = *context.budget;
  uint64_t chunk = std::clamp(count, min_in_chunk, max_in_chunk);
  if (budget.limit() == 0) return chunk;
  const uint64_t cached = context.cache.counters().bytes;
  const uint64_t others = budget.held() - std::min(cached, budget.held());
  const uint64_t room = budget.limit() - std::min(others, budget.limit());
  while (chunk > min_in_chunk && working_bytes(chunk, threads) > room)
    chunk = std::max(min_in_chunk, chunk / 2);
  return chunk;
}

/// Sets alive[i] to the shape's membership of points[i].
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

/// Progress from stage to stage.
class Stages {
 public:
  explicit Stages(uint64_t count) : count_(static_cast<double>(count)) {}
  Interval next() {
    const double begin = stage_++;
    return {begin / count_, stage_ / count_};
  }

 private:
  double count_, stage_ = 0;
};

/// The points [first, first + count) of a set.
struct Chunk {
  const PointSet& points;
  uint64_t first, count;

  uint64_t runs() const { return (count + run - 1) / run; }
  /// Calls body(i, positions) for each run, of points that begin with number i of the chunk.
  template <class Body>
  void for_each_run(const Executor& executor, Job* job, Interval progress, Body&& body) const {
    run_parts(executor, runs(), job, progress, [&](uint64_t r) {
      const uint64_t begin = r * run, size = std::min(count - begin, run);
      std::vector<Vec3> positions(size);
      points.read(first + begin, size, positions.data());
      body(begin, positions);
    });
  }
};

/// Sets alive[i] to 0 where a scale does not hold the point.
void keep_by_groups(const Executor& executor, const Scales& scales, const Chunk& chunk,
                    const QueryPlan& plan, PointGroups& groups, uint8_t* alive, Stages& stages,
                    Job* job) {
  for (const Scale* scale : scales) {
    if (!scale->structure->gains_by_groups()) {
      chunk.for_each_run(
          executor, job, stages.next(), [&](uint64_t i, const std::vector<Vec3>& positions) {
            ask_group(*scale, plan, positions.data(), alive + i, positions.size(), job);
          });
      continue;
    }
    const uint32_t parts = plan.group_parts ? plan.group_parts : scale->structure->group_parts();
    groups.group(executor, scale->structure->neighbourhood(), chunk.points, chunk.first,
                 chunk.count, alive, job, parts);
    run_parts(executor, groups.size(), job, stages.next(), [&](uint64_t g) {
      const std::span<const uint32_t> group = groups[g];
      std::vector<Vec3> positions(group.size());
      chunk.points.gather(chunk.first, group, positions.data());
      std::vector<uint8_t> kept(group.size(), 1);
      ask_group(*scale, plan, positions.data(), kept.data(), group.size(), job);
      for (size_t k = 0; k < group.size(); ++k) alive[group[k]] = kept[k];
    });
  }
}

/// Calls take(r, indices, positions) for the points that belong to each region, of which there are
/// some.
template <class Take>
void for_each_region(const Model& model, const Vec3* points, size_t count, Take&& take) {
  std::vector<uint32_t> open(count), own;
  std::vector<Vec3> positions(points, points + count), own_positions;
  std::vector<uint8_t> answers;
  for (size_t i = 0; i < count; ++i) open[i] = static_cast<uint32_t>(i);
  for (size_t r = 0; r < model.regions().size() && !open.empty(); ++r) {
    answers.resize(open.size());
    model.regions()[r]->shape().find_inside(positions.data(), open.size(), answers.data());
    own.clear();
    own_positions.clear();
    size_t kept = 0;
    for (size_t n = 0; n < open.size(); ++n) {
      if (answers[n]) {
        own.push_back(open[n]);
        own_positions.push_back(positions[n]);
      } else {
        open[kept] = open[n];
        positions[kept++] = positions[n];
      }
    }
    open.resize(kept);
    positions.resize(kept);
    if (!own.empty()) take(r, own, own_positions);
  }
}

static_assert(Model::max_regions < UINT16_MAX);
constexpr uint16_t in_no_region = UINT16_MAX;
/// Of a point in a chunk: its region, and whether one holds it.
constexpr uint64_t region_bytes = sizeof(uint16_t) + sizeof(uint8_t);

/// region[i] becomes the one that points[i] belongs to.
void find_regions(const Model& model, const Scales& resolved, const Vec3* points, uint16_t* region,
                  size_t count, Job* job) {
  std::fill_n(region, count, in_no_region);
  uint64_t by_scales = 0;
  for_each_region(model, points, count,
                  [&](size_t r, const std::vector<uint32_t>& own, const std::vector<Vec3>&) {
                    for (const uint32_t i : own) region[i] = static_cast<uint16_t>(r);
                    if (!resolved.regions[r].empty()) by_scales += own.size();
                  });
  if (!job) return;
  job->counts().points += count;
  job->counts().by_shape += count - by_scales;
}

void ask_by_groups(const Model& model, const Scales& resolved, const PointSet& points,
                   const QueryPlan& plan, uint8_t* inside, Job* job) {
  const Context& context = model.context();
  const Executor& executor = model.executor();
  const uint64_t chunk = chunk_of(context, points.count(), executor.threads());
  const bool has_regions = !model.regions().empty();
  const Reservation reservation(
      context.budget,
      working_bytes(chunk, executor.threads()) + (has_regions ? chunk * region_bytes : 0),
      "points grouped by cell");
  PointGroups groups(chunk);
  std::vector<uint16_t> region_of(has_regions ? chunk : 0);
  std::vector<uint8_t> of_region(has_regions ? chunk : 0);

  const uint64_t chunks = (points.count() + chunk - 1) / chunk;
  Stages stages(chunks * (1 + resolved.size()));
  for (uint64_t first = 0; first < points.count(); first += chunk) {
    const Chunk part{points, first, std::min(chunk, points.count() - first)};
    uint8_t* alive = inside + first;
    if (!has_regions) {
      part.for_each_run(
          executor, job, stages.next(), [&](uint64_t i, const std::vector<Vec3>& positions) {
            ask_shape(model, true, positions.data(), alive + i, positions.size(), job);
          });
      keep_by_groups(executor, resolved, part, plan, groups, alive, stages, job);
      continue;
    }
    part.for_each_run(
        executor, job, stages.next(), [&](uint64_t i, const std::vector<Vec3>& positions) {
          find_regions(model, resolved, positions.data(), &region_of[i], positions.size(), job);
        });
    std::fill_n(alive, part.count, 0);
    for (size_t r = 0; r < model.regions().size(); ++r) {
      bool is_any = false;
      for (uint64_t i = 0; i < part.count; ++i) is_any |= (of_region[i] = region_of[i] == r) != 0;
      if (!is_any) continue;
      keep_by_groups(executor, resolved.regions[r], part, plan, groups, of_region.data(), stages,
                     job);
      for (uint64_t i = 0; i < part.count; ++i) alive[i] |= of_region[i];
    }
  }
}

void ask_regions(const Model& model, const Scales& resolved, const QueryPlan& plan,
                 const Vec3* points, uint8_t* inside, size_t count, Job* job) {
  std::fill_n(inside, count, 0);
  uint64_t by_scales = 0;
  std::vector<uint8_t> alive;
  for_each_region(
      model, points, count,
      [&](size_t r, const std::vector<uint32_t>& own, const std::vector<Vec3>& positions) {
        alive.assign(own.size(), 1);
        for (const Scale* scale : resolved.regions[r])
          ask_group(*scale, plan, positions.data(), alive.data(), own.size(), job);
        if (!resolved.regions[r].empty()) by_scales += own.size();
        for (size_t n = 0; n < own.size(); ++n) inside[own[n]] = alive[n];
      });
  if (!job) return;
  job->counts().points += count;
  job->counts().by_shape += count - by_scales;
}

}  // namespace

void ask_points(const Model& model, const Scales& resolved, const QueryPlan& plan,
                const Vec3* points, uint8_t* inside, size_t count, Job* job) {
  if (!model.regions().empty())
    return ask_regions(model, resolved, plan, points, inside, count, job);
  ask_shape(model, !resolved.empty(), points, inside, count, job);
  for (const Scale* scale : resolved) ask_group(*scale, plan, points, inside, count, job);
}

void set_membership(const Model& model, const Scales& resolved, const PointSet& points,
                    const QueryPlan& plan, uint8_t* inside, Job* job) {
  bool gains = false;
  for (const Scale* scale : resolved) gains |= scale->structure->gains_by_groups();
  if (points.count() == 0) return;
  model.prepare_skins(resolved, job);
  if (const SampleGrid* grid = points.as_grid(); grid && plan.method != QueryMethod::point) {
    model.prepare_rows(job);  // before the first result is written
    grid_membership(model, resolved, *grid, inside, job);
  } else if (gains && !points.is_compact() && plan.method != QueryMethod::point) {
    ask_by_groups(model, resolved, points, plan, inside, job);
  } else {
    ask_by_parts(model, resolved, points, plan, inside, job);
  }
}

void set_regions(const Model& model, const PointSet& points, int32_t* regions, Job* job) {
  run_parts(model.executor(), points.parts(), job, {0, 1}, [&](uint64_t index) {
    PointSet::Part part;
    points.read_part(index, part);
    const size_t count = part.positions.size();
    for (size_t i = 0; i < count; ++i) regions[part.numbers[i]] = -1;
    if (model.regions().empty()) {
      std::vector<uint8_t> inside(count);
      model.shape().find_inside(part.positions.data(), count, inside.data());
      for (size_t i = 0; i < count; ++i)
        if (inside[i]) regions[part.numbers[i]] = 0;
      return;
    }
    for_each_region(model, part.positions.data(), count,
                    [&](size_t r, const std::vector<uint32_t>& own, const std::vector<Vec3>&) {
                      for (const uint32_t i : own)
                        regions[part.numbers[i]] = static_cast<int32_t>(r);
                    });
  });
}

}  // namespace msq
