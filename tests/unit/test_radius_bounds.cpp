// SPDX-License-Identifier: Apache-2.0
// Struts whose radius is a field: the bounds of their radii, and rows of samples.
#include "structure/common/radius_bounds.h"

#include "base/borrowed.h"
#include "bit_rows.h"
#include "expression/parser.h"
#include "field/expression.h"
#include "field/gradient.h"
#include "field/grid.h"
#include "field/host.h"
#include "field/map.h"
#include "field/radial.h"
#include "images.h"
#include "msq_test.h"
#include "random.h"
#include "structure/foam/foam.h"
#include "structure/lattice/lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

using FieldRef = Ref<const Field>;

struct NamedField {
  const char* name;
  FieldRef field;
  bool is_smooth;  // within a strut
};

FieldRef grid_field(ImageSize size, double step, const Rotation& rotation,
                    const std::function<double(Vec3)>& value) {
  return make_ref<GridField>(
      make_image(sampled<float>(size, value), size, {{-1, -1, -1}, {step, step, step}, rotation}));
}

FieldRef expression_field(const char* text, Interval range) {
  return make_ref<ExpressionField>(parse_expression(text, {}), range);
}

/// Between `low` and `high`, in space about the origin.
std::vector<NamedField> fields(double low, double high) {
  const auto between = [=](double part) { return low + (high - low) * part; };
  const auto wave = [=](Vec3 i) { return between(0.5 + 0.5 * std::sin(i.x + 0.7 * i.y - i.z)); };
  const auto jump = [=](Vec3 i) {
    return between(std::fmod(0.37 * i.x * i.x + 0.61 * i.y * i.z + 0.83 * i.z, 1));
  };
  char waves[200], kinks[200];
  std::snprintf(waves, sizeof waves, "%.17g + %.17g * sin(0.5*x) * cos(0.4*y + 0.3*z)",
                between(0.5), 0.5 * (high - low));
  std::snprintf(kinks, sizeof kinks, "%.17g + %.17g * abs(x - y) / (abs(z - 0.1) + 0.2)", low,
                high - low);
  HostFieldCalls calls;
  calls.evaluate = [=](const Vec3* points, size_t count, double* values) {
    for (size_t i = 0; i < count; ++i) values[i] = between(0.5 + 0.5 * std::sin(3 * points[i].x));
  };
  const FieldRef place = expression_field("sin(x) * cos(y) + 0.3*z", {-2, 2});
  return {
      {"linear", make_ref<GradientField>(Vec3{-3, -3, -3}, low, Vec3{3, 3, 3}, high), true},
      {"ramp", make_ref<GradientField>(Vec3{-0.2, 0, 0}, low, Vec3{0.3, 0.1, 0.1}, high), false},
      {"radial", make_ref<RadialField>(Vec3{5, 5, 4}, Vec3{}, RadialField::Ramp{1, high, 20, low}),
       true},
      {"about an axis",
       make_ref<RadialField>(Vec3{}, Vec3{1, 2, 1}, RadialField::Ramp{0.2, low, 1, high}), false},
      {"8^3 values", grid_field({8, 8, 8}, 0.3, {}, wave), false},
      {"20^3 values, turned", grid_field({20, 20, 20}, 0.1, skew_rotation(), wave), false},
      {"values that jump", grid_field({30, 30, 30}, 0.07, {}, jump), false},
      {"waves", expression_field(waves, {low, high}), true},
      {"kinks", expression_field(kinks, {low, high}), false},
      {"steep", expression_field("40*x - 39*x + sin(30*y)", {low, high}), false},
      {"map", make_ref<MapField>(place, Curve({{-1, low}, {0.1, between(0.9)}, {2, high}})), false},
      {"host's",
       make_ref<HostField>(calls, Interval{low, high}, std::numeric_limits<double>::infinity(),
                           true),
       false}};
}

SampleGrid samples_of(double spacing) {
  SampleGrid grid;
  grid.spacing = {spacing, spacing, spacing};
  grid.nx = grid.ny = grid.nz = 100;
  return grid;
}

/// Struts of about `length`, near each other.
void draw_struts(StrutBatch& batch, double length, Random& random) {
  batch.count = 0;
  const Vec3 corner = random.in_box(Box3{}.grown(1));
  const size_t count = 1 + random.below(StrutBatch::capacity);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 a = corner + random.in_box({{0, 0, 0}, Vec3{1, 1, 1} * (4 * length)});
    batch.push(a, a + random.in_box(Box3{}.grown(length)));
  }
}

/// Bounds hold wherever a strut may be, and are tight where the field is smooth.
void test_bounds(void**) {
  Random random(31);
  const Borrowed<StrutBatch> borrowed;
  StrutBatch& batch = *borrowed;
  for (const NamedField& row : fields(0.01, 0.06)) {
    const Parameter radius(row.field);
    const RadiusBounds bounds(radius, 1e-6, samples_of(0.001), Box3{}.grown(3));
    double departures = 0, spreads = 0;
    for (size_t n = 0; n < test_count(300); ++n) {
      const double factor = n % 3 ? 1 : random.between(0.3, 1);
      draw_struts(batch, n % 2 ? 0.1 : 0.3, random);
      bounds.set(batch, factor);
      for (size_t i = 0; i < batch.count; ++i) {
        const Vec3 a = batch.from(i), ab = batch.to(i) - a;
        const double most = batch.high[i];
        assert_true(batch.low[i] >= factor * radius.range().low);
        assert_true(most <= factor * radius.range().high);
        double low = 1, high = 0, departure = 0;
        for (int k = 0; k < 8; ++k) {
          const Vec3 axis = a + ab * (k < 2 ? k : random.unit());
          Vec3 away = random.in_box(Box3{}.grown(1));
          away = away * (most * random.unit() / length(away));
          const Vec3 p = axis + away;
          const double r = factor * radius.at(p);
          low = std::min(low, r);
          high = std::max(high, r);
          if (!(r >= batch.low[i] && r <= most))
            fail_msg("%s: radius %.17g is not within %.17g to %.17g", row.name, r, batch.low[i],
                     most);
          if (!batch.linear) continue;
          const double about = batch.at_a[i] + dot(batch.slope(i), p - a);
          const double bound = batch.departure_at(i, p - (a + ab * 0.5));
          if (!(std::abs(r - about) <= bound))
            fail_msg("%s: radius %.17g differs from %.17g by more than %.17g", row.name, r, about,
                     bound);
          departure += bound / 8;
        }
        spreads += 0.5 * (high - low);
        departures += batch.linear ? departure : 0.5 * (most - batch.low[i]);
      }
    }
    if (row.is_smooth && !(departures < 0.7 * spreads))
      fail_msg("%s: a departure of %g where radii differ by %g", row.name, departures, spreads);
  }
}

/// A radius that is 0, and one without a field.
void test_numbers(void**) {
  Random random(32);
  const Borrowed<StrutBatch> batch;
  for (double value : {0.0, 0.03}) {
    const Parameter number(value),
        field(make_ref<GradientField>(Vec3{}, value, Vec3{1, 0, 0}, value));
    for (const Parameter* radius : {&number, &field}) {
      draw_struts(*batch, 0.2, random);
      RadiusBounds(*radius, 1e-6, samples_of(0.003), Box3{}.grown(2)).set(*batch, 0.5);
      for (size_t i = 0; i < batch->count; ++i) {
        assert_true(batch->low[i] <= 0.5 * value && batch->low[i] > 0.5 * value - 1e-12);
        assert_true(batch->high[i] == 0.5 * value);
      }
    }
  }
}

/// Rows have the bits of single points.
void test_rows(void**) {
  const auto context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  Random random(33);
  size_t held = 0, asked = 0;
  for (bool is_turned : {false, true}) {
    Neighbourhood cells;
    cells.cell_size = {0.25, 0.25, 0.25};
    if (is_turned) cells.rotation = skew_rotation();
    for (const NamedField& row : fields(0, 0.05)) {
      const Parameter radius(row.field);
      const Ref<const Structure> structures[] = {
          make_ref<Foam>(context, cells, radius, 1.0, uint64_t{3}, FoamMethod::direct),
          make_ref<Lattice>(cells, octet_unit_cell(), radius, 0)};
      for (const Ref<const Structure>& structure : structures) {
        SampleGrid grid = samples_of(0.25 / random.between(12, 40));
        grid.origin = random.in_box(Box3{}.grown(1));
        grid.nx = 70 + random.below(60);
        grid.ny = grid.nz = 2 + test_count(20);
        BitRows rows(grid);
        for (uint64_t k = 0; k < grid.nz; ++k)
          for (uint64_t j = 0; j < grid.ny; ++j)
            for (uint64_t i = 0; i < grid.nx; ++i) rows.set(i, j, k);
        structure->keep_rows(rows.block(), nullptr);
        assert_int_equal(rows.damage(), 0);
        for (uint64_t k = 0; k < grid.nz; ++k)
          for (uint64_t j = 0; j < grid.ny; ++j)
            for (uint64_t i = 0; i < grid.nx; ++i) {
              const Vec3 p = grid.at(i, j, k);
              const bool is_inside = structure->inside(p);
              held += is_inside;
              ++asked;
              if (rows.get(i, j, k) != is_inside)
                fail_msg("%s: (%.17g, %.17g, %.17g) is %d alone, %d in a row", row.name, p.x, p.y,
                         p.z, is_inside, rows.get(i, j, k));
            }
      }
    }
  }
  assert_in_range(held, asked / 50, asked / 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_bounds), cmocka_unit_test(test_numbers),
                              cmocka_unit_test(test_rows)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
