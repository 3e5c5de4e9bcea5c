// SPDX-License-Identifier: Apache-2.0
// Rays through shapes agree with membership along them: at random, through vertices, along edges
// and faces, and along the axes.
#include "base/unit.h"
#include "flat_boundary.h"
#include "meshes.h"
#include "random.h"
#include "ray_check.h"
#include "shape/mesh.h"
#include "shapes.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Rays together are answered as each alone.
void check_together(const char* name, const Shape& shape, const std::vector<RaySearch>& searches) {
  std::vector<RaySearch> together = searches, found;
  shape.enter_all(together.data(), together.size(), nullptr);
  for (size_t i = 0; i < searches.size(); ++i) {
    const RaySearch& s = searches[i];
    double t = 0;
    const bool is_found = shape.enter(s.ray, s.from, s.to, t, nullptr);
    if (together[i].found != is_found || (is_found && together[i].t != t))
      fail_msg("%s: ray %zu enters at %.17g, with others at %.17g", name, i, t, together[i].t);
    double first = 0, end = 0;
    if (shape.cross(s.ray, s.from, s.to, first, end, nullptr) != is_found)
      fail_msg("%s: ray %zu enters, or crosses, but not both", name, i);
    if (!is_found) continue;
    found.push_back({s.ray, t, s.to, true, t});
    const double left = t > s.to ? t : shape.leave(s.ray, t, s.to, nullptr);
    if (first != t || end != left)
      fail_msg("%s: ray %zu crosses from %.17g to %.17g, but enters at %.17g and leaves at %.17g",
               name, i, first, end, t, left);
  }
  std::vector<RaySearch> left = found;
  shape.find_normals(found.data(), found.size());
  shape.leave_all(left.data(), left.size(), nullptr);
  for (size_t i = 0; i < found.size(); ++i) {
    assert_true(found[i].normal == shape.normal(found[i].ray, found[i].t));
    const double t = shape.leave(found[i].ray, found[i].from, found[i].to, nullptr);
    if (left[i].t != t)
      fail_msg("%s: ray %zu leaves at %.17g, with others at %.17g", name, i, t, left[i].t);
  }
}

/// Where normals of the points at which rays enter point to.
struct Normals {
  int outward = 0, inward = 0;
  Flatness flatness;

  void add(const Shape& shape, Vec3 p, Vec3 normal) {
    const double by =
        std::max(8 * shape.ray_tolerance(), 1e-6 * max_component(shape.bounds().extent()));
    const bool before = shape.inside(p + normal * by), behind = shape.inside(p - normal * by);
    outward += behind && !before;
    inward += before && !behind;
    flatness.add(is_flat_across(p, normal, 100 * by, [&](Vec3 q) { return shape.inside(q); }));
  }
};

void test_row(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  const Box3 box = shape->bounds();
  const Box3 around = box.grown(0.3 * max_component(box.extent()));
  Random random(5);
  int entries = 0;
  Normals normals;
  std::vector<RaySearch> searches;
  // Hosts' shapes are marched through by their distance, which is dear; so are images along the
  // faces of their cells.
  const bool is_image = row.name.rfind("voxels", 0) == 0;
  const bool is_marched = shape->gains_by_rays();
  const double reach = is_image ? 1.5 * max_component(box.extent()) : 3;
  const size_t count = test_count(is_marched ? 12 : 300);
  for (size_t i = 0; i < count; ++i) {
    Vec3 a = random.in_box(around), b = random.in_box(around);
    // On planes of symmetry, where vertices and edges are.
    const bool is_even = i % 3 == 0;
    if (is_even)
      for (int axis = 0; axis < 3; ++axis) {
        a[axis] = std::round(a[axis] * 8) / 8;
        b[axis] = std::round(b[axis] * 8) / 8;
      }
    if (i % 5 == 0) b[static_cast<int>(i % 3)] = a[static_cast<int>(i % 3)];
    if (i % 7 == 0) {
      b = a;
      b[static_cast<int>(random.below(3))] += i % 2 ? 1 : -1;
    }
    const double size = length(b - a);
    if (!(size > 0)) continue;
    const Ray ray{a, (b - a) * (1 / size)};
    searches.push_back({ray, random.between(-0.5, 0.5), random.between(-1, reach)});
    // Parts that are shorter than the steps of a march may be lost.
    const RayWalk walk{
        is_marched || (is_image && is_even) ? shape->min_ray_step() : shape->ray_tolerance(), 150};
    bool is_first = true;  // there may be many at one edge
    entries += check_ray(
        row.name.c_str(), ray, 0, reach, walk, [&](Vec3 p) { return shape->inside(p); },
        [&](const Ray& r, double from, double to, double& t) {
          if (!shape->enter(r, from, to, t, nullptr)) return false;
          const Vec3 normal = shape->normal(r, t);
          if (!(std::abs(length(normal) - 1) < 1e-9))
            fail_msg("a normal of length %.17g", length(normal));
          if (t > from && is_first) normals.add(*shape, r.at(t), normal);
          is_first = false;
          return true;
        },
        [&](const Ray& r, double from, double to) { return shape->leave(r, from, to, nullptr); });
  }
  // Some rules leave nothing of some meshes, some thresholds little of an image.
  if (row.least > (is_image ? 0.05 : 0) && !is_marched && count >= 60)
    assert_true(entries > static_cast<int>(count / 20));
  if (normals.inward * 50 > normals.outward)
    fail_msg("%d normals point out, and %d in", normals.outward, normals.inward);
  // Normals of the host's shapes are estimates; an image of bits also has sheets without thickness.
  const bool is_estimate =
      row.name.find("host's") != std::string::npos || row.name.rfind("voxels, bits", 0) == 0;
  if (!is_estimate && normals.flatness.are_most_tilted())
    fail_msg("%zu normals are tilted, %zu are not", normals.flatness.tilted,
             normals.flatness.straight);
  check_together(row.name.c_str(), *shape, searches);
}

/// A face with a needle along an edge. Rounding moves the needle's plane, where membership does not
/// change.
void needles_are_entered_where_membership_changes(void**) {
  const Rotation turn = turned_twice();
  TriangleSoup soup;
  for (const Vec3 v :
       {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 1, 0}, Vec3{0.4, 1e-9, 0}, Vec3{0.5, 0.3, -1}})
    soup.vertices.push_back(turn.apply(v) + Vec3{0.3, 0.1, -0.2});
  soup.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 1}, {1, 4, 2}, {2, 4, 0}};
  const Ref<const Mesh> mesh =
      make_ref<Mesh>(soup, WindingRule::automatic, std::make_shared<MemoryBudget>(uint64_t{0}));
  const Vec3 a = soup.vertices[0], b = soup.vertices[1], c = soup.vertices[3];
  const Vec3 way = unit_along(turn.apply({0.1, 0.7, -0.7}));
  for (int i = 1; i < 40; ++i) {
    const Vec3 p = a + (b - a) * (0.02 * i) + (c - a) * 0.2;
    double t = 0;
    assert_true(mesh->enter({p - way, way}, 0, 3, t, nullptr));
    if (!(std::abs(t - 1) <= 2 * mesh->ray_tolerance())) fail_msg("ray %d enters at %.17g", i, t);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(needles_are_entered_where_membership_changes)};
  std::vector<ShapeRow> rows = shape_rows();
  return cmocka_run_group_tests_name("rays at needles", tests, nullptr, nullptr) +
         run_for_each("shape_rays", rows, test_row);
}
