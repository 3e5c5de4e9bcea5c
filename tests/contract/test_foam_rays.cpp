// SPDX-License-Identifier: Apache-2.0
// Rays through foams: the same bits whatever other rays are cast with them, in whichever order, and
// whatever the cache holds; entries where marching finds them; normals that point out.
#include <algorithm>

#include "base/unit.h"
#include "expression/parser.h"
#include "field/expression.h"
#include "field/host.h"
#include "field/radial.h"
#include "random.h"
#include "structure/foam/point/edges_near.h"
#include "structure/foam/rays/packets.h"
#include "structure/foam/rays/strut_entry.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

bool has_density(const StructureRow& row) {
  return row.kind.name.find("density") != std::string::npos;
}

/// Of those with a density, whose edges are dear, a few.
bool is_tried(const StructureRow& row) {
  for (const char* name :
       {"jitter 1 r 0.06", "jitter 1 r 0.06, turned, graded", "jitter 1 r 0.26, uneven cells",
        "jitter 0.01 r 0.06, graded", "jitter 0 r 0.06, uneven, quarter turn, graded"})
    if (row.name == std::string("foam DIRECT, density 1 to 30, ") + name) return true;
  return false;
}

Ref<const Foam> foam_of(const StructureRow& row, Ref<Context> context) {
  const Neighbourhood& grid = row.variant.grid;
  const Vec3 centre = grid.from_grid(grid.cell_size * 0.5);
  return make_ref<Foam>(std::move(context), grid, row.parameter(centre), row.kind.jitter,
                        uint64_t{7}, FoamMethod::direct,
                        has_density(row) ? rising_density(grid) : Parameter(1));
}

/// About the grid's origin, as steep as the linear one is.
FieldRef radial_field(const Neighbourhood& grid, FieldRef linear) {
  const auto [low, high] = linear->range();
  const double unit = max_component(grid.cell_size);
  return make_ref<RadialField>(grid.origin, Vec3{},
                               RadialField::Ramp{0.3 * unit, high, 2.5 * unit, low});
}

/// That waves, and of which nothing but ranges is known.
FieldRef expression_field(const Neighbourhood& grid, FieldRef linear) {
  const auto [low, high] = linear->range();
  const double unit = max_component(grid.cell_size);
  char text[200];
  std::snprintf(text, sizeof text, "%.17g + %.17g * sin(2 * x / %.17g) * cos(3 * y / %.17g + z)",
                0.5 * (low + high), 0.5 * (high - low), unit, unit);
  return make_ref<ExpressionField>(parse_expression(text, {}), Interval{low, high});
}

/// The linear one, as a host has it: of known slope, or of which nothing is known.
template <bool kKnown>
FieldRef host_field(const Neighbourhood&, FieldRef linear) {
  HostFieldCalls calls;
  calls.evaluate = [linear](const Vec3* points, size_t count, double* values) {
    linear->values(points, count, values);
  };
  const double unknown = std::numeric_limits<double>::infinity();
  return make_ref<HostField>(calls, linear->range(), kKnown ? linear->lipschitz() : unknown, true);
}

RaySearch search_of(const Neighbourhood& grid, Vec3 a, Vec3 b, double reach) {
  const Vec3 from = grid.from_grid(a * grid.cell_size), to = grid.from_grid(b * grid.cell_size);
  RaySearch search;
  search.ray = {from, (to - from) * (1 / length(to - from))};
  search.to = reach;
  return search;
}

/// As of a camera: a tile of rays that follow each other, parallel or not.
std::vector<RaySearch> tile(const StructureRow& row, Random& random, size_t count) {
  const Neighbourhood& grid = row.variant.grid;
  std::vector<RaySearch> searches;
  const Vec3 eye = random.in_box({{-1, -1, -1}, {2, 2, 2}});
  Vec3 goal = random.in_box({{-1, -1, -1}, {2, 2, 2}});
  if (random.below(3) == 0) {  // along an axis of the grid
    goal = eye;
    goal[static_cast<int>(random.below(3))] += 1;
  }
  const bool is_parallel = random.below(2) == 0;
  const Vec3 right = random.in_box({{-1, -1, -1}, {1, 1, 1}}), up = cross(goal - eye, right);
  const double pixel = random.below(2) == 0 ? 0.02 : 0.2;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 away =
        right * (pixel * static_cast<double>(i % 8)) + up * (pixel * static_cast<double>(i / 8));
    searches.push_back(search_of(grid, is_parallel ? eye + away : eye, goal + away,
                                 (has_density(row) ? 1 : 3) * row.unit()));
  }
  return searches;
}

void check_same(const char* name, const char* what, const RaySearch& a, const RaySearch& b) {
  if (a.found == b.found && (!a.found || (a.t == b.t && a.normal == b.normal))) return;
  fail_msg("%s: %s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): %d %.17g, %d %.17g", name,
           what, a.ray.origin.x, a.ray.origin.y, a.ray.origin.z, a.ray.direction.x,
           a.ray.direction.y, a.ray.direction.z, a.found, a.t, b.found, b.t);
}

/// No sample before the hit is inside, and it is where membership changes.
void check_hit(const Foam& foam, const char* name, const RaySearch& ray) {
  const double end = ray.found ? ray.t : ray.to, part = foam.min_ray_step();
  const double tolerance = foam.ray_tolerance();
  bool is_right =
      !ray.found || foam.inside(ray.ray.at(end)) || foam.inside(ray.ray.at(end + tolerance));
  if (end > 2 * tolerance && ray.found)
    is_right &=
        !foam.inside(ray.ray.at(end - 2 * tolerance)) || !foam.inside(ray.ray.at(end - tolerance));
  for (double t = 0; t < end - part; t += 0.5 * part)
    is_right &= !foam.inside(ray.ray.at(t)) || !foam.inside(ray.ray.at(t + part)) ||
                !foam.inside(ray.ray.at(t + 0.5 * part));
  if (!is_right)
    fail_msg("%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): %d %.17g", name,
             ray.ray.origin.x, ray.ray.origin.y, ray.ray.origin.z, ray.ray.direction.x,
             ray.ray.direction.y, ray.ray.direction.z, ray.found, ray.t);
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const char* const name = row.name.c_str();
  const Ref<Context> none = make_ref<Context>(1u, uint64_t{0}, uint64_t{0});
  const Ref<const Foam> foam = foam_of(row, shared_context()), bare = foam_of(row, none);
  Random random(row.index + 11);
  // Where a march may overlook parts, it tells nothing.
  const bool may_march = foam->min_ray_step() == foam->ray_tolerance();
  const double tolerance = foam->ray_tolerance();
  const size_t tiles = has_density(row) ? 1 : row.samples(1200);
  for (size_t n = 0; n < tiles; ++n) {
    // A foam that rays were never cast through marches.
    const Ref<const Foam> fresh = foam_of(row, none);
    const std::vector<RaySearch> searches = tile(row, random, 64);
    std::vector<RaySearch> found = searches, reversed = searches;
    foam->enter(found.data(), found.size(), nullptr);
    std::reverse(reversed.begin(), reversed.end());
    bare->enter(reversed.data(), reversed.size(), nullptr);
    for (size_t i = 0; i < found.size(); ++i) {
      const RaySearch& ray = found[i];
      check_same(name, "reversed, no cache", ray, reversed[found.size() - 1 - i]);
      if (i % 8 != n % 8) continue;
      RaySearch alone = searches[i], marched = searches[i];
      fresh->enter(&alone, 1, nullptr);
      check_same(name, "alone", ray, alone);
      if (may_march) foam->Structure::enter(&marched, 1, nullptr);
      if (!may_march)
        check_hit(*foam, name, ray);
      else if (ray.found != marched.found ||
               (ray.found && !(std::abs(ray.t - marched.t) <= 2 * tolerance)))
        fail_msg(
            "%s: ray (%.17g, %.17g, %.17g) + t (%.17g, %.17g, %.17g): %d %.17g, march %d %.17g",
            name, ray.ray.origin.x, ray.ray.origin.y, ray.ray.origin.z, ray.ray.direction.x,
            ray.ray.direction.y, ray.ray.direction.z, ray.found, ray.t, marched.found, marched.t);
      if (!ray.found || ray.t == ray.from) continue;
      const Vec3 at = ray.ray.at(ray.t), seen = foam->normal(ray.ray, ray.t);
      const bool has_normal = dot(ray.normal, ray.normal) > 0;
      if (has_normal && dot(ray.normal, ray.ray.direction) < -0.01 &&
          !(length(seen - ray.normal) < 1e-5))
        fail_msg("%s: another normal at t %.17g than the one found with it", name, ray.t);
      for (const Vec3 out : {has_normal ? ray.normal : seen, seen}) {
        if (!(std::abs(length(out) - 1) < 1e-9)) fail_msg("%s: no normal of length 1", name);
        const double away = 1e-6 * row.unit();
        if (dot(out, ray.ray.direction) < -0.01 && !foam->inside(at - out * away))
          fail_msg("%s: the normal at t %.17g points in", name, ray.t);
      }
      if (has_normal && dot(ray.normal, ray.ray.direction) < -0.01 &&
          foam->inside(at + ray.normal * (1e-6 * row.unit()) -
                       ray.ray.direction * (1e-6 * row.unit())))
        fail_msg("%s: inside before the normal at t %.17g", name, ray.t);
    }
  }
}

/// Rays just behind the ends of struts, so shallow in the cylinders about their lines that rounding
/// counts. Where seeds are nearly on a grid, struts that meet are nearly in line: then often no
/// other strut covers such a cylinder behind the end, and no ray must enter there.
void struts_end_for_shallow_rays(void**) {
  constexpr double radius = 0.1;
  const Neighbourhood grid{};
  const Ref<const Foam> foam = make_ref<Foam>(shared_context(), grid, Parameter(radius), 1e-4,
                                              uint64_t{7}, FoamMethod::direct);
  std::vector<Vec3> ends;
  const auto take = [&](Vec3 a, Vec3 b, double) { ends.insert(ends.end(), {a, b}); };
  foam->for_each_strut({{0, 0, 0}, {1, 1, 1}}, take, nullptr);
  Random random(12);
  size_t rays = 0;
  for (const Vec3 end : ends) {
    // The same end to the last digits.
    const Neighbourhood::Located at = grid.locate(end);
    std::vector<NearEdge> edges;
    find_edges_near(foam->seeds(), at.cell, at.fraction, 0.01, edges);
    for (const NearEdge& edge : edges)
      for (const bool is_high : {false, true}) {
        const Vec3 tip = edge.line.at(is_high ? edge.part.high : edge.part.low);
        const Vec3 other = edge.line.at(is_high ? edge.part.low : edge.part.high);
        if (length(tip - at.fraction) > 2e-6 || length(tip - other) < 0.005) continue;
        const Vec3 along = unit_along(tip - other);
        const Vec3 out = unit_along(cross(along, random.direction())), way = cross(out, along);
        // The ray is in the cylinder for twice this.
        constexpr double half = 1e-5, depth = half * half / (2 * radius);
        const double behind = std::pow(10, random.between(-5.5, -4.5));
        RaySearch search;
        search.ray = {end - at.fraction + tip + along * behind + out * (radius - depth) - way * 0.2,
                      way};
        search.to = 0.4;
        if (foam->inside(search.ray.origin)) continue;
        ++rays;
        assert_true(walk_cells(*foam, &search, 1, nullptr));
        if (search.found && !foam->inside(search.ray.at(search.t)) &&
            !foam->inside(search.ray.at(search.t + foam->ray_tolerance())))
          fail_msg("%g behind the end of a strut: outside at t %.17g", behind, search.t);
      }
  }
  assert_true(rays > 100);
}

/// Of a strut whose seeds are not known, rays that begin nearer to the surface than the error of
/// its ends and graze it farther on, so shortly that steps of an eighth of the way may miss that.
void grazes_of_struts_without_seeds_are_found(void**) {
  constexpr double radius = 0.05, depth = 1e-9;
  const Ref<const Foam> foam = make_ref<Foam>(shared_context(), Neighbourhood{}, Parameter(radius),
                                              1.0, uint64_t{7}, FoamMethod::direct);
  const StrutEntries entries(*foam);
  const double near = std::sqrt(2 * radius * end_error), half = std::sqrt(2 * radius * depth);
  Random random(14);
  size_t rays = 0;
  const auto check = [&](Vec3 a, Vec3 b, double) {
    if (length(b - a) < radius) return;
    const Vec3 along = unit_along(b - a), out = unit_along(cross(along, random.direction()));
    const Vec3 way = cross(out, along), top = (a + b) * 0.5 + out * (radius - depth);
    const double before = near * random.between(0.2, 0.8);
    RaySearch search;
    search.ray = {top - way * before, way};
    search.to = 2 * near;
    bool is_alone = foam->inside(top);  // no other strut is as near
    for (double t = 1.5 * half; t < search.to; t += 0.5 * half)
      is_alone = is_alone && !foam->inside(top + way * t) && !foam->inside(top - way * t);
    if (!is_alone) return;
    ++rays;
    StrutLine strut;
    const auto single = [](Vec3 p) {
      return std::array{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    };
    entries.set_ends(single(a), single(b), {0, 0, 0}, strut);
    const StrutEntry entry = entries.find(entries.ray(search), strut);
    if (!entry.is_met || !foam->inside(search.ray.at(entry.t)) ||
        foam->inside(search.ray.at(entry.t - 2 * foam->ray_tolerance())))
      fail_msg("a ray %g before a strut: %d %g", before, entry.is_met, entry.t);
  };
  foam->for_each_strut({{0, 0, 0}, {4, 4, 4}}, check, nullptr);
  print_message("%zu grazes\n", rays);
  assert_true(rays > 30);
}

/// Rays that end about where they enter, or begin about where they leave. Cells are so flat that
/// the seeds of many struts are too many cells apart to be kept, or so far away that rounding
/// counts.
void rays_end_and_begin_at_struts(void**) {
  for (const Neighbourhood& grid :
       {Neighbourhood{{}, {1, 1, 0.1}, {}}, Neighbourhood{{-1e6, 1e6, 1e6}, {1, 1, 1}, {}}}) {
    const Ref<const Foam> foam = make_ref<Foam>(shared_context(), grid, Parameter(0.05), 1.0,
                                                uint64_t{7}, FoamMethod::direct);
    const auto walk = [&](RaySearch& search) {
      assert_true(walk_cells(*foam, &search, 1, nullptr));
      return search.found;
    };
    Random random(13);
    size_t found = 0;
    for (size_t i = 0; i < 50 + test_count(400); ++i) {
      RaySearch search;
      search.ray = {grid.origin + random.in_box({{0, 0, 0}, {4, 4, 4}}), random.direction()};
      search.to = 3;
      const double tolerance = foam->ray_tolerance(search.ray, search.to);
      if (!walk(search) || search.t == 0) continue;
      ++found;
      for (const double beyond : {-4.0, -1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 1.0, 4.0}) {
        RaySearch shorter = search;
        shorter.to = std::max(0.0, search.t + beyond * tolerance);
        const bool is_in = foam->inside(shorter.ray.at(shorter.to));
        if (walk(shorter) ? shorter.t > shorter.to : beyond >= 1 && is_in)
          fail_msg("ray %zu to %.17g: %d %.17g", i, shorter.to, shorter.found, shorter.t);
      }
      const double out = foam->leave(search.ray, search.t, search.to, nullptr);
      for (const double beyond : {4.0, 100.0, 1e4}) {
        RaySearch later = search;
        later.from = out + beyond * tolerance;
        if (!(later.from < later.to) || foam->inside(later.ray.at(later.from))) continue;
        RaySearch marched = later;
        foam->Structure::enter(&marched, 1, nullptr);
        if (walk(later) != marched.found ||
            (later.found && !(std::abs(later.t - marched.t) <= 4 * tolerance)))
          fail_msg("ray %zu from %.17g: %d %.17g, march %d %.17g", i, later.from, later.found,
                   later.t, marched.found, marched.t);
      }
    }
    assert_true(found > 10);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(struts_end_for_shallow_rays),
                              cmocka_unit_test(grazes_of_struts_without_seeds_are_found),
                              cmocka_unit_test(rays_end_and_begin_at_struts)};
  const int failed = cmocka_run_group_tests_name("foam rays", tests, nullptr, nullptr);
  std::vector<StructureRow> rows;
  for (const StructureRow& row : structures())
    if (row.kind.family == "foam DIRECT" && (!has_density(row) || is_tried(row)))
      rows.push_back(row);
  struct Field {
    const char* name;
    FieldRef (*vary)(const Neighbourhood&, FieldRef linear);
  };
  for (const Field& field :
       {Field{"radial radius", radial_field}, Field{"radius by expression", expression_field},
        Field{"host's radius", host_field<false>},
        Field{"host's radius of known slope", host_field<true>}})
    for (const GridVariant& variant : grid_variants(false)) {
      StructureRow row = rows.back();
      row.kind.vary = field.vary;
      row.kind.radius = 0.2;
      row.kind.jitter = 1;
      row.variant = variant;
      row.is_graded = true;
      row.graded_from = 0.3;
      row.name = std::string(field.name) + (variant.name.empty() ? "" : ", ") + variant.name;
      ++row.index;
      rows.push_back(row);
    }
  return failed + run_for_each("foam rays", rows, test_row);
}
