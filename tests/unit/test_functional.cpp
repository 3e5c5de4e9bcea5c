// SPDX-License-Identifier: Apache-2.0
// Functional structures against what is known of their surfaces.
//
// Volume fractions: integrals over one angle are closed, the other two were summed numerically
// (derived; that of P also from an integral of Bessel functions). Symmetries: those of the surfaces
// (Schoen 1970), at levels away from 0 too.
#include <functional>

#include "expression/parser.h"
#include "random.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

enum Preset {
  gyroid,
  schwarz_p,
  diamond,
  i_wp,
  neovius,
  f_rd,
  lidinoid,
  split_p,
  fischer_koch_s,
  c_y,
  c_plus_minus_y,
  karcher_k,
  g_prime,
  double_gyroid,
  double_diamond,
  double_p,
  honeycomb,
  rods,
};

/// Cells of 1 with corners at whole numbers.
Ref<Functional> make(Preset preset, double level, FunctionalKind kind = FunctionalKind::network) {
  return make_ref<Functional>(Neighbourhood{}, parse_expression(preset_expressions[preset], {}),
                              kind, Parameter(level), 0);
}

/// Independent samples of the cell.
double fraction_of(const Functional& structure, size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = random.in_box({{-1, -1, -1}, {1, 1, 1}});
  std::vector<uint8_t> alive(count, 1);
  structure.keep_points(points.data(), alive.data(), count);
  size_t held = 0;
  for (uint8_t a : alive) held += a;
  return static_cast<double>(held) / static_cast<double>(count);
}

void volume_fractions(void**) {
  constexpr double levels[] = {0.1, 0.3, 0.5, 0.75, 1.0, 1.2, 1.4};
  struct Column {
    Preset preset;
    double fractions[7];
  };
  constexpr Column columns[] = {
      {schwarz_p, {.528536, .585639, .642835, .714561, .786670, .832035, .867578}},
      {gyroid, {.532186, .596724, .661782, .744468, .829725, .901046, .977556}},
      {diamond, {.540936, .623019, .705759, .810923, .919410, .974776, .999612}},
  };
  const size_t count = test_count(1000000);
  uint64_t seed = 0;
  for (const Column& column : columns)
    for (size_t i = 0; i < std::size(levels); ++i) {
      const double c = levels[i], phi = column.fractions[i];
      const auto check = [&](const char* what, const Functional& structure, double expected) {
        const double got = fraction_of(structure, count, ++seed);
        const double error = std::sqrt(expected * (1 - expected) / static_cast<double>(count));
        if (std::abs(got - expected) > 4 * error + 1e-6)
          fail_msg("function %d, level %g, %s: %.6f, expected %.6f, standard error %.6f",
                   column.preset, c, what, got, expected, error);
      };
      check("network", *make(column.preset, c), phi);
      check("the other side", *make(column.preset, -c), 1 - phi);
      check("sheet", *make(column.preset, c, FunctionalKind::sheet), 2 * phi - 1);
    }
}

/// Those of docs/concepts.md, by tests/golden/make_fractions.py.
void volume_fractions_of_the_documents(void**) {
  struct Row {
    double network, sheet;  // at the levels 0 and 0.2
  };
  constexpr Row rows[preset_count] = {
      {.5000, .1288}, {.5000, .1142}, {.5000, .1638}, {.4693, .0526}, {.5000, .0869},
      {.4323, .0854}, {.3845, .3037}, {.5103, .1451}, {.5000, .1966}, {.5000, .0880},
      {.5000, .0996}, {.4102, .2100}, {.3693, .2336}, {.3170, .0470}, {.4146, .2448},
      {.3507, .3096}, {.4760, .1223}, {.1848, .0877}};
  const size_t count = test_count(400000);
  for (int i = 0; i < preset_count; ++i)
    for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet}) {
      const bool is_sheet = kind == FunctionalKind::sheet;
      const Ref<Functional> structure = make(static_cast<Preset>(i), is_sheet ? 0.2 : 0, kind);
      const double expected = is_sheet ? rows[i].sheet : rows[i].network;
      const double got =
          fraction_of(*structure, count, 100 + static_cast<uint64_t>(2 * i + is_sheet));
      const double error = std::sqrt(expected * (1 - expected) / static_cast<double>(count));
      if (std::abs(got - expected) > 4 * error + 1e-4)
        fail_msg("function %d, kind %d: %.4f, expected %.4f, standard error %.5f", i + 1,
                 static_cast<int>(kind), got, expected, error);
    }
}

/// The network of a double function is two parts that mirror or shift onto each other: on the torus
/// of two cells along each axis (a shift by one exchanges those of the double diamond), cut into
/// cubes, it has two components of about the same volume.
void double_networks_are_two(void**) {
  constexpr int side = 64;
  for (const Preset preset : {double_gyroid, double_diamond, double_p}) {
    const Ref<Functional> structure = make(preset, 0);
    std::vector<int> label(side * side * side);
    const auto at = [](int x, int y, int z) {
      return static_cast<size_t>(((z + side) % side * side + (y + side) % side) * side +
                                 (x + side) % side);
    };
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          label[at(x, y, z)] =
              structure->inside(Vec3{x + 0.5, y + 0.5, z + 0.5} * (2.0 / side)) ? -1 : 0;
    std::vector<size_t> volumes;
    for (int start = 0; start < side * side * side; ++start) {
      if (label[static_cast<size_t>(start)] >= 0) continue;
      std::vector<int> todo{start};
      volumes.push_back(0);
      label[static_cast<size_t>(start)] = 1;
      while (!todo.empty()) {
        const int i = todo.back(), x = i % side, y = i / side % side, z = i / side / side;
        todo.pop_back();
        ++volumes.back();
        for (const size_t next : {at(x + 1, y, z), at(x - 1, y, z), at(x, y + 1, z),
                                  at(x, y - 1, z), at(x, y, z + 1), at(x, y, z - 1)})
          if (label[next] < 0) {
            label[next] = 1;
            todo.push_back(static_cast<int>(next));
          }
      }
    }
    assert_int_equal(volumes.size(), 2);
    const double ratio = static_cast<double>(volumes[0]) / static_cast<double>(volumes[1]);
    assert_true(ratio > 0.98 && ratio < 1.02);
  }
}

/// A symmetry of space in cells, and whether it swaps the two sides of the surface.
struct Symmetry {
  const char* name;
  std::function<Vec3(Vec3)> map;
  bool swaps;
};

void check_symmetries(Preset preset, const std::vector<Symmetry>& symmetries) {
  const double level = 0.3;
  const Ref<Functional> inside = make(preset, level), other = make(preset, -level);
  const Ref<Functional> wider = make(preset, level + 1e-9), narrower = make(preset, level - 1e-9);
  Random random(7 + static_cast<uint64_t>(preset));
  for (const Symmetry& symmetry : symmetries) {
    size_t differ = 0, held = 0, near = 0;
    const size_t count = test_count(20000);
    for (size_t i = 0; i < count; ++i) {
      const Vec3 p = random.in_box({{0, 0, 0}, {1, 1, 1}}), q = symmetry.map(p);
      // Of a map that swaps sides: g(q) = -g(p), so p is inside at the level where q is not at
      // minus the level. Points next to the surface are left to rounding.
      const bool a = inside->inside(p);
      if (a != wider->inside(p) || a != narrower->inside(p)) {
        ++near;
        continue;
      }
      differ += symmetry.swaps ? other->inside(q) == a : inside->inside(q) != a;
      held += a;
    }
    if (differ)
      fail_msg("function %d, %s: %zu of %zu differ", preset, symmetry.name, differ, count);
    if (count > 100) assert_in_range(held, 1, count - 1);
    assert_true(near < 5);
  }
}

void symmetries(void**) {
  const Symmetry turn{"third of a turn about (1, 1, 1)",
                      [](Vec3 p) {
                        return Vec3{p.y, p.z, p.x};
                      },
                      false};
  const Symmetry body{"half a cell along all axes",
                      [](Vec3 p) {
                        return p + Vec3{0.5, 0.5, 0.5};
                      },
                      false};
  const Symmetry swap{"half a cell along all axes",
                      [](Vec3 p) {
                        return p + Vec3{0.5, 0.5, 0.5};
                      },
                      true};
  const Symmetry inversion{"inversion", [](Vec3 p) { return p * -1.0; }, false};
  const Symmetry odd{"inversion", [](Vec3 p) { return p * -1.0; }, true};
  const Symmetry mirror{"mirror at x = 0", [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; }, false};
  const Symmetry diagonal{"mirror at x = y", [](Vec3 p) { return Vec3{p.y, p.x, p.z}; }, false};
  const Symmetry screw{"screw axis along x",
                       [](Vec3 p) {
                         return Vec3{p.x + 0.5, 0.5 - p.y, -p.z};
                       },
                       false};
  const Symmetry face{"half a cell along x and y",
                      [](Vec3 p) {
                        return p + Vec3{0.5, 0.5, 0};
                      },
                      false};
  check_symmetries(gyroid, {turn, body, odd, screw});
  check_symmetries(schwarz_p, {turn, swap, inversion, mirror, diagonal});
  check_symmetries(diamond, {turn, swap, diagonal, face});
  check_symmetries(i_wp, {turn, body, inversion, mirror, diagonal});
  check_symmetries(neovius, {turn, swap, inversion, mirror, diagonal});
  check_symmetries(f_rd, {turn, inversion, mirror, diagonal, face});
  check_symmetries(lidinoid, {turn});
  check_symmetries(split_p, {turn});
  check_symmetries(fischer_koch_s, {turn, odd});
  check_symmetries(c_y, {turn});
  check_symmetries(c_plus_minus_y, {turn});
  check_symmetries(karcher_k, {turn, inversion, mirror, diagonal});
  check_symmetries(g_prime, {turn, inversion});
  check_symmetries(double_gyroid, {turn, inversion, body});
  check_symmetries(double_diamond, {turn, inversion, diagonal});
  check_symmetries(double_p, {turn, body, inversion, mirror, diagonal});
  check_symmetries(honeycomb, {inversion, mirror, face});
  check_symmetries(rods, {inversion, mirror, diagonal});
}

/// What no choice of clusters may change.
void clusters_change_nothing(void**) {
  const Tape tape = parse_expression("min(sin(x)*cos(y)+cos(z)*sin(x), 0.2*x-cos(y*z))", {});
  const Ref<Functional> none =
      make_ref<Functional>(Neighbourhood{}, tape, FunctionalKind::sheet, Parameter(0.3), 1);
  for (int side : {0, 2, 7, 16, 64}) {
    const Ref<Functional> other =
        make_ref<Functional>(Neighbourhood{}, tape, FunctionalKind::sheet, Parameter(0.3), side);
    SampleGrid grid;
    grid.origin = {-0.3, 0.1, 0.7};
    grid.spacing = {0.011, 0.03, 0.05};
    grid.nx = 200;
    grid.ny = grid.nz = 20;
    const size_t words = words_for(grid.nx) * grid.ny * grid.nz;
    std::vector<uint64_t> a(words, ~uint64_t{0}), b(words, ~uint64_t{0});
    RowBlock block;
    block.grid = &grid;
    block.y1 = block.z1 = 20;
    block.row_stride = words_for(grid.nx);
    block.layer_stride = block.row_stride * 20;
    block.words = a.data();
    none->keep_rows(block, nullptr);
    block.words = b.data();
    other->keep_rows(block, nullptr);
    for (uint64_t k = 0; k < 20; ++k)
      for (uint64_t j = 0; j < 20; ++j)
        for (uint64_t i = 0; i < grid.nx; ++i) {
          const size_t w = k * block.layer_stride + j * block.row_stride + i / 64;
          const bool is_inside = none->inside(grid.at(i, j, k));
          assert_int_equal(a[w] >> (i % 64) & 1, is_inside);
          assert_int_equal(b[w] >> (i % 64) & 1, is_inside);
        }
  }
}

/// Rows that repeat are copied: at pitches that divide the cell, or nearly do.
void rows_that_repeat(void**) {
  const Ref<Functional> structure = make(lidinoid, 0.2);
  for (double pitch : {1 / 64.0, 1 / 32.0, 1 / 16.0, 1 / 128.0, 1 / 63.0, 0.02, 1 / 64.0 + 1e-15})
    for (uint64_t nx : {64, 200, 256, 300}) {
      SampleGrid grid;
      grid.origin = {pitch / 2, 0.3, 0.4};
      grid.spacing = {pitch, 0.1, 0.1};
      grid.nx = nx;
      grid.ny = grid.nz = 5;
      std::vector<uint64_t> bits(words_for(nx) * 25);
      RowBlock block;
      block.grid = &grid;
      block.y1 = block.z1 = 5;
      block.row_stride = words_for(nx);
      block.layer_stride = 5 * block.row_stride;
      block.words = bits.data();
      for (uint64_t k = 0; k < 5; ++k)
        for (uint64_t j = 0; j < 5; ++j) set_bits(block.row(j, k), 0, nx - 1);
      structure->keep_rows(block, nullptr);
      for (uint64_t k = 0; k < 5; ++k)
        for (uint64_t j = 0; j < 5; ++j) {
          for (uint64_t i = 0; i < nx; ++i)
            assert_int_equal(block.row(j, k)[i / 64] >> (i % 64) & 1,
                             structure->inside(grid.at(i, j, k)));
          if (nx % 64) assert_int_equal(block.row(j, k)[nx / 64] >> (nx % 64), 0);
        }
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(volume_fractions),
      cmocka_unit_test(volume_fractions_of_the_documents),
      cmocka_unit_test(double_networks_are_two),
      cmocka_unit_test(symmetries),
      cmocka_unit_test(clusters_change_nothing),
      cmocka_unit_test(rows_that_repeat),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
