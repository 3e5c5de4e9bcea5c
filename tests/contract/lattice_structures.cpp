// SPDX-License-Identifier: Apache-2.0
#include "lattice_structures.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "field/gradient.h"
#include "sampled_maps.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/mixed/mixed_lattice.h"
#include "structure/lattice/plated_lattice.h"
#include "structure/lattice/plates/plate_lattice.h"
#include "structure/lattice/warped/graded_places.h"
#include "structure/lattice/warped/round_places.h"
#include "structure/lattice/warped/sampled_places.h"
#include "structure/lattice/warped/warped_lattice.h"

namespace msq::test {

GradedPeriod graded_period(const Neighbourhood& grid, int axis) {
  const double size = grid.cell_size[axis];
  std::vector<GradedPeriod::Knot> knots = {
      {-1.7, 1}, {-0.45, 1.5}, {0.3, 0.5}, {0.4, 0.7}, {1.9, 1.2}};
  for (auto& knot : knots) knot = {knot.position * size, knot.cell_size * size};
  return GradedPeriod(axis, knots);
}

Factory lattice_factory(UnitCell cell) {
  return [cell](const Neighbourhood& grid, Parameter radius) {
    return Ref<const Structure>(make_ref<Lattice>(grid, cell, std::move(radius)));
  };
}

Factory graded_lattice_factory(UnitCell cell, int axis) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    return Ref<const Structure>(make_ref<WarpedLattice>(
        shared_context(), std::make_unique<const GradedPlaces>(grid, graded_period(grid, axis)),
        cell, std::move(radius)));
  };
}

UnitCell skew_unit_cell() {
  UnitCell cell;
  cell.nodes = {{0, 0.25, 0.75},   {1, 0.5, 0.125}, {0.3, 0, 1},     {0.7, 1, 0},  {0, 0, 0},
                {0.6, 0.45, 0.55}, {1, 1, 0.4},     {0.2, 0.3, 0.1}, {0.9, 0.8, 1}};
  cell.struts = {{0, 1}, {2, 3}, {4, 5}, {5, 6}, {7, 8}, {0, 5}};
  return cell;
}

UnitCell factored_unit_cell() {
  UnitCell cell = skew_unit_cell();
  cell.factors = {1, 0.5, 1.75, 1, 0.25, 1.5};
  return cell;
}

Factory round_lattice_factory(UnitCell cell, Warp::Kind kind, Vec3 centre, Warp::Shell shell) {
  return [=](Neighbourhood grid, Parameter radius) {
    const double size = max_component(grid.cell_size);
    grid.origin = grid.from_grid(centre * size);
    Warp::Shell sized = shell;
    sized.inner *= size;
    sized.outer *= size;
    return Ref<const Structure>(make_ref<WarpedLattice>(
        shared_context(), std::make_unique<const RoundPlaces>(Warp(kind, grid, sized)), cell,
        std::move(radius)));
  };
}

std::shared_ptr<const SampledMap> sampled_map(const Neighbourhood& grid) {
  constexpr uint64_t nx = 12, ny = 9, nz = 10;
  const Vec3 spacing = Vec3{0.31, 0.4, 0.37} * grid.cell_size;
  const Vec3 corner = Vec3{-1.9, -1.7, -1.6} * grid.cell_size;
  std::vector<double> values[3];
  for (uint64_t i = 0; i < nx * ny * nz; ++i) {
    const Vec3 p{-1.9 + 0.31 * static_cast<double>(i % nx),
                 -1.7 + 0.4 * static_cast<double>(i / nx % ny),
                 -1.6 + 0.37 * static_cast<double>(i / nx / ny)};
    values[0].push_back(p.x + 0.3 * p.y + 0.1 * std::sin(1.5 * p.z));
    values[1].push_back(1.1 * p.y + 0.12 * std::sin(1.3 * p.x) + 0.03 * p.x * p.z);
    values[2].push_back(0.9 * p.z - 0.1 * p.x + 0.04 * p.y * p.y);
  }
  const ImageFrame frame{grid.from_grid(corner), spacing, grid.rotation};
  return make_map(frame, {nx, ny, nz}, values);
}

Factory sampled_lattice_factory(UnitCell cell) {
  return [=](const Neighbourhood& grid, Parameter radius) {
    auto places = std::make_unique<const SampledPlaces>(sampled_map(grid), cell,
                                                        std::make_shared<MemoryBudget>(0));
    return Ref<const Structure>(
        make_ref<WarpedLattice>(shared_context(), std::move(places), cell, std::move(radius)));
  };
}

Factory plates_factory(PlateCell cell) {
  return [cell](const Neighbourhood& grid, Parameter thickness) {
    return Ref<const Structure>(make_ref<PlateLattice>(grid, cell, std::move(thickness)));
  };
}

PlateCell skew_plate_cell() {
  PlateCell cell;
  cell.nodes = skew_unit_cell().nodes;
  cell.faces = {{0, 1, 5}, {2, 3, 4}, {5, 7, 8}, {0, 2, 6}, {4, 7, 5}};
  return cell;
}

PlateCell factored_plate_cell() {
  PlateCell cell = skew_plate_cell();
  cell.factors = {1, 0.5, 1.75, 0.25, 1.5};
  return cell;
}

Factory plated_factory(UnitCell struts, PlateCell plates) {
  return [=](const Neighbourhood& grid, const Parameter& size) {
    return Ref<const Structure>(make_ref<PlatedLattice>(
        make_ref<Lattice>(grid, struts, size), make_ref<PlateLattice>(grid, plates, size)));
  };
}

Factory mixed_factory() {
  return [](const Neighbourhood& grid, Parameter radius) {
    const Vec3 half = Vec3{1.5, 1.1, 0.8} * grid.cell_size;
    const Parameter choice(Ref<const Field>(
        make_ref<GradientField>(grid.from_grid(half * -1.0), -1.0, grid.from_grid(half), 4.0)));
    return Ref<const Structure>(
        make_ref<MixedLattice>(grid,
                               std::vector<UnitCell>{cubic_unit_cell(), factored_unit_cell(),
                                                     octet_unit_cell(), kelvin_unit_cell()},
                               choice, std::move(radius)));
  };
}

}  // namespace msq::test
