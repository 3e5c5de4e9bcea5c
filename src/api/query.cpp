// SPDX-License-Identifier: Apache-2.0
#include <atomic>

#include "api/guard.h"
#include "query/distance.h"
#include "query/membership.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_query_def query_defaults() {
  return {};
}

msq_points_def points_defaults() {
  msq_points_def def{};
  def.kind = MSQ_POINTS_ARRAY;
  def.coordinate_type = MSQ_FLOAT64;
  return def;
}

double read_length_scale(const msq_query_def* query) {
  const msq_query_def known = query ? read_def(query, query_defaults(), "query") : query_defaults();
  require_reserved(known.reserved, "reserved");
  if (!(known.length_scale >= 0))
    fail(Status::argument, "length_scale is %g; it must not be negative", known.length_scale);
  return known.length_scale;
}

void check_count(uint64_t count, const char* name, uint64_t points) {
  if (count != points)
    fail(Status::argument, "%s is %llu; there are %llu points", name,
         static_cast<unsigned long long>(count), static_cast<unsigned long long>(points));
}

SampleGrid read_grid(const msq_points_def& def) {
  SampleGrid grid;
  grid.origin = require_vector(def.origin, "origin");
  uint64_t counts[3];
  for (int axis = 0; axis < 3; ++axis) {
    grid.spacing[axis] = require_positive(def.spacing[axis], "spacing");
    counts[axis] = def.counts[axis];
    if (counts[axis] < 1 || counts[axis] > INT32_MAX)
      fail(Status::argument, "counts[%d] is %llu; it must be from 1 to %d", axis,
           static_cast<unsigned long long>(counts[axis]), INT32_MAX);
    const double last = static_cast<double>(counts[axis] - 1);
    require_finite(grid.origin[axis] + last * grid.spacing[axis], "the last point's coordinate");
    const double step = grid.spacing[axis], origin = grid.origin[axis];
    if (last > 0 && (origin + step == origin || origin + last * step == origin + (last - 1) * step))
      fail(Status::argument, "spacing[%d] is %g; points %g away from 0 would coincide", axis, step,
           std::max(std::abs(origin), std::abs(origin + last * step)));
  }
  grid.nx = counts[0];
  grid.ny = counts[1];
  grid.nz = counts[2];
  return grid;
}

/// Names the first point that is not finite.
void check_finite(const PointArray& points, const Executor& executor) {
  constexpr uint64_t run = 65536;
  std::atomic<uint64_t> first{points.count};
  executor.for_each((points.count + run - 1) / run, [&](uint64_t r) {
    const uint64_t end = std::min(points.count, (r + 1) * run);
    for (uint64_t i = r * run; i < end; ++i) {
      if (is_finite(points.at(i))) continue;
      uint64_t known = first.load();
      while (i < known && !first.compare_exchange_weak(known, i)) {
      }
      return;
    }
  });
  if (first == points.count) return;
  const Vec3 p = points.at(first);
  fail(Status::argument, "point %llu is (%g, %g, %g); it must be finite",
       static_cast<unsigned long long>(first.load()), p.x, p.y, p.z);
}

/// Where a set's answers go.
template <class Answer>
struct Answers {
  Answer* values;
  const char* name;
  uint64_t count;
  const char* count_name;
};

/// Checks the points of a set query and passes them on: to of_array(model, resolved, PointArray,
/// values, job) or of_grid(model, resolved, SampleGrid, values, job).
template <class Answer, class OfArray, class OfGrid>
void ask_set(const msq_model* model, const msq_points_def* points, const msq_query_def* query,
             const Answers<Answer>& answers, msq_job* job, OfArray&& of_array, OfGrid&& of_grid) {
  const Model& known = object(model, "model");
  const Ref<const Model> keep(&known);  // callbacks may release the host's last reference
  const msq_points_def def = read_def(points, points_defaults(), "points");
  const auto resolved = known.resolved(read_length_scale(query));
  Job* work = job ? &object(job, "job") : nullptr;
  require_reserved(def.reserved, "reserved");
  if (require_range(def.kind, MSQ_POINTS_ARRAY, MSQ_POINTS_GRID, "kind") == MSQ_POINTS_ARRAY) {
    const PointArray array =
        point_array(def.coordinates, def.count, def.stride, def.coordinate_type, "coordinates");
    check_count(answers.count, answers.count_name, array.count);
    if (array.count > 0) require(answers.values, answers.name);
    check_finite(array, known.context().executor);
    JobScope scope(work);
    of_array(known, resolved, array, answers.values, work);
    scope.done();
  } else {
    const SampleGrid grid = read_grid(def);
    check_count(answers.count, answers.count_name,
                checked_product(checked_product(grid.nx, grid.ny, "points"), grid.nz, "points"));
    require(answers.values, answers.name);
    JobScope scope(work);
    of_grid(known, resolved, grid, answers.values, work);
    scope.done();
  }
}

}  // namespace

msq_status msq_query_def_init(msq_query_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, query_defaults(), "msq_query_def"); });
}

msq_status msq_points_def_init(msq_points_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, points_defaults(), "msq_points_def"); });
}

msq_status msq_point_membership(const msq_model* model, const double point[3],
                                const msq_query_def* query, int32_t* inside) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    const Vec3 p = require_vector(point, "point");
    require(inside, "inside");
    *inside = known.inside(p, known.resolved(read_length_scale(query)));
  });
}

msq_status msq_set_membership(const msq_model* model, const msq_points_def* points,
                              const msq_query_def* query, uint8_t* inside, uint64_t inside_count,
                              msq_job* job) {
  return guard([&] {
    ask_set(model, points, query, Answers<uint8_t>{inside, "inside", inside_count, "inside_count"},
            job, array_membership, grid_membership);
  });
}

msq_status msq_point_distance(const msq_model* model, const double point[3],
                              const msq_query_def* query, double* distance) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    const Vec3 p = require_vector(point, "point");
    require(distance, "distance");
    *distance = known.distance(p, known.resolved(read_length_scale(query)));
  });
}

msq_status msq_set_distance(const msq_model* model, const msq_points_def* points,
                            const msq_query_def* query, double* distance, uint64_t distance_count,
                            msq_job* job) {
  return guard([&] {
    ask_set(model, points, query,
            Answers<double>{distance, "distance", distance_count, "distance_count"}, job,
            array_distance, grid_distance);
  });
}
