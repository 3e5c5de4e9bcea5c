// SPDX-License-Identifier: Apache-2.0
// The order in which vectors cover the rows of a slanting solid.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "../unit/test_row_order.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/simd.h"
#include "msq_test.h"
#include "random.h"
#include "strut/row_order-inl.h"

#ifndef MSQ_TEST_ROW_ORDER
#define MSQ_TEST_ROW_ORDER
namespace {

using msq::RasterTarget;

/// Rows of y and z in steps about an axis from the origin to (y, z).
struct Box {
  double y, z, reach, row_step, layer_step;
  double first_row, first_layer;  // of the box, from the origin
  size_t rows, layers;

  RasterTarget target() const {
    RasterTarget target{};
    target.dy = row_step;
    target.dz = layer_step;
    target.inverse_dx = 1;
    target.row_words = 3;
    target.layer_words = 3 * rows + 5;
    return target;
  }
  /// Whether the row is within reach of the axis' line.
  bool is_near(size_t row, size_t layer) const {
    const double v = (first_row + static_cast<double>(row)) * row_step,
                 w = (first_layer + static_cast<double>(layer)) * layer_step;
    return std::abs(v * z - w * y) <= reach * std::hypot(y, z);
  }
};

/// A row and its first bit, in a vector.
struct FoundRow {
  size_t vector, row, layer;
  int32_t bit;
};
struct FoundRows {
  size_t lanes, vectors;
  bool by_layers;
  std::vector<FoundRow> rows;
};

}  // namespace
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

void find_rows(const Box& box, FoundRows& found) {
  using D = hn::ScalableTag<double>;
  const D d;
  const FullLanes df;
  constexpr size_t most = 2 * max_simd_doubles;
  const auto number = [&](double x) { return hn::Set(d, x); };
  const RasterTarget target = box.target();
  RowOrder<D> order(d, target, number(static_cast<double>(box.rows)),
                    number(static_cast<double>(box.layers)));
  order.follow_axis(d, target, number(box.first_row * box.row_step),
                    number(box.first_layer * box.layer_step), number(box.y), number(box.z),
                    number(box.reach));
  RowOrders<max_simd_doubles> orders;
  orders.set(d, target, order, 0);
  found = {hn::Lanes(df), static_cast<size_t>(orders.vectors[0]), orders.by_layers[0] != 0, {}};
  const RowVectors vectors(orders, 0);
  for (size_t n = 0; n < found.vectors; ++n) {
    RowVectors::V inner, outer;
    const auto in = vectors.find(n, inner, outer);
    HWY_ALIGN float row[most], layer[most], is_in[most];
    HWY_ALIGN int32_t bit[most];
    hn::Store(vectors.row(inner, outer), df, row);
    hn::Store(vectors.layer(inner, outer), df, layer);
    hn::Store(hn::IfThenElseZero(in, hn::Set(df, 1.0f)), df, is_in);
    hn::Store(vectors.bits(inner, outer), hn::RebindToSigned<FullLanes>(), bit);
    for (size_t i = 0; i < found.lanes; ++i)
      if (is_in[i] != 0)
        found.rows.push_back(
            {n, static_cast<size_t>(row[i]), static_cast<size_t>(layer[i]), bit[i]});
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {
HWY_EXPORT(find_rows);
}

using namespace msq;
using namespace msq::test;

namespace {

FoundRows rows_of(const Box& box) {
  FoundRows found;
  HWY_DYNAMIC_DISPATCH(find_rows)(box, found);
  return found;
}

/// The box about the axis, or a part of it.
Box random_box(Random& random) {
  Box box{};
  const double size = std::exp(random.between(-1, 6));
  box.y = random.below(8) ? random.between(-size, size) : 0;
  box.z = random.below(8) ? random.between(-size, size) : 0;
  box.reach = size * std::exp(random.between(-4, 1));
  box.row_step = random.below(2) ? 1 : std::exp(random.between(-1, 1));
  box.layer_step = random.below(2) ? 1 : std::exp(random.between(-1, 1));
  const auto place = [&](double to, double step, double& first, size_t& count) {
    const double shift = random.between(0, 1);
    double low = std::ceil((std::min(to, 0.0) - box.reach) / step - shift),
           high = std::floor((std::max(to, 0.0) + box.reach) / step - shift);
    if (random.below(3) == 0) low += std::floor(random.between(0, 0.5) * (high - low));
    if (random.below(3) == 0) high -= std::floor(random.between(0, 0.5) * (high - low));
    first = low + shift;
    count = high < low ? 0 : static_cast<size_t>(high - low) + 1;
  };
  place(box.y, box.row_step, box.first_row, box.rows);
  place(box.z, box.layer_step, box.first_layer, box.layers);
  return box;
}

void check_boxes() {
  Random random(71);
  size_t by_layers = 0, by_rows = 0, fewer = 0;
  for (int round = 0; round < 2000; ++round) {
    const Box box = random_box(random);
    if (box.rows * box.layers == 0 || box.rows * box.layers > 50'000) continue;
    const RasterTarget target = box.target();
    const FoundRows found = rows_of(box);
    const size_t most = (box.rows * box.layers + found.lanes - 1) / found.lanes;
    assert_true(found.vectors <= most);
    std::vector<int> times(box.rows * box.layers, 0);
    for (const FoundRow& each : found.rows) {
      assert_true(each.row < box.rows && each.layer < box.layers);
      assert_int_equal(each.bit,
                       64 * (each.layer * target.layer_words + each.row * target.row_words));
      ++times[each.layer * box.rows + each.row];
    }
    size_t beyond = 0;
    for (size_t k = 0; k < box.layers; ++k)
      for (size_t j = 0; j < box.rows; ++j) {
        const int here = times[k * box.rows + j];
        assert_true(here == 1 || (here == 0 && !box.is_near(j, k)));
        beyond += here && !box.is_near(j, k);
      }
    if (found.vectors < most) assert_true(beyond <= 2 * (found.by_layers ? box.layers : box.rows));
    fewer += 4 * found.vectors < 3 * most;
    (found.by_layers ? by_layers : by_rows) += found.vectors < most;
  }
  assert_true(fewer > 100 && by_layers > 100 && by_rows > 100);
}

/// Layers anywhere: a vector has rows of one layer.
void check_uneven_layers() {
  const Box box{3, 5, 1, 1, 0, -2, 0, 35, 4};
  const FoundRows found = rows_of(box);
  const size_t of_layer = (box.rows + found.lanes - 1) / found.lanes;
  assert_int_equal(found.vectors, of_layer * box.layers);
  assert_int_equal(found.rows.size(), box.rows * box.layers);
  for (const FoundRow& each : found.rows) assert_int_equal(each.layer, each.vector / of_layer);
}

template <void (*check)()>
void in_all_instruction_sets(void**) {
  for (int64_t all = hwy::SupportedTargets() & HWY_TARGETS; all; all &= all - 1) {
    hwy::SetSupportedTargetsForTest(all & -all);
    check();
    hwy::SetSupportedTargetsForTest(0);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      {"rows_near_the_axis_come_once", in_all_instruction_sets<check_boxes>, nullptr, nullptr,
       nullptr},
      {"vectors_stay_in_uneven_layers", in_all_instruction_sets<check_uneven_layers>, nullptr,
       nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
#endif
