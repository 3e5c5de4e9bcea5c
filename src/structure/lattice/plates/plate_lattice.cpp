// SPDX-License-Identifier: Apache-2.0
#include "structure/lattice/plates/plate_lattice.h"

#include <algorithm>
#include <cmath>

#include "structure/common/known_onset.h"
#include "structure/common/strut_distance_bound.h"
#include "structure/lattice/plates/plate_lines.h"
#include "structure/lattice/rows/lattice_rows.h"

namespace msq {

namespace {

/// Number along an axis of the cell.
constexpr int point_clusters = 24, onset_clusters = 12;
/// Fewer points are tested against all plates near their cells: finding clusters takes
/// milliseconds.
constexpr size_t min_clustered = 512;
constexpr size_t batch = 256;

/// Whether a plate comes within radius of a box; if in doubt, true.
bool plate_may_reach(const PlateTriangle& t, const Box3& box, double radius) {
  const Box3 around = bounds_of(t).grown(radius * (1 + 1e-6));
  if (!around.overlaps(box)) return false;
  const Vec3 half = box.extent() * 0.5;
  const double from_centre = std::sqrt(t.distance_squared((box.min + box.max) * 0.5));
  const double slack = 1e-6 * (length(around.extent()) + max_magnitude(box.max));
  return from_centre <= radius + length(half) + slack;
}

}  // namespace

PlateLattice::PlateLattice(const Neighbourhood& neighbourhood, const PlateCell& cell,
                           Parameter thickness)
    : Structure(neighbourhood),
      cell_(cell),
      thickness_(std::move(thickness)),
      plates_(periodic_plates(cell)),
      max_factor_(plates_[0].factor),
      reach_(8 * min_component(neighbourhood.cell_size)),
      error_(0),
      row_axes_{-1, -1, -1} {
  const std::array<int, 3> sample_axes = neighbourhood.sample_axes();
  for (size_t axis = 0; axis < 3; ++axis)
    if (sample_axes[axis] >= 0)
      row_axes_[static_cast<size_t>(sample_axes[axis])] = static_cast<int>(axis);
  const Vec3 size = neighbourhood.cell_size;
  const double most = 0.5 * max_factor_ * thickness_.range().high;
  const Box3 corner_to_corner{{0, 0, 0}, size};
  Box3 reach{plates_[0].low(), plates_[0].high()};
  for (const PeriodicPlate& plate : plates_) {
    reach = {min(reach.min, plate.low()), max(reach.max, plate.high())};
    error_ = std::max(error_, plate.placed({}, size).axis.error(reach_ + length(size)));
  }
  const auto cells_back = [&](int axis) {  // copies that many cells before may still reach
    return static_cast<int>(std::ceil(reach.max[axis] + most / size[axis]));
  };
  const auto cells_ahead = [&](int axis) {
    return static_cast<int>(std::ceil(1 - reach.min[axis] + most / size[axis]));
  };
  for (int k = -cells_back(2); k <= cells_ahead(2); ++k)
    for (int j = -cells_back(1); j <= cells_ahead(1); ++j)
      for (int i = -cells_back(0); i <= cells_ahead(0); ++i)
        for (const PeriodicPlate& plate : plates_) {
          const LatticePlate placed = plate.placed({double(i), double(j), double(k)}, size);
          const double radius = 0.5 * placed.factor * thickness_.range().high;
          if (plate_may_reach(placed.axis, corner_to_corner, radius)) near_.push_back(placed);
        }
}

bool PlateLattice::inside(Vec3 p) const {
  const double half = 0.5 * thickness_.at(p);
  const Vec3 q = neighbourhood().locate(p).fraction * neighbourhood().cell_size;
  for (const LatticePlate& plate : near_)
    if (plate.holds(q, half)) return true;
  return false;
}

const PlateClusters& PlateLattice::clusters() const {
  return clusters_.get([&] {
    const Interval range = thickness_.range();
    return std::make_unique<PlateClusters>(plates_, neighbourhood().cell_size,
                                           Interval{0.5 * range.low, 0.5 * range.high},
                                           point_clusters);
  });
}

bool PlateLattice::holds(const PlateClusters& clusters, Vec3 p, double thickness) const {
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  return clusters.holds(fraction, fraction * neighbourhood().cell_size, 0.5 * thickness);
}

void PlateLattice::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  if (count < min_clustered) return Structure::keep_points(points, alive, count);
  const PlateClusters& clusters = this->clusters();
  double thicknesses[batch];
  for (size_t first = 0; first < count; first += batch) {
    check_cancelled();
    const size_t size = std::min(batch, count - first);
    thickness_.values(points + first, size, thicknesses);
    for (size_t i = 0; i < size; ++i) {
      if (!alive[first + i]) continue;
      alive[first + i] = holds(clusters, points[first + i], thicknesses[i]);
    }
  }
}

double PlateLattice::gap(Vec3 p, double t) const {
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  return clusters().gap(fraction, fraction * neighbourhood().cell_size, 0.5 * t);
}

double PlateLattice::slack(Vec3 p) const {
  // Plates lie within a few cells of the origin of these coordinates and are rounded as the cells'
  // sizes are.
  return locating_slack(p - neighbourhood().origin, reach_) +
         0x1p-46 * (max_component(neighbourhood().cell_size) + reach_) + error_;
}

double PlateLattice::distance_bound(Vec3 p) const {
  return factored_distance_bound(gap(p, thickness_.range(Box3{p, p}).low), 0.5 * max_factor_,
                                 slack(p), thickness_, p);
}

// The gap changes by at most the distance. It falls by at most half of the greatest factor times
// what the thickness grows.
BoxClass PlateLattice::classify(const Box3& box) const {
  const Vec3 centre = (box.min + box.max) * 0.5;
  const double around = 0.5 * length(box.extent()) * (1 + 1e-9) + slack(centre);
  const Interval range = thickness_.range(box);
  const double least = gap(centre, range.low);
  if (least <= -around) return BoxClass::inside;
  const double grown = 0.5 * max_factor_ * (range.high - range.low);
  return least > around + grown ? BoxClass::outside : BoxClass::mixed;
}

double PlateLattice::onset_limit() const {
  return max_thickness * min_component(neighbourhood().cell_size) / max_factor_;
}

double PlateLattice::onset(Vec3 p) const {
  const Vec3 size = neighbourhood().cell_size;
  const PlateClusters& onsets = onsets_.get([&] {
    return std::make_unique<PlateClusters>(plates_, size, Interval{0, 0.5 * onset_limit()},
                                           onset_clusters);
  });
  const Vec3 fraction = neighbourhood().locate(p).fraction;
  return known_onset(*this, 2 * onsets.onset(fraction, fraction * size));
}

bool PlateLattice::find(bool wanted, const Ray& ray, double from, double to, double& t,
                        const Job* job) const {
  const PlateClusters& clusters = this->clusters();
  return march(wanted, ray, from, to, t, job,
               [&](Vec3 p) { return holds(clusters, p, thickness_.at(p)); });
}

void PlateLattice::enter(RaySearch* searches, size_t count, const Job* job) const {
  for (size_t i = 0; i < count; ++i) {
    RaySearch& s = searches[i];
    s.found = find(true, s.ray, s.from, s.to, s.t, job);
  }
}

double PlateLattice::leave(const Ray& ray, double from, double to, const Job* job) const {
  double t;
  return find(false, ray, from, to, t, job) ? t : to;
}

Vec3 PlateLattice::normal(const Ray& ray, double t) const {
  const Vec3 p = ray.at(t);
  const double half = 0.5 * thickness_.at(p);
  const Vec3 q = neighbourhood().locate(p).fraction * neighbourhood().cell_size;
  const LatticePlate* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const LatticePlate& plate : near_) {
    const double gap = std::sqrt(plate.axis.distance_squared(q)) - plate.factor * half;
    if (!(gap < least)) continue;
    least = gap;
    nearest = &plate;
  }
  Vec3 normal;
  if (nearest) {
    const Vec3 way = nearest->axis.way_to(q);
    const double distance = length(way);
    if (distance > 0) {
      normal = neighbourhood().rotation.apply(way * (1 / distance));
      if (!thickness_.is_constant())
        normal =
            normal - thickness_.gradient(p, 0x1p-16 * min_component(neighbourhood().cell_size)) *
                         (0.5 * nearest->factor);
    }
  }
  const double size = length(normal);
  return size > 0 && size < std::numeric_limits<double>::infinity() ? normal * (1 / size)
                                                                    : ray.direction * -1.0;
}

const RowPlates& PlateLattice::row_plates() const {
  return row_plates_.get([&] {
    return std::make_unique<RowPlates>(plates_, neighbourhood().cell_size, row_axes_,
                                       thickness_.range().high, error_);
  });
}

uint64_t PlateLattice::row_period(const SampleGrid& grid, uint64_t y0, uint64_t y1) const {
  if (row_axes_[0] < 0 || !thickness_.is_constant()) return 0;
  return LatticeRows::row_period(neighbourhood(), row_axes_, row_plates(), grid, y0, y1);
}

void PlateLattice::keep_repeated_rows(const RowBlock& block, uint64_t end, RowFlips& flips,
                                      const Job* job) const {
  const PlateClusters& clusters = this->clusters();
  LatticeRows(neighbourhood(), row_axes_, row_plates(), thickness_, block,
              {block.rows(), end, &flips})
      .keep(job, [&](Vec3 p) { return holds(clusters, p, thickness_.at(p)); });
}

void PlateLattice::keep_rows(const RowBlock& block, const Job* job) const {
  if (row_axes_[0] < 0) return Structure::keep_rows(block, job);
  const PlateClusters& clusters = this->clusters();
  LatticeRows rows(neighbourhood(), row_axes_, row_plates(), thickness_, block);
  if (!rows.keep(job, [&](Vec3 p) { return holds(clusters, p, thickness_.at(p)); }))
    Structure::keep_rows(block, job);
}

LineGraph PlateLattice::wall_lines(const WallSection& section) const {
  return find_plate_lines(plates_, neighbourhood(), section);
}

void PlateLattice::describe(HashInput& input) const {
  input.kind("structure: plate lattice");
  neighbourhood().describe(input);
  cell_.describe(input);
  thickness_.describe(input);
}

}  // namespace msq
