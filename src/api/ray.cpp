// SPDX-License-Identifier: Apache-2.0
#include <limits>
#include <string>

#include "api/guard.h"
#include "api/points.h"
#include "api/warnings.h"
#include "ray/search.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_rays_def rays_defaults() {
  msq_rays_def def{};
  def.coordinate_type = MSQ_FLOAT64;
  return def;
}

/// The host's rays, their directions not yet of length 1.
struct RayArray {
  PointArray origins, directions;
  const double* t_min;
  const double* t_max;

  Vec3 direction(uint64_t i) const { return directions.at(i); }
  double from(uint64_t i) const { return t_min ? t_min[i] : 0; }
  double to(uint64_t i) const { return t_max ? t_max[i] : std::numeric_limits<double>::infinity(); }
  HWY_INLINE void prefetch(uint64_t i) const {
    origins.prefetch(i);
    directions.prefetch(i);
  }
};

/// Rays in an order that is not the array's come from and go to anywhere.
constexpr size_t ahead = 16;

void check_ray(const RayArray& rays, uint64_t i) {
  const auto number = static_cast<unsigned long long>(i);
  const Vec3 origin = rays.origins.at(i), direction = rays.direction(i);
  if (!is_finite(origin))
    fail(Status::argument, "the origin of ray %llu is (%g, %g, %g); it must be finite", number,
         origin.x, origin.y, origin.z);
  const double size = size_of(direction);
  if (!is_finite(direction) || !(size >= std::numeric_limits<double>::min()) ||
      !std::isfinite(size))
    fail(Status::argument,
         "the direction of ray %llu is (%g, %g, %g); it must be finite and not of length 0", number,
         direction.x, direction.y, direction.z);
  if (!std::isfinite(rays.from(i)))
    fail(Status::argument, "t_min of ray %llu is %g; it must be finite", number, rays.from(i));
  if (std::isnan(rays.to(i)))
    fail(Status::argument, "t_max of ray %llu is %g; it must be a number or infinity", number,
         rays.to(i));
}

void check_ray_in_all_space(const Model& model, const Scales& resolved, const RayArray& rays,
                            uint64_t i) {
  const auto number = static_cast<unsigned long long>(i);
  if (!std::isfinite(rays.to(i)))
    fail(Status::argument, "t_max of ray %llu is %g; in a model of all space it must be finite",
         number, rays.to(i));
  if (!(rays.from(i) <= rays.to(i))) return;
  const std::string name = "ray " + std::to_string(number);
  for (const double t : {rays.from(i), rays.to(i)}) {
    const Vec3 end = rays.origins.at(i) + rays.direction(i) * t;
    require_reach(model, resolved, Box3{end, end}, name.c_str());
  }
}

void set_search(const RayArray& rays, uint64_t i, RaySearch& search) {
  const Vec3 direction = rays.direction(i);
  search_along(rays.origins.at(i), direction, size_of(direction), rays.from(i), rays.to(i), search);
}

msq_ray_hit answer_of(const RayHit& hit, CellIndex cell, double size, double t_min, double t_max) {
  msq_ray_hit answer{};
  answer.scale = hit.scale;
  answer.t = parameter_of(hit, size, t_min, t_max);
  if (hit.scale < 0) return answer;
  answer.starts_inside = hit.starts_inside;
  for (int axis = 0; axis < 3; ++axis) answer.normal[axis] = hit.normal[axis];
  answer.cell[0] = cell.x;
  answer.cell[1] = cell.y;
  answer.cell[2] = cell.z;
  return answer;
}

}  // namespace

msq_status msq_rays_def_init(msq_rays_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, rays_defaults(), "msq_rays_def"); });
}

msq_status msq_ray_cast(const msq_model* model, const msq_rays_def* rays,
                        const msq_query_def* query, msq_ray_hit* hits, uint64_t hit_count,
                        msq_job* job) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Ref<const Model> keep(&known);  // callbacks may release the host's last reference
    const msq_rays_def def = read_def(rays, rays_defaults(), "rays");
    const auto resolved = known.resolved(read_query(query).length_scale);
    Job* work = job ? &object(job, "job") : nullptr;
    const RayArray array{
        point_array(def.origins, def.count, def.origin_stride, def.coordinate_type, "origins"),
        point_array(def.directions, def.count, def.direction_stride, def.coordinate_type,
                    "directions"),
        def.t_min, def.t_max};
    if (hit_count != def.count)
      fail(Status::argument, "hit_count is %llu; there are %llu rays",
           static_cast<unsigned long long>(hit_count), static_cast<unsigned long long>(def.count));
    if (def.count > 0) require(hits, "hits");
    const uint64_t bytes = checked_product(def.count, sizeof *hits, "hits");
    require_apart(array.origins, "origins", hits, bytes, "hits");
    require_apart(array.directions, "directions", hits, bytes, "hits");
    require_apart(def.t_min, def.count * sizeof(double), "t_min", hits, bytes, "hits");
    require_apart(def.t_max, def.count * sizeof(double), "t_max", hits, bytes, "hits");
    JobPoll poll(work);
    for (uint64_t i = 0; i < def.count; ++i) {
      check_ray(array, i);
      if (!known.shape().is_bounded()) check_ray_in_all_space(known, resolved, array, i);
      poll();
    }
    JobScope scope(work);
    cast_rays(
        known, resolved, def.count,
        [&](std::span<const uint64_t> numbers, RaySearch* searches) {
          for (size_t n = 0; n < numbers.size(); ++n) {
            if (n + ahead < numbers.size()) array.prefetch(numbers[n + ahead]);
            set_search(array, numbers[n], searches[n]);
          }
        },
        [&](std::span<const uint64_t> numbers, const RayHit* found) {
          uint32_t part = 0;  // of the skin, for points near each other
          for (size_t n = 0; n < numbers.size(); ++n) {
            const uint64_t i = numbers[n];
            if (n + ahead < numbers.size()) {
              array.directions.prefetch(numbers[n + ahead]);
              prefetch_to_write(&hits[numbers[n + ahead]]);
            }
            hits[i] = answer_of(found[n], cell_of(resolved, found[n]), size_of(array.direction(i)),
                                array.from(i), array.to(i));
            hits[i].material = material_id(known, resolved, found[n], part);
          }
        },
        work);
    scope.done();
    warn_of_cache(known.context());
  });
}
