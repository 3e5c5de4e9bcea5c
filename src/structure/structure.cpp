// SPDX-License-Identifier: Apache-2.0
#include "structure/structure.h"

#include "structure/sampled_rows.h"

#include "base/ray_normal.h"

namespace msq {

void Structure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  for (size_t i = 0; i < count; ++i)
    if (alive[i] && !inside(points[i])) alive[i] = 0;
}

void Structure::keep_rows(const RowBlock& block, const Job* job) const {
  SampledRows(*this, block, job).keep();
}

bool Structure::march(bool wanted, const Ray& ray, double from, double to,
                      double& t) const {
  const RayMarch steps{least_ray_step(), ray_tolerance()};
  return steps.find(wanted, ray, from, to, [this](Vec3 p) { return inside(p); },
                    [this](Vec3 p) { return clearance(p); }, t);
}

void Structure::enter(RaySearch* searches, size_t count) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.found = march(true, s.ray, s.from, s.to, s.t);
  }
}

double Structure::leave(const Ray& ray, double from, double to) const {
  double t;
  return march(false, ray, from, to, t) ? t : to;
}

Vec3 Structure::normal(const Ray& ray, double t) const {
  return normal_by_membership([this](Vec3 p) { return inside(p); }, ray, t,
                              normal_distance());
}

}  // namespace msq
