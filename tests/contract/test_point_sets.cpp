// SPDX-License-Identifier: Apache-2.0
// Foams answer sets of points as they answer each alone: whatever the order, type and spread of the
// points, the chunks and the threads; at large radii and low jitters; and on grids of few samples a
// cell.
#include <algorithm>
#include <cstring>

#include "field/gradient.h"
#include "query/array_points.h"
#include "query/membership.h"
#include "random.h"
#include "round_to_float.h"
#include "shape/primitive.h"
#include "structure/foam/sets/point_set.h"
#include "structure/lattice/lattice.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct SetRow {
  std::string name;
  Neighbourhood grid;
  double radius;  // of the largest cell size
  double jitter;
  size_t rows = 0, index = 0;

  double unit() const { return max_component(grid.cell_size); }
  Ref<const Foam> make(Parameter parameter) const {
    return make_ref<Foam>(shared_context(), grid, std::move(parameter), jitter, uint64_t{11},
                          FoamMethod::direct);
  }
};

std::vector<SetRow> set_rows() {
  std::vector<SetRow> rows;
  for (const GridVariant& variant : grid_variants(false))
    for (double radius : {0.05, 0.1, 0.26, 0.5, 0.9})
      for (double jitter : {0.0, 0.01, 1.0}) {
        char name[96];
        std::snprintf(name, sizeof name, "r %g jitter %g %s", radius, jitter, variant.name.c_str());
        rows.push_back({name, variant.grid, radius, jitter});
      }
  for (size_t i = 0; i < rows.size(); ++i) {
    rows[i].rows = rows.size();
    rows[i].index = i;
  }
  return rows;
}

void check_points(const Foam& foam, const std::vector<Vec3>& points) {
  std::vector<uint8_t> alive(points.size());
  for (size_t i = 0; i < alive.size(); ++i) alive[i] = i % 16 != 15;
  foam.keep_points(points.data(), alive.data(), points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const uint8_t expected = i % 16 != 15 && foam.inside(points[i]);
    if (alive[i] != expected)
      fail_msg("(%.17g, %.17g, %.17g): alone %d, in a set %d", points[i].x, points[i].y,
               points[i].z, expected, alive[i]);
  }
}

/// Sets in boxes of many and of few cells a point, with a constant and with a varying radius.
void sets_answer_as_points_do(void** state) {
  const SetRow& row = *static_cast<const SetRow*>(*state);
  Random random(row.index + 1);
  const double radius = row.radius * row.unit();
  const auto field =
      make_ref<GradientField>(row.grid.origin, 0.0, row.grid.from_grid(Vec3{3, 2, 1}), radius);
  const Ref<const Foam> foams[] = {row.make(Parameter(radius)),
                                   row.make(Parameter(Ref<const Field>(field)))};
  const size_t count = test_count(1000000) / row.rows / 6 + 1;
  for (const auto& foam : foams)
    for (const double side : {1.0, 5.0, 40.0}) {
      const Vec3 corner = random.in_box({{-50, -50, -50}, {50, 50, 50}});
      std::vector<Vec3> points;
      for (size_t i = 0; i < count; ++i)
        points.push_back(row.grid.from_grid(
            (corner + random.in_box({{0, 0, 0}, {side, side, side}})) * row.grid.cell_size));
      check_points(*foam, points);
    }
}

/// Rows of a grid with a pitch in cells, some samples of which are dead.
void check_rows(const Foam& foam, Vec3 pitch, Vec3 corner, uint64_t side, Random& random) {
  const double heights[] = {0.1, 0.4, 0.45, 1.7, 2.3, 2.4};
  SampleGrid grid;
  grid.nx = side + 7;
  grid.ny = side / 2;
  grid.nz = 6;
  grid.spacing = pitch * foam.unit();
  grid.origin = corner * foam.unit();
  if (pitch.x == pitch.y) grid.heights = heights;
  const size_t row_words = words_for(grid.nx);
  std::vector<uint64_t> words(row_words * grid.ny * grid.nz);
  for (uint64_t& word : words) word = random.below(4) ? ~uint64_t{0} : random.bits();
  for (size_t w = row_words - 1; w < words.size(); w += row_words)
    words[w] &= ~uint64_t{0} >> (bits_per_word - grid.nx % bits_per_word);
  RowBlock block{&grid, 1, grid.ny, 1, grid.nz, words.data(), row_words, row_words * grid.ny};
  const std::vector<uint64_t> before = words;
  foam_keep_rows_by_point(foam, block, nullptr);
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const size_t word = (k - block.z0) * block.layer_stride +
                            (j - block.y0) * block.row_stride + i / bits_per_word;
        const uint64_t bit = uint64_t{1} << i % bits_per_word;
        const bool is_inside = (before[word] & bit) != 0 && foam.inside(grid.at(i, j, k));
        if (((words[word] & bit) != 0) != is_inside)
          fail_msg("sample (%d, %d, %d), pitch %g: %d", int(i), int(j), int(k), pitch.x,
                   !is_inside);
      }
}

void rows_answer_as_points_do(void** state) {
  const SetRow& row = *static_cast<const SetRow*>(*state);
  if (row.radius > 0.5 && row.jitter == 0) return;  // slow one by one, and all inside
  Random random(row.index + 1);
  const auto field = make_ref<GradientField>(Vec3{0, 0, 0}, 0.0, Vec3{9, 5, 3} * row.unit(),
                                             row.radius * row.unit());
  const Ref<const Foam> foams[] = {row.make(Parameter(row.radius * row.unit())),
                                   row.make(Parameter(Ref<const Field>(field)))};
  const auto side = static_cast<uint64_t>(std::max(10.0, 120 * std::sqrt(test_scale())));
  const Vec3 corner = random.in_box({{-50, -50, -50}, {50, 50, 50}});
  check_rows(*foams[0], {0.5, 0.5, 0.5}, corner, side, random);
  check_rows(*foams[1], {0.3, 0.21, 0.4}, corner, side, random);
  check_rows(*foams[0], {3.7, 0.9, 1.3}, corner, side / 2, random);  // cells without samples
  check_rows(*foams[0], {50000.25, 40000, 3000}, corner, 16, random);
}

/// Axes in another order and direction.
Rotation swapped() {
  return {{0, 0, -1, -1, 0, 0, 0, 1, 0}};
}

void rows_of_turned_cells_answer_as_points_do(void**) {
  Random random(5);
  for (const Vec3 cell : {Vec3{1, 1, 1}, Vec3{0.5, 1, 0.75}}) {
    const SetRow row{"", {{0.1, 0.2, 0.3}, cell, swapped()}, 0.2, 1};
    check_rows(*row.make(Parameter(0.2)), {0.5, 0.4, 0.3}, {1, 2, 3}, 100, random);
  }
}

// ---- arrays of a model

struct ArrayModel {
  Ref<Context> context;
  Ref<const Model> model;
  Scales resolved;

  explicit ArrayModel(unsigned threads, uint64_t limit = 0, bool is_nested = false)
      : context(make_ref<Context>(threads, uint64_t{1} << 26, limit, true)) {
    const Neighbourhood grid{{0.1, 0.2, 0.3}, {0.07, 0.07, 0.07}, swapped()};
    std::vector<Ref<const Structure>> structures;
    if (is_nested)
      structures.push_back(make_ref<Lattice>(Neighbourhood{{}, {0.5, 0.5, 0.5}, {}},
                                             cubic_unit_cell(), Parameter(0.12)));
    structures.push_back(
        make_ref<Foam>(context, grid, Parameter(0.009), 1.0, uint64_t{3}, FoamMethod::direct));
    model = make_ref<Model>(context, make_ref<SphereShape>(Vec3{0.5, 0.5, 0.5}, 0.7),
                            std::move(structures));
    resolved = model->resolved(0);
  }
  std::vector<uint8_t> ask(const PointArray& array) const {
    std::vector<uint8_t> inside(array.count + 1, 7);
    set_membership(*model, resolved, ArrayPoints(array), {}, inside.data(), nullptr);
    assert_int_equal(inside.back(), 7);
    inside.pop_back();
    return inside;
  }
  std::vector<uint8_t> ask(const std::vector<Vec3>& points) const { return ask(array_of(points)); }
  static PointArray array_of(const std::vector<Vec3>& points) {
    return {reinterpret_cast<const unsigned char*>(points.data()), points.size(), sizeof(Vec3),
            false};
  }
  void assert_answers(const std::vector<Vec3>& points) const {
    const std::vector<uint8_t> inside = ask(points);
    for (size_t i = 0; i < points.size(); ++i)
      if (inside[i] != model->inside(points[i], resolved))
        fail_msg("point %d of %d differs", int(i), int(points.size()));
  }
};

std::vector<Vec3> random_points(size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> points;
  for (size_t i = 0; i < count; ++i) points.push_back(random.in_box({{-0.2, 0, 0}, {1, 1, 1.1}}));
  return points;
}

void every_count_is_answered(void**) {
  const ArrayModel plain(2), nested(2, 0, true);
  for (size_t count : {0, 1, 2, 511, 512, 4095, 4096, 4097, 8193, 32767, 32769, 100001}) {
    plain.assert_answers(random_points(test_count(count), count));
    nested.assert_answers(random_points(test_count(count), count));
  }
  plain.assert_answers({});
}

void order_and_threads_change_nothing(void**) {
  // More than a chunk.
  const std::vector<Vec3> points = random_points(test_count(4500000), 1);
  std::vector<uint32_t> order(points.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::make_pair(std::floor(points[a].z * 30), points[a].x) <
           std::make_pair(std::floor(points[b].z * 30), points[b].x);
  });
  std::vector<Vec3> sorted;
  for (const uint32_t i : order) sorted.push_back(points[i]);
  const std::vector<uint8_t> expected = ArrayModel(1).ask(points);
  for (unsigned threads : {2u, 5u}) {
    const ArrayModel model(threads);
    assert_true(model.ask(points) == expected);
    const std::vector<uint8_t> by_order = model.ask(sorted);
    for (size_t i = 0; i < order.size(); ++i) assert_int_equal(by_order[i], expected[order[i]]);
  }
  const auto held = std::count(expected.begin(), expected.end(), 1);
  assert_in_range(held, points.size() / 100, points.size() / 2);
}

void strides_and_types_change_nothing(void**) {
  const std::vector<Vec3> points = random_points(test_count(50000), 2);
  const ArrayModel model(2);
  constexpr size_t stride = 37;
  std::vector<unsigned char> wide(points.size() * stride), single(points.size() * 12);
  std::vector<Vec3> rounded;
  for (size_t i = 0; i < points.size(); ++i) {
    std::memcpy(&wide[i * stride], &points[i], sizeof(Vec3));
    const float p[3] = {float(points[i].x), float(points[i].y), float(points[i].z)};
    std::memcpy(&single[i * 12], p, sizeof p);
    rounded.push_back(
        {round_to_float(points[i].x), round_to_float(points[i].y), round_to_float(points[i].z)});
  }
  assert_true(model.ask({wide.data(), points.size(), stride, false}) == model.ask(points));
  assert_true(model.ask({single.data(), points.size(), 12, true}) == model.ask(rounded));
}

void any_spread_is_answered(void**) {
  const ArrayModel model(2);
  Random random(3);
  // All in one cell; and those with a few far away, outside the shape and inside.
  std::vector<Vec3> points;
  for (size_t i = 0; i < test_count(30000); ++i)
    points.push_back(random.in_box({{0.5, 0.5, 0.5}, {0.51, 0.51, 0.51}}));
  model.assert_answers(points);
  points.push_back({-0.1, 0.4, 0.5});
  points.push_back({1e15, -1e15, 1e300});
  points.push_back({0.5, 1.1, 0.9});
  model.assert_answers(points);
  // A million cells across.
  const Ref<Context> context = make_ref<Context>(2u, uint64_t{1} << 26, uint64_t{0});
  const auto foam = make_ref<Foam>(context, Neighbourhood{}, Parameter(0.2), 1.0, uint64_t{3},
                                   FoamMethod::direct);
  const Ref<const Model> wide = make_ref<Model>(context, make_ref<SphereShape>(Vec3{0, 0, 0}, 1e6),
                                                std::vector<Ref<const Structure>>{foam});
  points.clear();
  for (size_t i = 0; i < test_count(20000); ++i)
    points.push_back(random.in_box({{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}}));
  std::vector<uint8_t> inside(points.size());
  set_membership(*wide, wide->resolved(0), ArrayPoints(ArrayModel::array_of(points)), {},
                 inside.data(), nullptr);
  for (size_t i = 0; i < points.size(); ++i)
    assert_int_equal(inside[i], wide->inside(points[i], wide->resolved(0)));
}

void memory_stays_within_the_limit(void**) {
  const std::vector<Vec3> points = random_points(test_count(300000), 4);
  const std::vector<uint8_t> expected = ArrayModel(2).ask(points);
  constexpr uint64_t limit = 1500000;
  const ArrayModel tight(2, limit);
  assert_true(tight.ask(points) == expected);
  assert_in_range(tight.context->budget->peak(), 1, limit);
  assert_int_equal(tight.context->budget->held(), 0);
}

}  // namespace

int main() {
  std::vector<SetRow> rows = set_rows();
  const CMUnitTest tests[] = {
      cmocka_unit_test(rows_of_turned_cells_answer_as_points_do),
      cmocka_unit_test(every_count_is_answered),
      cmocka_unit_test(order_and_threads_change_nothing),
      cmocka_unit_test(strides_and_types_change_nothing),
      cmocka_unit_test(any_spread_is_answered),
      cmocka_unit_test(memory_stays_within_the_limit),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  return failed + run_for_each("sets", rows, sets_answer_as_points_do) +
         run_for_each("rows", rows, rows_answer_as_points_do);
}
