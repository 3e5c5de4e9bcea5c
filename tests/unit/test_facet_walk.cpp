// SPDX-License-Identifier: Apache-2.0
// The edges of bricks by both walks: over Delaunay tetrahedra, and over Voronoi cells.
#include <hwy/highway.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/edges/edge_builder.h"
#include "structure/foam/edges/facet_walk.h"

using namespace msq;
using namespace msq::test;

namespace {

double apart(const float (&a)[3], const float (&b)[3]) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) most = std::max(most, std::abs(double(a[axis]) - b[axis]));
  return most;
}
double apart(const FloatSegment& l, const FloatSegment& r) {
  return std::min(std::max(apart(l.a, r.a), apart(l.b, r.b)),
                  std::max(apart(l.a, r.b), apart(l.b, r.a)));
}
/// Edges so short that rounding decides whether they exist.
bool is_short(const FloatSegment& s) {
  return apart(s.a, s.b) < 2 * edge_error;
}

/// Compares run by run; returns the number of edges.
size_t compare(const SegmentSet& expected, const SegmentSet& got) {
  assert_int_equal(got.runs(), expected.runs());
  for (size_t run = 0; run < got.runs(); ++run) {
    std::vector<FloatSegment> rest;
    for (size_t i = got.run_start(run); i < got.run_end(run); ++i) {
      rest.push_back(got.at(i));
      for (int axis = 0; axis < 3; ++axis)
        for (const float p : {rest.back().a[axis], rest.back().b[axis]}) {
          assert_true(got.bound(axis)[run] <= p);
          assert_true(got.bound(axis + 3)[run] >= p);
        }
    }
    for (size_t i = expected.run_start(run); i < expected.run_end(run); ++i) {
      size_t best = rest.size();
      double least = 2 * edge_error;
      for (size_t j = 0; j < rest.size(); ++j)
        if (const double d = apart(expected.at(i), rest[j]); d <= least) {
          least = d;
          best = j;
        }
      if (best == rest.size()) {
        if (!is_short(expected.at(i))) fail_msg("run %d lacks an edge", int(run));
        continue;
      }
      rest.erase(rest.begin() + static_cast<ptrdiff_t>(best));
    }
    for (const FloatSegment& s : rest)
      if (!is_short(s)) fail_msg("run %d has an edge too many", int(run));
  }
  return got.count();
}

void assert_same(const SegmentSet& a, const SegmentSet& b) {
  assert_int_equal(a.count(), b.count());
  for (size_t i = 0; i < a.count(); ++i) {
    const FloatSegment l = a.at(i), r = b.at(i);
    assert_memory_equal(&l, &r, sizeof l);
  }
}

void test_random_grids(void**) {
  const auto walk = std::make_unique<FacetWalk>();
  Random random(21);
  const Vec3 scales[] = {{1, 1, 1}, {1, 0.8, 0.9}, {0.8, 1, 1}, {0.6, 0.6, 1}, {1, 1, 0.75}};
  size_t bricks = 0, refused = 0, edges = 0;
  for (const double jitter : {1.0, 0.7, 0.5, 0.2, 0.05, 0.02})
    for (const Vec3 scale : scales)
      for (size_t n = test_count(3); n > 0; --n) {
        const FoamSeeds seeds(random.bits(), jitter, scale);
        assert_true(FacetWalk::suits(seeds));
        const auto place = [&] {
          return static_cast<int32_t>(random.below(uint64_t{1} << (n == 1 ? 31 : 5))) - 16;
        };
        const CellIndex corner{place(), place(), place()};
        ++bricks;
        if (!walk->build(seeds, corner)) {
          ++refused;
          continue;
        }
        edges += compare(EdgeBrick::by_cells(seeds, corner).segments(), walk->segments());
      }
  print_message("%zu edges of %zu bricks; %zu bricks refused\n", edges, bricks, refused);
  assert_true(8 * refused <= bricks);
}

/// Owner, and the two other seeds from it.
using Triple = std::array<int, 9>;

/// Those that the seeds own.
std::map<Triple, FloatSegment> edges_of(const FacetWalk& walk, const Owners& owners) {
  std::map<Triple, FloatSegment> edges;
  walk.for_each_edge([&](const FacetWalk::Edge& edge) {
    const auto &o = edge.owner, &a = edge.others[0], &b = edge.others[1];
    if (!owners.hold({{o[0], o[1], o[2]}, {o[0] + 1, o[1] + 1, o[2] + 1}})) return;
    FloatSegment segment;
    for (int axis = 0; axis < 3; ++axis) {
      segment.a[axis] = walk.vertex(edge.ends[0])[axis];
      segment.b[axis] = walk.vertex(edge.ends[1])[axis];
    }
    const Triple triple{o[0], o[1], o[2], a[0], a[1], a[2], b[0], b[1], b[2]};
    assert_true(edges.emplace(triple, segment).second);
  });
  return edges;
}

/// Compares a brick of 4^3 cells edge by edge, by their seeds. Returns the number of edges.
size_t compare_small(const FoamSeeds& seeds, CellIndex corner, const FacetWalk& walk) {
  constexpr int side = 4;
  EdgeBuilder builder;
  builder.build(seeds, corner, side, true);
  const Vec3 middle = seeds.scale() * (0.5 * side);
  std::map<Triple, FloatSegment> rest = edges_of(walk, Owners::all(side));
  assert_int_equal(rest.size(), walk.count());
  const BrickSeeds& block = builder.block();
  bool is_known = true;
  for (size_t e = 0; e < builder.ends().size(); ++e) {
    FloatSegment expected;
    const Vec3 a = builder.vertex(builder.ends()[e][0]) - middle,
               b = builder.vertex(builder.ends()[e][1]) - middle;
    for (int axis = 0; axis < 3; ++axis) {
      expected.a[axis] = static_cast<float>(a[axis]);
      expected.b[axis] = static_cast<float>(b[axis]);
    }
    const std::array<uint32_t, 3>& names = builder.seeds()[e];
    is_known &= names[0] != names[1];
    if (is_short(expected) || names[0] == names[1]) continue;
    const auto &own = block.cell(names[0]), &one = block.cell(std::min(names[1], names[2])),
               &two = block.cell(std::max(names[1], names[2]));
    const auto found =
        rest.find({own[0], own[1], own[2], one[0] - own[0], one[1] - own[1], one[2] - own[2],
                   two[0] - own[0], two[1] - own[1], two[2] - own[2]});
    assert_true(found != rest.end());
    assert_true(apart(found->second, expected) <= 2 * edge_error);
    rest.erase(found);
  }
  for (const auto& [triple, segment] : rest) assert_true(!is_known || is_short(segment));
  return walk.count();
}

/// Bricks of 4^3 cells, with the seeds of edges.
void test_small_bricks(void**) {
  const auto walk = std::make_unique<FacetWalk>();
  Random random(22);
  size_t bricks = 0, refused = 0, edges = 0;
  for (const double jitter : {1.0, 0.5, 0.05})
    for (const Vec3 scale : {Vec3{1, 1, 1}, Vec3{1, 0.8, 0.9}, Vec3{0.6, 0.6, 1}})
      for (size_t n = test_count(20); n > 0; --n) {
        const FoamSeeds seeds(random.bits(), jitter, scale);
        const auto place = [&] { return static_cast<int32_t>(random.below(64)) - 32; };
        const CellIndex corner{place(), place(), place()};
        ++bricks;
        if (walk->build(seeds, corner, 4))
          edges += compare_small(seeds, corner, *walk);
        else
          ++refused;
      }
  print_message("%zu edges of %zu bricks; %zu bricks refused\n", edges, bricks, refused);
  assert_true(8 * refused <= bricks);
}

/// The edges of some seeds of a brick are those that the whole brick has of them.
void test_parts(void**) {
  const auto walk = std::make_unique<FacetWalk>();
  Random random(23);
  size_t parts = 0, refused = 0, edges = 0;
  for (const double jitter : {1.0, 0.5, 0.05})
    for (const Vec3 scale : {Vec3{1, 1, 1}, Vec3{1, 0.8, 0.9}})
      for (size_t n = test_count(30); n > 0; --n) {
        const FoamSeeds seeds(random.bits(), jitter, scale);
        const auto place = [&] { return static_cast<int32_t>(random.below(64)) - 32; };
        const CellIndex corner{place(), place(), place()};
        Owners owners = Owners::all(FacetWalk::side);
        for (int axis = 0; axis < 3; ++axis) {
          if (random.below(2)) continue;
          owners.low[axis] = static_cast<int>(random.below(FacetWalk::side));
          const auto room = static_cast<uint64_t>(FacetWalk::side - owners.low[axis]);
          owners.high[axis] = owners.low[axis] + 1 + static_cast<int>(random.below(room));
        }
        ++parts;
        if (!walk->build(seeds, corner)) {
          ++refused;
          continue;
        }
        const std::map<Triple, FloatSegment> expected = edges_of(*walk, owners);
        assert_true(walk->build(seeds, corner, FacetWalk::side, owners));
        const std::map<Triple, FloatSegment> found = edges_of(*walk, owners);
        assert_int_equal(found.size(), walk->count());
        assert_int_equal(found.size(), expected.size());
        for (const auto& [triple, segment] : expected) {
          assert_true(found.count(triple));
          assert_true(apart(found.at(triple), segment) <= 2 * edge_error);
        }
        edges += found.size();
      }
  print_message("%zu edges of %zu parts; %zu bricks refused\n", edges, parts, refused);
  assert_true(8 * refused <= parts);
}

/// A seed of the brick whose tetrahedra have no other seed of it.
void test_island(void**) {
  const auto walk = std::make_unique<FacetWalk>();
  const FoamSeeds seeds(5, 1, {0.75, 1, 0.75});
  const CellIndex corner{1400, 0, 0};
  assert_true(walk->build(seeds, corner));
  compare(EdgeBrick::by_cells(seeds, corner).segments(), walk->segments());
}

/// The same numbers, whichever vector instructions find them.
void test_instruction_sets(void**) {
  const auto walk = std::make_unique<FacetWalk>();
  const FoamSeeds seeds(5, 1, {1, 0.9, 0.8});
  assert_true(walk->build(seeds, {3, -5, 100}));
  const SegmentSet expected = walk->segments();
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    const bool is_built = walk->build(seeds, {3, -5, 100});
    hwy::SetSupportedTargetsForTest(0);
    assert_true(is_built);
    assert_same(walk->segments(), expected);
  }
}

/// What the walk refuses, the brick has from the walk over cells.
void test_refused(void**) {
  const auto walk = std::make_unique<FacetWalk>();
  struct Case {
    double jitter;
    Vec3 scale;
  };
  for (const Case& c : {Case{0, {1, 1, 1}}, Case{1e-9, {1, 1, 1}}, Case{1e-4, {1, 1, 1}},
                        Case{0.01, {1, 1, 1}}, Case{1, {1, 1, 0.25}}, Case{1, {1. / 9, 1. / 3, 1}},
                        Case{0.5, {0.25, 0.25, 1}}, Case{0, {1, 0.5, 0.75}}}) {
    const FoamSeeds seeds(3, c.jitter, c.scale);
    const CellIndex corner{-4, 7, 1};
    const EdgeBrick by_cells = EdgeBrick::by_cells(seeds, corner), brick(seeds, corner);
    const SegmentSet& expected = by_cells.segments();
    if (c.jitter > 0) compare(expected, brick.segments());
    // Also where no caller tries it: it refuses, or finds all edges.
    if (walk->build(seeds, corner)) {
      assert_true(c.jitter > 1e-5);
      compare(expected, walk->segments());
      continue;
    }
    assert_same(brick.segments(), expected);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_grids),     cmocka_unit_test(test_island),
      cmocka_unit_test(test_small_bricks),     cmocka_unit_test(test_parts),
      cmocka_unit_test(test_instruction_sets), cmocka_unit_test(test_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
