// SPDX-License-Identifier: Apache-2.0
// Rays that graze shapes. A ray that passes through a point of the shape, a little under its
// surface and along it, enters at that point or before; one that stays outside enters nowhere; and
// each entry is where membership changes. Over primitives near the origin and far away, also as
// slender as possible, placed ones, and the shapes of the suite whose rays are exact.
#include <algorithm>
#include <array>

#include "random.h"
#include "shape/placed.h"
#include "shape/primitive.h"
#include "shapes.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

std::vector<ShapeRow> primitives() {
  using Make = std::function<Ref<const Shape>(Vec3 by)>;
  const auto ball = [](Vec3 by) { return make_ref<SphereShape>(by, 0.75); };
  const auto cylinder = [](Vec3 from, Vec3 to, double radius) {
    return [=](Vec3 by) { return make_ref<CylinderShape>(from + by, to + by, radius); };
  };
  const auto box = [](Vec3 by) {
    return make_ref<BoxShape>(Box3{by - Vec3{0.5, 0.25, 0.3}, by + Vec3{0.5, 1, 0.375}});
  };
  const auto placed = [](Make make, std::array<double, 9> m) -> Make {
    return [=](Vec3 by) {
      return make_ref<PlacedShape>(make({}), Placement({m[0], m[1], m[2], by.x, m[3], m[4], m[5],
                                                        by.y, m[6], m[7], m[8], by.z}));
    };
  };
  const double c = std::cos(0.7), s = std::sin(0.7);
  const std::array<double, 9> turned{c, -s, 0, s, c, 0, 0, 0, 1},
      stretched{3, 0, 0, 0, 0.25, 0, 0, 0, -1}, sheared{1, 0.7, 0.2, -0.1, 0.8, 0.4, 0.3, 0, 1.1};
  const Make slanted = cylinder({-1, 0.3, 0.1}, {1, 1, 0.8}, 0.3);
  const std::pair<const char*, Make> shapes[] = {
      {"ball", ball},
      {"upright cylinder", cylinder({0, 0, -0.5}, {0, 0, 0.5}, 0.5)},
      {"slanted cylinder", slanted},
      {"slender cylinder", cylinder({-1, 0.3, 0.1}, {1, 1, 0.8}, 1e-3)},
      {"flat cylinder", cylinder({0, 0.001, 0}, {0, -0.001, 0.0005}, 1)},
      {"box", box},
      {"turned ball", placed(ball, turned)},
      {"turned cylinder", placed(slanted, turned)},
      {"ellipsoid", placed(ball, stretched)},
      {"sheared ball", placed(ball, sheared)},
      {"sheared cylinder", placed(slanted, sheared)},
      {"sheared box", placed(box, sheared)},
  };
  std::vector<ShapeRow> rows;
  for (const auto& [name, make] : shapes)
    for (const double away : {0.0, 1.0, 1e3, 1e5, 1e7}) {
      const Vec3 by = Vec3{1, -0.9, 0.8} * away;
      char text[64];
      snprintf(text, sizeof text, ", %g away", away);
      rows.push_back({name + std::string(text), [make = make, by] { return make(by); }, -1, 1});
    }
  return rows;
}

Vec3 unit_vector(Random& random) {
  for (;;) {
    const Vec3 d = random.in_box({{-1, -1, -1}, {1, 1, 1}});
    if (const double l = length(d); l > 0.1 && l < 1) return d * (1 / l);
  }
}

class Grazer {
 public:
  Grazer(const ShapeRow& row, const Shape& shape)
      : row_(row),
        shape_(shape),
        size_(max_component(shape.bounds().extent())),
        tolerance_(shape.ray_tolerance()),
        // The tolerance is 2^-36 of size and coordinates. Parts no deeper than 2^-50 of these may
        // be lost.
        deep_(0x1p-14 * tolerance_) {}

  /// A random ray that hits, and others along the surface there.
  void graze(Random& random) {
    const Vec3 target = random.in_box(shape_.bounds());
    Ray ray{target, unit_vector(random)};
    ray.origin = ray.at(-2 * size_);
    double t;
    if (!shape_.enter(ray, 0, 4 * size_, t, nullptr)) return;
    ++aimed;
    const Vec3 p = ray.at(t), normal = shape_.normal(ray, t);
    for (int n = 0; n < 4; ++n) {
      Vec3 along = unit_vector(random);
      along = along - normal * dot(along, normal);
      if (!(length(along) > 0.1)) continue;
      along = along * (1 / length(along));
      // Not only at the right angle: as the ray of an edge, or past a corner.
      if (n == 3) along = unit_vector(random);
      const double depth = std::exp2(-random.between(4, 46)) * size_;
      const double before = size_ * random.between(0.1, 3);
      const Vec3 through = p - normal * (n == 2 ? -depth : depth);
      check({through - along * before, along}, before);
    }
  }

  size_t aimed = 0, seen = 0, hits = 0;

 private:
  bool inside(Vec3 p) const { return shape_.inside(p); }

  bool is_deep(Vec3 p) const {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-deep_, deep_}) {
        Vec3 q = p;
        q[axis] += side;
        if (!inside(q)) return false;
      }
    return inside(p);
  }

  /// At t, in a part that may not be lost.
  bool is_seen(const Ray& ray, double t) const {
    for (const double away : {0.0, -1.0, -0.5, 0.5, 1.0})
      if (!is_deep(ray.at(t + away * tolerance_))) return false;
    return true;
  }

  void check(const Ray& ray, double middle) {
    const double to = middle + 3 * size_;
    double t = to;
    const bool found = shape_.enter(ray, 0, to, t, nullptr);
    const double end = found ? t : to;
    // All along, and about the graze on every scale.
    const auto sample = [&](double at) {
      if (at < tolerance_ || at > end - tolerance_ || !is_seen(ray, at)) return;
      fail_at(ray, end, "it is inside before", at);
    };
    for (int n = 0; n < 40; ++n) sample(end * n / 40);
    for (int n = 0; n < 34; ++n)
      for (const double side : {-1.0, 1.0}) sample(middle + side * size_ * std::exp2(-n));
    sample(middle);
    const bool is_inside = is_seen(ray, middle);
    seen += is_inside;
    if (is_inside && !(found && t <= middle)) fail_at(ray, end, "it is inside, and passed", middle);
    if (!found) return;
    ++hits;
    if (t < 0 || t > to) fail_at(ray, t, "out of range", t);
    if (!inside(ray.at(t)) && !inside(ray.at(t + tolerance_))) fail_at(ray, t, "outside", t);
    if (t > 2 * tolerance_) {
      bool changes = false;
      for (int n = -64; n < 64 && !changes; ++n)
        changes = inside(ray.at(t + tolerance_ * n / 64)) !=
                  inside(ray.at(t + tolerance_ * (n + 1) / 64));
      if (!changes) fail_at(ray, t, "membership does not change", t);
    }
    const double leaves = shape_.leave(ray, t, to, nullptr);
    if (!(leaves >= t && leaves <= to)) fail_at(ray, t, "it leaves out of range", leaves);
  }

  void fail_at(const Ray& ray, double t, const char* what, double at) const {
    fail_msg("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g), t %.17g: %s at %.17g",
             row_.name.c_str(), ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
             ray.direction.y, ray.direction.z, t, what, at);
  }

  const ShapeRow& row_;
  const Shape& shape_;
  const double size_, tolerance_, deep_;
};

void test_row(void** state) {
  const ShapeRow& row = *static_cast<const ShapeRow*>(*state);
  const Ref<const Shape> shape = row.make();
  Grazer grazer(row, *shape);
  Random random(31);
  const size_t rays = row.least < 0 ? std::max<size_t>(test_count(100), 40) : test_count(12) + 6;
  for (size_t i = 0; i < 300 * rays && grazer.aimed < rays; ++i) grazer.graze(random);
  // Of some meshes little is inside, and few of their rays come near a thick part.
  if (row.least < 0 || row.least > 0.1) assert_true(grazer.seen > 0 && grazer.hits > rays);
}

}  // namespace

int main() {
  std::vector<ShapeRow> rows = primitives();
  for (const ShapeRow& row : shape_rows()) {
    const auto has = [&](const char* word) { return row.name.find(word) != std::string::npos; };
    // Marched, dear, or nothing that is thick.
    const bool is_left_out =
        has("voxels") || has("host") || has("offset") || has("loose") || has("subtracted");
    if (!is_left_out) rows.push_back(row);
  }
  return run_for_each("shape_grazes", rows, test_row);
}
