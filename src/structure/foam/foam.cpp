// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/foam.h"

#include "structure/foam/direct.h"
#include "structure/foam/foam_rays.h"
#include "structure/foam/graded_point.h"
#include "structure/foam/method_1.h"
#include "structure/foam/method_2.h"
#include "structure/foam/naive_point.h"
#include "structure/foam/onset.h"
#include "structure/foam/point.h"
#include "structure/foam/point_set.h"
#include "structure/foam/strut_surface.h"
#include "structure/group_by_cell.h"
#include "structure/strut_clearance.h"

namespace msq {

Foam::Foam(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter radius,
           double jitter, uint64_t seed, FoamMethod method, Parameter density)
    : Structure(neighbourhood),
      context_(std::move(context)),
      id_(context_->new_structure_id()),
      seeded_edges_id_(context_->new_structure_id()),
      cell_struts_id_(context_->new_structure_id()),
      radius_(std::move(radius)),
      unit_(max_component(neighbourhood.cell_size)),
      seeds_(seed, jitter, neighbourhood.cell_size * (1 / unit_)),
      method_(method == FoamMethod::automatic ? FoamMethod::direct : method),
      is_concurrent_(radius_.is_concurrent() && density.is_concurrent()) {
  if (density.range().high > 1)
    graded_ = std::make_shared<const GradedSeeds>(seeds_, neighbourhood, std::move(density));
}

Foam::~Foam() {
  context_->cache.drop(id_);
  context_->cache.drop(seeded_edges_id_);
  context_->cache.drop(cell_struts_id_);
}

double Foam::most_radius(CellIndex cell, double margin) const {
  if (radius_.is_constant()) return most_radius();
  const Neighbourhood& grid = neighbourhood();
  const Vec3 low = Vec3{double(cell.x), double(cell.y), double(cell.z)} * grid.cell_size;
  const Box3 box = Box3{low, low + grid.cell_size}.grown(margin * unit_);
  return radius_.range(grid.from_grid(box)).high / unit_;
}

bool Foam::inside(const Neighbourhood::Located& located, Vec3 p) const {
  const Vec3 q = located.fraction * seeds_.scale();
  const double radius = radius_.at(p) / unit_;
  return graded_ ? graded_point_inside(graded_, located.cell, q, radius)
                 : foam_point_inside(seeds_, located.cell, q, radius);
}

bool Foam::inside(Vec3 p) const {
  return inside(neighbourhood().locate(p), p);
}

double Foam::onset(Vec3 p) const {
  const Neighbourhood::Located located = neighbourhood().locate(p);
  const Vec3 q = located.fraction * seeds_.scale();
  return unit_ *
         (graded_ ? graded_onset(graded_, located.cell, q) : foam_onset(seeds_, located.cell, q));
}

double Foam::clearance(Vec3 p) const {
  const double axis = onset(p);
  const double slack = onset_slack * unit_ + locating_slack(p - neighbourhood().origin, axis);
  return strut_clearance(axis, slack, radius_, p);
}

uint64_t Foam::critical_count() const {
  // Below, setting up a batch costs more than it saves: from 16 points on where they share a cell,
  // from 48 on where they are spread over 8^3. The methods of the paper are asked as they are.
  return method_ == FoamMethod::direct && !graded_ ? 32 : 1;
}

void Foam::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (method_ == FoamMethod::point) return naive_keep_points(*this, points, alive, count);
  if (method_ == FoamMethod::method_1) return method_1_keep_points(*this, points, alive, count);
  if (method_ == FoamMethod::method_2) return method_2_keep_points(*this, points, alive, count);
  if (!graded_) return foam_keep_points_by_point(*this, points, alive, count);
  // Cell by cell, since the point query keeps the seeds about the last point's cell.
  for (const LocatedPoint& point : group_by_cell(neighbourhood(), points, alive, count))
    if (!inside(point.located, points[point.index])) alive[point.index] = 0;
}

void Foam::keep_rows(const RowBlock& block, const Job* job) const {
  if (method_ == FoamMethod::direct)
    direct_keep_rows(*this, block, job);
  else if (method_ == FoamMethod::point)
    naive_keep_rows(*this, block, job);
  else
    Structure::keep_rows(block, job);
}

void Foam::enter(RaySearch* searches, size_t count) const {
  if (may_march() ? enter_by_cells(*this, searches, count) : walk_cells(*this, searches, count))
    return;
  const RayMarch steps{least_ray_step(), ray_tolerance()};
  const double near = 0.02 * min_component(neighbourhood().cell_size);
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    const auto way = [&](Vec3 p) {
      const double around = clearance(p);
      // The way to a strut that is met slantingly is much longer than the distance.
      if (around > near || graded_) return around;
      return std::max(around, way_to_strut(*this, p, s.ray.direction));
    };
    bool creeps = false;
    s.found = steps.find(
        true, s.ray, s.from, s.to, [this](Vec3 p) { return inside(p); }, way, s.t, &creeps);
    if (creeps && walk_cells(*this, &s, 1)) continue;
    if (s.found) sharpen_entry(*this, s);
  }
}

double Foam::leave(const Ray& ray, double from, double to) const {
  if (has_capsules()) {
    const double exit = strut_exit(*this, ray, from, to);
    if (exit > from) return exit;
  }
  return Structure::leave(ray, from, to);
}

Vec3 Foam::normal(const Ray& ray, double t) const {
  const Vec3 normal = strut_normal(*this, ray, t);
  return dot(normal, normal) > 0 ? normal : Structure::normal(ray, t);
}

}  // namespace msq
