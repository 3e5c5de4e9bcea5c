// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/lattice.h"

#include "structure/common/grid_boxes.h"
#include "structure/common/known_onset.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/common/strut_rows.h"
#include "structure/lattice/cell/may_reach.h"
#include "structure/lattice/rays/constant_struts.h"
#include "structure/lattice/rows/lattice_rows.h"

namespace msq {

namespace {

/// Samples per cell above which spans are faster than the point query, on turned grids. BCC, r =
/// 0.1 cell: with 13 samples per cell both cost the same, with 4 spans cost 2.7 times as much.
constexpr double critical_samples = 12;

/// Number along an axis of the cell.
constexpr int automatic_clusters = 24, onset_clusters = 12;
/// Fewer points are tested against all struts near their cells: finding clusters takes
/// milliseconds.
constexpr size_t min_clustered = 512;
constexpr size_t batch = 256;

}  // namespace

Lattice::Lattice(const Neighbourhood& neighbourhood, const UnitCell& cell, Parameter radius,
                 int clusters)
    : Structure(neighbourhood),
      cell_(cell),
      radius_(std::move(radius)),
      struts_(periodic_struts(cell)),
      graph_({cell}),
      max_factor_(struts_[0].factor),
      side_(clusters),
      row_axes_{-1, -1, -1} {
  const std::array<int, 3> sample_axes = neighbourhood.sample_axes();
  for (size_t axis = 0; axis < 3; ++axis)
    if (sample_axes[axis] >= 0)
      row_axes_[static_cast<size_t>(sample_axes[axis])] = static_cast<int>(axis);
  const Vec3 size = neighbourhood.cell_size;
  const double most = max_factor_ * radius_.range().high;
  const Box3 corner_to_corner{{0, 0, 0}, size};
  reach_ = {struts_[0].a, struts_[0].a};
  for (const PeriodicStrut& s : struts_) {
    reach_.min = min(reach_.min, min(s.a, s.b));
    reach_.max = max(reach_.max, max(s.a, s.b));
  }
  const auto cells_back = [&](int axis) {  // copies that many cells before may still reach
    return static_cast<int>(std::ceil(reach_.max[axis] + most / size[axis]));
  };
  const auto cells_ahead = [&](int axis) {
    return static_cast<int>(std::ceil(1 - reach_.min[axis] + most / size[axis]));
  };
  for (int k = -cells_back(2); k <= cells_ahead(2); ++k)
    for (int j = -cells_back(1); j <= cells_ahead(1); ++j)
      for (int i = -cells_back(0); i <= cells_ahead(0); ++i)
        for (const PeriodicStrut& s : struts_) {
          const Vec3 shift{double(i), double(j), double(k)};
          const Segment segment((s.a + shift) * size, (s.b + shift) * size);
          const double reach = s.factor * radius_.range().high;
          if (may_reach(segment, corner_to_corner, reach)) near_.push_back({segment, s.factor});
        }
}

bool Lattice::inside(Vec3 p) const {
  const double r = radius_.at(p);
  const Vec3 q = neighbourhood().locate(p).fraction * neighbourhood().cell_size;
  for (const LatticeStrut& s : near_)
    if (s.holds(q, r)) return true;
  return false;
}

void Lattice::for_each_strut(const Box3& box, const TakeStrut& take, const Job* job) const {
  const Neighbourhood& grid = neighbourhood();
  const Vec3 size = grid.cell_size;
  const double radius = radius_.range().high;
  for (const PeriodicStrut& s : struts_) {
    const double r = s.factor * radius;
    const Box3 reach = grid.to_grid(box.grown(r + 1e-9 * max_component(size)));
    // Copies whose box meets it.
    int64_t first[3], last[3];
    for (int axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int64_t>(
          std::ceil(reach.min[axis] / size[axis] - std::max(s.a[axis], s.b[axis])));
      last[axis] = static_cast<int64_t>(
          std::floor(reach.max[axis] / size[axis] - std::min(s.a[axis], s.b[axis])));
    }
    for (int64_t k = first[2]; k <= last[2]; ++k)
      for (int64_t j = first[1]; j <= last[1]; ++j) {
        check_cancelled(job);
        for (int64_t i = first[0]; i <= last[0]; ++i) {
          const Vec3 cell{double(i), double(j), double(k)};
          take(grid.from_grid((s.a + cell) * size), grid.from_grid((s.b + cell) * size), r);
        }
      }
  }
}

std::unique_ptr<StrutParts> Lattice::struts(const StrutSelection& selection) const {
  return std::make_unique<LatticeStruts>(graph_, neighbourhood(), radius_, selection);
}

const StrutClusters& Lattice::clusters() const {
  return clusters_.get([&] {
    const int side = side_ > 1 ? side_ : automatic_clusters;
    return std::make_unique<StrutClusters>(struts_, neighbourhood().cell_size, radius_.range(),
                                           side);
  });
}

void Lattice::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (side_ == 1 || count < min_clustered) return Structure::keep_points(points, alive, count);
  const StrutClusters& clusters = this->clusters();
  const Neighbourhood grid = neighbourhood();
  double radii[batch];
  for (size_t first = 0; first < count; first += batch) {
    const size_t size = std::min(batch, count - first);
    radius_.values(points + first, size, radii);
    for (size_t i = 0; i < size; ++i) {
      if (!alive[first + i]) continue;
      const Vec3 fraction = grid.locate(points[first + i]).fraction;
      alive[first + i] = clusters.holds(fraction, fraction * grid.cell_size, radii[i]);
    }
  }
}

double Lattice::distance_bound(Vec3 p) const {
  const Vec3 size = neighbourhood().cell_size;
  const StrutClusters& nearest = clusters();
  const Interval r = radius_.range(Box3{p, p});
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  const double gap = nearest.gap(fraction, fraction * size, r.low);
  // Struts lie within a few cells of the origin of these coordinates and are rounded as the cells'
  // sizes are.
  const double slack = locating_slack(p - neighbourhood().origin, nearest.reach()) +
                       0x1p-46 * (max_component(size) + nearest.reach());
  return factored_distance_bound(gap, max_factor_, slack, radius_, p);
}

const CellParts& Lattice::parts() const {
  return parts_.get([&] {
    return std::make_unique<CellParts>(near_, neighbourhood().cell_size, radius_.range().high);
  });
}

void Lattice::enter(RaySearch* searches, size_t count, const Job* job) const {
  if (radius_.is_constant())
    return enter_constant_struts(*this, parts(), radius_.at({}), searches, count, job);
  PartLists lists(parts());
  StrutRays(*this, lists, radius_, job).enter(searches, count);
}

double Lattice::leave(const Ray& ray, double from, double to, const Job* job) const {
  PartLists lists(parts());
  return StrutRays(*this, lists, radius_, job).leave(ray, from, to);
}

Vec3 Lattice::normal(const Ray& ray, double t) const {
  PartLists lists(parts());
  return StrutRays(*this, lists, radius_, nullptr).normal(ray, t);
}

double Lattice::onset_limit() const {
  return max_radius * min_component(neighbourhood().cell_size) / max_factor_;
}

double Lattice::onset(Vec3 p) const {
  const Vec3 size = neighbourhood().cell_size;
  const StrutClusters& onsets = onsets_.get([&] {
    return std::make_unique<StrutClusters>(struts_, size, Interval{0, onset_limit()},
                                           onset_clusters);
  });
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  return known_onset(*this, onsets.onset(fraction, fraction * size));
}

const RowStruts& Lattice::row_struts() const {
  return row_struts_.get([&] {
    return std::make_unique<RowStruts>(struts_, neighbourhood().cell_size, row_axes_,
                                       radius_.range().high);
  });
}

uint64_t Lattice::row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const {
  if (row_axes_[0] < 0 || !radius_.is_constant()) return 0;
  return LatticeRows::row_period(neighbourhood(), row_axes_, row_struts(), grid, y0, y1);
}

void Lattice::keep_repeated_rows(const RowBlock& block, uint64_t end, RowFlips& flips,
                                 const Job* job) const {
  LatticeRows(neighbourhood(), row_axes_, row_struts(), radius_, block, {block.rows(), end, &flips})
      .keep(job, [this](Vec3 p) { return inside(p); });
}

void Lattice::keep_rows(const RowBlock& block, const Job* job) const {
  const Neighbourhood& grid = neighbourhood();
  if (row_axes_[0] >= 0) {
    LatticeRows rows(grid, row_axes_, row_struts(), radius_, block);
    if (!rows.keep(job, [this](Vec3 p) { return inside(p); })) Structure::keep_rows(block, job);
    return;
  }
  StrutRows rows(block, grid, radius_, 1e-9 * max_factor_ * radius_.range().high, max_factor_);
  if (rows.empty()) return;
  if (!rows.pays(grid, critical_samples)) return Structure::keep_rows(block, job);
  // A strut that touches the rows' reach has a point in it. The cell of the strut is within the
  // struts' extent beyond their cell of that point.
  Vec3 beyond;
  for (int axis = 0; axis < 3; ++axis)
    beyond[axis] =
        grid.cell_size[axis] * std::max({0.0, -reach_.min[axis], reach_.max[axis] - 1.0});
  const double around = length(beyond) + 1e-9 * max_component(grid.cell_size);
  // The struts of one factor are adjacent, which is fastest for rows.
  for (auto s = struts_.begin(); s != struts_.end();) {
    const auto thinner = std::find_if(
        s, struts_.end(), [&](const PeriodicStrut& other) { return other.factor != s->factor; });
    constexpr int side = 4;  // of bricks of cells
    for_each_brick_near(
        grid, rows.reach(), around, side, 0, [&](CellIndex brick, const Box3& near) {
          check_cancelled(job);
          const int32_t begin[3] = {brick.x, brick.y, brick.z};
          int64_t first[3], last[3];  // cells whose struts may touch it
          for (int axis = 0; axis < 3; ++axis) {
            const double size = grid.cell_size[axis];
            first[axis] =
                std::max(static_cast<int64_t>(std::floor(near.min[axis] / size - reach_.max[axis])),
                         int64_t{begin[axis]});
            last[axis] =
                std::min(static_cast<int64_t>(std::ceil(near.max[axis] / size - reach_.min[axis])),
                         int64_t{begin[axis]} + side - 1);
          }
          for (int64_t k = first[2]; k <= last[2]; ++k)
            for (int64_t j = first[1]; j <= last[1]; ++j)
              for (int64_t i = first[0]; i <= last[0]; ++i) {
                const Vec3 corner{double(i), double(j), double(k)};
                for (auto t = s; t != thinner; ++t)
                  rows.add(grid.from_grid((t->a + corner) * grid.cell_size),
                           grid.from_grid((t->b + corner) * grid.cell_size), t->factor);
              }
        });
    s = thinner;
  }
  rows.finish(job, [this](Vec3 p) { return inside(p); });
}

void Lattice::describe(HashInput& input) const {
  input.kind("structure: lattice");
  neighbourhood().describe(input);
  cell_.describe(input);
  radius_.describe(input);
}

}  // namespace msq
