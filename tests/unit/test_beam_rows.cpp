// SPDX-License-Identifier: Apache-2.0
// Rows of samples through beams are what the definition says, bit for bit: beams of all forms and
// sizes, from less than a sample to thousands of them, along the rows and across, far from the
// origin, with samples on their very boundaries; and on every instruction set.
#include <hwy/highway.h>

#include "beam_lists.h"
#include "bit_rows.h"
#include "msq_test.h"
#include "random.h"
#include "structure/beams/beam_rows.h"

using namespace msq;
using namespace msq::test;

namespace {

Ref<Beams> make(const std::vector<Beam>& beams) {
  const Executor executor(1);
  return Beams::make(source_of(beams), 0, executor, std::make_shared<MemoryBudget>(uint64_t{0}),
                     nullptr);
}

/// Compares rows with the definition; returns how many samples are inside.
size_t check(const char* name, const std::vector<Beam>& beams, const SampleGrid& grid) {
  const Ref<Beams> made = make(beams);
  BitRows rows(grid);
  const RowBlock& block = rows.block();
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j) set_bits(block.row(j, k), 0, grid.nx - 1);
  BeamRows drawn(*made, block, nullptr);  // whether it pays or not
  drawn.find();
  drawn.keep();
  assert_int_equal(rows.damage(), 0);
  size_t held = 0;
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const Vec3 p = grid.at(i, j, k);
        bool expected = false;
        for (const Beam& beam : beams) expected = expected || beam.holds(p);
        held += expected;
        if (rows.get(i, j, k) == expected) continue;
        const Beam& b = beams[0];
        fail_msg(
            "%s: (%.17g, %.17g, %.17g) is %d; first beam (%.17g, %.17g, %.17g) to (%.17g, %.17g, "
            "%.17g), radii %.17g %.17g, caps %d %d",
            name, p.x, p.y, p.z, expected, b.a.x, b.a.y, b.a.z, b.b.x, b.b.y, b.b.z, b.radius_a,
            b.radius_b, static_cast<int>(b.cap_a), static_cast<int>(b.cap_b));
      }
  return held;
}

Beam any_beam(Random& random, double size) {
  Vec3 along = random.direction();
  switch (random.below(6)) {
    case 0:  // along an axis
      along = {};
      along[static_cast<int>(random.below(3))] = random.below(2) ? 1 : -1;
      break;
    case 1: {  // nearly
      Vec3 axis;
      axis[static_cast<int>(random.below(3))] = 1;
      along = axis + along * std::exp2(-random.between(1, 60));
      break;
    }
    case 2:  // in a plane of two
      along[static_cast<int>(random.below(3))] = 0;
      break;
    default:
      break;
  }
  const double steep = random.below(4) ? 1 : std::exp2(random.between(-8, 8));
  const Vec3 a = random.in_box({{-1, -1, -1}, {1, 1, 1}}) * size;
  Beam beam{a,
            a + along * (size * random.between(0.05, 1) / steep),
            0,
            0,
            BeamCap::sphere,
            BeamCap::sphere};
  const double thick = size * std::exp2(-random.between(1, random.below(5) ? 4 : 24));
  beam.radius_a = thick;
  beam.radius_b = random.below(3) ? thick * random.unit() : thick;
  if (random.below(8) == 0) beam.radius_b = 0;
  beam.cap_a = static_cast<BeamCap>(random.below(3));
  beam.cap_b = static_cast<BeamCap>(random.below(3));
  if (random.below(16) == 0) beam.b = beam.a;
  if (random.below(2)) std::swap(beam.radius_a, beam.radius_b);
  return beam;
}

void any_beam_in_any_grid(void**) {
  Random random(1);
  size_t held = 0, total = 0;
  for (size_t n = test_count(6000); n > 0; --n) {
    // In units of a pitch; few samples of small beams, rows through large ones.
    const double size = std::exp2(random.between(-2, 11));
    std::vector<Beam> beams;
    for (size_t i = 0; i < 1 + random.below(6); ++i) {
      const Beam beam = any_beam(random, size);
      if (beam.is_solid()) beams.push_back(beam);
    }
    if (beams.empty()) continue;
    const double unit = std::exp2(random.between(-40, 40));
    const double far = random.below(3) ? 0 : std::exp2(random.between(0, 24));
    const Vec3 shift = random.direction() * (far * size * unit);
    for (Beam& beam : beams) {
      beam.a = beam.a * unit + shift;
      beam.b = beam.b * unit + shift;
      beam.radius_a *= unit;
      beam.radius_b *= unit;
    }
    SampleGrid grid;
    grid.spacing =
        Vec3{random.between(0.5, 2), random.between(0.5, 2), random.between(0.5, 2)} * unit;
    grid.nx = 65 + random.below(130);
    grid.ny = 2 + random.below(18);
    grid.nz = 2 + random.below(18);
    const Beam& about = beams[random.below(beams.size())];
    const Vec3 middle = about.a + (about.b - about.a) * random.between(-0.1, 1.1);
    grid.origin = middle - grid.spacing * Vec3{0.5 * double(grid.nx), 0.5 * double(grid.ny),
                                               0.5 * double(grid.nz)};
    std::vector<double> heights;
    if (random.below(4) == 0) {
      for (uint64_t k = 0; k < grid.nz; ++k) heights.push_back(grid.z(k));
      grid.heights = heights.data();
    }
    held += check("any", beams, grid);
    total += grid.nx * grid.ny * grid.nz;
  }
  assert_in_range(held, total / 50, total);
}

/// Beams between whole numbers, with radii that put samples on their boundaries.
void samples_on_boundaries(void**) {
  Random random(2);
  for (size_t n = test_count(3000); n > 0; --n) {
    std::vector<Beam> beams;
    const auto whole = [&](uint64_t most) { return static_cast<double>(random.below(most)); };
    for (int i = 0; i < 4; ++i) {
      Beam beam{{whole(40), whole(12), whole(12)},
                {whole(40), whole(12), whole(12)},
                1 + whole(4),
                whole(5),
                static_cast<BeamCap>(random.below(3)),
                static_cast<BeamCap>(random.below(3))};
      const uint64_t form = random.below(4);
      if (form == 0) beam.b = beam.a + Vec3{whole(20), 0, 0};
      if (form == 1) beam.b = beam.a + Vec3{0, whole(8), 0};
      if (form == 2) beam.b = beam.a + Vec3{3, 4, 0} * (1 + whole(2));  // of a whole length
      if (random.below(2)) beam.radius_b = beam.radius_a;
      if (beam.is_solid()) beams.push_back(beam);
    }
    if (beams.empty()) continue;
    SampleGrid grid;
    grid.origin = {-4, -4, -4};
    const double pitch = random.below(2) ? 1 : 0.5;
    grid.spacing = {pitch, pitch, pitch};
    grid.nx = 70;
    grid.ny = 20;
    grid.nz = 20;
    check("on boundaries", beams, grid);
  }
}

/// One row or layer of any step, of which only one sample matters.
void steps_far_beyond_beams(void**) {
  Random random(3);
  for (size_t n = test_count(500); n > 0; --n)
    for (const double far : {1e3, 1e10, 1e40, 1e200}) {
      std::vector<Beam> beams;
      for (int i = 0; i < 5; ++i) beams.push_back(any_beam(random, 10));
      std::erase_if(beams, [](const Beam& beam) { return !beam.is_solid(); });
      if (beams.empty()) continue;
      SampleGrid grid;
      grid.origin = random.in_box({{-5, -5, -5}, {5, 5, 5}});
      grid.spacing = {0.1, 0.1, 0.1};
      grid.nx = 40;
      grid.ny = grid.nz = 10;
      const int axis = static_cast<int>(random.below(3));
      grid.spacing[axis] = far;
      (axis == 0 ? grid.nx : axis == 1 ? grid.ny : grid.nz) = 3;
      char name[32];
      std::snprintf(name, sizeof name, "steps of %g", far);
      check(name, beams, grid);
    }
}

/// Discs that are about as thick as positions are rounded, and as thin as a few samples.
void discs_of_the_size_of_rounding(void**) {
  Random random(5);
  for (size_t n = test_count(1500); n > 0; --n) {
    const Vec3 far = random.direction() * std::exp2(random.between(0, 30));
    const double most = 0x1p-43 * max_magnitude(far);
    std::vector<Beam> beams;
    for (int i = 0; i < 4; ++i) {
      Beam beam = any_beam(random, 4);
      const Vec3 along = beam.b - beam.a;
      if (!beam.has_length()) continue;
      beam.a = beam.a + far;
      beam.b = beam.a + along * (most * std::exp2(random.between(-12, 1)) / length(along));
      if (random.below(2)) beam.radius_a = beam.radius_b = 1 + random.unit();
      if (random.below(2)) beam.cap_a = beam.cap_b = BeamCap::butt;
      if (beam.is_solid()) beams.push_back(beam);
    }
    if (beams.empty()) continue;
    SampleGrid grid;
    grid.nx = 40;
    grid.ny = grid.nz = 9;
    const double pitch = most * std::exp2(random.between(-6, 2));
    grid.spacing = {pitch, pitch, pitch};
    if (random.below(2)) grid.spacing[static_cast<int>(random.below(3))] = 0.125;
    grid.origin = beams[0].a - grid.spacing * Vec3{20, 4, 4};
    check("discs", beams, grid);
  }
}

void every_instruction_set_is_right(void**) {
  Random random(4);
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    for (size_t n = test_count(300); n > 0; --n) {
      std::vector<Beam> beams;
      for (int i = 0; i < 200; ++i) beams.push_back(any_beam(random, 12));
      std::erase_if(beams, [](const Beam& beam) { return !beam.is_solid(); });
      SampleGrid grid;
      grid.origin = {-16, -16, -16};
      grid.nx = 66;
      grid.ny = grid.nz = 8;
      grid.spacing = {0.5, 4, 4};
      check(hwy::TargetName(all & -all), beams, grid);
    }
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(any_beam_in_any_grid),
      cmocka_unit_test(samples_on_boundaries),
      cmocka_unit_test(steps_far_beyond_beams),
      cmocka_unit_test(discs_of_the_size_of_rounding),
      cmocka_unit_test(every_instruction_set_is_right),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
