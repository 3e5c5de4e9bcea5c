// SPDX-License-Identifier: Apache-2.0
// Contours against exact sections: the section of each strut as a polygon, all of them united by
// CGAL and cut by the window.
#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
// The above before assert_*.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/pi.h"
#include "random.h"
#include "rings.h"
#include "shape/primitive.h"
#include "slice/contours.h"
#include "structure/foam/foam.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"
#include "suite.h"

namespace msq::test {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polygon = CGAL::Polygon_2<Kernel>;
using PolygonSet = CGAL::Polygon_set_2<Kernel>;

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

struct Strut {
  Vec3 a, b;
  double radius;

  double squared_distance(Vec3 p) const {
    const Vec3 d = b - a;
    const double size2 = dot(d, d);
    const double t = size2 > 0 ? std::clamp(dot(p - a, d) / size2, 0.0, 1.0) : 0;
    const Vec3 off = p - a - d * t;
    return dot(off, off);
  }
};

/// The section of a strut with the plane z: a convex polygon with its corners on the boundary, no
/// farther from it than `fine`. Fewer than three corners: there is none.
std::vector<RingPoint> section_of(const Strut& s, double z, double fine) {
  // The axis point nearest to the plane is about the middle of the section.
  const double d = s.b.z - s.a.z;
  const double t = d != 0 ? std::clamp((z - s.a.z) / d, 0.0, 1.0) : 0.5;
  const Vec3 on = s.a + (s.b - s.a) * t;
  const Vec3 middle{on.x, on.y, z};
  if (!(s.squared_distance(middle) < s.radius * s.radius)) return {};
  const auto corner = [&](double angle) {
    const Vec3 way{std::cos(angle), std::sin(angle), 0};
    double in = 0, out = 2 * (s.radius + std::sqrt(dot(s.b - s.a, s.b - s.a)));
    for (int i = 0; i < 50; ++i) {
      const double m = 0.5 * (in + out);
      (s.squared_distance(middle + way * m) <= s.radius * s.radius ? in : out) = m;
    }
    return RingPoint{middle.x + way.x * in, middle.y + way.y * in};
  };
  std::vector<RingPoint> ring;
  const std::function<void(double, RingPoint, double, RingPoint, int)> refine =
      [&](double a, RingPoint p, double b, RingPoint q, int depth) {
        const double m = 0.5 * (a + b);
        const RingPoint r = corner(m);
        const double size = std::hypot(q.u - p.u, q.v - p.v);
        // Long chords may be near the boundary at one end alone.
        const bool is_short = size <= 0.125 * s.radius;
        if (depth > 20 || (is_short && std::abs(cross(q - p, r - p)) <= fine * size)) return;
        refine(a, p, m, r, depth + 1);
        ring.push_back(r);
        refine(m, r, b, q, depth + 1);
      };
  constexpr int sides = 8;
  for (int i = 0; i < sides; ++i) {
    const double a = 2 * pi * i / sides + 0.1, b = 2 * pi * (i + 1) / sides + 0.1;
    ring.push_back(corner(a));
    refine(a, corner(a), b, corner(b), 0);
  }
  return ring;
}

Polygon polygon_of(const std::vector<RingPoint>& ring) {
  Polygon polygon;
  for (const RingPoint p : ring) polygon.push_back({p.u, p.v});
  return polygon;
}

std::vector<RingPoint> ring_of(const Polygon& polygon) {
  std::vector<RingPoint> ring;
  for (auto p = polygon.vertices_begin(); p != polygon.vertices_end(); ++p)
    ring.push_back({CGAL::to_double(p->x()), CGAL::to_double(p->y())});
  return ring;
}

double distance(RingPoint p, RingPoint a, RingPoint b) {
  const RingPoint d = b - a;
  const double size2 = dot(d, d);
  const double t = size2 > 0 ? std::clamp(dot(p - a, d) / size2, 0.0, 1.0) : 0;
  return std::hypot(p.u - a.u - t * d.u, p.v - a.v - t * d.v);
}
double distance(RingPoint p, const Rings& rings) {
  double least = HUGE_VAL;
  rings.for_each_segment(
      [&](RingPoint a, RingPoint b) { least = std::min(least, distance(p, a, b)); });
  return least;
}

struct Case {
  std::string name;
  std::function<Ref<const Structure>(Random&)> structure;
  double pitch;
};

std::vector<Case> cases() {
  const auto foam = [](double radius) {
    return [=](Random& random) -> Ref<const Structure> {
      return make_ref<Foam>(context(), Neighbourhood{{}, {1, 1, 1}, {}}, Parameter(radius), 1.0,
                            random.bits(), FoamMethod::direct);
    };
  };
  const auto lattice = [](double radius) {
    return [=](Random& random) -> Ref<const Structure> {
      return make_ref<Lattice>(Neighbourhood{random.in_box({{0, 0, 0}, {1, 1, 1}}), {1, 1, 1}, {}},
                               random.below(2) ? bcc_unit_cell() : octet_unit_cell(),
                               Parameter(radius));
    };
  };
  return {{"foam, r = 0.1", foam(0.1), 0.015625},
          {"foam, r = 0.2", foam(0.2), 0.03125},
          {"lattice, r = 0.08", lattice(0.08), 0.015625},
          {"lattice, r = 0.15", lattice(0.15), 0.015625}};
}

void test_exact_sections(void** state) {
  const Case& c = *static_cast<const Case*>(*state);
  Random random(57);
  const int layers = 1 + static_cast<int>(3 * test_scale());
  uint64_t rings = 0, counted = 0;
  for (int n = 0; n < layers; ++n) {
    const Ref<const Structure> structure = c.structure(random);
    const Ref<Model> model =
        make_ref<Model>(context(), make_ref<BoxShape>(Box3{{0, 0, 0}, {9, 9, 9}}),
                        std::vector<Model::ScaleParts>{Model::ScaleParts(structure)});
    ContourPlan plan;
    plan.plane.height = random.between(3, 4);
    plan.pitch = c.pitch;
    plan.tolerance = c.pitch * (n % 2 ? 0.1 : 0.5);
    plan.topology_samples = 16;
    plan.has_window = true;
    for (int i = 0; i < 2; ++i) {
      plan.window_min[i] = random.between(2, 5);
      plan.window_max[i] = plan.window_min[i] + random.between(1.2, 1.7);
    }
    const Ref<Contours> made = layer_contours(*model, plan, nullptr);
    const Rings found = rings_of(reinterpret_cast<const msq_contours*>(made.get()));

    const double z = plan.plane.height;
    const Box3 box{{plan.window_min[0], plan.window_min[1], z},
                   {plan.window_max[0], plan.window_max[1], z}};
    std::vector<Polygon> sections;
    structure->for_each_strut(
        box,
        [&](Vec3 a, Vec3 b, double radius) {
          const std::vector<RingPoint> ring = section_of({a, b, radius}, z, 0.005 * plan.tolerance);
          if (ring.size() >= 3) sections.push_back(polygon_of(ring));
        },
        nullptr);
    assert_true(sections.size() > 3);
    PolygonSet united;
    united.join(sections.begin(), sections.end());
    united.intersection(polygon_of({{box.min.x, box.min.y},
                                    {box.max.x, box.min.y},
                                    {box.max.x, box.max.y},
                                    {box.min.x, box.max.y}}));
    std::vector<CGAL::Polygon_with_holes_2<Kernel>> parts;
    united.polygons_with_holes(std::back_inserter(parts));
    Rings exact;
    uint64_t outer = 0, holes = 0, exact_holes = 0;
    for (const auto& part : parts) {
      exact.rings.push_back(ring_of(part.outer_boundary()));
      for (auto h = part.holes_begin(); h != part.holes_end(); ++h, ++exact_holes)
        exact.rings.push_back(ring_of(*h));
    }
    for (const uint8_t is_hole : found.holes) (is_hole ? holes : outer) += 1;

    // The mask of topology_samples sees what is wider than a sixteenth of the pitch: parts of the
    // exact section that are narrower are rare.
    const auto apart = [](uint64_t a, uint64_t b) { return a > b ? a - b : b - a; };
    if (apart(outer, parts.size()) > found.topology || apart(holes, exact_holes) > found.topology)
      fail_msg("%llu outer rings of %zu parts, %llu holes of %llu; the count is %llu",
               static_cast<unsigned long long>(outer), parts.size(),
               static_cast<unsigned long long>(holes), static_cast<unsigned long long>(exact_holes),
               static_cast<unsigned long long>(found.topology));
    const double band = 0.5 * plan.tolerance * exact.length();
    if (!(std::abs(found.area() - exact.area()) <= band))
      fail_msg("the area is %.9g, exactly %.9g", found.area(), exact.area());

    // Along the rings, the exact boundary is within the tolerance, except for places that are
    // counted, and where a disc of the diameter sqrt(2) pitch does not fit, on neither side.
    const double reach = 0.5 * std::sqrt(2.0) * c.pitch;
    const auto is_wide = [&](RingPoint p) {
      for (double r = 0; r < reach; r += 0.1 * reach)
        for (int k = 0; k < 24; ++k) {
          const double angle = 2 * pi * k / 24;
          const RingPoint q{p.u + r * std::cos(angle), p.v + r * std::sin(angle)};
          if (distance(q, exact) >= reach) return true;
        }
      return false;
    };
    uint64_t far = 0, segments = 0;
    found.for_each_segment([&](RingPoint a, RingPoint b) {
      ++segments;
      const int steps = 1 + static_cast<int>(std::hypot(b.u - a.u, b.v - a.v) / c.pitch);
      for (int i = 0; i < steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const RingPoint p{a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
        const double off = distance(p, exact);
        if (!(off > 1.01 * plan.tolerance && is_wide(p))) continue;
        print_message(
            "(%.9g, %.9g) of (%.9g, %.9g) to (%.9g, %.9g) is off by %g tolerances of %g\n", p.u,
            p.v, a.u, a.v, b.u, b.v, off / plan.tolerance, plan.tolerance);
        ++far;
        break;
      }
    });
    if (far > found.unresolved + found.topology)
      fail_msg("%llu of %llu segments are too far from the section; %llu places are counted",
               static_cast<unsigned long long>(far), static_cast<unsigned long long>(segments),
               static_cast<unsigned long long>(found.unresolved + found.topology));
    // Along the exact boundary, the rings are within the tolerance where both the solid and the
    // void hold a disc of the diameter sqrt(2) pitch that touches it.
    uint64_t wide = 0;
    exact.for_each_segment([&](RingPoint a, RingPoint b) {
      const double size = std::hypot(b.u - a.u, b.v - a.v);
      if (!(size > 0)) return;
      const RingPoint p{0.5 * (a.u + b.u), 0.5 * (a.v + b.v)};
      for (const double side : {1.0, -1.0}) {
        const RingPoint q{p.u - side * reach * (b.v - a.v) / size,
                          p.v + side * reach * (b.u - a.u) / size};
        if (!(distance(q, exact) >= 0.999 * reach)) return;
      }
      ++wide;
      const double off = distance(p, found);
      if (!(off <= 1.01 * plan.tolerance))
        fail_msg("the boundary at (%.9g, %.9g) is %g tolerances from the rings", p.u, p.v,
                 off / plan.tolerance);
    });
    assert_true(wide > 0);
    rings += found.rings.size();
    counted += found.topology;
  }
  print_message("%s: %d layers, %llu rings, %llu places counted\n", c.name.c_str(), layers,
                static_cast<unsigned long long>(rings), static_cast<unsigned long long>(counted));
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  std::vector<Case> rows = cases();
  return run_for_each("exact sections", rows, test_exact_sections);
}
