// SPDX-License-Identifier: Apache-2.0
// Signed distances of shapes, clean or dirty, under every winding rule: the sign is that of
// inside(), no ball of their size holds a point on the other side, they change by no more than the
// distance of two points, and those of meshes that triangles bound are exact.
#include <limits>

#include "meshes.h"
#include "random.h"
#include "shape/mesh.h"
#include "shapes.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Distance from a point to a triangle by the region that it lies in. Source: Ericson, "Real-Time
/// Collision Detection", 2005, section 5.1.5.
double triangle_distance(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp),
               d5 = dot(ab, cp), d6 = dot(ac, cp);
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (d1 <= 0 && d2 <= 0) return length(ap);
  if (d3 >= 0 && d4 <= d3) return length(bp);
  if (d6 >= 0 && d5 <= d6) return length(cp);
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return length(ap - ab * (d1 / (d1 - d3)));
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return length(ap - ac * (d2 / (d2 - d6)));
  if (va <= 0 && d4 >= d3 && d5 >= d6)
    return length(bp - (c - b) * ((d4 - d3) / (d4 - d3 + d5 - d6)));
  return length(ap - ab * (vb / (va + vb + vc)) - ac * (vc / (va + vb + vc)));
}

double mesh_distance(const Mesh& mesh, Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles())
    least = std::min(least, triangle_distance(p, mesh.vertices()[t[0]], mesh.vertices()[t[1]],
                                              mesh.vertices()[t[2]]));
  return least;
}

bool has_inner_triangles(const ShapeRow& row) {
  for (const char* part :
       {"pair", "twice", "staircase", "positive", "open", "sheet", "one of two", "auto"})
    if (row.name.find(part) != std::string::npos) return true;
  return false;
}

/// Gradients by differences need digits that shapes far from the origin lack.
bool is_exact(const Shape& shape) {
  return max_magnitude(shape.bounds().min) < 1e3 && shape.is_exact_outside() &&
         shape.is_exact_inside() && !dynamic_cast<const Mesh*>(&shape);
}

void test_row(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const Box3 box = shape->bounds();
  const double extent = max_component(box.extent());
  const auto* mesh = dynamic_cast<const Mesh*>(shape.get());
  const Vec3 eighth = box.extent() * 0.125;
  Random random(9);
  Vec3 last = box.min;
  double last_distance = shape->distance(last);
  const size_t count = test_count(20000);
  for (size_t i = 0; i < count; ++i) {
    Vec3 p = random.in_box(box.grown(i % 8 ? 0.1 * extent : 2 * extent));
    if (i % 16 == 1)  // on faces, edges and corners
      for (int axis = 0; axis < 3; ++axis)
        p[axis] =
            box.min[axis] + std::round((p[axis] - box.min[axis]) / eighth[axis]) * eighth[axis];
    if (mesh && i % 16 == 2) p = mesh->vertices()[random.below(mesh->vertices().size())];
    const double d = shape->distance(p);
    const bool is_inside = shape->inside(p);
    const auto check = [&](const char* what, bool holds) {
      if (!holds)
        fail_msg("at (%.17g, %.17g, %.17g), inside %d, distance %.17g: %s", p.x, p.y, p.z,
                 is_inside, d, what);
    };
    check("the sign is wrong", is_inside ? d <= 0 : d > 0);
    check("it is not finite", std::isfinite(d));
    check("it changes too fast",
          !shape->has_steady_distance() ||
              std::abs(d - last_distance) <= length(p - last) + 1e-12 * extent);
    last = p;
    last_distance = d;
    // The least number stands for no distance at all.
    for (int n = 0; n < 4 && std::abs(d) > std::numeric_limits<double>::min(); ++n) {
      const Vec3 other =
          p + random.direction() * (std::abs(d) * (n < 2 ? 1 - 1e-12 : random.unit()));
      check("its ball meets the boundary", shape->inside(other) == is_inside);
    }
    if (i % 8 == 0 && mesh) {
      const double wanted = mesh_distance(*mesh, p);
      check("it is above that of the triangles", std::abs(d) <= wanted);
      // Where all triangles bound the solid the ray to the nearest one meets it; on other meshes
      // triangles may be farther than the bound only if they are open.
      if (mesh->facts().closed || !has_inner_triangles(row))
        check("it is not that of the triangles", std::abs(std::abs(d) - wanted) <= 1e-12 * extent);
    }
  }
}

/// Exact distances: from outside and inside, the ball of a distance a little larger meets the
/// boundary. In the direction of the gradient, which is that of the nearest point.
void test_exact(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const double extent = max_component(shape->bounds().extent());
  Random random(2);
  const size_t count = test_count(20000);
  size_t missed = 0;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 p = random.in_box(shape->bounds().grown(extent));
    const double d = shape->distance(p);
    Vec3 up;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 by;
      by[axis] = 1e-6 * extent;
      up[axis] = shape->distance(p + by) - shape->distance(p - by);
    }
    const Vec3 way = up * ((d > 0 ? -1 : 1) / length(up));
    // Inside next to a ridge the gradient is that of neither face.
    missed += shape->inside(p + way * (std::abs(d) + 1e-5 * extent)) == shape->inside(p);
  }
  if (missed > count / 200) fail_msg("%zu of %zu points are farther than they say", missed, count);
}

/// A mesh of 327,680 triangles, small and far from the origin or large, answers as its triangles.
void test_many_triangles(void**) {
  struct Place {
    double size;
    Vec3 at;
  };
  for (const Place& place :
       {Place{1, {}}, Place{1e-90, {}}, Place{1e95, {}}, Place{1e-3, {50, 9, -70}}}) {
    const int level = place.size == 1 && test_scale() >= 0.5 ? 7 : 4;
    TriangleSoup soup = icosphere(0.5, level);
    for (Vec3& v : soup.vertices) v = v * place.size + place.at;
    const Mesh mesh(soup, WindingRule::nonzero, std::make_shared<MemoryBudget>(uint64_t{0}));
    const double rounding = 1e-12 * (place.size + max_magnitude(place.at));
    Random random(4);
    for (size_t i = 0; i < 50; ++i) {
      const Vec3 p = random.in_box({{-1, -1, -1}, {1, 1, 1}}) * place.size + place.at;
      // Squares of such numbers are no numbers: in units of the size.
      double wanted = std::numeric_limits<double>::infinity();
      for (const Triangle& t : mesh.triangles()) {
        const double back = 1 / place.size;
        const auto vertex = [&](int k) { return mesh.vertices()[t[k]] * back; };
        wanted = std::min(wanted, triangle_distance(p * back, vertex(0), vertex(1), vertex(2)));
      }
      wanted *= place.size;
      const double d = mesh.distance(p);
      if (!(std::abs(std::abs(d) - wanted) <= rounding))
        fail_msg("size %g: distance %.17g, not %.17g", place.size, d, wanted);
      assert_true(mesh.inside(p) ? d <= 0 : d > 0);
    }
  }
}

/// Far away, the distance of a shape is that of its box, finite and no more than it is.
void test_far(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const Box3 box = shape->bounds();
  const double size = 2 + 4 * std::max(max_magnitude(box.min), max_magnitude(box.max));
  for (double far : {1e3, 1e17, 1e19, 1e21, 1e150, 1e300, 1.7e308})
    for (int axis = 0; axis < 3; ++axis)
      for (double sign : {-1.0, 1.0}) {
        Vec3 p{0.1, -0.1, 0.2};
        p[axis] = sign * far;
        const double d = shape->distance(p);
        assert_true(d > 0 && d <= far + size && d >= far - size - 1e-12 * far);
        const Vec3 all{sign * far, far, -far};
        const double e = shape->distance(all), wanted = std::sqrt(3.0) * (far / 2) * 2;
        assert_true(std::isfinite(e) && e > 0 && e <= wanted + 2 * size);
      }
}

/// Needles and specks: every triangle's own distance is a bound to 1e-7 of its length.
void test_slivers(void**) {
  Random random(6);
  for (int n = 0; n < static_cast<int>(test_count(2000)); ++n) {
    TriangleSoup soup;
    const Vec3 a = random.in_box({{-1, -1, -1}, {1, 1, 1}}), along = random.direction();
    const double width = std::pow(10.0, random.between(-17, 0));
    soup.vertices = {a, a + along, a + along * random.unit() + random.direction() * width};
    soup.triangles = {{0, 1, 2}, {0, 2, 1}};
    const Mesh mesh(soup, WindingRule::even_odd, std::make_shared<MemoryBudget>(uint64_t{0}));
    if (mesh.triangles().empty()) continue;
    for (int i = 0; i < 10; ++i) {
      const double s = random.unit(), t = random.unit() * (1 - s);
      const Vec3 on = soup.vertices[0] * (1 - s - t) + soup.vertices[1] * s + soup.vertices[2] * t;
      const double off = std::pow(10.0, random.between(-12, 1));
      const Vec3 p = on + random.direction() * off;
      const double d = std::abs(mesh.distance(p)), most = length(p - on);
      if (d > most) fail_msg("%.17g, but a point is %.17g away (width %g)", d, most, width);
    }
  }
}

}  // namespace

int main() {
  std::vector<ShapeRow> rows = shape_rows(), exact;
  for (const ShapeRow& row : rows)
    if (is_exact(*row.make())) exact.push_back(row);
  const CMUnitTest meshes[] = {cmocka_unit_test(test_many_triangles),
                               cmocka_unit_test(test_slivers)};
  return run_for_each("distances of shapes", rows, test_row) +
         run_for_each("far away", rows, test_far) +
         run_for_each("exact distances", exact, test_exact) +
         cmocka_run_group_tests(meshes, nullptr, nullptr);
}
