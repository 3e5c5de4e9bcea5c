// SPDX-License-Identifier: Apache-2.0
// fill_rows of every shape, clean or dirty, under every winding rule, answers as inside() does: on
// grids whose rows run through vertices and along edges and whose layers lie in horizontal faces,
// and on grids that fit nothing.
#include <functional>

#include "bit_rows.h"
#include "meshes.h"
#include "random.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct ShapeRow {
  std::string name;
  std::function<Ref<const Shape>()> make;
  double least, most;  ///< part of the bounding box that is inside
};

TriangleSoup drop_triangles(TriangleSoup soup, size_t every) {
  std::vector<Triangle> kept;
  for (size_t i = 0; i < soup.triangles.size(); ++i)
    if (i % every != 1) kept.push_back(soup.triangles[i]);
  soup.triangles = kept;
  return soup;
}

/// Steps of horizontal and vertical faces: coplanar triangles at many heights, shared vertices.
TriangleSoup staircase() {
  TriangleSoup soup;
  for (int i = 0; i < 4; ++i) {
    const double x = 0.25 * i, z = 0.25 * (i + 1);
    append(soup, box_mesh({x, 0, 0}, {x + 0.25, 1, z}));
  }
  return soup;
}

/// Triangles in planes of x, y and z, with edges on the rows of a grid of 1/8, and slanted roofs.
TriangleSoup roof() {
  TriangleSoup soup;
  soup.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.5}, {0.5, 0.5, -0.5}};
  soup.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                    {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return soup;
}

std::vector<ShapeRow> shape_rows() {
  struct Soup {
    const char* name;
    TriangleSoup soup;
    double least, most;
  };
  const TriangleSoup cube = box_mesh({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const TriangleSoup ball = icosphere(0.5, 3), ring = torus_mesh(0.375, 0.125, 24, 12);
  std::vector<Soup> soups = {{"cube", cube, 1, 1},
                             {"off-grid box", box_mesh({-0.3, 0.1, -0.7}, {0.35, 0.77, 0.2}), 1, 1},
                             {"icosphere", ball, 0.4, 0.6},
                             {"octahedron on the grid", roof(), 0.2, 0.8},
                             {"torus", ring, 0.2, 0.8},
                             {"open icosphere", drop_triangles(ball, 9), 0, 1},
                             {"open cube", drop_triangles(cube, 12), 0, 1}};
  TriangleSoup pair = cube;
  append(pair, ball, {0.25, 0.125, 0.25});
  soups.push_back({"crossing pair", pair, 0.2, 0.9});
  TriangleSoup twice = cube;
  append(twice, cube);
  soups.push_back({"every triangle twice", twice, 0, 1});
  TriangleSoup hollow = cube;
  append(hollow, inside_out(box_mesh({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25})));
  soups.push_back({"hollow cube", hollow, 0.8, 0.95});
  TriangleSoup some_twice = ring;
  for (size_t i = 0; i < ring.triangles.size(); i += 5)
    some_twice.triangles.push_back(ring.triangles[i]);
  soups.push_back({"some triangles twice", some_twice, 0, 1});
  soups.push_back({"inside out", inside_out(ring), 0, 0.8});
  TriangleSoup mixed = inside_out(cube);
  append(mixed, cube, {0.5, 0.5, 0.5});
  soups.push_back({"one of two inside out", mixed, 0, 0.9});
  soups.push_back({"staircase of touching boxes", staircase(), 0.3, 0.8});
  TriangleSoup sheet = cube;
  sheet.triangles.resize(2);
  append(sheet, ball, {0, 0, 0.5});
  soups.push_back({"sheet and ball", sheet, 0, 0.9});

  std::vector<ShapeRow> rows;
  const char* rules[] = {"nonzero", "even-odd", "positive"};
  for (const Soup& s : soups)
    for (int rule = 0; rule < 3; ++rule)
      rows.push_back({std::string(s.name) + ", " + rules[rule],
                      [soup = s.soup, rule]() -> Ref<const Shape> {
                        return make_ref<Mesh>(soup, static_cast<WindingRule>(rule),
                                              std::make_shared<MemoryBudget>(uint64_t{0}));
                      },
                      s.least, s.most});
  const auto add = [&](const char* name, std::function<Ref<const Shape>()> make) {
    rows.push_back({name, std::move(make), 0.1, 1});
  };
  add("box", [] {
    return Ref<const Shape>(make_ref<BoxShape>(Box3{{-0.5, -0.25, 0}, {0.5, 1, 0.375}}));
  });
  add("sphere", [] { return Ref<const Shape>(make_ref<SphereShape>(Vec3{0.5, 0, -1}, 0.625)); });
  add("upright cylinder", [] {
    return Ref<const Shape>(make_ref<CylinderShape>(Vec3{0, 0, -0.5}, Vec3{0, 0, 0.5}, 0.5));
  });
  add("lying cylinder", [] {
    return Ref<const Shape>(make_ref<CylinderShape>(Vec3{-1, 0, 0}, Vec3{1, 0, 0}, 0.25));
  });
  add("slanted cylinder", [] {
    return Ref<const Shape>(make_ref<CylinderShape>(Vec3{-1, 0.3, 0.1}, Vec3{1, 1, 0.8}, 0.3));
  });
  return rows;
}

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
