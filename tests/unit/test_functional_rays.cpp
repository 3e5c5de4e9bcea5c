// SPDX-License-Identifier: Apache-2.0
// Rays through functional structures whose values, slopes or scales are extreme: they end, agree
// with membership, and stop with their job.
#include <thread>

#include "base/status.h"
#include "expression/parser.h"
#include "field/host.h"
#include "random.h"
#include "ray_check.h"
#include "structure/functional/ray_search.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

Ref<Functional> make(const char* text, FunctionalKind kind, double level, double cell = 1) {
  return make_ref<Functional>(Neighbourhood{{0, 0, 0}, {cell, cell, cell}, {}},
                              parse_expression(text, {}), kind, Parameter(level), 1);
}

struct Row {
  std::string name;
  const char* text;
  FunctionalKind kind;
  double level, cell;
  bool is_known;  ///< bounds are finite along all rays
};

/// As RayWalk's samples, and around what membership has along the ray at random places.
void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  const Ref<Functional> solid = make(row.text, row.kind, row.level, row.cell);
  const double part =
      row.is_known ? 4 * solid->ray_tolerance() : 1.5 * FunctionalRays::max_blind_step * row.cell;
  Random random(7);
  int entries = 0;
  for (size_t i = 0; i < test_count(200); ++i) {
    Vec3 a = random.in_box({{-1, -1, -1}, {2, 2, 2}}) * row.cell;
    Vec3 b = random.in_box({{-1, -1, -1}, {2, 2, 2}}) * row.cell;
    if (i % 2 == 0) {
      b = a;
      b[i % 8 == 0 ? 1 : 0] += (i % 4 ? 1 : -1) * row.cell;
    }
    const Vec3 way = (b - a) * (1 / row.cell);
    entries += check_ray(
        row.name.c_str(), {a, way * (1 / length(way))}, 0, 3 * row.cell, RayWalk{part, 300},
        [&](Vec3 p) { return solid->inside(p); },
        [&](const Ray& r, double first, double last, double& t) {
          RaySearch search{r, first, last};
          solid->enter(&search, 1, nullptr);
          t = search.t;
          return search.found;
        },
        [&](const Ray& r, double first, double last) {
          return solid->leave(r, first, last, nullptr);
        });
  }
  // Sheets may be too thin.
  if (test_count(200) >= 40 && row.kind == FunctionalKind::network) assert_true(entries > 0);
}

/// Along a face of the solid, or a tangent, nearer than rounding tells.
void rays_along_surfaces_end(void**) {
  struct Case {
    const char* text;
    double level;
  };
  for (const Case& c : {Case{"x", 3}, Case{"max(x,x+z-z)", 3}, Case{"3-abs(x-6)+3", 3},
                        Case{"(x-3)*1e150+3", 3}, Case{"(x-3)*1e-150", 0}}) {
    const Ref<Functional> solid = make(c.text, FunctionalKind::network, c.level);
    size_t outside = 0;
    double x = 3 / two_pi;
    const int rays = test_scale() < 1 ? 10 : 40;
    for (int i = 0; i < rays; ++i, x = std::nextafter(x, 1.0)) {
      RaySearch search{{{x, 0.1, 0.2}, {0, 0.8, 0.6}}, 0, 50};
      solid->enter(&search, 1, nullptr);
      const bool inside = solid->inside(search.ray.at(0));
      outside += !inside;
      assert_true(!inside || (search.found && search.t == 0));
      assert_true(!search.found || solid->inside(search.ray.at(search.t)));
      assert_true(solid->leave(search.ray, 0, 50, nullptr) <= 50);
    }
    assert_true(outside > 0);
  }
}

/// What comes after such a way is found.
void rays_along_surfaces_find_what_is_beyond(void**) {
  const Ref<Functional> solid = make("min(x,3+50*(abs(y-4)-0.5))", FunctionalKind::network, 3);
  const double x = std::nextafter(3 / two_pi, 1.0) + 0x1p-51;
  RaySearch search{{{x, 0.01, 0.2}, {0, 1, 0}}, 0, 0.9};
  assert_false(solid->inside(search.ray.at(0)));
  solid->enter(&search, 1, nullptr);
  assert_true(search.found);
  assert_true(std::abs(search.ray.at(search.t).y - 3.5 / two_pi) < 1e-9);
}

/// Not even a short part, if the way is shorter than 10^4 tolerances.
void rays_shortly_along_surfaces_lose_nothing(void**) {
  // Angles are 2 pi to a cell: it is 98 tolerances long.
  const Ref<Functional> solid = make("min(x,3+1e6*(abs(y-4)-4.5e-9))", FunctionalKind::network, 3);
  const double x = std::nextafter(3 / two_pi, 1.0) + 0x1p-51, y = (4 - 4.5e-9) / two_pi;
  const double tolerance = solid->ray_tolerance();
  for (const double way : {100.0, 1000.0, 3000.0}) {
    RaySearch search{{{x, y - way * tolerance, 0.2}, {0, 1, 0}}, 0, 0.1};
    assert_false(solid->inside(search.ray.at(0)));
    solid->enter(&search, 1, nullptr);
    if (!(search.found && std::abs(search.t - way * tolerance) < 4 * tolerance))
      fail_msg("%d at %g tolerances, not %g", search.found, search.t / tolerance, way);
  }
}

/// As above, with a level of which a host says how steep it is: its range at a point is rounded.
void rays_shortly_along_host_levels_lose_nothing(void**) {
  HostFieldCalls calls;
  calls.evaluate = [](const Vec3*, size_t count, double* values) {
    std::fill_n(values, count, 3.0);
  };
  const auto level = make_ref<HostField>(calls, Interval{0, 4}, 1.0, true);
  const auto solid =
      make_ref<Functional>(Neighbourhood{}, parse_expression("min(x,3+1e6*(abs(y-4)-4.5e-9))", {}),
                           FunctionalKind::network, Parameter(Ref<const Field>(level)), 1);
  const double x = std::nextafter(3 / two_pi, 1.0) + 0x1p-51, y = (4 - 4.5e-9) / two_pi;
  const double tolerance = solid->ray_tolerance();
  for (const double way : {1000.0, 3000.0, 5000.0}) {
    RaySearch search{{{x, y - way * tolerance, 0.2}, {0, 1, 0}}, 0, 0.1};
    assert_false(solid->inside(search.ray.at(0)));
    solid->enter(&search, 1, nullptr);
    if (!(search.found && std::abs(search.t - way * tolerance) < 4 * tolerance))
      fail_msg("%d at %g tolerances, not %g", search.found, search.t / tolerance, way);
  }
}

/// Steps of 10^-4 cells, as many as lead past 20 cells: no part of that length is lost.
void many_short_steps_lose_nothing(void**) {
  constexpr double steepest = 1e4;
  for (const double place : {17.3, 18.7, 19.9}) {
    HostFieldCalls calls;
    calls.evaluate = [place](const Vec3* points, size_t count, double* values) {
      for (size_t i = 0; i < count; ++i)
        values[i] = std::max(-1.0, 1 - steepest * std::abs(points[i].y - place));
    };
    const auto level = make_ref<HostField>(calls, Interval{-1, 1}, steepest, true);
    const auto solid =
        make_ref<Functional>(Neighbourhood{}, parse_expression("sin(x)", {}),
                             FunctionalKind::network, Parameter(Ref<const Field>(level)), 1);
    RaySearch search{{{0, 0, 0}, {0, 1, 0}}, 0, 20};
    solid->enter(&search, 1, nullptr);
    assert_true(search.found && std::abs(search.t - (place - 1 / steepest)) < 1e-8);
  }
}

/// More rays than are searched at once, some of which have no length or are none.
void rays_together_are_as_each_alone(void**) {
  for (const char* text : {"sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", "x^2+y^2+z^2-9"}) {
    const Ref<Functional> solid = make(text, FunctionalKind::network, -0.6);
    Random random(3);
    for (const size_t count : {size_t{1}, size_t{31}, size_t{33}, size_t{300}}) {
      std::vector<RaySearch> together(count);
      for (RaySearch& s : together) {
        const Vec3 way = random.in_box({{-1, -1, -1}, {1, 1, 1}});
        s.ray = {random.in_box({{-1, -1, -1}, {2, 2, 2}}), way * (1 / length(way))};
        s.to = random.below(8) == 0 ? -1 : random.below(8) == 0 ? 0 : random.between(0, 3);
      }
      std::vector<RaySearch> alone = together;
      solid->enter(together.data(), count, nullptr);
      size_t found = 0;
      for (size_t i = 0; i < count; ++i) {
        const RaySearch &a = together[i], &b = alone[i];
        solid->enter(&alone[i], 1, nullptr);
        found += b.found;
        if (a.found != b.found || (a.found && !(a.t == b.t && a.normal == b.normal)))
          fail_msg("ray %zu of %zu: %d %.17g, alone %d %.17g", i, count, a.found, a.t, b.found,
                   b.t);
      }
      assert_true(count < 300 || (found > count / 8 && found < count));
    }
  }
}

/// A search that would take hours: 10^8 bends to a cell, and nothing is inside.
void searches_stop_with_their_job(void**) {
  const Ref<Functional> solid =
      make("sin(1e4*sin(1e4*x))*sin(1e4*sin(1e4*y))", FunctionalKind::network, -1.5);
  for (const bool wanted : {true, false}) {
    const Ref<Functional> same =
        wanted ? solid : make("sin(1e4*sin(1e4*x))", FunctionalKind::network, 1.5);
    Job job;
    std::thread other([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      job.cancel();
    });
    std::vector<RaySearch> searches;
    for (int i = 0; i < 100; ++i)
      searches.push_back({{{0.1, 0.01 * i, 0.2}, {0.8, 0.6, 0}}, 0, 1e5});
    bool is_cancelled = false;
    try {
      if (wanted)
        same->enter(searches.data(), searches.size(), &job);
      else
        same->leave(searches[0].ray, 0, 1e5, &job);
    } catch (const Error& error) {
      is_cancelled = error.status == Status::cancelled;
    }
    other.join();
    assert_true(is_cancelled);
  }
}

/// So steep that bounds lead nowhere: the ray goes on by growing steps.
void steep_functions_end(void**) {
  const Ref<Functional> solid =
      make("sin(1e5*sin(1e5*sin(1e5*x)))", FunctionalKind::network, -0.999);
  RaySearch search{{{0.1, 0.2, 0.3}, {0.8, 0.6, 0}}, 0, 2};
  solid->enter(&search, 1, nullptr);
  assert_true(search.found && solid->inside(search.ray.at(search.t)));
  const Ref<Functional> none = make("sin(1e5*sin(1e5*sin(1e5*x)))+1.5", FunctionalKind::network, 0);
  search.to = test_scale() < 1 ? 0.005 : 0.05;
  none->enter(&search, 1, nullptr);
  assert_false(search.found);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(rays_along_surfaces_end),
                              cmocka_unit_test(rays_along_surfaces_find_what_is_beyond),
                              cmocka_unit_test(rays_shortly_along_surfaces_lose_nothing),
                              cmocka_unit_test(rays_shortly_along_host_levels_lose_nothing),
                              cmocka_unit_test(many_short_steps_lose_nothing),
                              cmocka_unit_test(rays_together_are_as_each_alone),
                              cmocka_unit_test(searches_stop_with_their_job),
                              cmocka_unit_test(steep_functions_end)};
  const int failed = cmocka_run_group_tests_name("functional_rays", tests, nullptr, nullptr);
  struct Case {
    const char* text;
    double level;
    bool is_known = true;
  };
  std::vector<Row> rows;
  for (const Case& c :
       {Case{"exp(57*x)", 5}, Case{"exp(57*x)", 1e100}, Case{"exp(57*x)", 1e154}, Case{"x^200", 1},
        Case{"x^200", 1e150}, Case{"1e154*sin(x)", 1}, Case{"1e154*sin(x)", 9e153},
        Case{"-1e154*sin(x)*cos(y)", 1e150}, Case{"1e160*(x-3)", 1}, Case{"1e-200*sin(x)", 5e-201},
        Case{"1e-290*cos(x)*cos(y)", 2e-291}, Case{"1e-310*sin(x)", 4e-311, false},
        Case{"1e307*sin(x)", 1e300, false}, Case{"exp(113*x)", 1e200, false},
        Case{"x^400", 1e300, false}, Case{"exp(57*x)*exp(57*y)*exp(-99*z)", 1e30, false},
        Case{"sin(x)", 0.3}})
    for (const FunctionalKind kind : {FunctionalKind::network, FunctionalKind::sheet})
      for (const double cell : {1.0, 1e-90, 1e90}) {
        char name[100];
        std::snprintf(name, sizeof name, "%s <= %g%s, cells of %g", c.text, c.level,
                      kind == FunctionalKind::sheet ? ", sheet" : "", cell);
        rows.push_back({name, c.text, kind, c.level, cell, c.is_known});
      }
  return failed + run_for_each("functional_rays", rows, test_row);
}
