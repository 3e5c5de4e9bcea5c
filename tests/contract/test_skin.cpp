// SPDX-License-Identifier: Apache-2.0
// The skin under a shape: its rows, and those and the points of a scale that leaves it, are what
// the definition says of each sample; distances have the sign of membership, and no ball of their
// size holds a point of the shape on the other side. Over all shapes; thickness constant, graded,
// nothing in places, and by a field of which nothing is known but its range.
#include <limits>

#include "bit_rows.h"
#include "field/gradient.h"
#include "model/scale.h"
#include "random.h"
#include "shapes.h"
#include "structure/lattice/lattice.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Jumps between two values, and says nothing of how fast.
class StepField final : public Field {
 public:
  StepField(double low, double high) : low_(low), high_(high) {}
  double at(Vec3 p) const override {
    return std::sin(40 * p.x) * std::cos(30 * p.y + 20 * p.z) > 0 ? high_ : low_;
  }
  Interval range() const override { return {low_, high_}; }
  Interval range(const Box3& box) const override {
    const Vec3 p = box.min;
    return box.min == box.max ? Interval{at(p), at(p)} : range();
  }
  void describe(HashInput&) const override {}

 private:
  double low_, high_;
};

struct Thickness {
  const char* name;
  std::function<Parameter(const Box3&)> make;
};

Parameter gradient(const Box3& box, double from, double to) {
  const double extent = max_component(box.extent());
  return Parameter(
      Ref<const Field>(make_ref<GradientField>(box.min, from * extent, box.max, to * extent)));
}

const Thickness thicknesses[] = {
    {"thin", [](const Box3& b) { return Parameter(0.004 * max_component(b.extent())); }},
    {"a sixteenth", [](const Box3& b) { return Parameter(max_component(b.extent()) / 16); }},
    {"thick", [](const Box3& b) { return Parameter(0.21 * max_component(b.extent())); }},
    {"all through", [](const Box3& b) { return Parameter(2 * max_component(b.extent())); }},
    {"graded", [](const Box3& b) { return gradient(b, 0.01, 0.2); }},
    {"steeply graded from nothing", [](const Box3& b) { return gradient(b, 0, 3); }},
    {"in steps",
     [](const Box3& b) {
       const double extent = max_component(b.extent());
       return Parameter(Ref<const Field>(make_ref<StepField>(0, 0.07 * extent)));
     }},
};

/// Samples on the eighths of the box and next to it, or anywhere, fine or coarse, as flat as one
/// layer.
SampleGrid make_grid(const Box3& box, size_t samples, size_t index, Random& random) {
  const Vec3 extent = box.extent();
  SampleGrid grid;
  const double side = std::cbrt(static_cast<double>(samples));
  const double stretch[][3] = {{1, 1, 1}, {2, 1, 0.5}, {8, 1.0 / 8, 1}, {1.0 / 4, 1, 4}};
  const double* s = stretch[index % 4];
  uint64_t counts[3];
  for (int axis = 0; axis < 3; ++axis) {
    counts[axis] = static_cast<uint64_t>(side * s[axis]) + 1;
    grid.spacing[axis] = 1.1 * extent[axis] / static_cast<double>(counts[axis]);
    grid.origin[axis] = box.min[axis] - 0.04 * extent[axis];
    if (index % 3 == 0) {  // on eighths
      const double step = extent[axis] / 8;
      grid.spacing[axis] = step / std::max(1.0, std::floor(step / grid.spacing[axis]));
      grid.origin[axis] = box.min[axis] - grid.spacing[axis];
    } else {
      grid.origin[axis] += grid.spacing[axis] * random.unit();
    }
  }
  if (index % 5 == 4) {  // one layer, finer
    grid.origin.z = box.min.z + random.unit() * extent.z;
    counts[2] = 1;
    for (int axis = 0; axis < 2; ++axis) {
      counts[axis] *= 4;
      grid.spacing[axis] *= 0.25;
    }
  }
  grid.nx = counts[0];
  grid.ny = counts[1];
  grid.nz = counts[2];
  return grid;
}

BitRows like(const BitRows& rows) {
  const RowBlock& b = rows.block();
  return BitRows(*b.grid, b.y0, b.y1, b.z0, b.z1);
}

template <class Visit>
void for_samples(const RowBlock& block, Visit&& visit) {
  for (uint64_t k = block.z0; k < block.z1; ++k)
    for (uint64_t j = block.y0; j < block.y1; ++j)
      for (uint64_t i = 0; i < block.grid->nx; ++i) visit(i, j, k);
}

void check_rows(const Shape& shape, const Scale& scale, const SampleGrid& grid,
                const char* thickness) {
  const uint64_t y0 = grid.ny > 8 ? 1 : 0, z0 = grid.nz > 8 ? 2 : 0;
  BitRows alive(grid, y0, grid.ny, z0, grid.nz);
  shape.fill_rows(alive.block());
  BitRows skin = like(alive);
  scale.skin.mark_rows(alive.block(), skin.block(), nullptr);
  assert_int_equal(skin.damage(), 0);
  std::vector<Vec3> points;
  std::vector<uint8_t> kept;
  for_samples(alive.block(), [&](uint64_t i, uint64_t j, uint64_t k) {
    const Vec3 p = grid.at(i, j, k);
    const bool in_shape = alive.get(i, j, k);
    const bool wanted = in_shape && scale.skin.holds(p);
    if (skin.get(i, j, k) != wanted)
      fail_msg("skin %s: (%.17g, %.17g, %.17g), depth %.17g: alone %d, in a row %d", thickness, p.x,
               p.y, p.z, shape.depth(p), wanted, skin.get(i, j, k));
    points.push_back(p);
    kept.push_back(in_shape);
  });
  scale.keep_points(points.data(), kept.data(), points.size());
  BitRows whole = like(alive);
  shape.fill_rows(whole.block());
  scale.keep_rows(whole.block(), nullptr);
  assert_int_equal(whole.damage(), 0);
  size_t n = 0;
  for_samples(alive.block(), [&](uint64_t i, uint64_t j, uint64_t k) {
    const Vec3 p = grid.at(i, j, k);
    const bool wanted = alive.get(i, j, k) && scale.inside(p);
    if (kept[n++] != wanted || whole.get(i, j, k) != wanted)
      fail_msg("scale with skin %s: (%.17g, %.17g, %.17g): alone %d, in an array %d, in a row %d",
               thickness, p.x, p.y, p.z, wanted, kept[n - 1], whole.get(i, j, k));
  });
}

void check_distance(const Shape& shape, const Scale& scale, const char* thickness, Random& random) {
  const size_t count = test_count(400);
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = random.in_box(shape.bounds());
    if (!shape.inside(p)) continue;
    const double d = scale.distance(p, shape.depth(p));
    const bool is_inside = scale.inside(p);
    const auto check = [&](const char* what, bool holds) {
      if (!holds)
        fail_msg("skin %s: at (%.17g, %.17g, %.17g), inside %d, distance %.17g: %s", thickness, p.x,
                 p.y, p.z, is_inside, d, what);
    };
    check("the sign is wrong", is_inside ? d <= 0 : d > 0);
    check("it is not finite", std::isfinite(d));
    for (int n = 0; n < 4 && std::abs(d) > std::numeric_limits<double>::min(); ++n) {
      const double part = n < 2 ? 1 - 1e-12 : random.unit();
      const Vec3 other = p + random.direction() * (std::abs(d) * part);
      if (shape.inside(other))
        check("its ball meets the boundary", scale.inside(other) == is_inside);
    }
  }
}

void test_row(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const Box3 box = shape->bounds();
  const double cell = max_component(box.extent()) / 3;
  Neighbourhood grid;
  grid.origin = box.min;
  grid.cell_size = {cell, cell, cell};
  const Ref<const Structure> lattice =
      make_ref<Lattice>(grid, bcc_unit_cell(), Parameter(0.12 * cell));
  Random random(3);
  static size_t index = 0;  // another grid for each row and thickness
  for (const Thickness& t : thicknesses) {
    const Scale scale{lattice, Skin(shape, t.make(box))};
    check_rows(*shape, scale, make_grid(box, test_count(6000), index++, random), t.name);
    check_distance(*shape, scale, t.name, random);
  }
}

}  // namespace

int main() {
  std::vector<ShapeRow> rows = shape_rows();
  return run_for_each("skin", rows, test_row);
}
