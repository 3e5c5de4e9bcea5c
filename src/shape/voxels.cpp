// SPDX-License-Identifier: Apache-2.0
#include "shape/voxels.h"

#include <limits>

#include "base/hash_input.h"
#include "base/status.h"
#include "shape/nearest_cell.h"

namespace msq {

Voxels::Voxels(Image image, double threshold, Solid solid)
    : image_(std::move(image)), threshold_(threshold), solid_(solid) {
  const Interval range = image_.range();
  if (!this->solid(solid == Solid::above ? range.high : range.low))
    fail(Status::argument, "no value of the image is solid: they run from %g to %g, and %s %g is",
         range.low, range.high, solid == Solid::above ? "from" : "up to", threshold);
  measure();
}

/// The bounds of the cells with a solid sample, and the volume by counting samples: each represents
/// the part of its voxel that lies in the image.
void Voxels::measure() {
  const uint64_t nx = image_.size(0), ny = image_.size(1), nz = image_.size(2);
  uint64_t low[3] = {nx, ny, nz}, high[3] = {0, 0, 0}, eighths = 0;
  image_.visit([&](const auto* v) {
    for (uint64_t k = 0; k < nz; ++k)
      for (uint64_t j = 0; j < ny; ++j, v += nx) {
        uint64_t count = 0;
        for (uint64_t i = 0; i < nx; ++i) count += solid(static_cast<double>(v[i]));
        if (count == 0) continue;
        uint64_t first = 0, last = nx - 1;
        while (!solid(static_cast<double>(v[first]))) ++first;
        while (!solid(static_cast<double>(v[last]))) --last;
        const uint64_t at[3] = {first, j, k}, to[3] = {last, j, k};
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], to[axis]);
        }
        const uint64_t halves = 2 * count - (first == 0) - (last == nx - 1);
        eighths += halves * (j == 0 || j == ny - 1 ? 1 : 2) * (k == 0 || k == nz - 1 ? 1 : 2);
      }
  });
  const ImageFrame& frame = image_.frame();
  const Vec3 s = frame.spacing;
  facts_.area = std::numeric_limits<double>::quiet_NaN();
  facts_.volume = static_cast<double>(eighths) / 8 * s.x * s.y * s.z;
  Box3 cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.min[axis] = static_cast<double>(std::max<uint64_t>(low[axis], 1) - 1);
    cells.max[axis] = static_cast<double>(std::min(high[axis] + 1, image_.size(axis) - 1));
  }
  if (!frame.is_turned()) {
    facts_.bounds = {frame.origin + cells.min * s, frame.origin + cells.max * s};
    return;
  }
  const Vec3 centre = (cells.min + cells.max) * 0.5 * s, half = cells.extent() * 0.5 * s;
  const auto& m = frame.rotation.m;
  Vec3 reach;
  for (int i = 0; i < 3; ++i)
    reach[i] = (std::abs(m[3 * i]) * half.x + std::abs(m[3 * i + 1]) * half.y +
                std::abs(m[3 * i + 2]) * half.z) *
               (1 + 0x1p-40);
  const Vec3 middle = frame.rotation.apply(centre) + frame.origin;
  facts_.bounds = Box3{middle - reach, middle + reach}.grown(
      2 * border * max_component(s) + image_.position_slack(max_magnitude(middle)));
}

bool Voxels::in_image(Vec3 u) const {
  for (int axis = 0; axis < 3; ++axis)
    if (!(u[axis] >= -border && u[axis] <= static_cast<double>(image_.cells(axis)) + border))
      return false;
  return true;
}

bool Voxels::inside(Vec3 p) const {
  if (!bounds().contains(p)) return false;
  const Vec3 u = image_.to_voxels(p);
  return in_image(u) && solid(image_.value(u));
}

/// Values are within the range of their cell's samples, so rounding has no effect here.
Voxels::Side Voxels::side(Interval samples) const {
  const bool low = solid(samples.low), high = solid(samples.high);
  return low != high ? Side::both : low ? Side::inside : Side::outside;
}

double Voxels::distance_bound(Vec3 p) const {
  // In model units along the image's axes, from its first sample.
  const ImageFrame& frame = image_.frame();
  const Vec3 g = frame.rotation.apply_inverse(p - frame.origin);
  const Vec3 extent = frame.spacing * Vec3{static_cast<double>(image_.cells(0)),
                                           static_cast<double>(image_.cells(1)),
                                           static_cast<double>(image_.cells(2))};
  const bool is_inside = inside(p);
  // At the boundary the function reaches the threshold; beyond the image it is that of the border.
  const double value = image_.value(image_.to_voxels(p));
  double distance = 0;
  if (solid(value) == is_inside && image_.lipschitz() > 0)
    distance = (std::abs(value - threshold_) - 4 * image_.value_slack()) / image_.lipschitz();
  // The boundary also lies in a cell that is not entirely on this side.
  const Side here = is_inside ? Side::inside : Side::outside;
  distance = std::max(
      distance, nearest_cell(image_, g, [&](Interval samples) { return side(samples) != here; }));
  if (is_inside) distance = std::min(distance, min_component(min(g, extent - g)));
  // Positions have errors here and in inside(), and the border has a width.
  const double slack = 4 * image_.position_slack(max_magnitude(p) + max_component(extent)) +
                       4 * border * max_component(frame.spacing) + 0x1p-47 * distance;
  return std::max(0.0, distance - slack);
}

struct Voxels::Part {
  uint64_t low[3], high[3];  ///< samples, high excluded

  uint64_t count(int axis) const { return high[axis] - low[axis]; }
};

void Voxels::fill_rows(const RowBlock& block) const {
  const SampleGrid& grid = *block.grid;
  const ImageFrame& frame = image_.frame();
  if (frame.is_turned() || grid.spacing.x > frame.spacing.x) {
    const Box3& box = bounds();
    const uint64_t first = grid.first_x_from(box.min.x);
    const uint64_t end = grid.first_x_from<true>(box.max.x);
    if (first < end) fill_part(block, {{first, block.y0, block.z0}, {end, block.y1, block.z1}});
    return;
  }
  image_.visit([&](const auto* values) {
    for_each_row_in_bounds(block,
                           [&](double y, double z, uint64_t* row, uint64_t first, uint64_t end) {
                             fill_row(values, grid, y, z, row, first, end);
                           });
  });
}

template <class T>
void Voxels::fill_row(const T* values, const SampleGrid& grid, double y, double z, uint64_t* row,
                      uint64_t first, uint64_t end) const {
  const double origin = image_.frame().origin.x, spacing = image_.frame().spacing.x;
  const Vec3 u = image_.to_voxels(Vec3{grid.x(first), y, z});
  const Image::Located v = image_.locate(u.y, 1), w = image_.locate(u.z, 2);
  const auto line = image_.row(values, v, w);
  const ImageBounds::Level& leaves = image_.bounds().levels().front();
  constexpr unsigned bits = ImageBounds::leaf_bits;

  // Without a rotation to_voxels() adds only zeros to this, which grows with the column.
  const auto column = [&](uint64_t i) { return (grid.x(i) - origin) * image_.scale().x; };
  const auto cell = [&](uint64_t i) { return image_.locate(column(i), 0).cell; };
  const uint64_t first_cell = cell(first), last_cell = cell(end - 1);
  /// The first sample that lies in this cell or beyond it.
  const auto sample_from = [&](uint64_t c) {
    if (c <= first_cell) return first;
    if (c > last_cell) return end;
    const double at = (origin + static_cast<double>(c) * spacing - grid.x(0)) / grid.spacing.x;
    uint64_t i = at > static_cast<double>(first) ? static_cast<uint64_t>(at) : first;
    i = std::min(i, end);
    while (i > first && cell(i - 1) >= c) --i;
    while (i < end && cell(i) < c) ++i;
    return i;
  };

  bool is_open = false;  // a run of samples inside, from `start`
  uint64_t start = 0;
  const auto open = [&](uint64_t c) {
    if (!is_open) start = sample_from(c);
    is_open = true;
  };
  const auto close = [&](uint64_t c) {
    if (!is_open) return;
    is_open = false;
    if (const uint64_t stop = sample_from(c); start < stop) set_bits(row, start, stop - 1);
  };
  for (uint64_t b = first_cell >> bits; b <= last_cell >> bits; ++b) {
    const uint64_t low = std::max(b << bits, first_cell);
    const uint64_t high = std::min((b + 1) << bits, last_cell + 1);
    const Side block_side = side(leaves.at(b, v.cell >> bits, w.cell >> bits));
    if (block_side == Side::inside) open(low);
    if (block_side == Side::outside) close(low);
    if (block_side != Side::both) continue;
    double from = line.at(low);
    for (uint64_t c = low; c < high; ++c) {
      const double to = line.at(c + 1);
      const bool from_solid = solid(from), to_solid = solid(to);
      if (from_solid && to_solid) {
        open(c);
      } else {
        close(c);
        if (from_solid || to_solid)
          for (uint64_t i = sample_from(c), stop = sample_from(c + 1); i < stop; ++i)
            if (solid(Image::join(from, to, image_.locate(column(i), 0).fraction)))
              row[i / bits_per_word] |= uint64_t{1} << (i % bits_per_word);
      }
      from = to;
    }
  }
  close(last_cell + 1);
}

void Voxels::fill_part(const RowBlock& block, const Part& part) const {
  const SampleGrid& grid = *block.grid;
  const Box3 box{grid.at(part.low[0], part.low[1], part.low[2]),
                 grid.at(part.high[0] - 1, part.high[1] - 1, part.high[2] - 1)};
  const Box3 voxels = image_.to_voxels(box);
  bool is_within = bounds().contains(box.min) && bounds().contains(box.max);
  for (int axis = 0; axis < 3; ++axis) {
    const double last = static_cast<double>(image_.cells(axis));
    if (voxels.max[axis] < -border || voxels.min[axis] > last + border) return;
    is_within = is_within && voxels.min[axis] >= -border && voxels.max[axis] <= last + border;
  }
  const Side all = side(image_.bounds().over(image_.cells_in(voxels)));
  if (all == Side::outside) return;
  const uint64_t nx = part.count(0), ny = part.count(1), nz = part.count(2);
  const bool is_inside = all == Side::inside && is_within;
  constexpr uint64_t few = 32;
  if (is_inside || nx * ny * nz <= few) {
    for (uint64_t k = part.low[2]; k < part.high[2]; ++k)
      for (uint64_t j = part.low[1]; j < part.high[1]; ++j) {
        uint64_t* row = block.row(j, k);
        if (is_inside) set_bits(row, part.low[0], part.high[0] - 1);
        for (uint64_t i = part.low[0]; !is_inside && i < part.high[0]; ++i)
          if (inside(grid.at(i, j, k)))
            row[i / bits_per_word] |= uint64_t{1} << (i % bits_per_word);
      }
    return;
  }
  const int longest = nx >= ny && nx >= nz ? 0 : ny >= nz ? 1 : 2;
  Part lower = part, upper = part;
  lower.high[longest] = upper.low[longest] = part.low[longest] + part.count(longest) / 2;
  fill_part(block, lower);
  fill_part(block, upper);
}

void Voxels::describe(HashInput& input) const {
  input.kind("shape: voxels");
  image_.describe(input);
  input.number(threshold_);
  input.integer(static_cast<uint64_t>(solid_));
}

}  // namespace msq
