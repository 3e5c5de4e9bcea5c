// SPDX-License-Identifier: Apache-2.0
// keep_rows answers as inside() does, at 10^6 samples a family of structures (fewer of the slow
// METHOD_1, METHOD_2 and POINT). Grids have their
// samples on borders, axes and symmetry planes of the cells, or anywhere; pitches of 1/3 to 1/100
// of a cell; by the origin, at negative coordinates and 1000 cells away.
#include "bit_rows.h"
#include "random.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct GridCase {
  double samples_per_cell;
  bool on_borders;
  Vec3 corner_cell;
};

const GridCase cases[] = {
    {8, true, {-1, -1, -1}},
    {100, true, {-1, 0, -1}},
    {31.7, false, {-1000, 999, 1001}},
    {10, true, {1000, -1000, 1000}},
    {7.31, false, {-1, -2, 0}},
    {3, true, {-2, -1, 0}},
    {16, true, {0, 0, -1}},
    {100.3, false, {0, -1, -1}},
    {12, true, {-1000, 0, 3}},
    {4, true, {-1, -1, -2}},
    {60, true, {1000, 0, -1000}},
    {3.7, false, {-1001, -2, 5}},
};

/// Which samples are alive before.
enum class Mask { all, scattered, ball };

struct Outcome {
  size_t asked = 0, held = 0, differ = 0, forgiven = 0;

  Outcome& operator+=(const Outcome& other) {
    asked += other.asked;
    held += other.held;
    differ += other.differ;
    forgiven += other.forgiven;
    return *this;
  }
};

/// A family of rows together.
struct Family {
  std::string name;
  Outcome outcome;
};
std::vector<Family> families;

Outcome& family_of(const StructureRow& row) {
  for (Family& family : families)
    if (family.name == row.kind.family) return family.outcome;
  return families.emplace_back(Family{row.kind.family, {}}).outcome;
}

/// Some of a few cells about the grid's origin is solid, and some is void. The samples of a row's
/// grids may be few, in few cells, or all beyond the cells of a map.
void check_not_trivial(const StructureRow& row, Random& random) {
  const Ref<const Structure> structure = row.make(row.variant.grid.origin);
  const Vec3 reach = row.variant.grid.cell_size * 2.5;
  bool has_solid = false, has_void = false;
  for (size_t n = 0; n < 20000 && !(has_solid && has_void); ++n) {
    const Vec3 g = random.in_box({reach * -1.0, reach});
    (structure->inside(row.variant.grid.from_grid(g)) ? has_solid : has_void) = true;
  }
  assert_true(has_solid);
  assert_true(has_void);
}

SampleGrid make_grid(const StructureRow& row, const GridCase& c, size_t samples, Random& random) {
  const Neighbourhood& n = row.variant.grid;
  Vec3 size = n.rotation.apply(n.cell_size);
  for (int axis = 0; axis < 3; ++axis)
    size[axis] = row.variant.is_axis_aligned ? std::abs(size[axis]) : n.cell_size[axis];
  SampleGrid grid;
  grid.spacing = size * (1 / c.samples_per_cell);
  grid.origin = n.from_grid(c.corner_cell * n.cell_size);
  if (!c.on_borders) grid.origin = grid.origin + size * random.in_box({{}, {1, 1, 1}});
  // Few samples or cells for the methods that they are dear to.
  grid.nx = row.has_dear_points() ? 8
            : row.has_dear_cells()
                ? static_cast<uint64_t>(std::min(70.0, 2 * c.samples_per_cell + 1))
                : 70 + random.below(70);
  const double rest = std::sqrt(static_cast<double>(samples) / static_cast<double>(grid.nx));
  grid.ny = std::max<uint64_t>(2, static_cast<uint64_t>(rest));
  grid.nz = grid.ny;
  return grid;
}

Outcome compare(const StructureRow& row, const GridCase& c, const SampleGrid& grid, Mask mask,
                Random& random) {
  // A block inside the grid, so that rows and layers do not start at 0.
  SampleGrid larger = grid;
  larger.origin.y -= larger.spacing.y;
  larger.origin.z -= 2 * larger.spacing.z;
  larger.ny += 2;
  larger.nz += 2;
  std::vector<double> heights;
  if (mask == Mask::scattered) {
    for (uint64_t k = 0; k < larger.nz; ++k) heights.push_back(larger.z(k));
    larger.heights = heights.data();
  }
  BitRows before(larger, 1, larger.ny - 1, 2, larger.nz);
  const RowBlock& block = before.block();
  const double ball = 0.3 * static_cast<double>(grid.nx);
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (uint64_t i = 0; i < larger.nx; ++i) {
        const double x = static_cast<double>(i) - ball, y = static_cast<double>(j) - ball;
        if (mask == Mask::all || (mask == Mask::scattered && random.below(4)) ||
            (mask == Mask::ball && x * x + y * y < ball * ball))
          before.set(i, j, k);
      }
  BitRows after(larger, 1, larger.ny - 1, 2, larger.nz);
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      std::copy_n(block.row(j, k), block.row_words(), after.block().row(j, k));

  const Vec3 centre = larger.at(larger.nx / 2, larger.ny / 2, larger.nz / 2);
  const Ref<const Structure> structure = row.make(centre);
  structure->keep_rows(after.block(), nullptr);
  assert_int_equal(after.damage(), 0);
  Outcome outcome;
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (uint64_t i = 0; i < larger.nx; ++i) {
        const Vec3 p = larger.at(i, j, k);
        const bool asked = before.get(i, j, k), is_inside = asked && structure->inside(p);
        outcome.asked += asked;
        outcome.held += is_inside;
        if (after.get(i, j, k) == is_inside) continue;
        if (may_differ(row, centre, p)) {
          ++outcome.forgiven;
          continue;
        }
        if (!outcome.differ++)
          print_error("(%.17g, %.17g, %.17g), %g samples a cell: alone %d, in a grid %d\n", p.x,
                      p.y, p.z, c.samples_per_cell, is_inside, after.get(i, j, k));
      }
  return outcome;
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  // Foams have many rows, each with two of the grids; lattices have few, each with all, or some
  // where samples are few.
  const size_t grids = !row.is_lattice() ? 2 : test_scale() < 0.5 ? 3 : std::size(cases);
  const size_t samples = row.samples(1000000) / grids + 2;
  Random random(row.index + 1);
  Outcome total;
  for (size_t g = 0; g < grids; ++g) {
    const GridCase& c = cases[(row.index * 5 + row.index / 8 + g * 7) % std::size(cases)];
    const SampleGrid grid = make_grid(row, c, samples, random);
    total += compare(row, c, grid, static_cast<Mask>((row.index + g) % 3), random);
  }
  if (total.forgiven)
    print_message("%zu of %zu samples differ within 1e-9 of the boundary\n", total.forgiven,
                  total.asked);
  if (total.differ) fail_msg("%zu of %zu samples differ", total.differ, total.asked);
  family_of(row) += total;
  check_not_trivial(row, random);
}

void test_family(void** state) {
  const Family& family = *static_cast<const Family*>(*state);
  assert_in_range(family.outcome.held, 1, family.outcome.asked - 1);
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures();
  const int failed = run_for_each("grids", rows, test_row);
  return failed + run_for_each("samples of families are solid and void", families, test_family);
}
