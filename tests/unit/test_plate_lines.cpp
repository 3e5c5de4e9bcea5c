// SPDX-License-Identifier: Apache-2.0
// Plates cut by a plane: against all triangles of the tiling, one by one; against their area; and
// against the volume of thin plates.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/pi.h"
#include "fill/chain.h"
#include "fill/line_density.h"
#include "images.h"
#include "msq_test.h"
#include "random.h"
#include "refused_sections.h"
#include "structure/lattice/plates/plate_lattice.h"

using namespace msq;
using namespace msq::test;

namespace {

struct Row {
  const char* name;
  PlateCell cell;
  Neighbourhood grid;
};

/// Planes normal to z have the lines of the plane of x and y in it.
PlateCell upright_cell() {
  PlateCell cell;
  cell.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1},
                {0, 1, 0}, {0, 1, 1}, {1, 1, 0}, {1, 1, 1}};
  cell.faces = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 3}, {0, 6, 7}, {0, 7, 3}};
  return cell;
}

const Neighbourhood cubes{}, uneven{{0.1, -0.3, 0.2}, {1.25, 0.75, 1}, {}},
    turned{{0.3, 0.2, -0.7}, {1, 0.8, 1.1}, skew_rotation()};

std::vector<Row> rows() {
  std::vector<Row> rows;
  for (const auto& [name, cell] : {std::pair<const char*, PlateCell>{"cubic", cubic_plate_cell()},
                                   {"BCC", bcc_plate_cell()},
                                   {"FCC", fcc_plate_cell()},
                                   {"cubic and octet", cubic_octet_plate_cell()},
                                   {"Kelvin", kelvin_plate_cell()},
                                   {"upright", upright_cell()}})
    for (const Neighbourhood& grid : {cubes, uneven, turned}) rows.push_back({name, cell, grid});
  return rows;
}

Ref<PlateLattice> make(const Row& row, double thickness = 0.05) {
  return make_ref<PlateLattice>(row.grid, row.cell, Parameter(thickness));
}

const Box2 window{{-1.3, -1.1}, {1.6, 1.4}};

/// All triangles of cells about the window, each as often as cells have it.
std::vector<std::array<Vec3, 3>> all_triangles(const Row& row, double z) {
  std::vector<std::array<Vec3, 3>> all;
  const Box3 near =
      row.grid.to_grid(Box3{{window.min.x, window.min.y, z}, {window.max.x, window.max.y, z}});
  int low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = static_cast<int>(std::floor(near.min[axis] / row.grid.cell_size[axis])) - 1;
    high[axis] = static_cast<int>(std::floor(near.max[axis] / row.grid.cell_size[axis])) + 1;
  }
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i)
        for (const auto& face : row.cell.faces) {
          std::array<Vec3, 3> triangle;
          for (size_t c = 0; c < 3; ++c)
            triangle[c] = row.grid.from_grid(
                (row.cell.nodes[face[c]] + Vec3{double(i), double(j), double(k)}) *
                row.grid.cell_size);
          all.push_back(triangle);
        }
  return all;
}

/// Where a way meets a triangle, from 0 to 1; negative if it does not. Source: Möller and Trumbore,
/// "Fast, minimum storage ray-triangle intersection", 1997.
double meeting(const std::array<Vec3, 3>& t, Vec3 p, Vec3 way) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], n = cross(way, ac);
  const double determinant = dot(ab, n);
  if (std::abs(determinant) < 1e-12) return -1;
  const Vec3 from = p - t[0], m = cross(from, ab);
  const double u = dot(from, n) / determinant, v = dot(way, m) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return -1;
  const double s = dot(ac, m) / determinant;
  return s <= 1 ? s : -1;
}

/// Where a way meets lines.
std::vector<double> meetings(const LineGraph& graph, Vec2 p, Vec2 way) {
  std::vector<double> found;
  for (const auto& [a, b] : graph.lines) {
    const Vec2 from = graph.points[a], along = graph.points[b] - from;
    const double determinant = cross(way, along);
    if (std::abs(determinant) < 1e-14) continue;
    const double s = cross(from - p, along) / determinant, t = cross(from - p, way) / determinant;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) found.push_back(s);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Those that are not the same.
std::vector<double> once(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(),
                        [](double a, double b) { return std::abs(a - b) < 1e-7; }),
            all.end());
  return all;
}

void test_random_ways_meet_plates_and_lines_alike(void**) {
  for (const Row& row : rows()) {
    const double z = 0.3712;
    const LineGraph graph = make(row)->wall_lines({z, window, 1e-3});
    const auto triangles = all_triangles(row, z);
    Random random(7);
    size_t count = 0;
    for (size_t i = 0; i < test_count(400); ++i) {
      const Vec2 p{random.between(window.min.x, window.max.x),
                   random.between(window.min.y, window.max.y)};
      const Vec2 q{random.between(window.min.x, window.max.x),
                   random.between(window.min.y, window.max.y)};
      const Vec2 way = q - p;
      std::vector<double> known;
      for (const auto& triangle : triangles) {
        const double s = meeting(triangle, {p.x, p.y, z}, {way.x, way.y, 0});
        if (s >= 0) known.push_back(s);
      }
      known = once(known);
      const std::vector<double> all = meetings(graph, p, way), found = once(all);
      if (known.size() != found.size() || all.size() > found.size() + 1)
        fail_msg("%s: %zu plates, %zu lines at %zu places, from %.17g, %.17g to %.17g, %.17g",
                 row.name, known.size(), all.size(), found.size(), p.x, p.y, q.x, q.y);
      for (size_t k = 0; k < known.size(); ++k) assert_true(std::abs(known[k] - found[k]) < 1e-9);
      count += known.size();
    }
    assert_true(test_scale() < 0.1 || count > test_count(400));
  }
}

/// Over all heights, a plate of area A whose normal makes an angle with z has lines of a mean
/// length of A times the sine of that angle per height.
void test_length_is_that_of_the_area(void**) {
  for (const Row& row : rows()) {
    double sum = 0;
    for (const PeriodicPlate& plate : periodic_plates(row.cell)) {
      const LatticePlate placed = plate.placed({}, row.grid.cell_size);
      const Vec3 n = row.grid.rotation.apply(placed.axis.normal);
      const double area =
          0.5 * length(cross(placed.axis.b() - placed.axis.a(), placed.axis.c() - placed.axis.a()));
      sum += area * std::hypot(n.x, n.y);
    }
    const Vec3 size = row.grid.cell_size;
    const double known = sum / (size.x * size.y * size.z), found = mean_line_density(*make(row));
    print_message("%s: %.5f, by area %.5f\n", row.name, found, known);
    assert_true(std::abs(found / known - 1) < 0.02);
  }
}

/// Plates along z: the lines times the thickness are the part that is solid.
void test_thin_plates_have_the_volume_of_their_lines(void**) {
  for (const Neighbourhood& grid : {cubes, uneven}) {
    const double thickness = 0.01;
    const Ref<PlateLattice> plates = make({"upright", upright_cell(), grid}, thickness);
    Random random(3);
    size_t inside = 0;
    const size_t count = test_count(400000);
    for (size_t i = 0; i < count; ++i)
      inside += plates->inside(random.in_box({{0, 0, 0}, grid.cell_size * 3}));
    const double known = static_cast<double>(inside) / static_cast<double>(count);
    const double found = mean_line_density(*plates) * thickness;
    print_message("part of the volume %.5f, of the area %.5f\n", known, found);
    const double error = 3 / std::sqrt(static_cast<double>(inside));
    assert_true(std::abs(found / known - 1) < 0.02 + error);
  }
}

/// The same square as two triangles, by either diagonal, and a plate that covers a part of it.
void test_plates_that_lie_on_each_other_give_one_line(void**) {
  PlateCell cell;
  cell.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1},    {0, 1, 0},
                {1, 1, 0}, {1, 1, 1}, {0, 1, 1}, {0.25, 0, 0}, {0.5, 0, 1}};
  cell.faces = {{0, 1, 2}, {0, 2, 3}, {4, 5, 7}, {5, 6, 7}, {8, 1, 9}};
  for (const double z : {0.1, 0.5, 0.77}) {
    const Ref<PlateLattice> plates = make({"doubled", cell, cubes});
    const LineGraph graph = plates->wall_lines({z, {{-0.5, -0.5}, {3.5, 2.5}}, 1e-3});
    const CountedVector<Polyline> paths = chain(graph);
    assert_int_equal(paths.size(), 3);
    for (const Polyline& path : paths) {
      double sum = 0;
      for (size_t i = 1; i < path.points.size(); ++i)
        sum += length(path.points[i] - path.points[i - 1]);
      assert_true(std::abs(sum - length(path.points.back() - path.points.front())) < 1e-9);
      assert_true(sum > 4);
    }
  }
}

/// In the plane of plates: none of these, and the lines of the plates that come from below.
void test_plates_in_the_plane_have_no_lines(void**) {
  const Ref<PlateLattice> plates = make({"cubic", cubic_plate_cell(), cubes});
  for (const double z : {0.0, 1.0, 2.0, 0.5, 1e-12}) {
    const LineGraph graph = plates->wall_lines({z, {{0.2, 0.2}, {2.8, 2.8}}, 1e-3});
    double sum = 0;
    for (const auto& [a, b] : graph.lines) {
      const Vec2 way = graph.points[b] - graph.points[a];
      assert_true(std::min(std::abs(way.x), std::abs(way.y)) < 1e-9);
      sum += length(way);
    }
    // Two lines along either axis, three cells long, and what reaches out of the window.
    assert_true(std::abs(sum - 12) < 1e-6);
  }
  PlateCell flat;
  flat.nodes = {{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}};
  flat.faces = {{0, 1, 2}};
  const Ref<PlateLattice> layers = make({"flat", flat, cubes});
  for (const double z : {0.5, 0.4999, 0.7})
    assert_int_equal(layers->wall_lines({z, window, 1e-3}).lines.size(), 0);
}

void test_what_is_too_far_or_too_much_is_refused(void**) {
  const Ref<PlateLattice> plates = make({"cubic", cubic_plate_cell(), cubes});
  check_limits_of_sections(*plates, "cells of the plates");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(test_random_ways_meet_plates_and_lines_alike),
      cmocka_unit_test(test_length_is_that_of_the_area),
      cmocka_unit_test(test_thin_plates_have_the_volume_of_their_lines),
      cmocka_unit_test(test_plates_that_lie_on_each_other_give_one_line),
      cmocka_unit_test(test_plates_in_the_plane_have_no_lines),
      cmocka_unit_test(test_what_is_too_far_or_too_much_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
