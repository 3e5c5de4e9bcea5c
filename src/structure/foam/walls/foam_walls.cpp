// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/walls/foam_walls.h"

#include <algorithm>

#include "structure/common/group_by_cell.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/foam/section/section_lines.h"
#include "structure/foam/walls/vent_distance.h"
#include "structure/foam/walls/vent_lines.h"
#include "structure/foam/walls/vent_ray.h"
#include "structure/foam/walls/void_rows.h"
#include "structure/foam/walls/wall_ray.h"

namespace msq {

namespace {

NearSeeds make_seeds(const Neighbourhood& grid, double unit, double jitter, uint64_t seed,
                     Parameter density, Vec3 stretch, double weight,
                     std::shared_ptr<const PlacedSeeds> placed) {
  if (Stretch::is_any(stretch)) return NearSeeds(Stretch(grid, jitter, seed, stretch));
  const FoamSeeds cells(seed, jitter, grid.cell_size * (1 / unit), weight / unit);
  if (placed)
    return NearSeeds(cells, std::make_shared<const GradedSeeds>(cells, std::move(placed)));
  if (!(density.range().high > 1)) return NearSeeds(cells, nullptr);
  return NearSeeds(cells, std::make_shared<const GradedSeeds>(cells, grid, std::move(density)));
}

}  // namespace

FoamWalls::FoamWalls(Ref<Context> context, const Neighbourhood& neighbourhood, Parameter thickness,
                     double jitter, uint64_t seed, const Parameter& density, Parameter vent_radius,
                     Vec3 stretch, double weight, std::shared_ptr<const PlacedSeeds> placed)
    : Structure(neighbourhood, placed ? placed->largest() : max_component(neighbourhood.cell_size)),
      context_(std::move(context)),
      id_(context_->new_structure_id()),
      thickness_(std::move(thickness)),
      unit_(max_component(neighbourhood.cell_size)),
      seeds_(make_seeds(neighbourhood, unit_, jitter, seed, density, stretch, weight,
                        std::move(placed))),
      vents_(neighbourhood, unit_, std::move(vent_radius)),
      is_concurrent_(thickness_.is_concurrent() && density.is_concurrent() &&
                     vents_.radius().is_concurrent()) {}

FoamWalls::~FoamWalls() {
  context_->cache.drop(id_);
}

CellIndex FoamWalls::cell_of(Vec3 p) const {
  const PlacedSeeds* const placed = seeds_.placed();
  return placed ? placed->cell_of(neighbourhood().to_grid(p)) : Structure::cell_of(p);
}

void FoamWalls::for_each_grid(const TakeGrid& take) const {
  take(seeds_.placed() ? seeds_.placed()->smallest() : neighbourhood());
}

bool FoamWalls::inside(const Neighbourhood::Located& located, Vec3 p) const {
  const Vec3 q = located.fraction * seeds_.seeds().scale();
  const double thickness = thickness_.at(p) / unit_;
  return vents_.exist() ? is_in_vented_wall(seeds_, vents_, located.cell, q, thickness)
                        : is_in_wall(seeds_, located.cell, q, thickness);
}

bool FoamWalls::inside(Vec3 p) const {
  return inside(neighbourhood().locate(p), p);
}

NearFace FoamWalls::face_near(Vec3 p) const {
  const Neighbourhood::Located located = neighbourhood().locate(p);
  const Vec3 q = located.fraction * seeds_.seeds().scale();
  if (!vents_.exist()) return find_nearest_face(seeds_, located.cell, q);
  return find_nearest_vented_face(seeds_, vents_, located.cell, q,
                                  onset_limit() / unit_ * (1 + 1e-9));
}

double FoamWalls::onset(Vec3 p) const {
  return unit_ * face_near(p).onset;
}

double FoamWalls::slack(Vec3 p, double distance) const {
  // Where cells are cubes, differences of seeds are exact. Otherwise seeds are rounded by 2^-53,
  // and the normal of a face by that over their distance: room for seeds down to 1e-6 of a cell
  // from each other.
  const Vec3 scale = seeds_.seeds().scale();
  // With weights, lifts are rounded by 2^-53.
  double of_faces = scale == Vec3{1, 1, 1} && !seeds_.is_weighted() ? 0x1p-47 : 1e-9;
  if (seeds_.stretch()) of_faces = 1e-9 * seeds_.stretch()->max_factor();
  if (vents_.exist())
    of_faces += vent_error(std::max(min_vent_radius, vents_.radius().range().low / unit_));
  return of_faces * unit_ + locating_slack(p - neighbourhood().origin, distance);
}

// The distance to the nearest face changes by no more than a step, and half the thickness by no
// more than half its Lipschitz constant times that. In the void of a cell, the face's wall is as
// near as the face less half the thickness, as cells are convex.
double FoamWalls::distance_bound(Vec3 p) const {
  const Interval t = thickness_.range(Box3{p, p});
  if (vents_.exist()) {
    const Neighbourhood::Located located = neighbourhood().locate(p);
    const double bound = unit_ * vented_distance(seeds_, vents_, located.cell,
                                                 located.fraction * seeds_.seeds().scale(),
                                                 {t.low / unit_, t.high / unit_});
    return std::max(0.0, steady_distance(bound - slack(p, bound), 1, 0.5, thickness_, p));
  }
  const double distance = 0.5 * onset(p);
  const double gap = std::max(distance - 0.5 * t.high, 0.5 * t.low - distance) - slack(p, distance);
  return std::max(0.0, steady_distance(gap, 1, 0.5, thickness_, p));
}

void FoamWalls::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  // Cell by cell, since the point query keeps the seeds about the last point's cell.
  size_t queried = 0;
  for (const LocatedPoint& point : group_by_cell(neighbourhood(), points, alive, count)) {
    if (queried++ % 16 == 0) check_cancelled();
    if (!inside(point.located, points[point.index])) alive[point.index] = 0;
  }
}

void FoamWalls::keep_rows(const RowBlock& block, const Job* job) const {
  if (!keep_void_rows(*this, block, job)) Structure::keep_rows(block, job);
}

BoxClass FoamWalls::classify(const Box3& box) const {
  const Vec3 centre = (box.min + box.max) * 0.5;
  if (vents_.exist()) {
    // distance_bound() allows for its rounding; this does for that of the box's points.
    const double half = 0.5 * length(box.extent());
    const double around =
        half * (1 + 1e-9) + 2 * slack(centre, half) + 0x1p-50 * max_magnitude(centre);
    if (!(distance_bound(centre) > around)) return BoxClass::mixed;
    return inside(centre) ? BoxClass::inside : BoxClass::outside;
  }
  const double distance = 0.5 * onset(centre);
  const double half = 0.5 * length(box.extent());
  const double around = half * (1 + 1e-9) + 2 * slack(centre, distance + half) +
                        0x1p-50 * (max_magnitude(box.min) + max_magnitude(box.max));
  const Interval t = thickness_.range(box);
  if (distance - around > 0.5 * t.high) return BoxClass::outside;
  if (distance + around < 0.5 * t.low) return BoxClass::inside;
  return BoxClass::mixed;
}

bool FoamWalls::find(bool wanted, const Ray& ray, double from, double to, double& t,
                     const Job* job) const {
  const double tolerance = ray_tolerance(ray, to);
  const bool goes_by_void = wanted && vents_.exist() && tolerance <= 0x1p-23 * unit_;
  if (!goes_by_void) return march(wanted, ray, from, to, t, job);
  const double coarse = std::max(min_ray_step(), tolerance);
  return RayMarch{tolerance, tolerance}.find(
      true, ray, from, to, [this](Vec3 p) { return inside(p); },
      [&](Vec3 p) {
        const double way = way_in_void(p, ray.direction, tolerance);
        return steady_ray_step(way, coarse, thickness_, p);
      },
      t, job);
}

// Walls of the greatest thickness along the way hold those of the thickness there is. Where the
// thickness has no slope, shorter ways are tried, on which it varies less.
double FoamWalls::way_in_void(Vec3 p, Vec3 direction, double tolerance) const {
  constexpr double rounding = 1e-12;
  const Ray ray{p, direction};
  const Neighbourhood::Located located = neighbourhood().locate(p);
  const double here = thickness_.range({p, p}).high;
  double ahead =
      0.5 * unit_ * seeds_.spacing(located.cell, located.fraction * seeds_.seeds().scale());
  for (int tries = 4;; ahead *= 0.125) {
    const Box3 box = box_of(ray, 0, ahead);
    const double slope = thickness_.lipschitz(box);
    const bool has_slope = slope < std::numeric_limits<double>::infinity();
    // Far ahead, steep walls would hold all cells around.
    if (has_slope && slope > 1) ahead /= slope;
    const double thickness = (has_slope ? here : thickness_.range(box).high) / unit_;
    const VentRay vent{seeds_,
                       vents_,
                       neighbourhood(),
                       unit_,
                       thickness * (1 + rounding) + rounding,
                       has_slope ? slope * (1 + rounding) / unit_ : 0};
    double met = ahead;
    vent.find(ray, 0, ahead, met);
    if (met > tolerance || has_slope || --tries == 0) return std::max(0.0, met - tolerance);
  }
}

double FoamWalls::leave(const Ray& ray, double from, double to, const Job* job) const {
  double t;
  return find(false, ray, from, to, t, job) ? t : to;
}

void FoamWalls::enter(RaySearch* searches, size_t count, const Job* job) const {
  JobPoll poll(job);
  for (size_t i = 0; i < count; ++i) {
    poll();
    enter(searches[i], job);
  }
}

void FoamWalls::enter(RaySearch& search, const Job* job) const {
  const Ray& ray = search.ray;
  const double tolerance = ray_tolerance(ray, search.to);
  // Where coordinates are so large that rounding is, membership alone knows.
  if (!thickness_.is_constant() || !(tolerance <= 0x1p-23 * unit_)) {
    search.found = find(true, ray, search.from, search.to, search.t, job);
    return;
  }
  const auto is_inside = [this](Vec3 p) { return inside(p); };
  search.found = false;
  if (inside(ray.at(search.from))) {
    search.found = true;
    search.t = search.from;
    return;
  }
  if (vents_.exist()) return enter_vented(search, job);
  const WallRay wall{seeds_, neighbourhood(), unit_, thickness_.at({}) / unit_};
  double from = search.from;
  // A ray that all but slides along a wall may come out of rounding's reach only after some tries.
  for (int attempt = 0; attempt < 16; ++attempt) {
    double t = from;
    const WallRay::Way way = wall.find(ray, from, search.to, tolerance, t);
    if (way == WallRay::Way::passes) return;
    if (way == WallRay::Way::unknown) break;
    if (settle_entry(ray, search.from, search.to, tolerance, is_inside, t)) {
      search.found = true;
      search.t = t;
      return;
    }
    from = t + tolerance;
    if (from >= search.to) return;
  }
  RaySearch rest = search;
  rest.from = from;
  Structure::enter(&rest, 1, job);
  search.found = rest.found;
  search.t = rest.t;
}

void FoamWalls::enter_vented(RaySearch& search, const Job* job) const {
  const Ray& ray = search.ray;
  const double tolerance = ray_tolerance(ray, search.to), thickness = thickness_.at({}) / unit_;
  const auto is_inside = [this](Vec3 p) { return inside(p); };
  const WallRay wall{seeds_, neighbourhood(), unit_, thickness};
  const VentRay vent{seeds_, vents_, neighbourhood(), unit_, thickness, 0};
  JobPoll poll(job);
  double from = search.from;
  int attempts = 0;
  do {
    poll();
    const Neighbourhood::Located located = neighbourhood().locate(ray.at(from));
    const Vec3 q = located.fraction * seeds_.seeds().scale();
    double t = from;
    if (!is_in_wall(seeds_, located.cell, q, thickness)) {
      const WallRay::Way way = wall.find(ray, from, search.to, tolerance, t);
      if (way == WallRay::Way::passes) return;
      // The void up to there is that of a cell.
      t = way == WallRay::Way::meets ? std::max(from, t - tolerance) : from;
    }
    // Slabs and holes are crossed a piece of the ray at a time: of longer ones, more seeds are
    // near.
    const double piece =
        unit_ * std::max(thickness, 0.25 * std::min(1.0, seeds_.spacing(located.cell, q)));
    const double end = std::min(search.to, t + piece);
    double met;
    from = end;
    if (!vent.find(ray, t, end, met)) continue;
    const double first = std::max(search.from, t);
    if (settle_entry(ray, first, search.to, tolerance, is_inside, met)) {
      search.found = true;
      search.t = met;
      return;
    }
    from = met + tolerance;
    // A ray that all but slides along a wall may come out of rounding's reach only after some
    // tries.
    if (++attempts % 16 != 0) continue;
    RaySearch rest = search;
    rest.from = met;
    rest.to = end;
    Structure::enter(&rest, 1, job);
    if (rest.found) {
      search.found = true;
      search.t = rest.t;
      return;
    }
    from = end;
  } while (from < search.to);
}

Vec3 FoamWalls::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  const NearFace face = face_near(p);
  const Vec3 across = seeds_.normal(face.across);
  const double apart = length(across);
  // In a hole of the nearest wall, the ray may meet the hole's side.
  const bool is_plane = !vents_.exist() || std::abs(face.onset - thickness_.at(p) / unit_) <= 1e-6;
  if (face.onset > 0 && apart > 0 && is_plane) {
    // Against the direction in which the onset less the thickness falls.
    const Vec3 outward = neighbourhood().rotation.apply(across) * (-2 / apart) -
                         thickness_.gradient(p, normal_distance());
    const double size = length(outward);
    if (size > 0.5 && dot(outward, ray.direction) <= 0) return outward * (1 / size);
  }
  return Structure::normal(ray, t);
}

LineGraph FoamWalls::wall_lines(const WallSection& section) const {
  LineGraph graph = foam_section(
      {neighbourhood(), seeds_.seeds(), seeds_.graded(), unit_, seeds_.stretch()}, section);
  if (vents_.exist()) cut_vents(*this, section.z, graph);
  return graph;
}

void FoamWalls::describe(HashInput& input) const {
  input.kind("structure: foam of walls");
  neighbourhood().describe(input);
  seeds_.seeds().describe(input);
  // A density that is 1 everywhere changes nothing.
  input.integer(seeds_.graded() ? 1 : 0);
  if (seeds_.graded()) seeds_.graded()->describe(input);
  thickness_.describe(input);
  input.integer(vents_.exist() ? 1 : 0);
  if (vents_.exist()) vents_.radius().describe(input);
  if (!seeds_.stretch()) return;
  input.text("stretch");
  seeds_.stretch()->describe(input);
}

}  // namespace msq
