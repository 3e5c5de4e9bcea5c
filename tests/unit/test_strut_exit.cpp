// SPDX-License-Identifier: Apache-2.0
// Exits of rays from struts whose radius is below rounding, or falls below it along the ray: none
// is before the ray's start or past its end, and the ray is in the foam up to the exit. Rays that
// search the foam end too, and hits are not before the start.
#include <cmath>
#include <string>
#include <vector>

#include "field/gradient.h"
#include "random.h"
#include "structure/foam/foam.h"
#include "structure/foam/rays/strut_exit.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  std::string name;
  double jitter, radius, radius_below;  // above the heights where it varies, and below them
  double away;                          // cells
  Vec3 stretch;
  double weight;
  double density;      // at x = 1; 1 at x = 0
  double heights = 1;  // about z = 0
};

std::string named(const char* format, double radius) {
  char name[80];
  std::snprintf(name, sizeof name, format, radius);
  return name;
}

std::vector<Row> rows() {
  std::vector<Row> rows;
  const auto add = [&](const Row& row) {
    for (const double away : {0.0, 1000.0}) {
      rows.push_back(row);
      rows.back().away = away;
      rows.back().name += away > 0 ? ", far away" : "";
    }
  };
  // Only struts without jitter have places that are exactly on their axes. 2e-16 is about the
  // rounding of points; squares of radii below 1e-162 are 0.
  for (const double radius : {1e-10, 1e-15, 2e-16, 1e-17, 1e-170, 5e-324})
    add({named("radius %g", radius), 0, radius, radius, 0, {1, 1, 1}, 0, 1});
  for (const double low : {0.0, 1e-170, 1e-16}) {
    for (const double high : {1e-12, 1e-14, 1e-15})
      add({named("radius %g", high) + named(" to %g", low), 0, high, low, 0, {1, 1, 1}, 0, 1});
    for (const double jitter : {0.0, 1.0})
      add({named("radius 0.0625 to %g, jitter ", low) + std::to_string(jitter),
           jitter,
           0.0625,
           low,
           0,
           {1, 1, 1},
           0,
           1});
  }
  // Within less than the radius, it falls below rounding.
  for (const double low : {0.0, 1e-16})
    for (const double jitter : {0.0, 1.0})
      add({named("radius 0.2 to %g, steep, jitter ", low) + std::to_string(jitter),
           jitter,
           0.2,
           low,
           0,
           {1, 1, 1},
           0,
           1,
           0.0625});
  for (const double low : {1e-17, 1e-170}) {
    const std::string name = named("radius 0.0625 to %g, ", low);
    add({name + "stretched", 1, 0.0625, low, 0, {1, 1, 2}, 0, 1});
    add({name + "weighted", 1, 0.0625, low, 0, {1, 1, 1}, 0.5, 1});
    add({name + "density", 1, 0.0625, low, 0, {1, 1, 1}, 0, 8});
  }
  return rows;
}

Ref<Foam> make_foam(const Row& row) {
  static const Ref<Context> context = make_ref<Context>(1u, uint64_t{64} << 20, uint64_t{0});
  Neighbourhood grid;
  grid.origin = Vec3{1, -1, 1} * row.away;
  const auto ramp = [&](Vec3 from, double low, Vec3 to, double high) {
    return Parameter(
        Ref<const Field>(make_ref<GradientField>(grid.origin + from, low, grid.origin + to, high)));
  };
  const Parameter radius = row.radius == row.radius_below
                               ? Parameter(row.radius)
                               : ramp({0, 0, -0.5 * row.heights}, row.radius_below,
                                      {0, 0, 0.5 * row.heights}, row.radius);
  const Parameter density =
      row.density > 1 ? ramp({0, 0, 0}, 1, {1, 0, 0}, row.density) : Parameter(1);
  return make_ref<Foam>(context, grid, radius, row.jitter, uint64_t{7}, FoamMethod::direct, density,
                        row.stretch, row.weight);
}

/// Rays from places on the axes of struts: along them, both ways, across, and any way.
std::vector<Ray> rays_from_struts(const Foam& foam, Random& random) {
  std::vector<Ray> rays;
  const Vec3 o = foam.neighbourhood().origin;
  size_t skipped = 0;
  const auto add = [&](Vec3 a, Vec3 b, double) {
    if (!(length(b - a) > 1e-6) || skipped++ % 149) return;
    const Vec3 along = (b - a) * (1 / length(b - a));
    const Vec3 across = cross(along, random.direction());
    for (const double part : {random.unit(), 0.0})
      for (const Vec3 way :
           {along, along * -1.0, across * (1 / length(across)), random.direction()})
        rays.push_back({a + (b - a) * part, way});
  };
  foam.for_each_strut({o - Vec3{1, 1, 1}, o + Vec3{1, 1, 1}}, add, nullptr);
  // Exactly on the edges of cells, which are those of the foam without jitter.
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 along{}, at{};
    along[axis] = 1;
    at[axis] = 0.25;
    for (const Vec3 way : {along, along * -1.0, Vec3{along.y, along.z, along.x}})
      rays.push_back({o + at, way});
  }
  return rays;
}

void test_row(void** state) {
  const Row& row = *static_cast<const Row*>(*state);
  Random random(3);
  const Ref<Foam> foam = make_foam(row);
  size_t inside = 0, left = 0;
  for (const Ray& ray : rays_from_struts(*foam, random))
    for (const double from : {0.0, 0.125, 0.24, random.unit()}) {
      const double to = from + 1.5;
      if (foam->inside(ray.at(from))) {
        ++inside;
        const double exit = strut_exit(*foam, ray, from, to);
        if (!(exit >= from && exit <= to)) fail_msg("exit %g of [%g, %g]", exit, from, to);
        left += exit > from;
        for (const double part : {0.0, 0.001, 0.3, 0.7, 0.999, 1.0}) {
          const double t = from + (exit - from) * part;
          if (!foam->inside(ray.at(t)))
            fail_msg("from %g the exit is %.17g, but at %.17g the ray is outside", from, exit, t);
        }
        const double end = from > 0 ? exit : foam->leave(ray, from, to, nullptr);
        assert_true(end >= from && end <= to);
      }
      if (from > 0) continue;
      RaySearch search{ray, from, to};
      foam->enter(&search, 1, nullptr);
      if (search.found) assert_true(search.t >= from && search.t <= to);
    }
  print_message("%s: %zu rays begin inside, %zu have an exit\n", row.name.c_str(), inside, left);
}

}  // namespace

int main() {
  std::vector<Row> all = rows();
  return run_for_each("exits from struts below rounding", all, test_row);
}
