// SPDX-License-Identifier: Apache-2.0
// Walls against voro++ 0.4.6: membership by the distance to the polygons of the cell that holds a
// point; and holes by the areas and centroids of these polygons. Built only where voro++ is found.
//
// voro++ is given the seeds of a box of cells and of all cells within twice the empty radius of it.
#include <algorithm>
#include <limits>
#include <vector>
#include <voro++/voro++.hh>

#include "msq_test.h"
#include "random.h"
#include "structure/foam/walls/vents.h"

using namespace msq;
using namespace msq::test;

namespace {

constexpr int box_cells = 6;

struct Cell {
  Vec3 seed;
  double radius = 0;                     // of its vertices about the seed
  std::vector<std::vector<Vec3>> faces;  // their corners
};

std::vector<Cell> ask_voropp(const FoamSeeds& foam, CellIndex corner) {
  const Vec3 scale = foam.scale();
  int halo[3];
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    halo[axis] = static_cast<int>(std::ceil(2 * foam.empty_radius() / scale[axis]));
    low[axis] = -halo[axis] * scale[axis];
    high[axis] = (box_cells + halo[axis]) * scale[axis];
  }
  voro::container box(low.x, high.x, low.y, high.y, low.z, high.z, 6, 6, 6, false, false, false, 8);
  std::vector<Vec3> seeds;
  std::vector<bool> is_ours;
  for (int z = -halo[2]; z < box_cells + halo[2]; ++z)
    for (int y = -halo[1]; y < box_cells + halo[1]; ++y)
      for (int x = -halo[0]; x < box_cells + halo[0]; ++x) {
        const Vec3 p = foam.at(corner, x, y, z);
        box.put(static_cast<int>(seeds.size()), p.x, p.y, p.z);
        seeds.push_back(p);
        is_ours.push_back(std::min({x, y, z}) >= 0 && std::max({x, y, z}) < box_cells);
      }
  std::vector<Cell> cells;
  voro::voronoicell_neighbor cell;
  voro::c_loop_all loop(box);
  if (loop.start()) do {
      const auto number = static_cast<size_t>(loop.pid());
      if (!is_ours[number] || !box.compute_cell(cell, loop)) continue;
      Cell ours;
      ours.seed = seeds[number];
      std::vector<int> corners;
      std::vector<double> vertices;
      cell.face_vertices(corners);
      cell.vertices(vertices);
      for (size_t at = 0; at < corners.size();) {
        std::vector<Vec3> face;
        for (int count = corners[at++]; count > 0; --count) {
          const size_t v = 3 * static_cast<size_t>(corners[at++]);
          face.push_back(Vec3{vertices[v], vertices[v + 1], vertices[v + 2]});
          ours.radius = std::max(ours.radius, length(face.back()));
        }
        ours.faces.push_back(face);
      }
      cells.push_back(ours);
    } while (loop.inc());
  return cells;
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double squared = dot(ab, ab);
  const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0;
  return length(p - a - ab * t);
}

/// To a convex polygon; infinite for one that is a needle to rounding.
double distance_to_face(Vec3 p, const std::vector<Vec3>& face) {
  const size_t n = face.size();
  Vec3 normal{};
  for (size_t i = 2; i < n; ++i) normal = normal + cross(face[i - 1] - face[0], face[i] - face[0]);
  const double area = length(normal);
  double least = std::numeric_limits<double>::infinity();
  bool is_over = area > 1e-9;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 a = face[i], b = face[(i + 1) % n];
    least = std::min(least, distance_to_segment(p, a, b));
    is_over = is_over && dot(cross(b - a, p - a), normal) >= 0;
  }
  return is_over ? std::abs(dot(p - face[0], normal)) / area : least;
}

void check_foam(const char* name, double jitter, Vec3 scale) {
  Random random(7);
  size_t asked = 0, inside = 0, wrong = 0, near = 0;
  double worst = 0;
  for (uint64_t number = 0; number < 20; ++number) {
    const FoamSeeds foam(number, jitter, scale);
    const NearSeeds seeds(foam, nullptr);
    const CellIndex corner{static_cast<int32_t>(random.below(2000)) - 1000, 40, -3};
    const std::vector<Cell> cells = ask_voropp(foam, corner);
    assert_int_equal(cells.size(), box_cells * box_cells * box_cells);
    for (size_t i = 0; i < test_count(200000) / 20 + 1; ++i) {
      // Points about the middle of the box, in cells of its own seeds.
      const Vec3 f = random.in_box({{2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}});
      const Vec3 p = f * scale;
      const Cell* own = &cells[0];
      for (const Cell& cell : cells)
        if (length(p - cell.seed) < length(p - own->seed)) own = &cell;
      double least = std::numeric_limits<double>::infinity();
      for (const auto& face : own->faces)
        least = std::min(least, distance_to_face(p - own->seed, face));
      int home[3];
      for (int axis = 0; axis < 3; ++axis) home[axis] = static_cast<int>(std::floor(f[axis]));
      const CellIndex cell{corner.x + home[0], corner.y + home[1], corner.z + home[2]};
      const Vec3 q = (f - Vec3{double(home[0]), double(home[1]), double(home[2])}) * scale;
      const double thickness = random.below(2) ? 0.1 : random.between(0, 0.5);
      const bool is_inside = is_in_wall(seeds, cell, q, thickness);
      ++asked;
      inside += is_inside;
      worst = std::max(worst, std::abs(find_nearest_face(seeds, cell, q).onset - 2 * least));
      if (std::abs(2 * least - thickness) < 1e-8)
        ++near;
      else
        wrong += is_inside != (2 * least <= thickness);
    }
  }
  print_message("%s: %zu points, %zu inside, %zu wrong, %zu near the boundary, onset off by %g\n",
                name, asked, inside, wrong, near, worst);
  assert_int_equal(wrong, 0);
  assert_true(inside > 0 && inside < asked && near < 5 && worst < 1e-8);
}

/// A polygon's area, centroid and normal.
struct Polygon {
  double area = 0;
  Vec3 middle, normal;

  explicit Polygon(const std::vector<Vec3>& face) {
    for (size_t i = 2; i < face.size(); ++i)
      normal = normal + cross(face[i - 1] - face[0], face[i] - face[0]) * 0.5;
    area = length(normal);
    if (!(area > 0)) return;
    normal = normal * (1 / area);
    for (size_t i = 2; i < face.size(); ++i)
      middle =
          middle + (face[0] + face[i - 1] + face[i]) *
                       (dot(cross(face[i - 1] - face[0], face[i] - face[0]), normal) / (6 * area));
  }
};

/// Solid is what is within half the thickness of the plane of a face of its cell, but in its hole.
void check_vents(const char* name, double jitter, Vec3 scale) {
  Random random(9);
  size_t asked = 0, inside = 0, in_holes = 0, wrong = 0, near = 0;
  for (uint64_t number = 0; number < 4; ++number) {
    const FoamSeeds foam(number, jitter, scale);
    const NearSeeds seeds(foam, nullptr);
    const CellIndex corner{static_cast<int32_t>(random.below(2000)) - 1000, 40, -3};
    Neighbourhood grid;
    grid.cell_size = scale;
    const std::vector<Cell> cells = ask_voropp(foam, corner);
    std::vector<std::vector<Polygon>> walls(cells.size());
    for (size_t i = 0; i < cells.size(); ++i)
      for (const auto& face : cells[i].faces) walls[i].emplace_back(face);
    for (size_t i = 0; i < test_count(40000) / 4 + 1; ++i) {
      const Vec3 f = random.in_box({{2.5, 2.5, 2.5}, {3.5, 3.5, 3.5}});
      const Vec3 p = f * scale;
      size_t own = 0;
      for (size_t c = 0; c < cells.size(); ++c)
        if (length(p - cells[c].seed) < length(p - cells[own].seed)) own = c;
      const double thickness = random.below(2) ? 0.1 : random.between(0, 0.5),
                   radius = random.below(2) ? 0.15 : random.between(0.01, 0.5);
      const Vec3 x = p - cells[own].seed;
      bool is_solid = false, is_near = false, is_plain = false;
      for (const Polygon& wall : walls[own]) {
        const double away = 2 * std::abs(dot(x - wall.middle, wall.normal));
        if (wall.area < 1e-8) {
          is_near = is_near || (wall.area > 1e-9 && away <= thickness);
          continue;
        }
        is_near = is_near || std::abs(away - thickness) < 1e-8;
        if (away > thickness) continue;
        is_plain = true;
        const double least_area = 3.14159265358979323846 * radius * radius;
        const double from_axis = length(cross(x - wall.middle, wall.normal));
        is_near = is_near || std::abs(wall.area - least_area) < 1e-8 ||
                  std::abs(from_axis - radius) < 1e-6;
        is_solid = is_solid || wall.area < least_area || from_axis >= radius;
      }
      int home[3];
      for (int axis = 0; axis < 3; ++axis) home[axis] = static_cast<int>(std::floor(f[axis]));
      const CellIndex cell{corner.x + home[0], corner.y + home[1], corner.z + home[2]};
      const Vec3 q = (f - Vec3{double(home[0]), double(home[1]), double(home[2])}) * scale;
      const Vents vents(grid, 1, Parameter(radius));
      const bool is_inside = is_in_vented_wall(seeds, vents, cell, q, thickness);
      ++asked;
      inside += is_inside;
      in_holes += is_plain && !is_solid;
      if (is_near)
        ++near;
      else
        wrong += is_inside != is_solid;
    }
  }
  print_message("%s: %zu points, %zu inside, %zu in holes, %zu wrong, %zu near the boundary\n",
                name, asked, inside, in_holes, wrong, near);
  assert_int_equal(wrong, 0);
  // One face with an area of about 1e-9 leaves its whole slab undecided.
  assert_true(inside > 0 && in_holes > 0 && near < 10 + asked / 200);
}

void test_vents(void**) {
  check_vents("holes", 1, {1, 1, 1});
  check_vents("holes, jitter 0.2", 0.2, {1, 1, 1});
  check_vents("holes, unlike sides", 1, {1, 0.8, 0.5});
}

void test_cubes(void**) {
  check_foam("cubes", 1, {1, 1, 1});
}

void test_little_jitter(void**) {
  check_foam("jitter 0.2", 0.2, {1, 1, 1});
}

void test_unlike_sides(void**) {
  check_foam("unlike sides", 1, {1, 0.8, 0.5});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_cubes), cmocka_unit_test(test_little_jitter),
                              cmocka_unit_test(test_unlike_sides), cmocka_unit_test(test_vents)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
