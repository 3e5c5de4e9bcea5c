// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/section/section_seeds.h"

#include <algorithm>
#include <cmath>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/seeds/seed_trees.h"

namespace msq {

namespace {

/// Seeds of a section: 1.6 GB of them.
constexpr double max_seeds = 0x1p26;

class Search {
 public:
  Search(const SectionFoam& foam, const SectionPlane& plane, const Box2& window)
      : foam_(foam),
        plane_(plane),
        grid_(foam.grid),
        z_(plane.height()),
        reach_(plane.reach()),
        area_(window.grown(3 * reach_)),
        slab_{{area_.min.x, area_.min.y, z_ - reach_}, {area_.max.x, area_.max.y, z_ + reach_}} {
    found_.reach = reach_;
    found_.height = z_;
    found_.origin = plane.from_grid().origin;
  }

  SectionSeeds find();

 private:
  void reserve(double expected);
  void visit(CellIndex cell);
  void visit_tree(CellIndex cell);
  void add(CellIndex cell, Vec3 in_cell, double lift);

  const SectionFoam& foam_;
  const SectionPlane& plane_;
  const Neighbourhood& grid_;
  const double z_, reach_;
  const Box2 area_;
  const Box3 slab_;
  SectionSeeds found_;
};

void Search::reserve(double expected) {
  if (!(expected < max_seeds))
    fail(Status::limit, "the window meets about %g seeds of the foam; the limit is %g", expected,
         max_seeds);
  found_.seeds.reserve(static_cast<size_t>(1.1 * expected) + 1000);
}

void Search::add(CellIndex cell, Vec3 in_cell, double lift) {
  const Vec3 g = Vec3{cell.x + in_cell.x, cell.y + in_cell.y, cell.z + in_cell.z} * grid_.cell_size;
  const Vec3 p = plane_.from_grid().of(g);
  const double above = p.z - z_;
  if (std::abs(above) > reach_ || !area_.contains({p.x, p.y})) return;
  if (static_cast<double>(found_.seeds.size()) >= max_seeds)
    fail(Status::limit, "the window meets more than %g seeds of the foam", max_seeds);
  found_.seeds.push_back({{p.x, p.y}, above * above + lift});
}

void Search::visit(CellIndex cell) {
  const uint64_t bits = foam_.seeds.bits(cell);
  const double lift =
      foam_.seeds.is_weighted() ? foam_.seeds.lift(bits) * (foam_.unit * foam_.unit) : 0;
  add(cell, foam_.seeds.fractions(bits), lift);
}

void Search::visit_tree(CellIndex cell) {
  const Vec3 size = grid_.cell_size, scale = foam_.seeds.scale();
  const Vec3 corner = Vec3{double(cell.x), double(cell.y), double(cell.z)} * size;
  // A point of the plane whose nearest seed is in the cell is within `reach_` of the cell.
  const Box3 about = Box3{corner, corner + size}.grown(reach_);
  const double near = foam_.graded->max_distance(about);
  const auto& m = grid_.rotation.m;
  const auto wanted = [&](const Box3& box) {
    const Vec3 centre = (box.min + box.max) * (0.5 * foam_.unit);
    const Vec3 half = box.extent() * (0.5 * foam_.unit);
    const double z = grid_.from_grid(corner + centre).z;
    const double room = std::abs(m[6]) * half.x + std::abs(m[7]) * half.y + std::abs(m[8]) * half.z;
    return std::abs(z - z_) <= (near + room) * (1 + 1e-9);
  };
  const Borrowed<SeedForest> forest;
  SeedTrees& trees = forest->of(foam_.graded);
  const Vec3 middle = scale * 0.5;
  trees.visit(cell, Box3{middle, middle}, wanted, [&](const LeafSeed& leaf) {
    add(cell, {leaf.position.x / scale.x, leaf.position.y / scale.y, leaf.position.z / scale.z}, 0);
  });
}

SectionSeeds Search::find() {
  const Vec3 size = grid_.cell_size;
  const Box3 queried = plane_.to_grid(slab_);
  require_in_cells(grid_, queried);
  const Vec2 extent = area_.extent();
  const double cells = extent.x * extent.y * 2 * reach_ / plane_.cell_volume();
  reserve(foam_.graded ? std::min(cells, max_seeds / 2) : cells);
  JobPoll poll(current_job());
  for (double z = std::floor(queried.min.z / size.z); z <= queried.max.z / size.z; ++z)
    for (double y = std::floor(queried.min.y / size.y); y <= queried.max.y / size.y; ++y) {
      const CellRow row = cells_in_row(plane_.from_grid(), size, slab_, 1e-6 * reach_, y, z);
      poll();
      for (double x = row.first; x <= row.last; ++x) {
        const CellIndex cell{static_cast<int32_t>(x), static_cast<int32_t>(y),
                             static_cast<int32_t>(z)};
        poll();
        foam_.graded ? visit_tree(cell) : visit(cell);
      }
    }
  return std::move(found_);
}

}  // namespace

// With u = 2^-53, a coordinate g of the grid is off by up to 4 u of itself, and the sum of three
// products and an offset by 5 u of their magnitudes. The products are at most sqrt(3) |p - origin|
// in all, as the stretch cancels: 18 sqrt(3) u for two seeds, below 2^-48. The map itself is off by
// some u of the distance of two seeds.
double SectionSeeds::same_place(Vec2 p) const {
  const double away = length(Vec3{p.x, p.y, height} - origin) + reach;
  const double rounding = 0x1p-48 * (away + length(origin));
  // Where rounding is more than what corners are told apart by (section_lines.cpp), cells are lost.
  return std::min(1e-12 * reach + rounding, 1e-7 * reach);
}

// With F the division by the stretch, a point of the plane is F (x a + y b + z c) in the space of
// the diagram, a, b and c being the rows of the grid's rotation and x, y, z from the grid's origin.
// F a, and what of F b is perpendicular to it, are the directions of v.
SectionPlane::SectionPlane(const SectionFoam& foam, double z)
    : grid_(foam.grid),
      is_stretched_(foam.stretch != nullptr),
      from_grid_(model_map(grid_)),
      height_(z) {
  const Vec3 size = grid_.cell_size;
  reach_ = length(size);
  cell_volume_ = size.x * size.y * size.z;
  if (foam.seeds.is_weighted() || is_stretched_)
    reach_ = foam.seeds.empty_radius() * foam.unit * (1 + 1e-9);
  if (!is_stretched_) return;
  factor_ = foam.stretch->factor();
  cell_volume_ /= factor_.x * factor_.y * factor_.z;
  const Vec3 shrink{1 / factor_.x, 1 / factor_.y, 1 / factor_.z};
  const auto& m = grid_.rotation.m;
  const Vec3 a = Vec3{m[0], m[1], m[2]} * shrink, b = Vec3{m[3], m[4], m[5]} * shrink,
             c = Vec3{m[6], m[7], m[8]} * shrink;
  const Vec3 e = a * (1 / length(a));
  const double skew = dot(b, e);
  const Vec3 across = b - e * skew;
  const Vec3 f = across * (1 / length(across)), n = cross(e, f);
  axes_ = {{e.x, e.y, e.z, f.x, f.y, f.z, n.x, n.y, n.z}};
  const Vec3 base = c * (z - grid_.origin.z);
  from_grid_ = {{e.x * shrink.x, e.y * shrink.y, e.z * shrink.z, f.x * shrink.x, f.y * shrink.y,
                 f.z * shrink.z, n.x * shrink.x, n.y * shrink.y, n.z * shrink.z},
                {-dot(e, base), -dot(f, base), -dot(n, base)}};
  height_ = 0;
  xx_ = 1 / length(a);
  yy_ = 1 / length(across);
  xy_ = -skew * xx_ * yy_;
  origin_ = {grid_.origin.x, grid_.origin.y};
}

Box2 SectionPlane::image(const Box2& window) const {
  if (!is_stretched_) return window;
  const Vec2 low = window.min - origin_, high = window.max - origin_;
  // x and y of the model are sums of v, with the matrix of to_model().
  const auto along = [&](double x, double y) { return (x - xy_ / yy_ * y) / xx_; };
  const double v[4] = {along(low.x, low.y), along(high.x, low.y), along(low.x, high.y),
                       along(high.x, high.y)};
  const Box2 box{{*std::min_element(v, v + 4), low.y / yy_},
                 {*std::max_element(v, v + 4), high.y / yy_}};
  return box.grown(1e-9 * reach_);
}

Box3 SectionPlane::to_grid(const Box3& box) const {
  if (!is_stretched_) return grid_.to_grid(box);
  const Vec3 centre = axes_.apply_inverse((box.min + box.max) * 0.5 - from_grid_.origin) * factor_;
  const Vec3 half = box.extent() * 0.5;
  const auto& m = axes_.m;
  const Vec3 h = Vec3{std::abs(m[0]) * half.x + std::abs(m[3]) * half.y + std::abs(m[6]) * half.z,
                      std::abs(m[1]) * half.x + std::abs(m[4]) * half.y + std::abs(m[7]) * half.z,
                      std::abs(m[2]) * half.x + std::abs(m[5]) * half.y + std::abs(m[8]) * half.z} *
                 factor_;
  return {centre - h, centre + h};
}

SectionSeeds find_section_seeds(const SectionFoam& foam, const SectionPlane& plane,
                                const Box2& window) {
  return Search(foam, plane, window).find();
}

}  // namespace msq
