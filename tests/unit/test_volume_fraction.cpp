// SPDX-License-Identifier: Apache-2.0
// Volume fractions and edge statistics against known values.
//
// Lattices: closed forms, exact for thin struts (cylinders minus what they share at nodes; the
// cubic constant is that of Steinmetz bodies, the others were found numerically to six digits).
// Foams: the edge statistics of one uniform seed a cell, measured with voro++ over 97,336 seeds.
#include <array>
#include <set>

#include "base/pi.h"
#include "bit_rows.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/foam.h"
#include "structure/lattice/lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

/// The part of about `samples` samples that are inside, one in each of n^3 boxes of the cell. The
/// standard error of random samples is an upper bound for that of stratified ones.
double fraction(const UnitCell& cell, double radius, double samples) {
  const Lattice lattice(Neighbourhood{}, cell, Parameter(radius));
  const int n = static_cast<int>(std::cbrt(samples));
  Random random(8);
  std::vector<Vec3> points;
  std::vector<uint8_t> alive;
  uint64_t held = 0;
  for (int k = 0; k < n; ++k) {
    points.clear();
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const Vec3 corner{double(i), double(j), double(k)};
        points.push_back((corner + random.in_box({{0, 0, 0}, {1, 1, 1}})) * (1.0 / n));
      }
    alive.assign(points.size(), 1);
    lattice.keep_points(points.data(), alive.data(), points.size());
    for (const uint8_t is_inside : alive) held += is_inside;
  }
  return static_cast<double>(held) / std::pow(n, 3);
}

void check_fraction(const char* name, UnitCell cell, double radius, double expected) {
  const double samples = static_cast<double>(test_count(10000000)),
               got = fraction(cell, radius, samples);
  const double error = std::sqrt(expected * (1 - expected) / samples);
  print_message("%s, r %g: %.6f, expected %.6f, standard error below %.6f\n", name, radius, got,
                expected, error);
  assert_true(std::abs(got - expected) <= 4 * error);
}

void test_cubic(void**) {
  for (double r : {0.05, 0.2})
    check_fraction("cubic", cubic_unit_cell(), r, 3 * pi * r * r - 8 * std::sqrt(2.0) * r * r * r);
}

void test_bcc(void**) {
  for (double r : {0.05, 0.2})
    check_fraction("BCC", bcc_unit_cell(), r,
                   4 * std::sqrt(3.0) * pi * r * r - 16 * std::sqrt(6.0) * r * r * r);
}

void test_octet(void**) {
  const double strut = std::sqrt(0.5);  // length of a strut in cells
  for (double part : {0.05, 0.2})
    check_fraction("octet", octet_unit_cell(), part * strut,
                   6 * std::sqrt(2.0) * pi * part * part - 54.627 * part * part * part);
}

/// Thin struts fill pi r^2 L of a cell, L being their length in it, except for the joints. What
/// capsules share at a joint is r^3 times a constant, as long as joints are apart; so with two
/// radii the joints cancel.
void test_thin_lattices(void**) {
  struct Thin {
    const char* name;
    UnitCell cell;
    double length;
  };
  const double root2 = std::sqrt(2.0), root3 = std::sqrt(3.0), root5 = std::sqrt(5.0);
  const double r = 0.02;
  for (const Thin& thin :
       {Thin{"FCC", fcc_unit_cell(), 6 * root2}, Thin{"Kelvin", kelvin_unit_cell(), 6 * root2},
        Thin{"diamond", diamond_unit_cell(), 4 * root3},
        Thin{"rhombic dodecahedron", rhombic_dodecahedron_unit_cell(), 8 * root3},
        Thin{"re-entrant", reentrant_unit_cell(), 3 + 4 * root5}}) {
    const double count = static_cast<double>(test_count(10000000 / 6)),
                 cylinders = pi * r * r * thin.length;
    const double once = fraction(thin.cell, r, count) / cylinders;
    const double twice = fraction(thin.cell, 2 * r, count) / (4 * cylinders);
    const double got = 2 * once - twice;
    // Of `once`, doubled, and a little more for `twice`.
    const double error = 2.2 / std::sqrt(count * cylinders);
    print_message("%s: pi r^2 L times %.4f for thin struts, standard error below %.4f\n", thin.name,
                  got, error);
    assert_true(std::abs(got - 1) <= 4 * error);
  }
}

/// Length of the part of a segment within a box.
double length_within(const Box3& box, Vec3 a, Vec3 b) {
  double low = 0, high = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = b[axis] - a[axis];
    if (d == 0) {
      if (a[axis] < box.min[axis] || a[axis] > box.max[axis]) return 0;
      continue;
    }
    const double s = (box.min[axis] - a[axis]) / d, t = (box.max[axis] - a[axis]) / d;
    low = std::max(low, std::min(s, t));
    high = std::min(high, std::max(s, t));
  }
  return low < high ? (high - low) * length(b - a) : 0;
}

/// Thin struts fill pi r^2 L_V of space, except for the joints. With n vertices a volume: capsules
/// lie within the cylinders and one ball a vertex, so the fraction is at most that plus n 4/3 pi
/// r^3; and each of the six pairs of struts at a vertex shares about half a Steinmetz body, 8/3
/// r^3, at most, so it is at least that less 16 n r^3. With n = 6.76 and L_V = 5.79: from -6 r to
/// +1.6 r, relative. L_V is measured in the same box.
void test_thin_foam(void**) {
  const int cells = test_scale() < 0.5 ? 4 : 8;
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  const FoamSeeds seeds(3, 1, {1, 1, 1});
  const Box3 box{{0, 0, 0}, {double(cells), double(cells), double(cells)}};
  double total = 0;
  for (int z = -4; z < cells + 4; z += EdgeBrick::side)
    for (int y = -4; y < cells + 4; y += EdgeBrick::side)
      for (int x = -4; x < cells + 4; x += EdgeBrick::side) {
        const EdgeBrick brick(seeds, {x, y, z});
        const Vec3 corner{double(x), double(y), double(z)};
        for (const FoamEdge& e : brick.edges())
          total += length_within(box, corner + Vec3{e.a[0], e.a[1], e.a[2]},
                                 corner + Vec3{e.b[0], e.b[1], e.b[2]});
      }
  const double length_per_volume = total / std::pow(cells, 3);
  for (double r : {0.005, 0.01, 0.02}) {
    const Ref<Foam> foam = make_ref<Foam>(context, Neighbourhood{}, Parameter(r), 1.0, uint64_t{3},
                                          FoamMethod::direct);
    // A grid whose planes are no cell's.
    SampleGrid grid;
    const double step = 1 / 60.37;
    grid.spacing = {step, step, step};
    grid.origin = Vec3{0.4, 0.3, 0.7} * step;
    grid.nx = grid.ny = grid.nz = static_cast<uint64_t>(cells / step);
    uint64_t held = 0;
    for (uint64_t k = 0; k < grid.nz; k += 32) {
      BitRows rows(grid, 0, grid.ny, k, std::min(grid.nz, k + 32));
      const RowBlock& block = rows.block();
      for (uint64_t z = block.z0; z < block.z1; ++z)
        for (uint64_t y = 0; y < grid.ny; ++y) set_bits(block.row(y, z), 0, grid.nx - 1);
      foam->keep_rows(block, nullptr);
      for (uint64_t z = block.z0; z < block.z1; ++z)
        for (uint64_t y = 0; y < grid.ny; ++y)
          for (size_t w = 0; w < block.row_words(); ++w) held += std::popcount(block.row(y, z)[w]);
    }
    const double count = static_cast<double>(grid.nx * grid.ny * grid.nz);
    const double ratio = static_cast<double>(held) / count / (pi * r * r * length_per_volume);
    // Hits are random samples at worst.
    const double error = 4 / std::sqrt(static_cast<double>(held));
    print_message("foam r %g: %llu of %.0f samples, pi r^2 L_V times %.4f (within %.4f)\n", r,
                  static_cast<unsigned long long>(held), count, ratio, error);
    assert_true(ratio >= 1 - 6 * r - error && ratio <= 1 + 1.6 * r + error);
  }
}

struct Statistic {
  double sum = 0, sum_squared = 0;
  int count = 0;
  void add(double v) {
    sum += v;
    sum_squared += v * v;
    ++count;
  }
  double mean() const { return sum / count; }
  double error() const {
    return std::sqrt(std::max(0.0, sum_squared / count - mean() * mean()) / (count - 1));
  }
};

/// Means over bricks; their spread gives the sampling error (neighbouring bricks hardly correlate),
/// and that of the reference is as that of as many seeds.
void check_edges(double jitter, double faces, double length_per_volume, double mean_edge) {
  const FoamSeeds seeds(12, jitter, {1, 1, 1});
  const int cells = test_scale() < 0.5 ? 16 : 32;
  const double brick_cells = std::pow(EdgeBrick::side, 3);
  Statistic edges, lengths, ratio;
  for (int z = 0; z < cells; z += EdgeBrick::side)
    for (int y = 0; y < cells; y += EdgeBrick::side)
      for (int x = 0; x < cells; x += EdgeBrick::side) {
        const EdgeBrick brick(seeds, {x - 16, y, z});
        double total = 0;
        for (const FoamEdge& e : brick.edges())
          total += length(Vec3{e.b[0], e.b[1], e.b[2]} - Vec3{e.a[0], e.a[1], e.a[2]});
        const double count = static_cast<double>(brick.edges().size());
        edges.add(count / brick_cells);
        lengths.add(total / brick_cells);
        ratio.add(total / count);
      }
  const double others = std::sqrt(1 + std::pow(cells, 3) / 97336);
  const auto check = [&](const char* name, double got, double error, double expected,
                         double digit) {
    print_message("jitter %g, %s: %.5f +- %.5f, expected %.5f\n", jitter, name, got, error,
                  expected);
    assert_true(std::abs(got - expected) <= 4 * error * others + digit);
  };
  // A cell with f faces has 3 (f - 2) edges, each of three cells.
  check("faces a cell", edges.mean() + 2, edges.error(), faces, 0.0005);
  check("edges a seed", edges.mean(), edges.error(), faces - 2, 0.0005);
  check("edge length a volume", lengths.mean(), lengths.error(), length_per_volume, 0.0005);
  check("mean edge", lengths.mean() / edges.mean(), ratio.error(), mean_edge, 0.00005);
}

void test_edges(void**) {
  check_edges(0.01, 16.112, 5.988, 0.4243);
  check_edges(0.1, 16.023, 5.895, 0.4204);
  check_edges(0.5, 15.559, 5.690, 0.4196);
  check_edges(1, 15.501, 5.787, 0.4286);
}

/// Without jitter the cells are cubes (derived): 6 faces of 4 edges, 12 edges, each 1 long and of
/// four cells, so 3 a volume. Four seeds share an edge then, so bricks hold it more than once, and
/// edges of no length at its ends.
void test_cubes(void**) {
  constexpr int64_t part = 1000;  // ends in thousandths
  const FoamSeeds seeds(1, 0, {1, 1, 1});
  std::set<std::array<int64_t, 6>> edges;
  for (int z = -EdgeBrick::side; z <= EdgeBrick::side; z += EdgeBrick::side)
    for (int y = -EdgeBrick::side; y <= EdgeBrick::side; y += EdgeBrick::side)
      for (int x = -EdgeBrick::side; x <= EdgeBrick::side; x += EdgeBrick::side) {
        const EdgeBrick brick(seeds, {x, y, z});
        for (const FoamEdge& e : brick.edges()) {
          std::array<int64_t, 3> a, b;
          const int corner[3] = {x, y, z};
          for (int axis = 0; axis < 3; ++axis) {
            a[axis] = std::llround((e.a[axis] + corner[axis]) * part);
            b[axis] = std::llround((e.b[axis] + corner[axis]) * part);
          }
          if (b < a) std::swap(a, b);
          if (a != b) edges.insert({a[0], a[1], a[2], b[0], b[1], b[2]});
        }
      }
  size_t in_box = 0, of_cell = 0;
  size_t of_face[6] = {};
  double total = 0;
  for (const auto& e : edges) {
    const Vec3 a{double(e[0]), double(e[1]), double(e[2])},
        b{double(e[3]), double(e[4]), double(e[5])};
    const Vec3 middle = (a + b) * (0.5 / part);
    const double low = -0.25, high = EdgeBrick::side - 0.25;  // no edge is that near its border
    if (min_component(middle) >= low && max_component(middle) < high) {
      ++in_box;
      total += length(b - a) / part;
    }
    const Box3 cell{Vec3{1, 1, 1} * part, Vec3{2, 2, 2} * part};
    if (!cell.contains(a) || !cell.contains(b)) continue;
    ++of_cell;
    for (int axis = 0; axis < 3; ++axis) {
      of_face[2 * axis] += a[axis] == cell.min[axis] && b[axis] == cell.min[axis];
      of_face[2 * axis + 1] += a[axis] == cell.max[axis] && b[axis] == cell.max[axis];
    }
  }
  const size_t volume = EdgeBrick::side * EdgeBrick::side * EdgeBrick::side;
  assert_int_equal(in_box, 3 * volume);
  assert_true(std::abs(total - 3.0 * static_cast<double>(volume)) <= 1e-9);
  assert_int_equal(of_cell, 12);
  for (size_t count : of_face) assert_int_equal(count, 4);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_cubic),     cmocka_unit_test(test_bcc),
      cmocka_unit_test(test_octet),     cmocka_unit_test(test_thin_lattices),
      cmocka_unit_test(test_thin_foam), cmocka_unit_test(test_edges),
      cmocka_unit_test(test_cubes)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
