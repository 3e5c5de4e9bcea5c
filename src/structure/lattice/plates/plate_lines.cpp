// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/plates/plate_lines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/interval.h"
#include "base/job.h"
#include "structure/common/line_splits.h"
#include "structure/common/plane_cells.h"

namespace msq {

namespace {

/// Of the smallest cell size: corners that are closer to the plane are on it, and those closer to
/// each other are one.
constexpr double on_plane = 1e-9, weld_distance = 1e-7;
/// Cells that the plane and the window meet, and rows of cells that are looked at. Lines have
/// 32-bit numbers of points.
constexpr double max_plate_cells = 0x1p26, max_plate_rows = 0x1p26;
constexpr size_t max_points = size_t{1} << 31;

/// A corner of a plate and its height above the plane.
struct PlateCorner {
  Vec2 point;
  double height;

  /// Corners on the plane count as above it. So the plane goes through none, and a line along the
  /// rim of plates is that of the plates below.
  bool is_below() const { return height < 0; }
};

/// Where the plane meets the side between two corners, with the same bits for all plates there.
Vec2 meeting(const PlateCorner& a, const PlateCorner& b) {
  const auto key = [](const PlateCorner& c) { return std::tie(c.point.x, c.point.y, c.height); };
  const PlateCorner &from = key(a) < key(b) ? a : b, &to = &from == &a ? b : a;
  return from.point + (to.point - from.point) * (from.height / (from.height - to.height));
}

class PlateCut {
 public:
  PlateCut(const std::vector<PeriodicPlate>& plates, const Neighbourhood& grid,
           const WallSection& section)
      : plates_(plates), grid_(grid), section_(section), smallest_(min_component(grid.cell_size)) {
    for (const PeriodicPlate& plate : plates) {
      const double a = rise(plate.a), b = rise(plate.b), c = rise(plate.c);
      rises_.push_back({std::min({a, b, c}), std::max({a, b, c})});
    }
  }

  LineGraph find();

 private:
  void cut(Vec3 cell);
  PlateCorner corner(Vec3 cells) const;
  void add(Vec2 a, Vec2 b);
  /// The height of a point, in cells, above the corner of its cell.
  double rise(Vec3 cells) const { return grid_.rotation.apply(cells * grid_.cell_size).z; }

  const std::vector<PeriodicPlate>& plates_;
  const Neighbourhood& grid_;
  const WallSection& section_;
  const double smallest_;
  std::vector<Interval> rises_;  // of the plates
  LineGraph graph_;
};

PlateCorner PlateCut::corner(Vec3 cells) const {
  const Vec3 p = grid_.from_grid(cells * grid_.cell_size);
  const double height = p.z - section_.z;
  return {{p.x, p.y}, std::abs(height) <= on_plane * smallest_ ? 0 : height};
}

void PlateCut::add(Vec2 a, Vec2 b) {
  const Box2& w = section_.window;
  if (std::min(a.x, b.x) > w.max.x || std::max(a.x, b.x) < w.min.x ||
      std::min(a.y, b.y) > w.max.y || std::max(a.y, b.y) < w.min.y)
    return;
  if (graph_.points.size() >= max_points)
    fail(Status::limit, "the window meets more than %g plates",
         0.5 * static_cast<double>(max_points));
  const auto number = static_cast<uint32_t>(graph_.points.size());
  graph_.points.push_back(a);
  graph_.points.push_back(b);
  graph_.lines.push_back({number, number + 1});
}

void PlateCut::cut(Vec3 cell) {
  // Both ways, by far more than heights are rounded.
  const double slack = 1e-6 * smallest_,
               up = section_.z - grid_.from_grid(cell * grid_.cell_size).z;
  for (size_t i = 0; i < plates_.size(); ++i) {
    if (rises_[i].low > up + slack || rises_[i].high < up - slack) continue;
    const PeriodicPlate& plate = plates_[i];
    const PlateCorner corners[3] = {corner(plate.a + cell), corner(plate.b + cell),
                                    corner(plate.c + cell)};
    const bool below[3] = {corners[0].is_below(), corners[1].is_below(), corners[2].is_below()};
    if (below[0] == below[1] && below[1] == below[2]) continue;
    // The corner that is alone on its side.
    const size_t alone = below[0] == below[1] ? 2 : below[0] == below[2] ? 1 : 0;
    add(meeting(corners[alone], corners[(alone + 1) % 3]),
        meeting(corners[alone], corners[(alone + 2) % 3]));
  }
}

LineGraph PlateCut::find() {
  const Vec3 size = grid_.cell_size;
  const Box2& w = section_.window;
  // Plates begin in their cell and extend no farther than one cell beyond it.
  const double around = length(size);
  const Box3 box =
      Box3{{w.min.x, w.min.y, section_.z}, {w.max.x, w.max.y, section_.z}}.grown(around);
  const Box3 queried = grid_.to_grid(box);
  require_in_cells(grid_, queried);
  const Vec3 extent = box.extent();
  if (!(extent.x * extent.y * extent.z / (size.x * size.y * size.z) < max_plate_cells))
    fail(Status::limit, "the window meets about %g cells of the plates; the limit is %g",
         extent.x * extent.y * extent.z / (size.x * size.y * size.z), max_plate_cells);
  const Vec3 asked_extent = queried.extent();
  const double rows = (asked_extent.y / size.y + 2) * (asked_extent.z / size.z + 2);
  if (!(rows < max_plate_rows))
    fail(Status::limit, "about %g rows of cells are about the window; the limit is %g", rows,
         max_plate_rows);
  const GridMap map = model_map(grid_);
  JobPoll poll(current_job());
  for (double z = std::floor(queried.min.z / size.z); z <= queried.max.z / size.z; ++z)
    for (double y = std::floor(queried.min.y / size.y); y <= queried.max.y / size.y; ++y) {
      poll();
      const CellRow row = cells_in_row(map, size, box, 1e-6 * around, y, z);
      for (double x = row.first; x <= row.last; ++x) {
        poll();
        cut({x, y, z});
      }
    }
  graph_.weld(weld_distance * smallest_);
  // Plates may lie on each other, each with corners of its own.
  split_at_points(graph_, weld_distance * smallest_);
  return std::move(graph_);
}

}  // namespace

LineGraph find_plate_lines(const std::vector<PeriodicPlate>& plates, const Neighbourhood& grid,
                           const WallSection& section) {
  return PlateCut(plates, grid, section).find();
}

}  // namespace msq
