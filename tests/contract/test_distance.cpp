// SPDX-License-Identifier: Apache-2.0
// Signed distances of structures: the sign is that of inside(), no ball of their size holds a point
// on the other side, they change by no more than the distance of two points, over cell borders too,
// and they are exact where the contract says so. 10^6 points in all.
#include <limits>

#include "random.h"
#include "structures.h"
#include "strut/segment.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// The direction in which the distance grows fastest, about.
Vec3 gradient(const Structure& structure, Vec3 p, double step) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 by;
    by[axis] = step;
    g[axis] = structure.distance(p + by) - structure.distance(p - by);
  }
  const double l = length(g);
  return l > 0 ? g * (1 / l) : Vec3{1, 0, 0};
}

void check_point(const StructureRow& row, const Structure& structure, Vec3 p, double d,
                 const char* what, bool holds) {
  if (holds) return;
  fail_msg("%s: at (%.17g, %.17g, %.17g), inside %d, distance %.17g: %s", row.name.c_str(), p.x,
           p.y, p.z, structure.inside(p), d, what);
}

void test_row(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const double unit = row.unit();
  Random random(row.index + 11);
  for (Vec3 corner : {Vec3{-1, -1, -1}, Vec3{1000, -1001, 999}}) {
    const Vec3 centre = grid.from_grid((corner + Vec3{1, 1, 1}) * grid.cell_size);
    const Ref<const Structure> structure = row.make(centre);
    // Coordinates 1000 cells away are rounded to 1e-13 of them.
    const double rounding = 4e-9 * unit;
    Vec3 last = centre;
    double last_distance = structure->distance(centre);
    const size_t count = test_count(1000000 / 190 / 2) + 1;
    for (size_t i = 0; i < count; ++i) {
      // Anywhere, or with coordinates on the borders and symmetry planes of cells.
      Vec3 cell = random.in_box({{0, 0, 0}, {2, 2, 2}});
      if (i % 4 == 0)
        for (int axis = 0; axis < 3; ++axis) cell[axis] = std::round(cell[axis] * 4) / 4;
      const Vec3 p = grid.from_grid((corner + cell) * grid.cell_size);
      const double d = structure->distance(p);
      const bool is_inside = structure->inside(p);
      check_point(row, *structure, p, d, "the sign is wrong", is_inside ? d <= 0 : d > 0);
      check_point(row, *structure, p, d, "it is not finite", std::isfinite(d));
      check_point(row, *structure, p, d, "it changes too fast",
                  std::abs(d - last_distance) <= length(p - last) + rounding);
      last = p;
      last_distance = d;
      if (i % 16) continue;

      // Balls: at random, and towards the boundary.
      const Vec3 up = gradient(*structure, p, 1e-6 * unit);
      const double size = std::abs(d);
      // The least number stands for no distance at all.
      for (int n = 0; n < 12 && size > std::numeric_limits<double>::min(); ++n) {
        const Vec3 way = n == 0 ? up * (d > 0 ? -1.0 : 1.0) : random.direction();
        const Vec3 other = p + way * (size * (n < 6 ? 1 - 1e-12 : random.unit()));
        check_point(row, *structure, p, d, "its ball meets the boundary",
                    structure->inside(other) == is_inside);
      }
      // Neighbours, over the borders of cells where coordinates lie on them.
      const Vec3 next = p + random.direction() * (1e-7 * unit);
      check_point(row, *structure, p, d, "it jumps",
                  std::abs(structure->distance(next) - d) <= 1e-7 * unit + rounding);
    }
  }
}

/// The unit cell of a lattice's row; none of other structures.
UnitCell unit_cell_of(const StructureRow& row) {
  const std::string& family = row.kind.family;
  return family == "cubic"     ? cubic_unit_cell()
         : family == "BCC"     ? bcc_unit_cell()
         : family == "octet"   ? octet_unit_cell()
         : family == "skew"    ? skew_unit_cell()
         : family == "factors" ? factored_unit_cell()
                               : UnitCell{};
}

/// Outside and for constant radius, the least distance to all struts of the tiling less their
/// radii.
void test_exact(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const Ref<const Structure> structure = row.make({});
  const UnitCell cell = unit_cell_of(row);
  std::vector<LatticeStrut> struts;
  constexpr int reach = 3;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i)
        for (size_t s = 0; s < cell.struts.size(); ++s) {
          const auto [a, b] = cell.struts[s];
          const Vec3 shift{double(i), double(j), double(k)};
          struts.push_back({Segment((cell.nodes[a] + shift) * grid.cell_size,
                                    (cell.nodes[b] + shift) * grid.cell_size),
                            cell.factor(s)});
        }
  Random random(row.index + 5);
  const size_t count = test_count(600);
  size_t outside = 0;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 q = random.in_box({{0, 0, 0}, grid.cell_size});
    const Vec3 p = grid.from_grid(q);
    double wanted = std::numeric_limits<double>::infinity();
    for (const LatticeStrut& s : struts)
      wanted = std::min(wanted, std::sqrt(s.axis.distance_squared(q)) - s.factor * row.radius());
    const double d = structure->distance(p);
    outside += wanted > 0;
    if (std::abs(d - wanted) > 1e-11 * row.unit())
      fail_msg("%s: distance %.17g at (%.17g, %.17g, %.17g), not %.17g", row.name.c_str(), d, p.x,
               p.y, p.z, wanted);
  }
  if (count > 100) assert_in_range(outside, 1, count);
}

/// A plate's distance: of the line through p across its plane, or of its rim, point by point.
double distance_to_plate(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  // The parameters of the nearest point of the plane, by Cramer's rule on Gram's matrix.
  const Vec3 ab = b - a, ac = c - a, w = p - a;
  const double bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac);
  const double wb = dot(w, ab), wc = dot(w, ac), gram = bb * cc - bc * bc;
  const double s = (wb * cc - wc * bc) / gram, t = (wc * bb - wb * bc) / gram;
  if (s >= 0 && t >= 0 && s + t <= 1) return length(w - ab * s - ac * t);
  const auto to_side = [&](Vec3 from, Vec3 to) {
    const Vec3 way = to - from;
    const double at = std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
    return length(p - from - way * at);
  };
  return std::min({to_side(a, b), to_side(b, c), to_side(c, a)});
}

/// Outside and for constant thickness, the least distance to all triangles of the tiling less half
/// of their thickness.
void test_plates(void** state) {
  const StructureRow& row = *static_cast<const StructureRow*>(*state);
  const Neighbourhood& grid = row.variant.grid;
  const Ref<const Structure> structure = row.make({});
  const PlateCell cell = row.kind.name == "factors" ? factored_plate_cell() : skew_plate_cell();
  Random random(row.index + 6);
  const size_t count = test_count(600);
  size_t outside = 0;
  for (size_t i = 0; i < count; ++i) {
    const Vec3 q = random.in_box({{0, 0, 0}, grid.cell_size}), p = grid.from_grid(q);
    double wanted = std::numeric_limits<double>::infinity();
    double onset = wanted;
    constexpr int reach = 3;
    for (int n = 0; n < 7 * 7 * 7; ++n) {
      const Vec3 shift{double(n % 7 - reach), double(n / 7 % 7 - reach), double(n / 49 - reach)};
      for (size_t f = 0; f < cell.faces.size(); ++f) {
        const auto corner = [&](size_t k) {
          return (cell.nodes[cell.faces[f][k]] + shift) * grid.cell_size;
        };
        const double distance = distance_to_plate(q, corner(0), corner(1), corner(2));
        wanted = std::min(wanted, distance - 0.5 * cell.factor(f) * row.radius());
        onset = std::min(onset, 2 * distance / cell.factor(f));
      }
    }
    const double d = structure->distance(p);
    outside += wanted > 0;
    if (std::abs(d - wanted) > 1e-11 * row.unit())
      fail_msg("%s: distance %.17g at (%.17g, %.17g, %.17g), not %.17g", row.name.c_str(), d, p.x,
               p.y, p.z, wanted);
    assert_true(std::abs(structure->onset(p) - onset) <= 1e-11 * row.unit());
    if (std::abs(wanted) > 1e-11 * row.unit()) assert_int_equal(structure->inside(p), wanted < 0);
  }
  if (count > 100) assert_in_range(outside, 1, count);
}

/// Jumps at the cells' borders along x and y, which no other row of the suite may.
Kind jumping_kind() {
  return {"functional", "jumps", 0.1, 1,
          functional_factory("0.15*x-0.2*cos(y/2)+0.1*cos(z)", FunctionalKind::network, 0)};
}

}  // namespace

int main() {
  std::vector<StructureRow> rows = structures_by_point(), lattices;
  for (const GridVariant& variant : grid_variants(true))
    for (bool is_graded : {false, true})
      rows.push_back({"jumps, " + variant.name + (is_graded ? ", graded" : ""), jumping_kind(),
                      variant, is_graded, 8, rows.size()});
  for (const StructureRow& row : rows)
    if (!row.is_graded && !unit_cell_of(row).struts.empty()) lattices.push_back(row);
  std::vector<StructureRow> plates;
  for (const StructureRow& row : rows)
    if (row.kind.family == "plates" && !row.is_graded &&
        (row.kind.name.find("skew") == 0 || row.kind.name == "factors"))
      plates.push_back(row);
  return run_for_each("distance", rows, test_row) + run_for_each("exact", lattices, test_exact) +
         run_for_each("exact plates", plates, test_plates);
}
