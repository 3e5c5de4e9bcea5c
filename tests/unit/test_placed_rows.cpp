// SPDX-License-Identifier: Apache-2.0
// Rows of placed meshes answer as inside() does: on grids of units in the last place about placed
// vertices, edges and faces, where all is rounding; on grids whose samples lie in faces, edges and
// vertices; and on others, for every winding rule. So do layers of meshes in turned frames.
#include <cmath>
#include <utility>

#include "base/unit.h"
#include "bit_rows.h"
#include "meshes.h"
#include "msq_test.h"
#include "random.h"
#include "shape/mesh.h"
#include "shape/placed.h"
#include "slice/framed_model.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr WindingRule rules[] = {WindingRule::nonzero, WindingRule::even_odd, WindingRule::positive,
                                 WindingRule::automatic};

/// Boxes that touch, overlap and lie within each other, one of them inside out, and a torus.
TriangleSoup boxes_and_ring() {
  TriangleSoup soup;
  for (int i = 0; i < 4; ++i) {
    const double x = 0.25 * i;
    append(soup, box_mesh({x, 0, 0}, {x + 0.25, 1, 0.25 * (i + 1)}));
  }
  append(soup, box_mesh({0.125, 0.25, 0}, {0.875, 0.75, 0.5}));
  append(soup, inside_out(box_mesh({0.25, 0.375, 0.125}, {0.75, 0.625, 0.375})));
  append(soup, torus_mesh(0.375, 0.125, 12, 8), {0.5, 0.5, 0.5});
  return soup;
}

Ref<const Shape> placed(const TriangleSoup& soup, WindingRule rule, const Placement& placement) {
  return make_ref<PlacedShape>(
      make_ref<Mesh>(soup, rule, std::make_shared<MemoryBudget>(uint64_t{0})), placement);
}

/// Returns how many samples are inside.
uint64_t check(const Shape& shape, const SampleGrid& grid) {
  BitRows rows(grid);
  shape.fill_rows(rows.block());
  assert_int_equal(rows.damage(), 0);
  uint64_t inside = 0;
  for (uint64_t k = 0; k < grid.nz; ++k)
    for (uint64_t j = 0; j < grid.ny; ++j)
      for (uint64_t i = 0; i < grid.nx; ++i) {
        const Vec3 p = grid.at(i, j, k);
        const bool expected = shape.inside(p);
        inside += expected;
        if (rows.get(i, j, k) != expected)
          fail_msg("(%.17g, %.17g, %.17g) is %s", p.x, p.y, p.z, expected ? "inside" : "outside");
      }
  return inside;
}

SampleGrid grid_of(Vec3 origin, Vec3 spacing, uint64_t count) {
  SampleGrid grid;
  grid.origin = origin;
  grid.spacing = spacing;
  grid.nx = grid.ny = grid.nz = count;
  return grid;
}

/// Orthonormal, right-handed.
std::array<Vec3, 3> random_axes(Random& random) {
  const Vec3 u = random.direction(), v = unit_along(cross(u, random.direction()));
  return {u, v, cross(u, v)};
}

Placement random_placement(Random& random) {
  const std::array<Vec3, 3> axes = random_axes(random);
  const double scale = random.between(0.3, 3) * (random.between(0, 1) < 0.5 ? -1 : 1);
  const double far = random.between(0, 1) < 0.3 ? 1e4 : 2;
  std::array<double, 12> matrix;
  for (size_t i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix[4 * i + static_cast<size_t>(j)] = scale * axes[i][j];
    matrix[4 * i + 3] = random.between(-far, far);
  }
  return Placement(matrix);
}

void test_units_in_the_last_place(void**) {
  const TriangleSoup soup = boxes_and_ring();
  Random random(1);
  uint64_t inside = 0, outside = 0;
  for (size_t n = 0; n < test_count(400); ++n) {
    const Placement placement = random_placement(random);
    const Ref<const Shape> shape = placed(soup, rules[n % 4], placement);
    const Triangle& t = soup.triangles[random.below(soup.triangles.size())];
    const Vec3 a = soup.vertices[t[0]], b = soup.vertices[t[1]], c = soup.vertices[t[2]];
    const double u = random.between(0, 1), v = random.between(0, 1 - u);
    for (const Vec3 q : {a, a + (b - a) * u, a + (b - a) * u + (c - a) * v}) {
      const Vec3 p = placement.to_placed(q);
      const double unit = 0x1p-52 * max_magnitude(p);
      // Wider ones have a spacing at which few samples are near.
      const double spacing = unit * std::exp2(random.between(0, 12));
      const SampleGrid grid =
          grid_of(p - Vec3{1, 1, 1} * (3 * spacing), Vec3{1, 1, 1} * spacing, 7);
      const uint64_t found = check(*shape, grid);
      inside += found;
      outside += 7 * 7 * 7 - found;
    }
  }
  assert_true(inside > 0 && outside > 0);
}

// Signed permutations: rows and layers run within faces, along edges and through vertices.
void test_samples_on_faces(void**) {
  const TriangleSoup soup = boxes_and_ring();
  uint64_t inside = 0;
  for (int order = 0; order < 6; ++order)
    for (int signs = 0; signs < 8; ++signs) {
      const int axes[3] = {order % 3, (order % 3 + 1 + order / 3) % 3,
                           (order % 3 + 2 - order / 3) % 3};
      std::array<double, 12> matrix{};
      for (int i = 0; i < 3; ++i) {
        const bool is_back = signs >> i & 1;
        matrix[static_cast<size_t>(4 * i + axes[i])] = is_back ? -1 : 1;
        matrix[static_cast<size_t>(4 * i + 3)] = is_back ? 1 : 0;
      }
      const Ref<const Shape> shape = placed(soup, rules[signs % 4], Placement(matrix));
      inside += check(*shape, grid_of({-0.125, -0.125, -0.125}, {0.0625, 0.0625, 0.0625}, 21));
    }
  assert_true(inside > 0);
}

void test_any_samples(void**) {
  const TriangleSoup soup = boxes_and_ring();
  Random random(2);
  for (size_t n = 0; n < test_count(40); ++n) {
    const Placement placement = random_placement(random);
    const Ref<const Shape> shape = placed(soup, rules[n % 4], placement);
    const Box3 box = shape->bounds();
    const uint64_t count = 3 + random.below(40);
    const Vec3 spacing = box.extent() * (1.1 / static_cast<double>(count));
    const Vec3 origin = box.min - spacing * random.between(0, 1);
    assert_true(check(*shape, grid_of(origin, spacing, count)) > 0 || count < 10);
  }
}

// A map that all but flattens the mesh moves points by far more than rounding does elsewhere.
void test_maps_of_poor_condition(void**) {
  const TriangleSoup soup = boxes_and_ring();
  Random random(3);
  for (size_t n = 0; n < test_count(40); ++n) {
    const double thin = random.between(3e-6, 1e-4);
    const Placement placement(
        {1, 1, 0, 0.3, 1, 1 + thin, 0.2, -1, 0.1, 0, random.between(0.5, 1), 2});
    const Ref<const Shape> shape = placed(soup, rules[n % 4], placement);
    const Triangle& t = soup.triangles[random.below(soup.triangles.size())];
    const Vec3 p = placement.to_placed(soup.vertices[t[n % 3]]);
    for (const double spacing : {1e-15, 1e-13, 1e-11, 1e-7, 1e-2})
      check(*shape, grid_of(p - Vec3{3, 3, 3} * spacing, Vec3{1, 1, 1} * spacing, 7));
  }
}

void test_layers_in_frames(void**) {
  const TriangleSoup soup = boxes_and_ring();
  const Ref<Context> context = make_ref<Context>(1u, uint64_t{1} << 20, uint64_t{0});
  Random random(4);
  uint64_t inside = 0;
  for (size_t n = 0; n < test_count(100); ++n) {
    // Every other one is also placed.
    const Placement placement = random_placement(random);
    const Ref<const Shape> mesh =
        n % 2 ? placed(soup, rules[n / 2 % 4], placement)
              : Ref<const Shape>(make_ref<Mesh>(soup, rules[n / 2 % 4],
                                                std::make_shared<MemoryBudget>(uint64_t{0})));
    const Ref<const Model> model =
        make_ref<Model>(context, mesh, std::vector<Ref<const Structure>>{});
    LayerFrame frame;
    frame.axes = random_axes(random);
    if (n % 3 == 0) std::swap(frame.axes[0], frame.axes[1]);
    frame.origin = random.in_box({{-9, -9, -9}, {9, 9, 9}});
    const Ref<const Model> framed = make_framed_model(*model, frame);
    const Vec3 vertex = soup.vertices[random.below(soup.vertices.size())];
    const Vec3 p = frame.from_model(n % 2 ? placement.to_placed(vertex) : vertex);
    for (const double spacing : {0x1p-50, 0x1p-46, 0x1p-40, 0.05})
      inside +=
          check(framed->shape(), grid_of(p - Vec3{3, 3, 3} * spacing, Vec3{1, 1, 1} * spacing, 7));
  }
  assert_true(inside > 0);
}

}  // namespace

int main(void) {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_units_in_the_last_place),
      cmocka_unit_test(test_samples_on_faces),
      cmocka_unit_test(test_any_samples),
      cmocka_unit_test(test_maps_of_poor_condition),
      cmocka_unit_test(test_layers_in_frames),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
