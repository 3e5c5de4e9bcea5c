// SPDX-License-Identifier: Apache-2.0
// Contours against membership: rings are simple and nested, hold what is inside, come within the
// tolerance of the boundary, and meet on the seams of windows.
#include "slice/contours.h"

#include <map>
#include <set>
#include <string>
#include <thread>

#include "expression/parser.h"
#include "field/gradient.h"
#include "meshes.h"
#include "query/membership.h"
#include "random.h"
#include "rings.h"
#include "shape/mesh.h"
#include "shape/primitive.h"
#include "slice/contour_points.h"
#include "slice/contour_struts.h"
#include "structure/foam/foam.h"
#include "structure/functional/functional.h"
#include "structure/functional/presets.h"
#include "structure/lattice/cell/unit_cell.h"
#include "structure/lattice/lattice.h"
#include "suite.h"

namespace msq::test {

namespace {

Ref<Context> context() {
  static const Ref<Context> shared = make_ref<Context>(2u, uint64_t{64} << 20, uint64_t{0});
  return shared;
}

Neighbourhood cells(double size, Vec3 origin = {}) {
  return {origin, {size, size, size}, {}};
}

Ref<const Structure> foam(double size, Parameter radius) {
  return make_ref<Foam>(context(), cells(size, {0.1, 0.2, 0.3}), std::move(radius), 1.0,
                        uint64_t{5}, FoamMethod::direct);
}

Ref<const Structure> gyroid(FunctionalKind kind, double level) {
  return make_ref<Functional>(cells(2.0), parse_expression(preset_expressions[0], {}), kind,
                              Parameter(level), 8);
}

Ref<const Structure> lattice(double radius) {
  return make_ref<Lattice>(cells(2.0, {0.3, 0, 0.1}), bcc_unit_cell(), Parameter(radius));
}

Ref<const Shape> box() {
  return make_ref<BoxShape>(Box3{{0, 0, 0}, {8, 6, 4}});
}
Ref<const Shape> ball() {
  return make_ref<SphereShape>(Vec3{4, 3, 2}, 3.3);
}
Ref<const Shape> turned_mesh() {
  TriangleSoup soup = box_mesh({-3, -2, -1.5}, {3, 2, 1.5});
  for (Vec3& v : soup.vertices) v = turned_twice().apply(v) + Vec3{4, 3, 2};
  return make_ref<Mesh>(soup, WindingRule::nonzero, context()->budget);
}

struct Case {
  std::string name;
  std::function<Ref<Model>()> model;
  double height, tolerance, pitch;
  int axis = 2;
  /// Share of unresolved places, of all points, that is allowed.
  double unresolved = 0.0;
};

Ref<Model> model_of(Ref<const Shape> shape, std::vector<Model::ScaleParts> scales = {}) {
  return make_ref<Model>(context(), std::move(shape), std::move(scales));
}

ContourPlan plan_of(const Case& c) {
  ContourPlan plan;
  plan.plane = {c.axis, c.height};
  plan.tolerance = c.tolerance;
  plan.pitch = c.pitch;
  return plan;
}

Rings contours(const Model& model, const ContourPlan& plan) {
  const Ref<Contours> made = layer_contours(model, plan, nullptr);
  return rings_of(reinterpret_cast<const msq_contours*>(made.get()));
}

std::vector<Case> cases() {
  return {
      {"box", [] { return model_of(box()); }, 1.3, 0.05, 0},
      {"box, coarse", [] { return model_of(box()); }, 1.3, 0.4, 0.8},
      {"ball", [] { return model_of(ball()); }, 1.3, 0.02, 0.2},
      {"mesh", [] { return model_of(turned_mesh()); }, 1.7, 0.02, 0.1},
      {"mesh across x", [] { return model_of(turned_mesh()); }, 3.9, 0.02, 0.1, 0},
      {"mesh across y", [] { return model_of(turned_mesh()); }, 2.9, 0.02, 0.1, 1},
      {"gyroid network", [] { return model_of(box(), {gyroid(FunctionalKind::network, 0.2)}); },
       1.1, 0.02, 0.05},
      {"gyroid sheet", [] { return model_of(ball(), {gyroid(FunctionalKind::sheet, 0.3)}); }, 1.9,
       0.01, 0.04, 2, 0.02},
      {"lattice", [] { return model_of(box(), {lattice(0.2)}); }, 1.15, 0.02, 0.04, 2, 0.02},
      {"lattice across x", [] { return model_of(box(), {lattice(0.2)}); }, 1.15, 0.02, 0.04, 0,
       0.02},
      {"lattice across y", [] { return model_of(box(), {lattice(0.2)}); }, 1.15, 0.02, 0.04, 1,
       0.02},
      {"foam", [] { return model_of(box(), {foam(1.0, Parameter(0.1))}); }, 1.5, 0.01, 0.02, 2,
       0.02},
      {"foam, coarse", [] { return model_of(box(), {foam(1.0, Parameter(0.1))}); }, 1.5, 0.03, 0.06,
       2, 0.05},
      {"foam with skin",
       [] {
         return model_of(box(), {Model::ScaleParts(foam(1.0, Parameter(0.1)), Parameter(0.3))});
       },
       1.5, 0.02, 0.04, 2, 0.05},
      {"foam of graded radius",
       [] {
         return model_of(ball(), {foam(1.0, Parameter(Ref<const Field>(make_ref<GradientField>(
                                                Vec3{0, 0, 0}, 0.05, Vec3{8, 0, 0}, 0.2))))});
       },
       1.5, 0.02, 0.04, 2, 0.05},
      {"two scales",
       [] {
         return model_of(box(), {gyroid(FunctionalKind::network, 0.2), foam(0.5, Parameter(0.08))});
       },
       1.5, 0.01, 0.02, 2, 0.05},
  };
}

void test_against_membership(void** state) {
  const Case& c = *static_cast<const Case*>(*state);
  const Ref<Model> model = c.model();
  const Scales resolved = model->resolved(0);
  const ContourPlan plan = plan_of(c);
  const Rings all = contours(*model, plan);
  check_rings(all);
  assert_true(all.rings.size() > 0);
  const double allowed = c.unresolved * static_cast<double>(all.points());
  if (!(static_cast<double>(all.unresolved) <= allowed))
    fail_msg("%llu unresolved of %zu points", static_cast<unsigned long long>(all.unresolved),
             all.points());
  const auto inside = [&](RingPoint p) { return model->inside(plan.plane.at(p.u, p.v), resolved); };
  // Both memberships occur within the tolerance of any point of a ring.
  const auto both_about = [&](RingPoint p, double reach) {
    const bool here = inside(p);
    for (double r = reach; r > 0.1 * reach; r *= 0.7)
      for (int k = 0; k < 24; ++k) {
        const double angle = 2 * pi * k / 24;
        if (inside({p.u + r * std::cos(angle), p.v + r * std::sin(angle)}) != here) return true;
      }
    return false;
  };
  uint64_t far = 0;
  double lengths = 0;
  all.for_each_segment([&](RingPoint a, RingPoint b) {
    const double size = std::hypot(b.u - a.u, b.v - a.v);
    lengths += size;
    const int steps = 1 + static_cast<int>(size / (0.5 * all.pitch));
    for (int i = 0; i < std::min(steps, 20); ++i) {
      const double t = static_cast<double>(i) / std::min(steps, 20);
      const RingPoint p{a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
      if (!both_about(p, c.tolerance * 1.001 + 2e-6 * all.pitch)) ++far;
    }
  });
  if (!(static_cast<double>(far) <= allowed))
    fail_msg("%llu points of rings are far from the boundary",
             static_cast<unsigned long long>(far));

  // Points whose surroundings are all alike are on the right side.
  Random random(3);
  const Box3& box = model->bounds();
  const int u = plan.plane.u_axis(), v = plan.plane.v_axis();
  const double around = 0.71 * all.pitch + c.tolerance;
  uint64_t wrong = 0, wrong_alike = 0, alike = 0;
  const int samples = static_cast<int>(20000 * test_scale());
  for (int n = 0; n < samples; ++n) {
    const RingPoint p{random.between(box.min[u], box.max[u]),
                      random.between(box.min[v], box.max[v])};
    const bool wanted = inside(p);
    const bool is_wrong = all.winding(p) != (wanted ? 1 : 0);
    wrong += is_wrong;
    if (!both_about(p, around)) {
      ++alike;
      wrong_alike += is_wrong;
    }
  }
  if (wrong_alike > 0)
    fail_msg("%llu of %llu points in the open are on the wrong side",
             static_cast<unsigned long long>(wrong_alike), static_cast<unsigned long long>(alike));
  // The others lie in a band of the tolerance.
  const double area = (box.max[u] - box.min[u]) * (box.max[v] - box.min[v]);
  const double band = static_cast<double>(samples) * lengths * c.tolerance / area;
  if (!(static_cast<double>(wrong) <= 0.5 * band + 3 * std::sqrt(band) + 3))
    fail_msg("%llu of %d points are on the wrong side; %g are in the band",
             static_cast<unsigned long long>(wrong), samples, band);
}

/// Windows that tile the layer: the same points on both sides of each seam, the same area.
void test_seams(void** state) {
  const Case& c = *static_cast<const Case*>(*state);
  const Ref<Model> model = c.model();
  ContourPlan plan = plan_of(c);
  const int u = plan.plane.u_axis(), v = plan.plane.v_axis();
  const Box3& box = model->bounds();
  Random random(9);
  for (int round = 0; round < 3; ++round) {
    std::vector<double> cuts[2];
    for (int i = 0; i < 2; ++i) {
      const int axis = i == 0 ? u : v;
      cuts[i] = {box.min[axis] - 0.1, box.max[axis] + 0.1};
      for (int k = 0; k < 2; ++k) cuts[i].push_back(random.between(box.min[axis], box.max[axis]));
      std::sort(cuts[i].begin(), cuts[i].end());
    }
    plan.has_window = true;
    plan.format = round == 0 ? ContourFormat::float64 : ContourFormat::int64;
    plan.units = round == 0 ? 1 : 1e6;
    const double scale = plan.units;
    // Points on each seam, with the sides that they were seen from.
    std::map<std::pair<int, RingPoint>, int> seen;
    double area = 0;
    for (size_t j = 0; j < 3; ++j)
      for (size_t i = 0; i < 3; ++i) {
        plan.window_min[0] = cuts[0][i];
        plan.window_max[0] = cuts[0][i + 1];
        plan.window_min[1] = cuts[1][j];
        plan.window_max[1] = cuts[1][j + 1];
        const Rings tile = contours(*model, plan);
        check_rings(tile);
        area += tile.area();
        const auto at = [&](double x) { return round == 0 ? x : std::nearbyint(x * scale); };
        for (const auto& ring : tile.rings)
          for (const RingPoint p : ring) {
            if (p.u < at(cuts[0][i]) || p.u > at(cuts[0][i + 1]) || p.v < at(cuts[1][j]) ||
                p.v > at(cuts[1][j + 1]))
              fail_msg("a point lies beyond its window");
            if (i > 0 && p.u == at(cuts[0][i])) ++seen[{0, p}];
            if (i < 2 && p.u == at(cuts[0][i + 1])) ++seen[{1, p}];
            if (j > 0 && p.v == at(cuts[1][j])) ++seen[{2, p}];
            if (j < 2 && p.v == at(cuts[1][j + 1])) ++seen[{3, p}];
          }
      }
    for (const auto& [key, count] : seen) {
      const auto other = seen.find({key.first ^ 1, key.second});
      if (other == seen.end() || other->second != count)
        fail_msg("(%.17g, %.17g) is on one side of a seam", key.second.u, key.second.v);
    }
    plan.has_window = false;
    const Rings whole = contours(*model, plan);
    const double off = std::abs(area - whole.area()) / (scale * scale);
    if (!(off <= 0.5 * c.tolerance * whole.length() / scale + 8 * c.tolerance * c.tolerance))
      fail_msg("the windows' area is off by %g", off);
    // Rounded or not, the same rings.
    if (round > 0) check_rings(whole);
  }
}

void test_disc(void**) {
  const Ref<Model> model = model_of(make_ref<SphereShape>(Vec3{0.3, -0.2, 1}, 2.0));
  ContourPlan plan;
  plan.plane.height = 1.5;
  const double r = std::sqrt(4 - 0.25);
  size_t points = SIZE_MAX;
  for (const double tolerance : {0.001, 0.01, 0.1}) {
    plan.tolerance = tolerance;
    plan.pitch = 0.2;
    const Rings all = contours(*model, plan);
    check_rings(all);
    assert_int_equal(all.rings.size(), 1);
    assert_int_equal(all.unresolved, 0);
    for (const RingPoint p : all.rings[0]) {
      const double off = std::abs(std::hypot(p.u - 0.3, p.v + 0.2) - r);
      if (!(off <= tolerance)) fail_msg("a point is off by %g", off);
    }
    assert_true(std::abs(all.area() - pi * r * r) <= 2 * pi * r * tolerance);
    assert_true(std::abs(all.length() - 2 * pi * r) <= 4 * pi * tolerance + 4 * tolerance);
    assert_true(all.points() < points);  // the coarser, the fewer
    points = all.points();
  }
}

void test_square(void**) {
  // Faces on no round number, so that corners lie within cells.
  const Ref<Model> model =
      model_of(make_ref<BoxShape>(Box3{{-1.0171, -2.0333, 0}, {3.0717, 1.0519, 1}}));
  ContourPlan plan;
  plan.plane.height = 0.5;
  plan.tolerance = 0.05;
  plan.pitch = 0.25;
  for (const double window : {0.0, 1.0}) {
    plan.has_window = window > 0;
    plan.window_min[0] = plan.window_min[1] = -5;
    plan.window_max[0] = plan.window_max[1] = 5;
    const Rings all = contours(*model, plan);
    check_rings(all);
    assert_int_equal(all.rings.size(), 1);
    assert_int_equal(all.points(), 4);
    assert_true(std::abs(all.area() - 4.0888 * 3.0852) < 0.002);
    assert_true(std::abs(all.length() - 2 * (4.0888 + 3.0852)) < 0.001);
    for (const RingPoint p : all.rings[0]) {
      assert_true(std::min(std::abs(p.u + 1.0171), std::abs(p.u - 3.0717)) < 1e-3);
      assert_true(std::min(std::abs(p.v + 2.0333), std::abs(p.v - 1.0519)) < 1e-3);
    }
  }
}

/// Two threads at once, and contexts of any number of threads.
void test_threads(void**) {
  const auto bytes_of = [](const Contours& made) {
    const auto* points = static_cast<const unsigned char*>(made.points());
    std::vector<unsigned char> bytes(points, points + made.point_count() * 16);
    const auto* starts = reinterpret_cast<const unsigned char*>(made.starts());
    bytes.insert(bytes.end(), starts, starts + (made.ring_count() + 1) * 8);
    return bytes;
  };
  ContourPlan plan;
  plan.plane.height = 1.5;
  plan.tolerance = 0.02;
  std::vector<std::vector<unsigned char>> all;
  for (const unsigned threads : {1u, 3u}) {
    const Ref<Context> own = make_ref<Context>(threads, uint64_t{1} << 20, uint64_t{0});
    const Ref<Model> model = make_ref<Model>(
        own, box(),
        std::vector<Model::ScaleParts>{Model::ScaleParts(make_ref<Foam>(
            own, cells(1.0), Parameter(0.1), 1.0, uint64_t{5}, FoamMethod::direct))});
    std::vector<unsigned char> made[2];
    std::thread other([&] { made[0] = bytes_of(*layer_contours(*model, plan, nullptr)); });
    made[1] = bytes_of(*layer_contours(*model, plan, nullptr));
    other.join();
    all.insert(all.end(), made, made + 2);
  }
  for (const auto& bytes : all) assert_true(bytes == all[0]);
}

/// Struts tell where points of a plane are as the structure does, also next to the boundary.
void test_struts_tell_membership(void**) {
  using Found = PlaneStruts::Found;
  const LayerPlane planes[] = {{2, 1.5}, {0, 1.15}, {1, 2.2}};
  const std::function<Ref<const Structure>()> structures[] = {
      [] { return foam(1.0, Parameter(0.1)); }, [] { return foam(0.4, Parameter(0.15)); },
      [] { return lattice(0.2); }};
  Random random(17);
  for (const auto& make : structures)
    for (const LayerPlane& plane : planes) {
      const Ref<const Structure> structure = make();
      const double low[2] = {1.1, 0.7}, high[2] = {4.3, 3.1}, around = 0.05;
      const ContourGrid grid(plane, low, high, 0.0625);
      const PlaneStruts struts(*structure, grid, around, context()->budget, nullptr);
      uint64_t doubtful = 0, inside = 0;
      const int samples = 200 + static_cast<int>(3000 * test_scale());
      std::vector<Vec2> points;
      const auto compare = [&](Vec2 p, Found found) {
        const bool wanted = structure->inside(plane.at(p.x, p.y));
        if (found != Found::doubtful && (found == Found::inside) != wanted)
          fail_msg("(%.17g, %.17g) is not where the struts say", p.x, p.y);
        return wanted;
      };
      const auto check = [&](Vec2 p) {
        const Found found = struts.find(p);
        const bool is_inside = compare(p, found);
        doubtful += found == Found::doubtful;
        inside += is_inside;
        points.push_back(p);
        if (random.below(50) == 0) points.push_back({low[0] - 2 * around, p.y});
        return is_inside;
      };
      for (int n = 0; n < samples; ++n) {
        const auto point = [&] {
          return Vec2{random.between(low[0] - around, high[0] + around),
                      random.between(low[1] - around, high[1] + around)};
        };
        Vec2 p = point(), q = point();
        const bool is_inside = check(p);
        if (n % 8 != 0 || check(q) == is_inside) continue;
        for (int i = 0; i < 40; ++i) {
          const Vec2 m = (p + q) * 0.5;
          (check(m) == is_inside ? p : q) = m;
        }
      }
      assert_true(inside > 0);
      // Those of bisection, from 1e-6 of a cell on.
      assert_true(doubtful > 0 && doubtful < static_cast<uint64_t>(6 * samples));
      assert_true(struts.find({low[0] - 2 * around, low[1]}) == Found::doubtful);
      // Several at a time. Those of a bisection are near each other.
      std::vector<Found> found(points.size());
      for (size_t first = 0, count; first < points.size(); first += count) {
        count = std::min<size_t>(points.size() - first, 1 + random.below(200));
        struts.find(points.data() + first, count, found.data() + first);
      }
      for (size_t n = 0; n < points.size(); ++n) compare(points[n], found[n]);
    }
}

/// Struts draw the nodes that are members, to the last one; also struts along the rows, of foams
/// without jitter and cubic lattices, whose surface holds nodes.
void test_struts_draw_nodes(void**) {
  Random random(23);
  const auto cubic = [](double radius) {
    return make_ref<Lattice>(cells(1.0, {0.3125, 0.3125, 0.3125}), cubic_unit_cell(),
                             Parameter(radius));
  };
  const std::function<Ref<const Structure>()> structures[] = {
      [] { return foam(1.0, Parameter(0.1)); },
      [] {
        return make_ref<Foam>(context(), cells(1.0), Parameter(0.125), 0.0, uint64_t{5},
                              FoamMethod::direct);
      },
      [&] { return cubic(0.125); }, [&] { return cubic(1e-7); }, [&] { return cubic(0.53); }};
  for (const auto& make : structures)
    for (const Ref<const Shape>& shape : {box(), ball()}) {
      const Ref<Model> model = model_of(shape, {Ref<const Structure>(make())});
      const Scales resolved = model->resolved(0);
      for (int axis = 0; axis < 3; ++axis) {
        const LayerPlane plane{axis, axis == 1 ? random.between(1, 3) : 1.3125};
        const double low[2] = {random.between(-0.1, 1), 0.1}, high[2] = {3.9, 3.3125};
        const ContourGrid nodes(plane, low, high, 0.0625);
        ContourGrid wanted = nodes.alike(), drawn = nodes.alike(), alone = nodes.alike();
        wanted.find_nodes(*model, resolved, nullptr);
        alone.find_nodes(*model, {}, nullptr);
        const PlaneStruts struts(*resolved[0]->structure, nodes, 0.02, context()->budget, nullptr);
        ContourPoints points(*model, resolved, plane, nullptr);
        points.use_struts(struts);
        drawn.find_nodes(struts, alone, points);
        for (uint32_t row = 0; row < nodes.rows(); ++row)
          for (uint32_t column = 0; column <= nodes.right_edge() + 1; ++column)
            if (drawn.inside(column, row) != wanted.inside(column, row))
              fail_msg("node %u, %u across axis %d is not as drawn", column, row, axis);
      }
    }
}

/// Where struts leave the part, the corners lie on its wall and where the wall leaves the struts.
void test_corners_at_walls(void**) {
  const Ref<Model> model = model_of(box(), {lattice(0.3)});
  const Scales resolved = model->resolved(0);
  ContourPlan plan;
  plan.plane.height = 0.5;
  plan.tolerance = 0.02;
  plan.pitch = 0.05;
  const Rings all = contours(*model, plan);
  const auto inside = [&](double v) { return model->inside({0, v, plan.plane.height}, resolved); };
  int corners = 0;
  const double step = 0.01;
  for (double v = 0.5 * step; v + step < 6; v += step) {
    if (inside(v) == inside(v + step)) continue;
    double a = v, b = v + step;
    for (int i = 0; i < 40; ++i) (inside(0.5 * (a + b)) == inside(v) ? a : b) = 0.5 * (a + b);
    double nearest = HUGE_VAL;
    for (const auto& ring : all.rings)
      for (const RingPoint p : ring) nearest = std::min(nearest, std::hypot(p.u, p.v - a));
    // Of the tolerance, half is for leaving out points; corners stay.
    if (!(nearest <= 0.1 * plan.tolerance))
      fail_msg("the corner at v = %g is off by %g", a, nearest);
    ++corners;
  }
  assert_true(corners >= 4);
}

/// No more points than needed: not many more than the fewest on the circle whose lines are within
/// half of the tolerance. The other half is for what lies between crossings.
void test_points_of_disc(void**) {
  const double r = 2;
  const Ref<Model> model = model_of(make_ref<SphereShape>(Vec3{0.3, -0.2, 0}, r));
  ContourPlan plan;
  plan.plane.height = 0;
  plan.pitch = 0.05;
  for (const double tolerance : {0.0005, 0.002, 0.01, 0.05}) {
    plan.tolerance = tolerance;
    const Rings all = contours(*model, plan);
    const double fewest = pi / std::acos(1 - 0.5 * tolerance / r);
    if (!(static_cast<double>(all.points()) <= 2 * fewest))
      fail_msg("%zu points, where %g would do", all.points(), fewest);
  }
}

/// Numbers of the parts of the solid and of the enclosed parts of the void of a mask of samples. Of
/// each part that holds a square of so many samples, the middle of such a square.
struct Parts {
  uint64_t solid = 0, enclosed = 0;
  std::vector<size_t> wide_solid, wide_void;
};
Parts parts_of(const std::vector<uint8_t>& inside, size_t across, size_t up, size_t wide) {
  // The side of the largest square of alike samples that ends with a sample.
  std::vector<size_t> side(inside.size(), 1);
  for (size_t at = across; at < inside.size(); ++at) {
    if (at % across == 0) continue;
    const size_t before[3] = {at - 1, at - across, at - across - 1};
    size_t least = SIZE_MAX;
    for (const size_t b : before) least = std::min(least, inside[b] == inside[at] ? side[b] : 0);
    side[at] = least + 1;
  }
  Parts parts;
  std::vector<bool> seen(inside.size());
  std::vector<size_t> stack;
  for (size_t first = 0; first < inside.size(); ++first) {
    if (seen[first]) continue;
    const uint8_t kind = inside[first];
    bool is_enclosed = true;
    size_t widest = first;
    stack.assign(1, first);
    seen[first] = true;
    while (!stack.empty()) {
      const size_t at = stack.back(), i = at % across, j = at / across;
      stack.pop_back();
      if (side[at] > side[widest]) widest = at;
      if (i == 0 || j == 0 || i + 1 == across || j + 1 == up) is_enclosed = false;
      const auto visit = [&](size_t next) {
        if (seen[next] || inside[next] != kind) return;
        seen[next] = true;
        stack.push_back(next);
      };
      if (i > 0) visit(at - 1);
      if (i + 1 < across) visit(at + 1);
      if (j > 0) visit(at - across);
      if (j + 1 < up) visit(at + across);
    }
    ++(kind ? parts.solid : parts.enclosed);
    if (!kind && !is_enclosed) --parts.enclosed;
    if (side[widest] >= wide)
      (kind ? parts.wide_solid : parts.wide_void)
          .push_back(widest - side[widest] / 2 * (across + 1));
  }
  return parts;
}

/// Against a mask of 16 samples to a pitch: no part that holds a disc of the diameter sqrt(2) *
/// pitch is lost, and no more rings than parts appear, except for places that are counted. Parts
/// closer to each other than the pitch may be one.
void test_topology(void** state) {
  const Case& c = *static_cast<const Case*>(*state);
  const Ref<Model> model = c.model();
  const Scales resolved = model->resolved(0);
  ContourPlan plan = plan_of(c);
  const int u = plan.plane.u_axis(), v = plan.plane.v_axis();
  const Box3& box = model->bounds();
  plan.has_window = true;
  const double pitch = contours(*model, plan_of(c)).pitch;
  const double side =
      std::min(40 * pitch, 0.8 * std::min(box.max[u] - box.min[u], box.max[v] - box.min[v]));
  Random random(29);
  for (int i = 0; i < 2; ++i) {
    const int axis = i == 0 ? u : v;
    plan.window_min[i] = random.between(box.min[axis], box.max[axis] - side);
    plan.window_max[i] = plan.window_min[i] + side;
  }
  const Rings rings = contours(*model, plan);
  SampleGrid fine;
  const double spacing = pitch / 16;
  const uint64_t count = static_cast<uint64_t>(side / spacing);
  fine.spacing = {spacing, spacing, spacing};
  fine.origin =
      plan.plane.at(plan.window_min[0] + 0.5 * spacing, plan.window_min[1] + 0.5 * spacing);
  fine.nx = u == 0 ? count : 1;
  fine.ny = u == 1 ? count : v == 1 ? count : 1;
  fine.nz = v == 2 ? count : 1;
  std::vector<uint8_t> inside(count * count);
  grid_membership(*model, resolved, fine, inside.data(), nullptr);
  const Parts parts = parts_of(inside, count, count, 25);
  uint64_t outer = 0, holes = 0;
  for (const uint8_t is_hole : rings.holes) (is_hole ? holes : outer) += 1;
  if (outer > parts.solid + rings.unresolved || holes > parts.enclosed + rings.unresolved)
    fail_msg("%llu outer rings of %llu parts, %llu holes of %llu; %llu unresolved",
             static_cast<unsigned long long>(outer), static_cast<unsigned long long>(parts.solid),
             static_cast<unsigned long long>(holes),
             static_cast<unsigned long long>(parts.enclosed),
             static_cast<unsigned long long>(rings.unresolved));
  const auto check_all = [&](const std::vector<size_t>& places, int winding) {
    for (const size_t at : places) {
      const RingPoint p{plan.window_min[0] + (static_cast<double>(at % count) + 0.5) * spacing,
                        plan.window_min[1] + (static_cast<double>(at / count) + 0.5) * spacing};
      if (rings.winding(p) != winding) fail_msg("the part about (%g, %g) is lost", p.u, p.v);
    }
  };
  check_all(parts.wide_solid, 1);
  check_all(parts.wide_void, 0);
}

}  // namespace

}  // namespace msq::test

int main() {
  using namespace msq::test;
  std::vector<Case> rows = cases();
  const CMUnitTest single[] = {
      cmocka_unit_test(test_disc),
      cmocka_unit_test(test_square),
      cmocka_unit_test(test_threads),
      cmocka_unit_test(test_struts_tell_membership),
      cmocka_unit_test(test_struts_draw_nodes),
      cmocka_unit_test(test_corners_at_walls),
      cmocka_unit_test(test_points_of_disc),
  };
  return cmocka_run_group_tests(single, nullptr, nullptr) +
         run_for_each("contours against membership", rows, test_against_membership) +
         run_for_each("seams of contours", rows, test_seams) +
         run_for_each("topology of contours", rows, test_topology);
}
