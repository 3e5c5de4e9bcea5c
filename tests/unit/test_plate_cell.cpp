// SPDX-License-Identifier: Apache-2.0
// Unit cells of plates: counts, areas and symmetries of the named ones against closed forms,
// triangles that count once, distances to a triangle against a formula of another kind, volume
// fractions.
#include "structure/lattice/cell/plate_cell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "field/gradient.h"
#include "field/radial.h"
#include "msq_test.h"
#include "random.h"
#include "structure/lattice/plates/plate_lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

double area_of(const PeriodicPlate& p) {
  return 0.5 * length(cross(p.b - p.a, p.c - p.a));
}

struct NamedCell {
  const char* name;
  PlateCell (*make)();
  size_t faces, periodic;
  double area;
};

const double root_2 = std::sqrt(2.0), root_3 = std::sqrt(3.0);
// Planes {110}: 6 rectangles of 1 by sqrt 2. Planes {111}: 8 triangles of sides sqrt 2. Kelvin: 14
// faces of each of two polyhedra, shared by two; sides sqrt(2) / 4.
const NamedCell named_cells[] = {
    {"cubic", cubic_plate_cell, 6, 6, 3},
    {"BCC", bcc_plate_cell, 12, 12, 6 * root_2},
    {"FCC", fcc_plate_cell, 8, 8, 8 * root_3 / 2},
    {"cubic and octet", cubic_octet_plate_cell, 14, 14, 3 + 4 * root_3},
    {"Kelvin", kelvin_plate_cell, 72, 72, (6 + 12 * root_3) / 8}};

void test_named_cells(void**) {
  for (const NamedCell& named : named_cells) {
    const PlateCell cell = named.make();
    assert_int_equal(cell.faces.size(), named.faces);
    for (const Vec3& node : cell.nodes) assert_true((Box3{{0, 0, 0}, {1, 1, 1}}.contains(node)));
    const std::vector<PeriodicPlate> plates = periodic_plates(cell);
    assert_int_equal(plates.size(), named.periodic);
    double area = 0;
    for (const PeriodicPlate& plate : plates) area += area_of(plate);
    assert_true(std::abs(area - named.area) < 1e-14 * named.area);
  }
}

/// Points keep their membership if axes are exchanged, mirrored or moved by a cell, all of which
/// are symmetries of cubic crystals.
void test_symmetries(void**) {
  Random random(5);
  for (const NamedCell& named : named_cells) {
    const PlateLattice lattice({}, named.make(), Parameter(0.1));
    for (size_t i = 0; i < test_count(3000); ++i) {
      const Vec3 p = random.in_box({{0, 0, 0}, {1, 1, 1}});
      const double onset = lattice.onset(p);
      for (const Vec3& image : {Vec3{p.y, p.z, p.x}, Vec3{p.y, p.x, p.z}, Vec3{1 - p.x, p.y, p.z},
                                Vec3{p.x + 5, p.y, p.z - 3}})
        assert_true(std::abs(lattice.onset(image) - onset) < 1e-13);
    }
  }
}

void test_planes(void**) {
  // Cubic: distance to the nearest plane x, y, z = n; FCC: to +-x +-y +-z = n.
  const PlateLattice cubic({}, cubic_plate_cell(), Parameter(0.1)),
      fcc({}, fcc_plate_cell(), Parameter(0.1)), bcc({}, bcc_plate_cell(), Parameter(0.1));
  const auto to_integer = [](double x) { return std::abs(x - std::round(x)); };
  Random random(6);
  for (size_t i = 0; i < test_count(10000); ++i) {
    const Vec3 p = random.in_box({{-2, -2, -2}, {2, 2, 2}});
    const double x = to_integer(p.x), y = to_integer(p.y), z = to_integer(p.z);
    assert_true(std::abs(cubic.onset(p) - 2 * std::min({x, y, z})) < 1e-14);
    const double octet = std::min({to_integer(p.x + p.y + p.z), to_integer(p.x + p.y - p.z),
                                   to_integer(p.x - p.y + p.z), to_integer(p.x - p.y - p.z)});
    assert_true(std::abs(fcc.onset(p) - 2 * octet / root_3) < 1e-14);
    const double diagonal =
        std::min({to_integer(p.x + p.y), to_integer(p.x - p.y), to_integer(p.y + p.z),
                  to_integer(p.y - p.z), to_integer(p.z + p.x), to_integer(p.z - p.x)});
    assert_true(std::abs(bcc.onset(p) - 2 * diagonal / root_2) < 1e-14);
  }
}

void test_coinciding_faces(void**) {
  PlateCell cell;
  cell.nodes = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 0, 1}};
  cell.faces = {{0, 1, 2}, {5, 3, 4}};  // the same, a cell apart and from another corner
  cell.factors = {0.5, 2};
  const std::vector<PeriodicPlate> plates = periodic_plates(cell);
  assert_int_equal(plates.size(), 1);
  assert_true(plates[0].factor == 2);
}

/// The least distance over the triangle by halving it, in extended precision.
long double searched_distance(Vec3 p, std::array<Vec3, 3> t) {
  using Real = long double;
  struct Point {
    Real x, y, z;
  };
  const auto to_real = [](Vec3 v) { return Point{v.x, v.y, v.z}; };
  const auto middle = [](Point a, Point b) {
    return Point{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2};
  };
  const auto distance = [&](Point a) {
    const Real x = a.x - p.x, y = a.y - p.y, z = a.z - p.z;
    return std::sqrt(x * x + y * y + z * z);
  };
  // Branch and bound: the best parts of four, as many as may hold the nearest point.
  struct Part {
    Point a, b, c;
  };
  std::vector<Part> parts = {{to_real(t[0]), to_real(t[1]), to_real(t[2])}}, next;
  Real best = 1e30L;
  for (int level = 0; level < 20; ++level) {
    for (const Part& part : parts)
      best = std::min({best, distance(part.a), distance(part.b), distance(part.c)});
    next.clear();
    for (const Part& part : parts) {
      const Point ab = middle(part.a, part.b), bc = middle(part.b, part.c),
                  ca = middle(part.c, part.a);
      for (const Part& quarter :
           {Part{part.a, ab, ca}, Part{ab, part.b, bc}, Part{ca, bc, part.c}, Part{ab, bc, ca}}) {
        const auto size = [](Point u, Point v) {
          return std::abs(u.x - v.x) + std::abs(u.y - v.y) + std::abs(u.z - v.z);
        };
        const Real reach = std::max(size(quarter.a, quarter.b), size(quarter.a, quarter.c));
        if (distance(quarter.a) - reach <= best) next.push_back(quarter);
      }
    }
    parts.swap(next);
    if (parts.size() > 4000) break;
  }
  for (const Part& part : parts) best = std::min(best, distance(part.a));
  return best;
}

void test_triangle_distance(void**) {
  Random random(7);
  size_t over = 0;
  const size_t count = test_count(300) + 100;
  for (size_t i = 0; i < count; ++i) {
    const Box3 box{{0, 0, 0}, {1, 1, 1}};
    const Vec3 a = random.in_box(box), b = random.in_box(box), c = random.in_box(box);
    if (length(cross(b - a, c - a)) < 1e-3) continue;
    const PlateTriangle triangle(a, b, c);
    const Vec3 p = random.in_box(box.grown(0.5));
    const double found = std::sqrt(triangle.distance_squared(p));
    const auto wanted = static_cast<double>(searched_distance(p, {a, b, c}));
    over += triangle.is_over(p - a);
    // The search comes within its last parts' size of the nearest point.
    assert_true(found <= wanted + 1e-14 && wanted - found < 2e-5);
    assert_true(std::abs(length(triangle.way_to(p)) - found) < 1e-14);
    const double moved = std::sqrt(PlateTriangle(b, c, a).distance_squared(p));
    assert_true(std::abs(moved - found) < 1e-12);
  }
  assert_in_range(over, 1, count - 1);
}

/// The part of random points that is inside, and its standard error.
void expect_fraction(const PlateLattice& lattice, double wanted) {
  Random random(9);
  const size_t count = test_count(60000) + 2000;
  size_t inside = 0;
  for (size_t i = 0; i < count; ++i)
    inside += lattice.inside(random.in_box({{0, 0, 0}, {1, 1, 1}}));
  const double found = static_cast<double>(inside) / static_cast<double>(count);
  const double error = std::sqrt(wanted * (1 - wanted) / static_cast<double>(count));
  if (std::abs(found - wanted) > 4.5 * error)
    fail_msg("%g of the points are inside, not %g +- %g", found, wanted, error);
}

void test_volume_fractions(void**) {
  for (const double t : {0.05, 0.3, 0.9})
    expect_fraction(PlateLattice({}, cubic_plate_cell(), Parameter(t)),
                    1 - (1 - t) * (1 - t) * (1 - t));
  // Half of the plates twice as thick: planes normal to x of 0.4, others of 0.2.
  PlateCell cell = cubic_plate_cell();
  cell.factors = {2, 2, 1, 1, 1, 1};
  expect_fraction(PlateLattice({}, cell, Parameter(0.2)), 1 - 0.6 * 0.8 * 0.8);
  // One triangle alone: a prism, half of each cylinder, and a ball in three wedges.
  cell.nodes = {{0.3, 0.3, 0.5}, {0.7, 0.3, 0.5}, {0.3, 0.6, 0.5}};
  cell.faces = {{0, 1, 2}};
  cell.factors.clear();
  const double t = 0.2, r = 0.1, pi_ = 3.14159265358979323846;
  expect_fraction(PlateLattice({}, cell, Parameter(t)),
                  0.06 * t + 0.5 * pi_ * r * r * (0.4 + 0.3 + 0.5) + 4 * pi_ * r * r * r / 3);
}

void test_boxes(void**) {
  const Parameter thicknesses[] = {
      Parameter(0.15),
      Parameter(make_ref<GradientField>(Vec3{-2, 0, 0}, 0.05, Vec3{2, 1, 0.5}, 0.5)),
      Parameter(make_ref<GradientField>(Vec3{-0.2, -0.2, -0.2}, 0.0, Vec3{0.2, 0.2, 0.2}, 0.9))};
  for (const Parameter& thickness : thicknesses) {
    const PlateLattice lattice({}, cubic_octet_plate_cell(), thickness);
    // The last one changes about the origin alone.
    const double around = &thickness == &thicknesses[2] ? 0.25 : 2;
    Random random(11);
    size_t decided[3] = {};
    for (size_t i = 0; i < test_count(3000) + 1500; ++i) {
      const Vec3 low = random.in_box({Vec3{-1, -1, -1} * around, Vec3{1, 1, 1} * around});
      const Box3 box{low, low + Vec3{1, 1, 1} * random.between(0.001, 0.1)};
      const BoxClass known = lattice.classify(box);
      ++decided[static_cast<int>(known)];
      for (unsigned n = 0; n < 20; ++n) {
        const Vec3 corner{(n & 1 ? box.max : box.min).x, (n & 2 ? box.max : box.min).y,
                          (n & 4 ? box.max : box.min).z};
        const bool is_inside = lattice.inside(n < 8 ? corner : random.in_box(box));
        if (known != BoxClass::mixed) assert_int_equal(is_inside, known == BoxClass::inside);
      }
    }
    for (const size_t number : decided) assert_true(number > 0);
  }
}

// A plate whose thickness falls by 1.6 along its normal, and boxes along that.
void test_boxes_across_a_slope(void**) {
  const Ref<const Field> field = make_ref<GradientField>(Vec3{0, 0, 0}, 0.4, Vec3{0, 0.25, 0}, 0.0);
  const PlateLattice lattice({}, cubic_plate_cell(), Parameter(field));
  constexpr double half = 0.01;
  size_t outside = 0;
  for (int i = 0; i < 150; ++i) {
    const Vec3 centre{0.5, 0.05 + 0.001 * i, 0.5}, up{0, half, 0};
    const BoxClass known = lattice.classify({centre - up, centre + up});
    if (known == BoxClass::mixed) continue;
    assert_int_equal(lattice.inside(centre - up), known == BoxClass::inside);
    assert_int_equal(lattice.inside(centre + up), known == BoxClass::inside);
    outside += known == BoxClass::outside;
  }
  assert_true(outside > 50);
}

// Plates normal to y, whose thickness grows with the distance from the y axis.
void test_normals(void**) {
  const Ref<const Field> linear = make_ref<GradientField>(Vec3{0, 0, 0}, 0.1, Vec3{1, 0, 0}, 0.3);
  const Ref<const Field> radial =
      make_ref<RadialField>(Vec3{0, 0, 0}, Vec3{0, 1, 0}, RadialField::Ramp{0, 0.1, 2, 0.5});
  const struct {
    Ref<const Field> thickness;
    Vec3 at, gradient;  // where the thickness is 0.2
  } rows[] = {{linear, {0.5, 0.5, 0.5}, {0.2, 0, 0}}, {radial, {0.3, 0.5, 0.4}, {0.12, 0, 0.16}}};
  for (const auto& row : rows)
    for (const double factor : {1.0, 2.0}) {
      PlateCell cell = cubic_plate_cell();
      cell.factors.assign(6, factor);
      const PlateLattice lattice({}, cell, Parameter(row.thickness));
      const Vec3 normal = lattice.normal({row.at, {0, -1, 0}}, 0.5 - 0.5 * factor * 0.2);
      const Vec3 wanted = Vec3{0, 1, 0} - row.gradient * (0.5 * factor);
      assert_true(length(normal - wanted * (1 / length(wanted))) < 1e-6);
    }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_named_cells),
      cmocka_unit_test(test_symmetries),
      cmocka_unit_test(test_planes),
      cmocka_unit_test(test_coinciding_faces),
      cmocka_unit_test(test_triangle_distance),
      cmocka_unit_test(test_volume_fractions),
      cmocka_unit_test(test_boxes),
      cmocka_unit_test(test_boxes_across_a_slope),
      cmocka_unit_test(test_normals),
  };
  return cmocka_run_group_tests_name("plate_cell", tests, nullptr, nullptr);
}
