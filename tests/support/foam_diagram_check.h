// SPDX-License-Identifier: Apache-2.0
// Foams, open and closed, against the edges and faces of a diagram that an oracle found.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "diagram_check.h"
#include "structure/foam/foam.h"
#include "structure/foam/seeds/placed_seeds.h"
#include "structure/foam/walls/foam_walls.h"

namespace msq::test {

/// A grid at the origin, or one that is turned about z and lies elsewhere.
inline Neighbourhood diagram_grid(Vec3 cell_size, bool is_turned) {
  if (!is_turned) return {{}, cell_size, {}};
  const double c = std::cos(0.7), s = std::sin(0.7);
  return {{0.25, -0.5, 0.125}, cell_size, {{c, -s, 0, s, c, 0, 0, 0, 1}}};
}

/// Whether an edge or a face comes near the box from -half to half.
template <class Part>
bool reaches_box(const Part& part, Vec3 half) {
  return box_of(part).overlaps(Box3{half * -1.0, half});
}

/// The seeds of a foam.
struct DiagramSeeds {
  std::string name;
  Neighbourhood grid;
  double jitter;
  uint64_t seed;
  Vec3 stretch{1, 1, 1};
  double weight = 0;
  std::shared_ptr<const PlacedSeeds> placed = nullptr;
};

/// Asks points of the box of `asked_half` cells on each side of the grid's origin. radii: of
/// struts. These and the thickness of walls are in smallest cell sizes.
inline void check_foam_diagram(const DiagramSeeds& seeds, const Diagram& diagram, double asked_half,
                               const std::array<double, 2>& radii, double thickness) {
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  const Neighbourhood& grid = seeds.grid;
  const double size =
      min_component((seeds.placed ? seeds.placed->smallest() : seeds.grid).cell_size);
  const size_t count = test_count(5500);
  const Vec3 half = grid.cell_size * asked_half;
  const double near = 3e-8 * max_component(grid.cell_size);
  for (const double part : radii) {
    const double radius = part * size;
    const Ref<const Structure> foam =
        make_ref<Foam>(context, grid, Parameter(radius), seeds.jitter, seeds.seed,
                       FoamMethod::direct, Parameter(1), seeds.stretch, seeds.weight, seeds.placed);
    check_diagram(seeds.name.c_str(), "edges", *foam,
                  ask(diagram.edges, grid, half, radius, count, seeds.seed), radius, 1, near);
  }
  const double reach = 0.5 * thickness * size;
  const Ref<const Structure> walls =
      make_ref<FoamWalls>(context, grid, Parameter(2 * reach), seeds.jitter, seeds.seed,
                          Parameter(1), Parameter(0), seeds.stretch, seeds.weight, seeds.placed);
  check_diagram(seeds.name.c_str(), "faces", *walls,
                ask(diagram.faces, grid, half, reach, count, seeds.seed), reach, 2, near);
}

}  // namespace msq::test
