// SPDX-License-Identifier: Apache-2.0
// Rows and sets of points of strut lattices answer as inside() does: pitches that tile the cell and
// that do not, cells of many samples and samples of many cells, long rows, listed layers, radii
// that are constant, linear along rows or across them, and neither; points at the very surface of
// struts; any number of clusters. 2 * 10^5 samples and as many points a row; with
// MSQ_TEST_SCALE=50, 10^7.
#include <algorithm>
#include <map>
#include <tuple>

#include "bit_rows.h"
#include "field/gradient.h"
#include "random.h"
#include "structure/lattice/lattice.h"
#include "structures.h"
#include "suite.h"

using namespace msq;
using namespace msq::test;

namespace {

/// Neither linear nor known to be smooth.
class Bumps final : public Field {
 public:
  Bumps(double low, double high, double length) : low_(low), high_(high), length_(length) {}
  double at(Vec3 p) const override {
    const double s = std::sin(p.x / length_) * std::cos(p.y / length_ + p.z / (2 * length_));
    return std::clamp(low_ + (0.5 + 0.5 * s) * (high_ - low_), low_, high_);
  }
  Interval range() const override { return {low_, high_}; }
  Interval range(const Box3& box) const override {
    const double reach = length(box.extent()) / length_ * (high_ - low_), middle = at(box.min);
    return {std::max(low_, middle - reach - 1e-9), std::min(high_, middle + reach + 1e-9)};
  }
  void describe(HashInput&) const override {}

 private:
  double low_, high_, length_;
};

struct LatticeRow {
  std::string name;
  UnitCell cell;
  double radius;  // of the smallest cell size
  GridVariant variant;
  size_t index;
};

UnitCell with_factors(UnitCell cell) {
  for (size_t i = 0; i < cell.struts.size(); ++i) cell.factors.push_back(i % 3 ? 0.4 : 1);
  return cell;
}

std::vector<LatticeRow> lattice_rows() {
  struct Cell {
    const char* name;
    UnitCell cell;
  };
  const Cell cells[] = {{"cubic", cubic_unit_cell()},
                        {"BCC", bcc_unit_cell()},
                        {"octet", octet_unit_cell()},
                        {"Kelvin", kelvin_unit_cell()},
                        {"skew", skew_unit_cell()},
                        {"re-entrant", reentrant_unit_cell()},
                        {"factors", with_factors(bcc_unit_cell())}};
  std::vector<LatticeRow> rows;
  for (const GridVariant& variant : grid_variants(true)) {
    if (!variant.is_axis_aligned) continue;
    for (const Cell& cell : cells)
      for (double radius : {1e-4, 0.03, 0.125, 0.6}) {
        char name[96];
        std::snprintf(name, sizeof name, "%s r %g %s", cell.name, radius, variant.name.c_str());
        rows.push_back({name, cell.cell, radius, variant, rows.size()});
      }
  }
  return rows;
}

enum class Radii { constant, steep, slight, across, bumps };

Parameter parameter(const LatticeRow& row, Radii radii, Vec3 centre, double length) {
  const double most = row.radius * min_component(row.variant.grid.cell_size);
  const auto ramp = [&](Vec3 half, double least) {
    return Parameter(
        Ref<const Field>(make_ref<GradientField>(centre - half, least, centre + half, most)));
  };
  switch (radii) {
    case Radii::steep:
      return ramp(Vec3{0.45, -0.2, 0.1} * length, 0);
    case Radii::slight:
      return ramp(Vec3{-3, 2, 1} * length, 0.2 * most);
    case Radii::across:
      return ramp(Vec3{0, 0.5, 0.7} * length, 0.1 * most);
    case Radii::bumps:
      return Parameter(Ref<const Field>(make_ref<Bumps>(0, most, 0.3 * length)));
    default:
      return Parameter(most);
  }
}

struct Pitch {
  double samples_per_cell;
  bool on_borders;
  Vec3 corner;  // in cells
  uint64_t columns;
};

const Pitch pitches[] = {
    {8, true, {-1, 2, 3}, 300},       {64, true, {0, 0, 0}, 700},
    {31.7, false, {-5, 7, 1}, 1100},  {5.0 / 3, true, {1, 0, -2}, 200},
    {3.97, false, {900, -3, 5}, 600}, {1000, false, {0, 0, 0}, 2600},
    {0.31, false, {-40, 3, 2}, 400},  {12, false, {2, 2, 2}, 9000},
    {16, true, {-1000, 5, 0}, 64},    {7.0, true, {3, -3, 3}, 4097},
};

void rows_answer_as_points_do(void** state) {
  const LatticeRow& row = *static_cast<const LatticeRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  Random random(row.index + 1);
  size_t asked = 0, differ = 0;
  for (size_t turn = 0; turn < 5; ++turn) {
    const Pitch& pitch = pitches[(row.index * 3 + turn * 7) % std::size(pitches)];
    const auto radii = static_cast<Radii>((row.index + turn) % 5);
    Vec3 size = n.rotation.apply(n.cell_size);
    for (int axis = 0; axis < 3; ++axis) size[axis] = std::abs(size[axis]);
    SampleGrid grid;
    grid.spacing = size * (1 / pitch.samples_per_cell);
    grid.origin = n.from_grid(pitch.corner * n.cell_size);
    if (!pitch.on_borders) grid.origin = grid.origin + size * random.in_box({{}, {1, 1, 1}});
    grid.nx = pitch.columns;
    const double rest = static_cast<double>(test_count(15000)) / static_cast<double>(grid.nx);
    grid.ny = std::max<uint64_t>(3, static_cast<uint64_t>(std::sqrt(rest)) + 1);
    grid.nz = grid.ny;
    std::vector<double> heights;
    if (turn == 3) {
      for (uint64_t k = 0; k < grid.nz; ++k)
        heights.push_back(grid.z(k) + random.between(-0.3, 0.3) * grid.spacing.z);
      grid.heights = heights.data();
    }
    const double length = static_cast<double>(grid.nx) * grid.spacing.x;
    const Lattice lattice(
        n, row.cell, parameter(row, radii, grid.at(grid.nx / 2, grid.ny / 2, grid.nz / 2), length));
    BitRows before(grid), after(grid);
    for (uint64_t k = 0; k < grid.nz; ++k)
      for (uint64_t j = 0; j < grid.ny; ++j)
        for (uint64_t i = 0; i < grid.nx; ++i)
          if (turn % 2 || random.below(8)) {
            before.set(i, j, k);
            after.set(i, j, k);
          }
    lattice.keep_rows(after.block(), nullptr);
    assert_int_equal(after.damage(), 0);
    for (uint64_t k = 0; k < grid.nz; ++k)
      for (uint64_t j = 0; j < grid.ny; ++j)
        for (uint64_t i = 0; i < grid.nx; ++i, ++asked) {
          const bool is_inside = before.get(i, j, k) && lattice.inside(grid.at(i, j, k));
          if (after.get(i, j, k) == is_inside) continue;
          if (!differ++)
            print_error("sample (%d, %d, %d), %g a cell, radii %d: alone %d\n", int(i), int(j),
                        int(k), pitch.samples_per_cell, int(radii), is_inside);
        }
  }
  if (differ) fail_msg("%zu of %zu samples differ", differ, asked);
}

/// The radius of each of some points.
class RadiusOfPoint final : public Field {
 public:
  explicit RadiusOfPoint(double most) : most_(most) {}
  void set(Vec3 p, double radius) { radii_[{p.x, p.y, p.z}] = std::min(radius, most_); }
  double at(Vec3 p) const override { return radii_.at({p.x, p.y, p.z}); }
  Interval range() const override { return {0, most_}; }
  Interval range(const Box3&) const override { return range(); }
  void describe(HashInput&) const override {}

 private:
  double most_;
  std::map<std::tuple<double, double, double>, double> radii_;
};

void clusters_answer_as_points_do(void** state) {
  const LatticeRow& row = *static_cast<const LatticeRow*>(*state);
  const Neighbourhood& n = row.variant.grid;
  const double most = row.radius * min_component(n.cell_size);
  Random random(row.index + 101);
  const size_t count = test_count(12000) + 512;
  std::vector<Vec3> points;
  for (size_t i = 0; i < count; ++i) {
    Vec3 cell = random.in_box({{-3, -3, -3}, {3, 3, 3}});
    if (i % 3 == 0)  // on borders of clusters and on symmetry planes
      for (int axis = 0; axis < 3; ++axis) cell[axis] = std::round(cell[axis] * 24) / 24;
    points.push_back(n.from_grid(cell * n.cell_size));
  }
  const Vec3 half = Vec3{3, 2, 2} * n.cell_size;
  const Parameter graded(Ref<const Field>(make_ref<GradientField>(half * -1.0, 0.0, half, most)));
  const int sides[] = {0, 2, 3, 7, 16, 64};
  const int side = sides[row.index % std::size(sides)];
  const auto check = [&](const Parameter& radius, int clusters) {
    const Lattice lattice(n, row.cell, radius, clusters);
    std::vector<uint8_t> alive(count, 1);
    for (size_t i = 0; i < count; i += 17) alive[i] = 0;
    lattice.keep_points(points.data(), alive.data(), count);
    size_t differ = 0;
    for (size_t i = 0; i < count; ++i)
      differ += alive[i] != (i % 17 != 0 && lattice.inside(points[i]));
    if (differ) fail_msg("%zu of %zu points differ with %d clusters", differ, count, clusters);
  };
  check(Parameter(most), side);
  check(graded, side);
  check(graded, 1);
  // Each point with a radius that its onset is some last bits away from.
  const Ref<RadiusOfPoint> radii = make_ref<RadiusOfPoint>(most);
  const std::vector<PeriodicStrut> struts = periodic_struts(row.cell);
  for (size_t i = 0; i < count; ++i) {
    if (i >= test_count(2000) + 512) {
      points.resize(i);
      break;
    }
    const Vec3 q = n.locate(points[i]).fraction * n.cell_size;
    double least = most;
    for (const PeriodicStrut& s : struts)
      for (int shift = 0; shift < 27; ++shift) {
        const Vec3 by{double(shift % 3 - 1), double(shift / 3 % 3 - 1), double(shift / 9 - 1)};
        const Segment axis((s.a + by) * n.cell_size, (s.b + by) * n.cell_size);
        least = std::min(least, std::sqrt(axis.distance_squared(q)) / s.factor);
      }
    for (size_t step = i % 5; step > 0; --step) least = std::nextafter(least, i % 2 ? 0 : most);
    radii->set(points[i], least);
  }
  const Lattice lattice(n, row.cell, Parameter(Ref<const Field>(radii)), side);
  std::vector<uint8_t> alive(points.size(), 1);
  lattice.keep_points(points.data(), alive.data(), points.size());
  for (size_t i = 0; i < points.size(); ++i)
    if (alive[i] != lattice.inside(points[i])) fail_msg("point %zu at the surface differs", i);
}

}  // namespace

int main() {
  std::vector<LatticeRow> rows = lattice_rows();
  return run_for_each("rows", rows, rows_answer_as_points_do) +
         run_for_each("clusters", rows, clusters_answer_as_points_do);
}
