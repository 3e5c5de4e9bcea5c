// SPDX-License-Identifier: Apache-2.0
#include "api/points.h"
#include "query/distance.h"
#include "query/membership.h"

using namespace msq;
using namespace msq::api;

msq_status msq_query_def_init(msq_query_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, query_defaults(), "msq_query_def"); });
}

msq_status msq_points_def_init(msq_points_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, points_defaults(), "msq_points_def"); });
}

msq_status msq_points_generate(const msq_points_def* points, uint64_t first, uint64_t count,
                               double* coordinates) {
  return guard([&] {
    const std::unique_ptr<PointSet> set = read_points(points);
    if (first > set->count() || count > set->count() - first)
      fail(Status::argument, "points %llu to %llu + %llu are wanted; there are %llu",
           static_cast<unsigned long long>(first), static_cast<unsigned long long>(first),
           static_cast<unsigned long long>(count), static_cast<unsigned long long>(set->count()));
    if (count == 0) return;
    require(coordinates, "coordinates");
    constexpr uint64_t at_once = 256;
    Vec3 positions[at_once];
    for (uint64_t done = 0; done < count; done += at_once) {
      const uint64_t size = std::min(at_once, count - done);
      set->read(first + done, size, positions);
      for (uint64_t i = 0; i < size; ++i)
        for (int axis = 0; axis < 3; ++axis)
          coordinates[3 * (done + i) + static_cast<uint64_t>(axis)] = positions[i][axis];
    }
  });
}

msq_status msq_point_membership(const msq_model* model, const double point[3],
                                const msq_query_def* query, int32_t* inside) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    const Vec3 p = require_vector(point, "point");
    require(inside, "inside");
    Scales some;
    const Scales& resolved = resolve(known, query, some);
    require_point(known, resolved, p);
    *inside = known.inside(p, resolved);
  });
}

msq_status msq_set_membership(const msq_model* model, const msq_points_def* points,
                              const msq_query_def* query, uint8_t* inside, uint64_t inside_count,
                              msq_job* job) {
  return guard([&] {
    ask_set(model, points, query, inside, "inside", inside_count, "inside_count", job,
            set_membership);
  });
}

msq_status msq_point_region(const msq_model* model, const double point[3], int32_t* region) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    const Vec3 p = require_vector(point, "point");
    require(region, "region");
    const size_t found = known.region_at(p);
    *region = found == Model::no_region ? -1 : static_cast<int32_t>(found);
  });
}

msq_status msq_set_region(const msq_model* model, const msq_points_def* points, int32_t* regions,
                          uint64_t region_count, msq_job* job) {
  return guard([&] {
    ask_set(model, points, nullptr, regions, "regions", region_count, "region_count", job,
            [](const Model& known, const Scales&, const PointSet& set, const QueryPlan&,
               int32_t* values, Job* work) { set_regions(known, set, values, work); });
  });
}

msq_status msq_point_distance(const msq_model* model, const double point[3],
                              const msq_query_def* query, double* distance) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);
    const Vec3 p = require_vector(point, "point");
    require(distance, "distance");
    Scales some;
    const Scales& resolved = resolve(known, query, some);
    require_point(known, resolved, p);
    *distance = known.distance(p, resolved);
  });
}

msq_status msq_set_distance(const msq_model* model, const msq_points_def* points,
                            const msq_query_def* query, double* distance, uint64_t distance_count,
                            msq_job* job) {
  return guard([&] {
    ask_set(model, points, query, distance, "distance", distance_count, "distance_count", job,
            [](const Model& known, const Scales& resolved, const PointSet& set, const QueryPlan&,
               double* values, Job* work) { set_distance(known, resolved, set, values, work); });
  });
}
