// SPDX-License-Identifier: Apache-2.0
// Beams of the contract suite.
#include <cmath>

#include "beam_lists.h"
#include "random.h"
#include "structures.h"

namespace msq::test {

namespace {

/// Ends in a cell, in cell units.
Vec3 random_end(Random& random, Vec3 cell) {
  return cell + random.in_box({{0, 0, 0}, {1, 1, 1}});
}

/// A beam of a cell. Its radii are for a radius of 1.
Beam random_beam(Random& random, Vec3 cell, BeamSort sort) {
  Beam beam{random_end(random, cell), {}, 1, 1, BeamCap::sphere, BeamCap::sphere};
  const uint64_t form = random.below(8);
  beam.b = random_end(random, cell + Vec3{double(random.below(2)), double(random.below(2)), 0});
  if (form == 0) {  // along an axis
    beam.b = beam.a;
    beam.b[static_cast<int>(random.below(3))] += random.between(-1, 1);
  }
  if (form == 1) beam.b = beam.a + (beam.b - beam.a) * 0.05;  // shorter than wide
  const auto any_cap = [&] { return static_cast<BeamCap>(random.below(3)); };
  switch (sort) {
    case BeamSort::capsules:
      break;
    case BeamSort::cones:
      beam.radius_b = random.between(0.2, 1);
      break;
    case BeamSort::half_balls:
      beam.cap_a = beam.cap_b = BeamCap::hemisphere;
      beam.radius_b = random.between(0.2, 1);
      break;
    case BeamSort::flat:
      beam.cap_a = beam.cap_b = BeamCap::butt;
      beam.radius_b = random.below(2) ? 1 : random.between(0.2, 1);
      break;
    case BeamSort::all:
      beam.cap_a = any_cap();
      beam.cap_b = any_cap();
      if (form == 2) beam.b = beam.a;                       // a ball, or nothing
      if (form == 3) beam.radius_b = 0;                     // a cone
      if (form == 4) beam.radius_a = beam.radius_b = 0.01;  // a needle
      if (form > 4) beam.radius_b = random.between(0.3, 1.2);
      break;
  }
  if (random.below(2)) std::swap(beam.a, beam.b);
  return beam;
}

}  // namespace

std::vector<Beam> random_beams(const Neighbourhood& grid, const Parameter& radius, BeamSort sort) {
  Random random(static_cast<uint64_t>(sort) + 1);
  std::vector<Beam> beams;
  for (const Vec3 middle : {Vec3{0, 0, 0}, Vec3{1001, -1000, 1000}, Vec3{-1000, 1000, 1002},
                            Vec3{1001, -999, 1001}, Vec3{-999, 1, 4}, Vec3{1001, 1, -999}}) {
    constexpr int reach = 2;
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          for (int n = 0; n < 4; ++n) {
            Beam beam = random_beam(random, middle + Vec3{double(i), double(j), double(k)}, sort);
            beam.a = grid.from_grid(beam.a * grid.cell_size);
            beam.b = grid.from_grid(beam.b * grid.cell_size);
            beam.radius_a *= radius.at(beam.a);
            beam.radius_b *= radius.at(beam.b);
            beams.push_back(beam);
          }
  }
  return beams;
}

Ref<const Beams> make_beams(const std::vector<Beam>& beams) {
  return Ref<const Beams>(Beams::make(source_of(beams), 0, shared_context()->executor,
                                      shared_context()->budget, nullptr));
}

}  // namespace msq::test
