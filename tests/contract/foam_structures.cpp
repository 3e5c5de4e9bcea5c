// SPDX-License-Identifier: Apache-2.0
#include "foam_structures.h"

#include <utility>

#include "field/gradient.h"
#include "structure/common/box_shell.h"
#include "structure/common/warp_shell.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/sampled_seeds.h"
#include "structure/foam/seeds/warp_seeds.h"
#include "structure/foam/shell/shelled_foam.h"
#include "structure/foam/walled_foam.h"

namespace msq::test {

Factory foam_factory(FoamMethod method, double jitter) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    return Ref<const Structure>(
        make_ref<Foam>(shared_context(), grid, std::move(radius), jitter, uint64_t{7}, method));
  };
}

Factory graded_foam_factory(double jitter) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    const Parameter density = rising_density(grid);
    return Ref<const Structure>(make_ref<Foam>(shared_context(), grid, std::move(radius), jitter,
                                               uint64_t{7}, FoamMethod::direct, density));
  };
}

Factory stretched_factory(double jitter, Vec3 stretch) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    return Ref<const Structure>(make_ref<Foam>(shared_context(), grid, std::move(radius), jitter,
                                               uint64_t{7}, FoamMethod::direct, Parameter(1),
                                               stretch));
  };
}

Factory stretched_walls_factory(double jitter, Vec3 stretch) {
  return [=](const Neighbourhood& grid, Parameter thickness) {
    return Ref<const Structure>(make_ref<FoamWalls>(shared_context(), grid, std::move(thickness),
                                                    jitter, uint64_t{7}, Parameter(1), Parameter(0),
                                                    stretch));
  };
}

Factory weighted_factory(double jitter, double weight) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    return Ref<const Structure>(make_ref<Foam>(
        shared_context(), grid, std::move(radius), jitter, uint64_t{7}, FoamMethod::direct,
        Parameter(1), Vec3{1, 1, 1}, weight * min_component(grid.cell_size)));
  };
}

Factory weighted_walls_factory(double jitter, double weight) {
  return [=](const Neighbourhood& grid, Parameter thickness) {
    return Ref<const Structure>(make_ref<FoamWalls>(
        shared_context(), grid, std::move(thickness), jitter, uint64_t{7}, Parameter(1),
        Parameter(0), Vec3{1, 1, 1}, weight * min_component(grid.cell_size)));
  };
}

Factory placed_factory(double jitter, Placed place) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    const std::shared_ptr<const PlacedSeeds> placed = place(grid, jitter);
    return Ref<const Structure>(make_ref<Foam>(shared_context(), placed->grid(), std::move(radius),
                                               jitter, uint64_t{7}, FoamMethod::direct,
                                               Parameter(1), Vec3{1, 1, 1}, 0.0, placed));
  };
}

Factory placed_walls_factory(double jitter, Placed place, double vent_radius) {
  return [=](const Neighbourhood& grid, Parameter thickness) {
    const std::shared_ptr<const PlacedSeeds> placed = place(grid, jitter);
    return Ref<const Structure>(make_ref<FoamWalls>(
        shared_context(), placed->grid(), std::move(thickness), jitter, uint64_t{7}, Parameter(1),
        Parameter(vent_radius * min_component(grid.cell_size)), Vec3{1, 1, 1}, 0.0, placed));
  };
}

Factory placed_both_factory(double jitter, Placed place) {
  return [=](const Neighbourhood& grid, const Parameter& size) {
    const auto struts = placed_factory(jitter, place)(grid, size),
               walls = placed_walls_factory(jitter, place)(grid, size);
    return Ref<const Structure>(
        make_ref<WalledFoam>(Ref<const Foam>(static_cast<const Foam*>(struts.get())),
                             Ref<const FoamWalls>(static_cast<const FoamWalls*>(walls.get()))));
  };
}

namespace {

Warp warp_of_foams(const Neighbourhood& grid, FoamWarp kind) {
  const double size = grid.cell_size.x, inner = 0.8 * size, outer = 2.6 * size;
  if (kind == FoamWarp::sphere) return {Warp::Kind::spherical, grid, {12, 6, inner, outer}};
  if (kind == FoamWarp::sheared)
    return {Warp::Kind::cylindrical, grid, {12, 0, inner, outer, -0.5, 1.25}};
  return {Warp::Kind::cylindrical, grid, {12, 0, inner, outer}};
}

}  // namespace

std::shared_ptr<const PlacedSeeds> warped_seeds(const Neighbourhood& grid, double jitter,
                                                FoamWarp kind) {
  constexpr uint64_t seed = 7;
  if (kind == FoamWarp::sampled)
    return std::make_shared<const SampledSeeds>(*shared_context(), sampled_map(grid), jitter, seed);
  return std::make_shared<const WarpSeeds>(shared_context(), warp_of_foams(grid, kind), jitter,
                                           seed);
}

std::shared_ptr<const CellShell> shell_of_foams(const Neighbourhood& grid, FoamWarp kind) {
  if (kind == FoamWarp::sampled) return std::make_shared<const BoxShell>(sampled_map(grid));
  return std::make_shared<const WarpShell>(warp_of_foams(grid, kind));
}

Factory shelled_factory(Factory foam, FoamWarp kind) {
  return [foam = std::move(foam), kind](const Neighbourhood& grid, Parameter size) {
    return Ref<const Structure>(
        make_ref<ShelledFoam>(foam(grid, std::move(size)), shell_of_foams(grid, kind)));
  };
}

Factory walls_factory(double jitter, bool has_density) {
  return [=](const Neighbourhood& grid, Parameter thickness) {
    const Parameter density = has_density ? rising_density(grid) : Parameter(1);
    return Ref<const Structure>(make_ref<FoamWalls>(shared_context(), grid, std::move(thickness),
                                                    jitter, uint64_t{7}, density));
  };
}

Factory vented_factory(double jitter, bool is_even, bool has_density) {
  return [=](const Neighbourhood& grid, Parameter thickness) {
    const Parameter density = has_density ? rising_density(grid) : Parameter(1);
    const double radius = (has_density ? 0.06 : 0.2) * min_component(grid.cell_size);
    const Vec3 reach = Vec3{2, 2, 2} * max_component(grid.cell_size);
    const Parameter radii = is_even ? Parameter(radius)
                                    : Parameter(Ref<const Field>(make_ref<GradientField>(
                                          grid.origin - reach, 0.0, grid.origin + reach, radius)));
    return Ref<const Structure>(make_ref<FoamWalls>(shared_context(), grid, std::move(thickness),
                                                    jitter, uint64_t{7}, density, radii));
  };
}

Factory walled_factory(double jitter) {
  return [=](const Neighbourhood& grid, Parameter size) {
    return Ref<const Structure>(make_ref<WalledFoam>(
        make_ref<Foam>(shared_context(), grid, size, jitter, uint64_t{7}, FoamMethod::direct),
        make_ref<FoamWalls>(shared_context(), grid, size, jitter, uint64_t{7})));
  };
}

}  // namespace msq::test
