// SPDX-License-Identifier: Apache-2.0
// Windows that tile a grid have the bits of the whole grid, for every structure and every shape:
// where the windows are cut at random, and far from the first sample of a grid of 2^31 - 1 samples
// along each axis, where the rounding of the index is as large as it gets. There the whole is the
// predicate, at positions that the test computes.
#include "bit_rows.h"
#include "random.h"
#include "shapes.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Cuts 0 to `count` into up to `most` intervals.
std::vector<uint64_t> cuts(uint64_t count, uint64_t most, Random& random) {
  std::vector<uint64_t> at = {0, count};
  for (uint64_t n = random.below(most); n > 0; --n) at.push_back(random.below(count + 1));
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

/// fill(rows) fills in the rows of a grid. Compares windows with the whole, and counts its samples.
template <class Fill>
size_t compare_tiles(const SampleGrid& grid, Random& random, Fill&& fill) {
  const BitRows whole = fill(grid);
  size_t held = 0;
  const auto x = cuts(grid.nx, 4, random), y = cuts(grid.ny, 3, random),
             z = cuts(grid.nz, 3, random);
  for (size_t c = 0; c + 1 < z.size(); ++c)
    for (size_t b = 0; b + 1 < y.size(); ++b)
      for (size_t a = 0; a + 1 < x.size(); ++a) {
        const SampleWindow window{{x[a], y[b], z[c]},
                                  {x[a + 1] - x[a], y[b + 1] - y[b], z[c + 1] - z[c]}};
        const SampleGrid part = window_of(grid, window);
        const BitRows rows = fill(part);
        for (uint64_t k = 0; k < part.nz; ++k)
          for (uint64_t j = 0; j < part.ny; ++j)
            for (uint64_t i = 0; i < part.nx; ++i) {
              const bool in = whole.get(x[a] + i, y[b] + j, z[c] + k);
              held += in;
              if (rows.get(i, j, k) != in)
                fail_msg("sample %d, %d, %d of a window of %d x %d x %d from %d, %d, %d on: %d",
                         int(i), int(j), int(k), int(part.nx), int(part.ny), int(part.nz),
                         int(x[a]), int(y[b]), int(z[c]), !in);
            }
      }
  return held;
}

/// The grid `near` as the last samples of the largest grid that there is.
SampleGrid end_of_largest(const SampleGrid& near) {
  constexpr uint64_t largest = INT32_MAX;
  SampleGrid whole = near;
  SampleWindow window{{}, {near.nx, near.ny, near.nz}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    window.first[a] = largest - window.count[a];
    whole.origin[axis] -= static_cast<double>(window.first[a]) * near.spacing[axis];
  }
  whole.nx = whole.ny = whole.nz = largest;
  return window_of(whole, window);
}

/// Compares the samples of a grid with the predicate; `forgive`(p): where they may differ.
template <class Fill, class Inside, class Forgive>
void compare_samples(const SampleGrid& grid, Fill&& fill, Inside&& inside, Forgive&& forgive) {
  const BitRows rows = fill(grid);
  const auto place = [&](int axis, uint64_t i) {
    const uint64_t index = grid.first[static_cast<size_t>(axis)] + i;
    return grid.origin[axis] + static_cast<double>(index) * grid.spacing[axis];
  };
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const Vec3 p{place(0, i), place(1, j), place(2, k)};
        if (rows.get(i, j, k) != inside(p) && !forgive(p))
          fail_msg("(%.17g, %.17g, %.17g): alone %d, in a window %d", p.x, p.y, p.z, inside(p),
                   !inside(p));
      }
}

void test_structure(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  Random random(row.index + 1);
  const Neighbourhood& n = row.variant.grid;
  Vec3 size = n.rotation.apply(n.cell_size);
  for (int axis = 0; axis < 3; ++axis)
    size[axis] = row.variant.is_axis_aligned ? std::abs(size[axis]) : n.cell_size[axis];
  const double per_cell = row.has_dear_cells() || row.has_dear_points() ? 6 : 10;
  SampleGrid grid;
  grid.spacing = size * (1 / per_cell);  // rounded, except by chance
  grid.origin = n.from_grid(Vec3{-1, 0, -1} * n.cell_size);
  const bool is_dear = row.has_dear_points() || row.has_dear_cells();
  grid.nx = is_dear ? 9 : 60 + random.below(90);
  const double rest = std::sqrt(static_cast<double>(row.samples(1000000)) / double(grid.nx));
  grid.ny = std::clamp<uint64_t>(static_cast<uint64_t>(rest), 2, 40);
  grid.nz = grid.ny;
  const Vec3 centre = grid.at(grid.nx / 2, grid.ny / 2, grid.nz / 2);
  const Ref<const Structure> structure = row.make(centre);
  const auto fill = [&](const SampleGrid& part) {
    BitRows rows(part);
    for (uint64_t k = 0; k < part.nz; ++k)
      for (uint64_t j = 0; j < part.ny; ++j) set_bits(rows.block().row(j, k), 0, part.nx - 1);
    structure->keep_rows(rows.block(), nullptr);
    assert_int_equal(rows.damage(), 0);
    return rows;
  };
  const auto forgive = [&](Vec3 p) { return may_differ(row, centre, p); };
  if (!row.is_method_2() || row.kind.jitter >= 0.01) compare_tiles(grid, random, fill);
  const SampleGrid far = end_of_largest(grid);
  compare_samples(
      far, fill, [&](Vec3 p) { return structure->inside(p); }, forgive);
}

void test_shape(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const Box3 box = shape->bounds();
  Random random(5);
  const auto fill = [&](const SampleGrid& part) {
    BitRows rows(part);
    shape->fill_rows(rows.block());
    assert_int_equal(rows.damage(), 0);
    return rows;
  };
  SampleGrid grid;
  size_t held = 0;
  for (double part : {10.0, 7.0, 24.0}) {
    grid.spacing = box.extent() * (1 / part);
    grid.spacing.x /= 5;
    grid.origin = box.min - grid.spacing;
    grid.nx = static_cast<uint64_t>(5 * part) + 3;
    grid.ny = grid.nz = static_cast<uint64_t>(part) + 3;
    for (size_t n = test_count(8); n > 0; --n) held += compare_tiles(grid, random, fill);
  }
  assert_true(held > 0 || row.least == 0);
  const auto never = [](Vec3) { return false; };
  compare_samples(
      end_of_largest(grid), fill, [&](Vec3 p) { return shape->inside(p); }, never);
}

}  // namespace

int main() {
  std::vector<StructureRow> structure_rows = structures();
  std::vector<ShapeRow> shapes = shape_rows();
  int failed = run_for_each("windows of structures", structure_rows, test_structure);
  failed += run_for_each("windows of shapes", shapes, test_shape);
  return failed;
}
