// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/foam.h"
#include "api/definitions.h"
#include "api/guard.h"
#include "api/neighbourhood.h"
#include "api/period.h"
#include "api/strut_radius.h"
#include "api/warp.h"
#include "structure/common/make_shell.h"
#include "structure/foam/paper/delaunay.h"
#include "structure/foam/seeds/period_seeds.h"
#include "structure/foam/seeds/sampled_seeds.h"
#include "structure/foam/seeds/warp_seeds.h"
#include "structure/foam/shell/shelled_foam.h"
#include "structure/foam/walled_foam.h"

using namespace msq;
using namespace msq::api;

namespace {

msq_foam_def foam_defaults() {
  msq_foam_def def{};
  def.grid = neighbourhood_defaults();
  def.jitter = 1;
  def.density.value = 1;
  for (double& factor : def.stretch) factor = 1;
  return def;
}

bool is_none(const msq_param& param) {
  return !param.field && param.value == 0;
}

Parameter read_wall_thickness(const msq_param& thickness, const Neighbourhood& grid) {
  Parameter read;
  if (thickness.field) {
    read = Parameter(Ref<const Field>(&object(thickness.field, "wall_thickness.field")));
    const Interval range = read.range();
    if (!(range.low >= 0) || !(range.high > 0))
      fail(Status::argument,
           "the field of wall_thickness runs from %g to %g; it must not be negative, nor 0 "
           "everywhere",
           range.low, range.high);
  } else {
    if (!(thickness.value >= 0) || !std::isfinite(thickness.value))
      fail(Status::argument, "wall_thickness is %g; it must be finite and not negative",
           thickness.value);
    read = Parameter(thickness.value);
  }
  const double most = min_component(grid.cell_size);
  if (read.range().high > most)
    fail(Status::limit, "wall_thickness reaches %g; the limit is %g (the smallest cell size)",
         read.range().high, most);
  return read;
}

Parameter read_vent_radius(const msq_foam_def& def, const Neighbourhood& grid) {
  const msq_param& radius = def.vent_radius;
  Parameter read;
  if (radius.field) {
    read = Parameter(Ref<const Field>(&object(radius.field, "vent_radius.field")));
    const Interval range = read.range();
    if (!(range.low >= 0) || !(range.high > 0))
      fail(Status::argument,
           "the field of vent_radius runs from %g to %g; it must not be negative, nor 0 everywhere",
           range.low, range.high);
  } else {
    if (!(radius.value >= 0) || !std::isfinite(radius.value))
      fail(Status::argument, "vent_radius is %g; it must be finite and not negative", radius.value);
    read = Parameter(radius.value);
  }
  const double most = min_component(grid.cell_size);
  if (read.range().high > most)
    fail(Status::limit, "vent_radius reaches %g; the limit is %g (the smallest cell size)",
         read.range().high, most);
  if (!is_none(radius) && is_none(def.wall_thickness))
    fail(Status::argument, "vent_radius reaches %g; without wall_thickness it must be 0",
         read.range().high);
  return read;
}

Parameter read_density(const msq_param& density) {
  Parameter read;
  if (density.field) {
    read = Parameter(Ref<const Field>(&object(density.field, "density.field")));
    const Interval range = read.range();
    if (!(range.low >= 0))
      fail(Status::argument, "the field of density runs from %g to %g; it must not be negative",
           range.low, range.high);
  } else {
    if (!(density.value >= 0) || !std::isfinite(density.value))
      fail(Status::argument, "density is %g; it must be finite and not negative", density.value);
    read = Parameter(density.value);
  }
  if (!(read.range().high <= GradedSeeds::max_density))
    fail(Status::limit, "density reaches %g; the limit is %g seeds in the volume of a cell",
         read.range().high, GradedSeeds::max_density);
  return read;
}

Vec3 read_stretch(const msq_foam_def& def, const Neighbourhood& grid) {
  constexpr double most = Stretch::max_ratio, least = 1 / most;
  Vec3 stretch;
  for (int axis = 0; axis < 3; ++axis) {
    const double factor = def.stretch[axis];
    if (!(factor > 0) || !std::isfinite(factor))
      fail(Status::argument, "stretch[%d] is %g; it must be finite and above 0", axis, factor);
    if (factor < least || factor > most)
      fail(Status::limit, "stretch[%d] is %g; the limits are %g and %g", axis, factor, least, most);
    stretch[axis] = factor;
  }
  if (!Stretch::is_any(stretch)) return {1, 1, 1};
  const Vec3 sides = Stretch::sides(grid, stretch);
  const double ratio = max_component(sides) / min_component(sides);
  // A ratio of the limit may be rounded up.
  if (ratio > Stretch::max_ratio * (1 + 1e-12))
    fail(Status::limit,
         "with stretch (%g, %g, %g), cell sizes over stretch differ by %g times; the limit is %g",
         stretch.x, stretch.y, stretch.z, ratio, Stretch::max_ratio);
  return stretch;
}

/// What a stretched foam cannot be yet.
void refuse_stretched(const msq_foam_def& def, Vec3 stretch, FoamMethod method, double density,
                      double vent_radius) {
  if (!Stretch::is_any(stretch)) return;
  if (method != FoamMethod::automatic && method != FoamMethod::direct)
    fail(Status::unsupported,
         "stretch is (%g, %g, %g) and method %d; with a stretch, the method of a foam must be "
         "MSQ_FOAM_AUTO or MSQ_FOAM_DIRECT",
         stretch.x, stretch.y, stretch.z, static_cast<int>(def.method));
  if (density > 1)
    fail(Status::unsupported,
         "stretch is (%g, %g, %g) and density reaches %g; with a stretch, density must not exceed "
         "1",
         stretch.x, stretch.y, stretch.z, density);
  if (!is_none(def.vent_radius))
    fail(
        Status::unsupported,
        "stretch is (%g, %g, %g) and vent_radius reaches %g; with a stretch, vent_radius must be 0",
        stretch.x, stretch.y, stretch.z, vent_radius);
}

double read_weight(const msq_foam_def& def, const Neighbourhood& grid) {
  if (!(def.weight >= 0) || !std::isfinite(def.weight))
    fail(Status::argument, "weight is %g; it must be finite and not negative", def.weight);
  const double most = min_component(grid.cell_size);
  if (def.weight > most)
    fail(Status::limit, "weight is %g; the limit is %g (the smallest cell size)", def.weight, most);
  return def.weight;
}

/// What a weighted foam cannot be yet.
void refuse_weighted(const msq_foam_def& def, double weight, FoamMethod method, Vec3 stretch,
                     double density, double vent_radius) {
  if (!(weight > 0)) return;
  if (method != FoamMethod::automatic && method != FoamMethod::direct)
    fail(Status::unsupported,
         "weight is %g and method %d; with a weight, the method of a foam must be MSQ_FOAM_AUTO or "
         "MSQ_FOAM_DIRECT",
         weight, static_cast<int>(def.method));
  if (Stretch::is_any(stretch))
    fail(Status::unsupported,
         "weight is %g and stretch (%g, %g, %g); with a weight, the three numbers of stretch must "
         "be equal",
         weight, stretch.x, stretch.y, stretch.z);
  if (density > 1)
    fail(Status::unsupported,
         "weight is %g and density reaches %g; with a weight, density must not exceed 1", weight,
         density);
  if (!is_none(def.vent_radius))
    fail(Status::unsupported,
         "weight is %g and vent_radius reaches %g; with a weight, vent_radius must be 0", weight,
         vent_radius);
}

std::optional<GradedPeriod> read_foam_period(msq_foam_def& def, msq_period_def& known) {
  std::optional<GradedPeriod> period = read_period(def.period, known);
  if (period && period->largest() > PeriodSeeds::max_ratio * period->smallest() * (1 + 1e-12))
    fail(Status::limit,
         "period.cell_sizes run from %g to %g; in a foam, the largest may be %g times the smallest",
         period->smallest(), period->largest(), PeriodSeeds::max_ratio);
  return period;
}

CellMap read_foam_map(msq_foam_def& def, msq_warp_def& known, const Neighbourhood& grid) {
  CellMap map = read_warp(def.warp, known, grid);
  if (map && def.period)
    fail(Status::unsupported, "a period and a warp are given; a foam takes one of them");
  return map;
}

/// What a foam with a period or a warp cannot be yet. `given`: the name of that.
void refuse_placed(const char* given, const msq_foam_def& def, FoamMethod method, Vec3 stretch,
                   double weight, double density) {
  if (method != FoamMethod::automatic && method != FoamMethod::direct)
    fail(Status::unsupported,
         "a %s is given and method %d; with a %s, the method of a foam must be MSQ_FOAM_AUTO or "
         "MSQ_FOAM_DIRECT",
         given, static_cast<int>(def.method), given);
  if (Stretch::is_any(stretch))
    fail(Status::unsupported,
         "a %s is given and stretch (%g, %g, %g); with a %s, the three numbers of stretch must be "
         "equal",
         given, stretch.x, stretch.y, stretch.z, given);
  if (weight > 0)
    fail(Status::unsupported, "a %s is given and weight %g; with a %s, weight must be 0", given,
         weight, given);
  if (density > 1)
    fail(Status::unsupported,
         "a %s is given and density reaches %g; with a %s, density must not exceed 1", given,
         density, given);
}

}  // namespace

msq_status msq_foam_def_init(msq_foam_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, foam_defaults(), "msq_foam_def"); });
}

msq_status msq_structure_foam(msq_context* context, const msq_foam_def* def,
                              msq_structure** structure) {
  return guard([&] {
    Context& owner = object(context, "context");
    require(structure, "structure");
    msq_foam_def known = read_def(def, foam_defaults(), "def");
    Neighbourhood grid = read_neighbourhood(known.grid);
    msq_period_def known_period;
    msq_warp_def known_warp;
    const CellMap map = read_foam_map(known, known_warp, grid);
    const std::optional<GradedPeriod> period = read_foam_period(known, known_period);
    if (!(known.jitter >= 0 && known.jitter <= 1))
      fail(Status::argument, "jitter is %g; it must be from 0 to 1", known.jitter);
    std::shared_ptr<const PlacedSeeds> placed;
    if (map.round) {
      placed = std::make_shared<const WarpSeeds>(Ref<Context>(&owner), *map.round, known.jitter,
                                                 known.seed);
      grid = placed->grid();
    }
    if (map.sampled) grid = map.sampled->smallest();
    if (period) grid = period->resized(grid, period->largest());
    const double ratio = max_component(grid.cell_size) / min_component(grid.cell_size);
    if (ratio > 4)
      fail(Status::limit, "cell sizes of a foam differ by %g times; the limit is 4", ratio);
    const FoamMethod method = static_cast<FoamMethod>(
        require_range(known.method, MSQ_FOAM_AUTO, MSQ_FOAM_METHOD_1, "method"));
    if (method == FoamMethod::method_2 && !can_triangulate())
      fail(Status::unsupported, "MSQ_FOAM_METHOD_2 is not in this build (MSQ_WITH_CGAL is off)");
    const Parameter density = read_density(known.density);
    if (density.range().high > 1 && method != FoamMethod::automatic && method != FoamMethod::direct)
      fail(Status::unsupported,
           "density reaches %g; above 1, the method of a foam must be MSQ_FOAM_AUTO or "
           "MSQ_FOAM_DIRECT",
           density.range().high);
    const Vec3 stretch = read_stretch(known, grid);
    const Neighbourhood smallest = map.round ? placed->smallest()
                                   : period  ? period->resized(grid, period->smallest())
                                             : grid;
    const Parameter thickness = read_wall_thickness(known.wall_thickness, smallest);
    const bool has_walls = !is_none(known.wall_thickness);
    if (has_walls && method != FoamMethod::automatic && method != FoamMethod::direct)
      fail(Status::unsupported,
           "wall_thickness reaches %g; with walls, the method of a foam must be MSQ_FOAM_AUTO or "
           "MSQ_FOAM_DIRECT",
           thickness.range().high);
    const bool has_struts = !has_walls || !is_none(known.radius);
    const Parameter radius = has_struts ? read_radius(known.radius, smallest, 1) : Parameter(0);
    const Parameter vent_radius = read_vent_radius(known, smallest);
    refuse_stretched(known, stretch, method, density.range().high, vent_radius.range().high);
    const double weight = read_weight(known, smallest);
    refuse_weighted(known, weight, method, stretch, density.range().high, vent_radius.range().high);
    if (map) refuse_placed("warp", known, method, stretch, weight, density.range().high);
    if (period) {
      refuse_placed("period", known, method, stretch, weight, density.range().high);
      placed = std::make_shared<const PeriodSeeds>(grid, *period, known.jitter, known.seed);
      grid = placed->grid();
    }
    // All seeds are found: after what is refused.
    if (map.sampled) {
      placed = std::make_shared<const SampledSeeds>(owner, map.sampled, known.jitter, known.seed);
      grid = placed->grid();
    }
    const auto make_walls = [&] {
      return make_ref<FoamWalls>(Ref<Context>(&owner), grid, thickness, known.jitter, known.seed,
                                 density, vent_radius, stretch, weight, placed);
    };
    const auto finish = [&](Ref<Structure> foam) {
      const Ref<Structure> made =
          map ? Ref<Structure>(make_ref<ShelledFoam>(foam, make_shell(map.round, map.sampled)))
              : std::move(foam);
      keep(*made, known);
      *structure = new_handle<msq_structure>(made);
    };
    if (!has_struts) return finish(make_walls());
    Ref<Foam> struts = make_ref<Foam>(Ref<Context>(&owner), grid, radius, known.jitter, known.seed,
                                      method, density, stretch, weight, placed);
    finish(has_walls ? Ref<Structure>(make_ref<WalledFoam>(std::move(struts), make_walls()))
                     : Ref<Structure>(std::move(struts)));
  });
}

void msq_structure_retain(msq_structure* structure) {
  retain(structure);
}
void msq_structure_release(msq_structure* structure) {
  release(structure);
}
