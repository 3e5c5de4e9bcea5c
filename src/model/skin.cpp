// SPDX-License-Identifier: Apache-2.0
#include "model/skin.h"

#include <bit>
#include <limits>

#include "model/skin_cells.h"
#include "structure/common/strut_distance_bound.h"

namespace msq {

namespace {

/// Index of the first bit set from `from` on, below `count`; count if there is none.
uint64_t next_bit(const uint64_t* row, uint64_t from, uint64_t count) {
  for (uint64_t w = from / bits_per_word; w < words_for(count); ++w) {
    uint64_t word = row[w];
    if (w == from / bits_per_word) word &= ~uint64_t{0} << (from % bits_per_word);
    if (word) return w * bits_per_word + static_cast<unsigned>(std::countr_zero(word));
  }
  return count;
}

}  // namespace

Skin::Skin(Ref<const Shape> shape, Parameter thickness)
    : shape_(std::move(shape)), thickness_(std::move(thickness)) {}

double Skin::search_margin() const {
  // Each is within the error of the distance; radii are rounded.
  return 3 * shape_->depth_error() + 0x1p-40 * max_component(shape_->bounds().extent());
}

bool Skin::find(Vec3 p, uint32_t& part) const {
  const BoundarySearch* search = shape_->boundary_search();
  if (!search) return holds(p);
  const double thickness = thickness_.at(p), margin = search_margin();
  if (!(thickness > 0)) return false;
  const BoundarySearch::Range range =
      search->compare(p, thickness - margin, thickness + margin, part);
  return range == BoundarySearch::Range::between ? holds(p) : range == BoundarySearch::Range::below;
}

double Skin::distance_bound(Vec3 p, double depth) const {
  return strut_distance_bound(depth, shape_->depth_error(), thickness_, p);
}

bool Skin::enter(const Ray& ray, double from, double to, double tolerance, double& t,
                 const Job* job) const {
  return march(true, ray, from, to, tolerance, t, job);
}

double Skin::leave(const Ray& ray, double from, double to, double tolerance, const Job* job) const {
  double t;
  return march(false, ray, from, to, tolerance, t, job) ? t : to;
}

// Steps are as the shape's, since its depth is known no better. A change that they find is bisected
// to within the scale's tolerance.
bool Skin::march(bool wanted, const Ray& ray, double from, double to, double tolerance, double& t,
                 const Job* job) const {
  // If the Lipschitz constant of the thickness is unknown, there is no bound.
  const bool is_bounded = thickness_.lipschitz() < std::numeric_limits<double>::infinity();
  const RayMarch steps{is_bounded ? shape_->ray_tolerance() : shape_->min_ray_step(),
                       shape_->ray_tolerance(), tolerance};
  return steps.find(
      wanted, ray, from, to, [this](Vec3 p) { return holds(p); },
      [this](Vec3 p) { return distance_bound(p, shape_->depth(p)); }, t, job);
}

// A sample decides all following samples of the row within its distance bound.
void Skin::step_along_rows(const RowBlock& alive, const RowBlock& skin, const Job* job) const {
  const SampleGrid& grid = *alive.grid;
  const Interval thickness = thickness_.range();
  const double error = shape_->depth_error();
  // Positions of samples are rounded, by far less than 2^-40 of a coordinate.
  const double rounding =
      0x1p-40 * (max_magnitude(grid.at(0, alive.y0, alive.z0)) + std::abs(grid.x(grid.nx - 1))) +
      grid.rounding();
  for (uint64_t k = alive.z0; k < alive.z1; ++k)
    for (uint64_t j = alive.y0; j < alive.y1; ++j) {
      if (j % 16 == 0) check_cancelled(job);
      const uint64_t* row = alive.row(j, k);
      for (uint64_t i = next_bit(row, 0, grid.nx); i < grid.nx;) {
        const Vec3 p = grid.at(i, j, k);
        const double depth = shape_->depth(p);
        // If the Lipschitz constant of the thickness is unknown, its range is still known.
        const double reach =
            std::max(distance_bound(p, depth),
                     std::max(depth - thickness.high, thickness.low - depth) - error) -
            rounding;
        const double steps = std::clamp(std::floor(reach / grid.spacing.x), 0.0,
                                        static_cast<double>(grid.nx - 1 - i));
        const uint64_t last = i + static_cast<uint64_t>(steps);
        if (holds(p, depth)) set_bits(skin.row(j, k), i, last);
        i = next_bit(row, last + 1, grid.nx);
      }
    }
}

void Skin::mark_rows(const RowBlock& alive, const RowBlock& skin, const Job* job) const {
  if (const BoundarySearch* search = shape_->boundary_search())
    SkinCells(*this, *search, alive, skin).mark(job);
  else if (!thickness_.is_constant() || !shape_->fill_shallow_rows(thickness_.range().high, skin))
    step_along_rows(alive, skin, job);
  for (uint64_t k = alive.z0; k < alive.z1; ++k)
    for (uint64_t j = alive.y0; j < alive.y1; ++j)
      for (size_t w = 0; w < alive.row_words(); ++w) skin.row(j, k)[w] &= alive.row(j, k)[w];
}

}  // namespace msq
