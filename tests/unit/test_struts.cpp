// SPDX-License-Identifier: Apache-2.0
// Struts of lattices against their unit cells, struts cut to shapes, and ids that hosts may keep.
#include <algorithm>
#include <cmath>

#include "field/gradient.h"
#include "msq_test.h"
#include "query/strut_cuts.h"
#include "query/strut_graph.h"
#include "query/struts.h"
#include "random.h"
#include "shape/boolean.h"
#include "shape/primitive.h"
#include "structure/foam/foam.h"
#include "structure/lattice/lattice.h"
#include "structure/lattice/mixed/mixed_lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

Ref<Context> context_of(unsigned threads) {
  return make_ref<Context>(threads, uint64_t{64} << 20, uint64_t{0}, true);
}

std::vector<Strut> struts_of(const StrutQuery& query, unsigned threads = 1) {
  std::vector<Strut> all;
  for_each_strut(*context_of(threads), query, nullptr, [&](const Strut* struts, size_t count) {
    assert_true(count > 0 && count <= max_struts_at_once);
    all.insert(all.end(), struts, struts + count);
  });
  return all;
}

/// Each strut of the tiled unit cell is among those of a lattice, and none besides.
void check_unit_cell(const UnitCell& cell, size_t per_cell) {
  const Neighbourhood grid{{0.1, 0.2, 0.3}, {1, 2, 0.5}, {}};
  const Ref<Structure> lattice = make_ref<Lattice>(grid, cell, Parameter(0.05));
  constexpr int n = 3;
  const Box3 cells{grid.from_grid(Vec3{0, 0, 0}), grid.from_grid(Vec3{n, n, n} * grid.cell_size)};
  // Middles on the lower faces belong to the box: move it off them.
  const Vec3 off = Vec3{1, 1, 1} * -1e-4;
  const Box3 box{cells.min + off, cells.max + off};
  const std::vector<Strut> owned = struts_of({*lattice, {box, true}});
  assert_int_equal(owned.size(), per_cell * n * n * n);
  for (const auto& [i, j] : cell.struts)
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const Vec3 corner{double(x), double(y), double(z)};
          const Vec3 a = grid.from_grid((cell.nodes[i] + corner) * grid.cell_size);
          const Vec3 b = grid.from_grid((cell.nodes[j] + corner) * grid.cell_size);
          const Vec3 middle = (a + b) * 0.5;
          if (!(max_component(middle - box.max) < 0)) continue;
          const auto count = std::count_if(owned.begin(), owned.end(), [&](const Strut& s) {
            const double same = std::max(max_magnitude(s.a - a), max_magnitude(s.b - b));
            const double turned = std::max(max_magnitude(s.a - b), max_magnitude(s.b - a));
            return std::min(same, turned) < 1e-8;
          });
          assert_int_equal(count, 1);
        }
}

void lattices_have_the_struts_of_their_unit_cell(void**) {
  check_unit_cell(cubic_unit_cell(), 3);
  check_unit_cell(bcc_unit_cell(), 8);
  check_unit_cell(octet_unit_cell(), 24);
  check_unit_cell(fcc_unit_cell(), 12);
  check_unit_cell(kelvin_unit_cell(), 24);
  check_unit_cell(diamond_unit_cell(), 16);
  check_unit_cell(rhombic_dodecahedron_unit_cell(), 32);
  check_unit_cell(reentrant_unit_cell(), 22);
  // All twelve edges of the cube are three.
  UnitCell cube;
  for (int i = 0; i < 8; ++i)
    cube.nodes.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  for (uint32_t i = 0; i < 8; ++i)
    for (uint32_t bit : {1u, 2u, 4u})
      if (!(i & bit)) cube.struts.push_back({i, i | bit});
  check_unit_cell(cube, 3);
}

void the_thickest_of_equal_struts_counts(void**) {
  UnitCell thin = cubic_unit_cell(), thick = cubic_unit_cell();
  thin.factors.assign(thin.struts.size(), 0.5);
  thick.factors.assign(thick.struts.size(), 2);
  const Neighbourhood grid;
  const Ref<Structure> one = make_ref<Lattice>(grid, thick, Parameter(0.1));
  for (const Strut& s : struts_of({*one, {{{0, 0, 0}, {2, 2, 2}}, true}}))
    assert_true(s.radii[0] == 0.2 && s.radii[1] == 0.2);
  // Thin below x = 0, thick above: the struts in the plane between are thick.
  const Ref<Structure> mixed = make_ref<MixedLattice>(
      grid, std::vector<UnitCell>{thin, thick},
      Parameter(
          Ref<const Field>(make_ref<GradientField>(Vec3{-0.1, 0, 0}, 0.0, Vec3{0.1, 0, 0}, 1.0))),
      Parameter(0.1));
  const std::vector<Strut> struts = struts_of({*mixed, {{{-2, -0.2, -0.2}, {2, 0.9, 0.9}}, true}});
  size_t planes = 0;
  for (const Strut& s : struts) {
    const double x = 0.5 * (s.a.x + s.b.x);
    planes += s.a.x == 0 && s.b.x == 0;
    assert_true(std::abs(s.radii[0] - (x >= 0 ? 0.2 : 0.05)) < 1e-15);
  }
  assert_true(planes > 0);
}

void struts_do_not_depend_on_threads(void**) {
  const Ref<Context> context = context_of(1);
  const Ref<Structure> foam = make_ref<Foam>(context, Neighbourhood{}, Parameter(0.1), 1.0,
                                             uint64_t{3}, FoamMethod::automatic);
  const Ref<Structure> lattice =
      make_ref<Lattice>(Neighbourhood{}, octet_unit_cell(), Parameter(0.1));
  for (const Structure* structure : {&*foam, &*lattice}) {
    const StrutQuery query{*structure, {{{-9, -8, -7}, {9, 10, 5}}, true}};
    const std::vector<Strut> one = struts_of(query), four = struts_of(query, 4);
    assert_int_equal(one.size(), four.size());
    assert_memory_equal(one.data(), four.data(), one.size() * sizeof one[0]);
  }
}

/// Of the struts that a cell of a foam owns, summed. Hosts may have stored ids.
constexpr uint64_t foam_ids = 0x9b7ed2c929fba560, foam_nodes = 0xb550070c72c4baff;

void ids_stay(void**) {
  const Ref<Structure> foam = make_ref<Foam>(context_of(1), Neighbourhood{}, Parameter(0.1), 1.0,
                                             uint64_t{1}, FoamMethod::automatic);
  uint64_t sum = 0, nodes = 0;
  for (const Strut& s : struts_of({*foam, {{{0, 0, 0}, {1, 1, 1}}, true}})) {
    sum += s.id.low ^ s.id.high;
    nodes += s.nodes[0].low ^ s.nodes[1].high;
  }
  if (sum != foam_ids || nodes != foam_nodes)
    fail_msg("the ids of a foam are now 0x%llx and 0x%llx", (unsigned long long)sum,
             (unsigned long long)nodes);
  const Ref<Structure> lattice =
      make_ref<Lattice>(Neighbourhood{}, bcc_unit_cell(), Parameter(0.1));
  const std::vector<Strut> struts = struts_of({*lattice, {{{2, 3, 4}, {2.3, 3.3, 4.3}}, true}});
  assert_int_equal(struts.size(), 1);
  assert_true(struts[0].cell == (CellIndex{2, 3, 4}));
  assert_true(struts[0].id.low == (2 | uint64_t{3} << 32));
  assert_true(static_cast<uint32_t>(struts[0].id.high) == 4);
}

/// A box with a hole.
Ref<const Shape> make_shape() {
  const Ref<const Shape> box(make_ref<BoxShape>(Box3{{0, 0, 0}, {6, 5, 4}}));
  const Ref<const Shape> ball(make_ref<SphereShape>(Vec3{3, 2.5, 2}, 1.3));
  return make_ref<BooleanShape>(BooleanShape::Operation::subtracted,
                                std::vector<Ref<const Shape>>{box, ball});
}

void pieces_are_what_is_inside(void**) {
  const Ref<const Shape> shape = make_shape();
  const Neighbourhood grid{{0.3, 0.1, -0.2}, {2.5, 2.7, 2.9}, {}};
  const Ref<Structure> lattice = make_ref<Lattice>(grid, octet_unit_cell(), Parameter(0.1));
  const Box3 box{{-1, -1, -1}, {7, 6, 5}};
  const std::vector<Strut> whole = struts_of({*lattice, {box, false}});
  const std::vector<Strut> pieces = struts_of({*lattice, {box, false}, &*shape});
  const std::vector<Strut> again = struts_of({*lattice, {box, false}, &*shape}, 3);
  assert_int_equal(pieces.size(), again.size());
  assert_memory_equal(pieces.data(), again.data(), pieces.size() * sizeof pieces[0]);
  // Its first piece has the id of the strut.
  const auto is_first_piece = [&](const Strut& piece) {
    return std::any_of(whole.begin(), whole.end(),
                       [&](const Strut& strut) { return strut.id == piece.id; });
  };
  Random random(5);
  size_t cut = 0, several = 0, n = 0;
  for (const Strut& s : whole) {
    const Vec3 way = s.b - s.a;
    const double size = length(way);
    // Its pieces come next.
    std::vector<std::array<double, 2>> parts;
    const auto along = [&](Vec3 p) { return dot(p - s.a, way) / (size * size); };
    const size_t first = n;
    for (; n < pieces.size() && pieces[n].cell == s.cell; ++n) {
      const Strut& piece = pieces[n];
      const double from = along(piece.a), to = along(piece.b);
      if (length(piece.a - (s.a + way * from)) > 1e-9) break;
      if (length(piece.b - (s.b + way * (to - 1))) > 1e-9) break;
      if (n == first && !(piece.id == s.id)) break;
      if (n > first && is_first_piece(piece)) break;
      parts.push_back({from, to});
      assert_true(from <= to);
      assert_true(shape->inside(piece.a) && shape->inside(piece.b));
      assert_int_equal(piece.cut[0], from > 1e-12);
      assert_int_equal(piece.cut[1], to < 1 - 1e-12);
      assert_true((piece.nodes[0] == s.nodes[0]) == !piece.cut[0]);
      assert_true((piece.nodes[1] == s.nodes[1]) == !piece.cut[1]);
      // Just beyond a cut end it is outside.
      const double beyond = 1e-9 / size;
      if (piece.cut[0]) assert_false(shape->inside(s.a + way * (from - beyond)));
      if (piece.cut[1]) assert_false(shape->inside(s.a + way * (to + beyond)));
      cut += piece.cut[0] || piece.cut[1];
    }
    several += parts.size() > 1;
    for (size_t i = 0; i < test_count(100); ++i) {
      const double t = random.unit();
      bool is_in = false, is_near = false;
      for (const auto& [from, to] : parts) {
        is_in = is_in || (t >= from && t <= to);
        is_near = is_near || std::abs(t - from) < 1e-8 || std::abs(t - to) < 1e-8;
      }
      if (!is_near && is_in != shape->inside(s.a + way * t)) fail_msg("a part is missing");
    }
  }
  assert_int_equal(n, pieces.size());
  assert_true(cut > 20 && several > 0);
}

void radii_at_cut_ends_are_those_of_the_field(void**) {
  const Ref<const Field> field = make_ref<GradientField>(Vec3{0, 0, 0}, 0.1, Vec3{6, 0, 0}, 0.4);
  const Ref<Structure> lattice =
      make_ref<Lattice>(Neighbourhood{{}, {2.2, 2.2, 2.2}, {}}, bcc_unit_cell(), Parameter(field));
  const Ref<const Shape> shape = make_shape();
  size_t cut = 0;
  for (const Strut& s : struts_of({*lattice, {{{-1, -1, -1}, {7, 6, 5}}, true}, &*shape})) {
    assert_true(s.radii[0] == field->at(s.a) && s.radii[1] == field->at(s.b));
    cut += s.cut[0] || s.cut[1];
  }
  assert_true(cut > 10);
}

void graphs_join_struts(void**) {
  const Ref<Context> context = context_of(2);
  const Ref<Structure> lattice =
      make_ref<Lattice>(Neighbourhood{}, kelvin_unit_cell(), Parameter(0.1));
  const Box3 box{{-0.01, -0.01, -0.01}, {7.99, 7.99, 7.99}};
  const StrutQuery query{*lattice, {box, true}};
  const std::vector<Strut> struts = struts_of(query);
  const StrutGraph graph(*context, query, nullptr);
  assert_int_equal(graph.ids().size(), struts.size());
  std::vector<int> degree(graph.nodes().size());
  for (size_t i = 0; i < struts.size(); ++i) {
    assert_true(graph.ids()[i] == struts[i].id);
    for (size_t end = 0; end < 2; ++end) {
      const uint32_t node = graph.ends()[i][end];
      assert_true(node < graph.nodes().size());
      assert_true(graph.nodes()[node] == (end ? struts[i].b : struts[i].a));
      assert_true(graph.node_ids()[node] == struts[i].nodes[end]);
      ++degree[node];
    }
  }
  // Four struts meet where truncated octahedra do.
  size_t inner = 0;
  for (size_t i = 0; i < degree.size(); ++i) {
    const Vec3 p = graph.nodes()[i];
    if (std::min(min_component(p), min_component(Vec3{8, 8, 8} - p)) < 0.6) continue;
    ++inner;
    assert_int_equal(degree[i], 4);
  }
  assert_true(inner > 1000);
  const uint64_t bytes = 56 * graph.ids().size() + 40 * graph.nodes().size();
  assert_int_equal(context->budget->held(), bytes);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(lattices_have_the_struts_of_their_unit_cell),
      cmocka_unit_test(the_thickest_of_equal_struts_counts),
      cmocka_unit_test(struts_do_not_depend_on_threads),
      cmocka_unit_test(ids_stay),
      cmocka_unit_test(pieces_are_what_is_inside),
      cmocka_unit_test(radii_at_cut_ends_are_those_of_the_field),
      cmocka_unit_test(graphs_join_struts),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
