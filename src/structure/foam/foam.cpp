// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/foam.h"

#include <algorithm>

#include "structure/common/group_by_cell.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/foam/joints/foam_struts.h"
#include "structure/foam/paper/method_1.h"
#include "structure/foam/paper/method_2.h"
#include "structure/foam/paper/naive_point.h"
#include "structure/foam/point/onset.h"
#include "structure/foam/point/stretched_point.h"
#include "structure/foam/rays/march.h"
#include "structure/foam/rays/packets.h"
#include "structure/foam/rays/strut_entry.h"
#include "structure/foam/rays/strut_exit.h"
#include "structure/foam/section/section_lines.h"
#include "structure/foam/sets/brick_rows.h"
#include "structure/foam/sets/bricks.h"
#include "structure/foam/sets/point_set.h"

namespace msq {

Foam::Foam(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter radius,
           double jitter, uint64_t seed, FoamMethod method, const Parameter& density, Vec3 stretch,
           double weight, std::shared_ptr<const PlacedSeeds> placed)
    : FoamData(std::move(context), neighbourhood, std::move(radius), jitter, seed, density, stretch,
               weight, std::move(placed)),
      method_(method == FoamMethod::automatic ? FoamMethod::direct : method),
      is_concurrent_(this->radius().is_concurrent() && density.is_concurrent()) {}

bool Foam::inside(const Neighbourhood::Located& located, Vec3 p) const {
  const Vec3 q = located.fraction * seeds().scale();
  return graph().inside(located.cell, q, radius().at(p) / unit());
}

bool Foam::inside(Vec3 p) const {
  return inside(neighbourhood().locate(p), p);
}

double Foam::onset(Vec3 p) const {
  const Neighbourhood::Located located = neighbourhood().locate(p);
  return unit() * graph().onset(located.cell, located.fraction * seeds().scale());
}

double Foam::onset_error() const {
  return stretch() ? stretched_slack(*stretch()) : onset_slack;
}

double Foam::distance_bound(Vec3 p) const {
  const double axis = onset(p);
  const double slack = onset_error() * unit() + locating_slack(p - neighbourhood().origin, axis);
  return strut_distance_bound(axis, slack, radius(), p);
}

uint64_t Foam::critical_count() const {
  // For smaller groups, the setup of a batch costs more than it saves: the limit is 16 points that
  // share a cell, and 48 points spread over 8^3 cells. The methods of the paper are used without
  // groups.
  return method_ == FoamMethod::direct && is_plain() ? 32 : 1;
}

void Foam::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (method_ == FoamMethod::point) return naive_keep_points(*this, points, alive, count);
  if (method_ == FoamMethod::method_1) return method_1_keep_points(*this, points, alive, count);
  if (method_ == FoamMethod::method_2) return method_2_keep_points(*this, points, alive, count);
  if (is_plain()) return foam_keep_points_by_point(*this, points, alive, count);
  // Cell by cell, since the point query keeps the seeds around the last point's cell.
  for (const LocatedPoint& point : group_by_cell(neighbourhood(), points, alive, count)) {
    check_cancelled();
    if (!inside(point.located, points[point.index])) alive[point.index] = 0;
  }
}

void Foam::keep_rows(const RowBlock& block, const Job* job) const {
  if (method_ == FoamMethod::direct) {
    if (keep_brick_rows(*this, block, AliveRows::some, job)) return;
    is_plain() ? foam_keep_rows_by_point(*this, block, job) : Structure::keep_rows(block, job);
  } else if (method_ == FoamMethod::point) {
    naive_keep_rows(*this, block, job);
  } else {
    Structure::keep_rows(block, job);
  }
}

void Foam::draw_rows(const RowBlock& block, const Job* job) const {
  if (method_ == FoamMethod::direct && keep_brick_rows(*this, block, AliveRows::all, job)) return;
  Structure::draw_rows(block, job);
}

void Foam::for_each_strut(const Box3& box, const TakeStrut& take, const Job* job) const {
  for_each_foam_strut(*this, box, take, job);
}

std::unique_ptr<StrutParts> Foam::struts(const StrutSelection& selection) const {
  return foam_struts(*this, selection);
}

void Foam::enter(RaySearch* searches, size_t count, const Job* job) const {
  const auto fits = [this](const RaySearch& s) { return fits_struts(s.ray, s.to); };
  if (!all_fit_struts(searches, count) && !std::all_of(searches, searches + count, fits)) {
    for (size_t i = 0; i < count; ++i)
      fits(searches[i]) ? enter(&searches[i], 1, job) : Structure::enter(&searches[i], 1, job);
    return;
  }
  if (may_march() ? enter_by_cells(*this, searches, count, job)
                  : walk_cells(*this, searches, count, job))
    return;
  for (size_t i = 0; i < count; ++i)
    // If steps may have missed a strut, or may differ, the search by cells decides.
    if (!enter_by_steps(searches[i], job) && !walk_cells(*this, &searches[i], 1, job) &&
        searches[i].found)
      sharpen_entry(*this, searches[i]);
}

bool Foam::enter_by_steps(RaySearch& search, const Job* job) const {
  const Ray& ray = search.ray;
  const double tolerance = ray_tolerance(ray, search.to);
  const RayMarch steps{std::max(min_ray_step(), tolerance), tolerance};
  const double near = 0.02 * min_component(neighbourhood().cell_size);
  const double rounding = 2 * unit() * StrutEntries(*this).ray(search).error;
  const auto way = [&](Vec3 p) {
    const double around = distance_bound(p) - rounding;
    // The way to a strut that the ray meets at a shallow angle is much longer than the distance.
    if (around > near || graded()) return around;
    return std::max(around, way_to_strut(*this, p, ray.direction, rounding));
  };
  bool creeps = false;
  search.found = steps.find(
      true, ray, search.from, search.to, [this](Vec3 p) { return inside(p); }, way, search.t, job,
      &creeps);
  return !creeps && (!search.found || sharpen_entry(*this, search));
}

namespace {

constexpr double max_rounding = 0x1p-23;  // foam units

}  // namespace

bool Foam::fits_struts(const Ray& ray, double to) const {
  return ray_tolerance(ray, to) <= max_rounding * unit();
}

// No coordinate of a ray exceeds the sum of its origin's and of its length, which is rounded by far
// less than the factor of 2 here.
bool Foam::all_fit_struts(const RaySearch* searches, size_t count) const {
  double reach = 0;
  for (size_t i = 0; i < count; ++i)
    reach = std::max(reach, max_magnitude(searches[i].ray.origin) + std::abs(searches[i].to));
  const double max = 2 * (reach + max_magnitude(neighbourhood().origin));
  return std::max(ray_tolerance(), coordinate_rounding(max)) <= max_rounding * unit();
}

double Foam::leave(const Ray& ray, double from, double to, const Job* job) const {
  if (fits_struts(ray, to)) {
    const double exit = strut_exit(*this, ray, from, to);
    if (exit > from) return exit;
  }
  return Structure::leave(ray, from, to, job);
}

Vec3 Foam::normal(const Ray& ray, double t) const {
  const Vec3 normal = strut_normal(*this, ray, t);
  return dot(normal, normal) > 0 ? normal : Structure::normal(ray, t);
}

LineGraph Foam::wall_lines(const WallSection& section) const {
  return foam_section({neighbourhood(), diagram_seeds(), graded(), unit(), stretch()}, section);
}

void Foam::describe(HashInput& input) const {
  input.kind("structure: foam of struts");
  neighbourhood().describe(input);
  seeds().describe(input);
  // A density that is 1 everywhere changes nothing.
  input.integer(graded() ? 1 : 0);
  if (graded()) graded()->describe(input);
  radius().describe(input);
  if (!stretch()) return;
  input.text("stretch");
  stretch()->describe(input);
}

}  // namespace msq
