// SPDX-License-Identifier: Apache-2.0
// Rows of lattices whose radius is linear along them, with few and with many samples in a cell:
// each sample is as the definition says.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "bit_rows.h"
#include "field/gradient.h"
#include "msq_test.h"
#include "random.h"
#include "structure/lattice/lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Onto axes, each of them in either direction.
Rotation turn_of(Random& random) {
  std::array<size_t, 3> axes{0, 1, 2};
  for (size_t i = 2; i > 0; --i) std::swap(axes[i], axes[random.below(i + 1)]);
  const bool is_odd = (axes[0] + 1) % 3 != axes[1];
  const double x = random.below(2) ? 1 : -1, y = random.below(2) ? 1 : -1;
  Rotation turn;
  for (double& m : turn.m) m = 0;
  turn.m[axes[0]] = x;
  turn.m[3 + axes[1]] = y;
  turn.m[6 + axes[2]] = x * y * (is_odd ? -1 : 1);
  return turn;
}

/// Struts of any length, also so short that its square is 0, and of any factor.
UnitCell any_cell(Random& random) {
  UnitCell cell;
  for (uint32_t n = 0; n < 3; ++n) {
    // Coordinates of 0 keep a small difference.
    const Vec3 node = random.below(2) ? Vec3{} : random.in_box({{0, 0, 0}, {1, 1, 1}});
    const double lengths[] = {1, 1, 0.01, 1e-9, 1e-80, 1e-158, 1e-170, 0};
    cell.nodes.push_back(node);
    const Vec3 other = node + random.in_box({{0, 0, 0}, {1, 1, 1}}) * lengths[random.below(8)];
    cell.nodes.push_back(min(other, Vec3{1, 1, 1}));
    cell.struts.push_back({2 * n, 2 * n + 1});
    cell.factors.push_back(random.below(2) ? 1 : random.between(0.2, 1));
  }
  return cell;
}

UnitCell cell_of(uint64_t number, Random& random) {
  switch (number % 8) {
    case 0:
      return bcc_unit_cell();
    case 1:
      return octet_unit_cell();
    case 2:
      return kelvin_unit_cell();
    case 3:
      return cubic_unit_cell();
    case 4:
      return diamond_unit_cell();
    case 5:
      return reentrant_unit_cell();
    default:
      return any_cell(random);
  }
}

/// Compares all samples of some rows. Returns the samples inside.
size_t check(Random& random, uint64_t number) {
  const auto pick = [&](std::initializer_list<double> choices) {
    return choices.begin()[random.below(choices.size())];
  };
  const double size = pick({1, 0.3, 40});
  Neighbourhood grid{{0.1 * size, -0.3 * size, 0.7 * size}, {size, size, size}, turn_of(random)};
  for (int axis = 0; axis < 3; ++axis) grid.cell_size[axis] *= pick({1, 1, 0.5, 3});
  const double far = pick({0, 0, 1e3, 1e7}) * size;

  SampleGrid samples;
  const bool is_wide = number % 20 == 7;  // more columns than are drawn at a time
  samples.nx = is_wide ? 4000 + random.below(6000) : 100 + random.below(900);
  samples.ny = is_wide ? 4 : 16 + random.below(16);
  samples.nz = is_wide ? 1 : 2;
  const double across = random.between(8, 300);
  samples.origin = {far + random.unit() * size, random.unit() * size, -far + random.unit() * size};
  samples.spacing = {size / across, size * random.between(0.01, 0.1), size * random.unit()};
  if (random.below(4) == 0) samples.spacing.x = size / std::round(across);

  // From the middle of the rows on, along a direction that is often theirs.
  const Vec3 middle = samples.at(samples.nx / 2, samples.ny / 2, 0);
  Vec3 direction = random.below(2) ? random.direction() : Vec3{random.below(2) ? 1.0 : -1.0, 0, 0};
  const double length = samples.spacing.x * static_cast<double>(samples.nx);
  const double way = length * pick({0.55, 0.7, 1, 3});  // some rows leave what is linear
  double low = pick({0, 1e-4, 0.02, 0.1}) * size, high = pick({0.05, 0.15, 0.4}) * size;
  if (random.below(8) == 0) std::swap(low, high);
  const Lattice lattice(grid, cell_of(number, random),
                        Parameter(Ref<const Field>(make_ref<GradientField>(
                            middle - direction * way, low, middle + direction * way, high))));

  BitRows rows(samples);
  for (uint64_t k = 0; k < samples.nz; ++k)
    for (uint64_t j = 0; j < samples.ny; ++j)
      for (uint64_t i = 3; i + 2 < samples.nx; ++i)
        if ((i / 50 + j) % 7 != 0) rows.set(i, j, k);
  lattice.keep_rows(rows.block(), nullptr);
  assert_int_equal(rows.damage(), 0);
  size_t inside = 0;
  for (uint64_t k = 0; k < samples.nz; ++k)
    for (uint64_t j = 0; j < samples.ny; ++j)
      for (uint64_t i = 0; i < samples.nx; ++i) {
        const bool is_alive = i >= 3 && i + 2 < samples.nx && (i / 50 + j) % 7 != 0;
        const bool expected = is_alive && lattice.inside(samples.at(i, j, k));
        if (rows.get(i, j, k) != expected)
          fail_msg("model %d: sample %d, %d, %d of %d is %d", int(number), int(i), int(j), int(k),
                   int(samples.nx), !expected);
        inside += expected;
      }
  return inside;
}

void samples_are_as_defined(void**) {
  const size_t models = test_count(1000);
  size_t inside = 0;
  std::vector<int64_t> targets;  // the best instruction set first
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1)
    targets.push_back(all & -all);
  for (size_t n = 0; n < models; ++n) {
    Random random(n);
    hwy::SetSupportedTargetsForTest(targets[n % 5 == 4 ? n / 5 % targets.size() : 0]);
    inside += check(random, n);
  }
  hwy::SetSupportedTargetsForTest(0);
  assert_true(inside > 500 * models);
}

/// Rows within a few roundings of touching a strut along z, at its body or at the sphere about its
/// end, whose samples include the point of contact: rounding decides whether it is inside.
void rows_that_touch_are_as_defined(void**) {
  const size_t models = test_count(2000);
  size_t inside = 0, outside = 0;
  for (size_t n = 0; n < models; ++n) {
    Random random(n);
    const double radius = random.between(0.05, 0.2), slope = random.between(-0.04, 0.04);
    const double shrunk = 1 - slope * slope;
    SampleGrid samples;
    samples.nx = 200;
    samples.ny = 32;
    samples.nz = 1;
    samples.spacing = {1 / random.between(60, 120), 0x1p-53, 1};
    const double reach = radius / std::sqrt(shrunk);
    // Beyond the end at z = 0.5, or beside the body.
    const double beyond = n % 2 ? reach * random.between(0.1, 0.9) : 0;
    const Vec3 contact{1 + slope * radius / shrunk, 1 + std::sqrt(reach * reach - beyond * beyond),
                       0.5 + beyond};
    samples.origin = contact - Vec3{100 * samples.spacing.x, 16 * samples.spacing.y, 0};
    const Lattice lattice(
        {{0, 0, 0}, {1, 1, 1}, {}}, {{{0, 0, 0.2}, {0, 0, 0.5}}, {{0, 1}}, {}},
        Parameter(Ref<const Field>(make_ref<GradientField>(Vec3{-1, 0, 0}, radius - 2 * slope,
                                                           Vec3{3, 0, 0}, radius + 2 * slope))));
    BitRows rows(samples);
    for (uint64_t j = 0; j < samples.ny; ++j)
      for (uint64_t i = 0; i < samples.nx; ++i) rows.set(i, j, 0);
    lattice.keep_rows(rows.block(), nullptr);
    for (uint64_t j = 0; j < samples.ny; ++j)
      for (uint64_t i = 95; i < 106; ++i) {
        const bool expected = lattice.inside(samples.at(i, j, 0));
        if (rows.get(i, j, 0) != expected)
          fail_msg("model %d: sample %d of row %d is %d", int(n), int(i), int(j), !expected);
        ++(expected ? inside : outside);
      }
  }
  assert_true(inside > models && outside > models);
}

/// Planes whose places come from numbers so large that their rounding may be many cells.
void planes_far_from_where_they_count_are_as_defined(void**) {
  const Lattice lattice({{0, 0, 0}, {1, 1, 1}, {}}, bcc_unit_cell(),
                        Parameter(Ref<const Field>(
                            make_ref<GradientField>(Vec3{-1, -1, -1}, 0.05, Vec3{4, 5, 6}, 0.3))));
  for (int axis = 0; axis < 3; ++axis) {
    SampleGrid samples;
    samples.nx = samples.ny = samples.nz = 40;
    (axis == 0 ? samples.nx : axis == 1 ? samples.ny : samples.nz) = 1;
    samples.origin = {0.01, 0.02, 0.03};
    samples.spacing = {0.05, 0.05, 0.05};
    samples.origin[axis] = -0x1p90;
    samples.spacing[axis] = 0x1p90;
    samples.first[static_cast<size_t>(axis)] = 1;
    BitRows rows(samples);
    size_t inside = 0;
    const auto for_samples = [&](auto&& visit) {
      for (uint64_t k = 0; k < samples.nz; ++k)
        for (uint64_t j = 0; j < samples.ny; ++j)
          for (uint64_t i = 0; i < samples.nx; ++i) visit(i, j, k);
    };
    for_samples([&](uint64_t i, uint64_t j, uint64_t k) { rows.set(i, j, k); });
    lattice.keep_rows(rows.block(), nullptr);
    for_samples([&](uint64_t i, uint64_t j, uint64_t k) {
      const bool expected = lattice.inside(samples.at(i, j, k));
      assert_int_equal(rows.get(i, j, k), expected);
      inside += expected;
    });
    assert_true(inside > 0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(samples_are_as_defined),
      cmocka_unit_test(rows_that_touch_are_as_defined),
      cmocka_unit_test(planes_far_from_where_they_count_are_as_defined),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
