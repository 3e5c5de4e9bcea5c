// SPDX-License-Identifier: Apache-2.0
// fill_rows of every shape, clean or dirty, under every winding rule, answers as inside() does: on
// grids whose rows run through vertices and along edges and whose layers lie in horizontal faces,
// and on grids that fit nothing.
#include "bit_rows.h"
#include "random.h"
#include "shape/mesh.h"
#include "shapes.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Outcome {
  size_t samples = 0, differ = 0, held = 0;
};

void compare(const Shape& shape, const SampleGrid& grid, Outcome& outcome) {
  BitRows rows(grid, 1, grid.ny, 1, grid.nz);
  shape.fill_rows(rows.block());
  assert_int_equal(rows.damage(), 0);
  for (uint64_t k = 1; k < grid.nz; ++k)
    for (uint64_t j = 1; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const Vec3 p = grid.at(i, j, k);
        const bool is_inside = shape.inside(p);
        ++outcome.samples;
        outcome.held += is_inside;
        if (rows.get(i, j, k) == is_inside) continue;
        if (!outcome.differ++)
          print_error("(%.17g, %.17g, %.17g): alone %d, in a row %d\n", p.x, p.y, p.z, is_inside,
                      !is_inside);
      }
}

void test_row(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const Box3 box = shape->bounds();
  const Vec3 extent = box.extent();
  Random random(3);
  Outcome outcome;
  // The box's own corners, and eighths, sixteenths and tenths of it, with one sample around.
  std::vector<double> parts = {8, 16, 10, 24};
  if (test_scale() < 0.5) parts = {8, 10};
  for (double part : parts) {
    SampleGrid grid;
    grid.spacing = extent * (1 / part);
    grid.origin = box.min - grid.spacing * Vec3{1, 2, 2};
    grid.nx = static_cast<uint64_t>(part) + 3;
    grid.ny = grid.nz = static_cast<uint64_t>(part) + 5;
    compare(*shape, grid, outcome);
    grid.origin = grid.origin + grid.spacing * random.in_box({{0, 0, 0}, {1, 1, 1}});
    grid.nx *= 3;
    grid.spacing.x /= 3;
    compare(*shape, grid, outcome);
  }
  // A part of a finer one: of holes, samples far from their edges compared with the spacing.
  if (row.name.ends_with(", auto")) {
    SampleGrid grid;
    grid.spacing = extent * (1.0 / 64);
    grid.origin = box.min + grid.spacing * Vec3{-1, 23, 23};
    grid.nx = 67;
    grid.ny = grid.nz = 18;
    compare(*shape, grid, outcome);
  }
  // Rows and layers through the vertices themselves, whatever they are; x on one of them.
  const auto* mesh = dynamic_cast<const Mesh*>(shape.get());
  for (int n = 0; mesh && n < static_cast<int>(test_count(40)); ++n) {
    const auto& vertices = mesh->vertices();
    const Vec3 v = vertices[random.below(vertices.size())];
    std::vector<double> heights;
    for (int k = 0; k < 6; ++k) heights.push_back(vertices[random.below(vertices.size())].z);
    heights.push_back(v.z);
    std::sort(heights.begin(), heights.end());
    SampleGrid grid;
    grid.heights = heights.data();
    grid.nz = heights.size();
    grid.nx = 67;
    grid.spacing = {extent.x / 40, extent.y / 7, 1};
    grid.origin = {v.x - 20 * grid.spacing.x, v.y, 0};
    grid.ny = 5;
    if (n % 2) {  // downwards from the vertex
      grid.ny = 2;
      grid.origin.y = v.y - grid.spacing.y;
    }
    compare(*shape, grid, outcome);
  }
  if (outcome.differ) fail_msg("%zu of %zu samples differ", outcome.differ, outcome.samples);
  // The shape is there at all: its part of random points of the box.
  size_t held = 0;
  const size_t count = 20000;
  for (size_t i = 0; i < count; ++i) held += shape->inside(random.in_box(box));
  const double part = static_cast<double>(held) / static_cast<double>(count);
  if (part < row.least || part > row.most) fail_msg("%g of the box is inside", part);
}

}  // namespace

int main() {
  std::vector<ShapeRow> rows = shape_rows();
  return run_for_each("shapes", rows, test_row);
}
