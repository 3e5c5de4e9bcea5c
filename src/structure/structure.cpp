// SPDX-License-Identifier: Apache-2.0
#include "structure/structure.h"

#include "field/field.h"
#include "structure/common/sampled_rows.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/common/struts.h"

#include "base/ray_normal.h"

namespace msq {

void Structure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  for (size_t i = 0; i < count; ++i) {
    if (i % 16 == 0) check_cancelled();
    if (alive[i] && !inside(points[i])) alive[i] = 0;
  }
}

void Structure::keep_rows(const RowBlock& block, const Job* job) const {
  SampledRows(*this, block, job).keep();
}

void Structure::draw_rows(const RowBlock& block, const Job* job) const {
  set_all_bits(block);
  keep_rows(block, job);
}

bool Structure::is_sloped_everywhere() const {
  const Parameter* const parameter = sloped_parameter();
  return parameter && parameter->lipschitz() < infinity;
}

double Structure::min_ray_step() const {
  return is_sloped_everywhere() ? ray_tolerance() : min_component(neighbourhood().cell_size) / 64;
}

double Structure::march_step(Vec3 p, double coarse) const {
  const double bound = distance_bound(p);
  const Parameter* const parameter = sloped_parameter();
  return parameter ? steady_ray_step(bound, coarse, *parameter, p) : bound;
}

void Structure::enter(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.found = march(true, s.ray, s.from, s.to, s.t, job);
  }
}

double Structure::leave(const Ray& ray, double from, double to, const Job* job) const {
  double t;
  return march(false, ray, from, to, t, job) ? t : to;
}

Vec3 Structure::normal(const Ray& ray, double t) const {
  return normal_by_membership([this](Vec3 p) { return inside(p); }, ray, t, normal_distance());
}

std::unique_ptr<StrutParts> Structure::struts(const StrutSelection&) const {
  return nullptr;
}

void Structure::onsets(const Vec3* points, size_t count, double* to) const {
  for (size_t i = 0; i < count; ++i) {
    if (i % 16 == 0) check_cancelled();
    to[i] = onset(points[i]);
  }
}

LineGraph Structure::wall_lines(const WallSection&) const {
  fail(Status::unsupported,
       "the structure has no thin walls whose middle lines are known; use its contours");
}

}  // namespace msq
