// SPDX-License-Identifier: Apache-2.0
// Foams among the structures of structures.h. The parameter stands for the radius of the struts, or
// for the thickness of the walls.
#pragma once

#include <memory>

#include "lattice_structures.h"
#include "structure/common/cell_shell.h"
#include "structure/foam/seeds/period_seeds.h"
#include "structures.h"

namespace msq::test {

Factory graded_foam_factory(double jitter);

Factory stretched_factory(double jitter, Vec3 stretch);
Factory stretched_walls_factory(double jitter, Vec3 stretch);

/// weight: over the smallest cell size.
Factory weighted_factory(double jitter, double weight);
Factory weighted_walls_factory(double jitter, double weight);

/// Where a map places the seeds.
using Placed = std::shared_ptr<const PlacedSeeds> (*)(const Neighbourhood&, double jitter);
template <int axis>
std::shared_ptr<const PlacedSeeds> by_period(const Neighbourhood& grid, double jitter) {
  return std::make_shared<const PeriodSeeds>(grid, graded_period(grid, axis), jitter, uint64_t{7});
}
Factory placed_factory(double jitter, Placed place);
Factory placed_walls_factory(double jitter, Placed place, double vent_radius = 0);
/// Struts and walls.
Factory placed_both_factory(double jitter, Placed place);

/// Twelve cells around the grid's z axis, some of the shell's ends within reach; those sheared;
/// cells around its origin; or those of sampled_map().
enum class FoamWarp { cylinder, sheared, sphere, sampled };
std::shared_ptr<const PlacedSeeds> warped_seeds(const Neighbourhood& grid, double jitter,
                                                FoamWarp kind);
template <FoamWarp kind = FoamWarp::cylinder>
std::shared_ptr<const PlacedSeeds> by_warp(const Neighbourhood& grid, double jitter) {
  return warped_seeds(grid, jitter, kind);
}
std::shared_ptr<const CellShell> shell_of_foams(const Neighbourhood& grid, FoamWarp kind);
/// In that shell.
Factory shelled_factory(Factory foam, FoamWarp kind = FoamWarp::cylinder);

Factory walls_factory(double jitter, bool has_density = false);
/// Walls with holes of 0.2 of a cell, or in places less.
Factory vented_factory(double jitter, bool is_even = true, bool has_density = false);
/// It stands for the thickness of the walls and for the radius of the struts.
Factory walled_factory(double jitter);

}  // namespace msq::test
