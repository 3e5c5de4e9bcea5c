// SPDX-License-Identifier: Apache-2.0
#include "shape/image.h"

#include <cstring>
#include <limits>
#include <type_traits>

#include "base/checked.h"

namespace msq {

namespace {

/// Throws for the first invalid value.
template <class T>
void check_values(const T* values, const uint64_t (&size)[3], const Job* job) {
  if constexpr (std::is_floating_point_v<T>) {
    const uint64_t count = size[0] * size[1] * size[2];
    for (uint64_t i = 0; i < count; ++i) {
      if (i % 65536 == 0) check_cancelled(job);
      if (!(std::abs(static_cast<double>(values[i])) <= Image::max_value))
        fail(Status::argument,
             "value (%llu, %llu, %llu) of the image is %g; it must be finite, at most %g in "
             "magnitude",
             static_cast<unsigned long long>(i % size[0]),
             static_cast<unsigned long long>(i / size[0] % size[1]),
             static_cast<unsigned long long>(i / size[0] / size[1]), double(values[i]),
             Image::max_value);
    }
  }
}

/// The first minimum sample and the last maximum one.
template <class T>
Interval range_of(const T* v, const uint64_t (&size)[3], const Job* job) {
  T low = v[0], high = v[0];
  for (uint64_t row = 0, rows = size[1] * size[2]; row < rows; ++row) {
    check_cancelled(job);
    const T* at = v + row * size[0];
    const auto [least, greatest] = std::minmax_element(at, at + size[0]);
    if (*least < low) low = *least;
    if (!(*greatest < high)) high = *greatest;
  }
  return {static_cast<double>(low), static_cast<double>(high)};
}

/// Differences of neighbours; they cannot overflow, and are exact for integers.
template <class T>
using Wide = std::conditional_t<std::is_floating_point_v<T>, double, int32_t>;

/// Maximum magnitude of the differences of samples that are `step` apart.
template <class T>
double steepest(const T* a, uint64_t count, uint64_t step) {
  Wide<T> most = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const Wide<T> d = static_cast<Wide<T>>(a[i + step]) - static_cast<Wide<T>>(a[i]);
    most = std::max(most, d < 0 ? -d : d);
  }
  return static_cast<double>(most);
}

/// Along each axis, over all cells.
template <class T>
Vec3 steepest(const T* v, const uint64_t (&size)[3], const Job* job) {
  Vec3 most;
  for (uint64_t row = 0, rows = size[1] * size[2]; row < rows; ++row) {
    check_cancelled(job);
    const T* at = v + row * size[0];
    most.x = std::max(most.x, steepest(at, size[0] - 1, 1));
    if ((row + 1) % size[1] != 0) most.y = std::max(most.y, steepest(at, size[0], size[0]));
    if (row + size[1] < rows) most.z = std::max(most.z, steepest(at, size[0], size[0] * size[1]));
  }
  return most;
}

}  // namespace

uint64_t Image::bytes_of(Type type) {
  constexpr uint64_t bytes[] = {1, 2, 2, 4, 8};
  return bytes[static_cast<int>(type)];
}

Image::Image(const Source& source, const ImageFrame& frame, std::shared_ptr<MemoryBudget> budget,
             const Job* job)
    : type_(source.type),
      size_{source.size[0], source.size[1], source.size[2]},
      frame_(frame),
      scale_{1 / frame.spacing.x, 1 / frame.spacing.y, 1 / frame.spacing.z} {
  const uint64_t count =
      checked_product(checked_product(size_[0], size_[1], "an image"), size_[2], "an image");
  const uint64_t bytes = checked_product(count, bytes_of(type_), "an image");
  reservation_ = Reservation(std::move(budget), bytes + ImageBounds::bytes_for(size_), "an image");
  bytes_.reset(new unsigned char[bytes]);
  const auto* from = static_cast<const unsigned char*>(source.values);
  const uint64_t row = size_[0] * bytes_of(type_);
  for (uint64_t k = 0; k < size_[2]; ++k)
    for (uint64_t j = 0; j < size_[1]; ++j) {
      check_cancelled(job);
      std::memcpy(bytes_.get() + (k * size_[1] + j) * row,
                  from + k * source.layer_stride + j * source.row_stride, row);
    }
  visit([&](const auto* values) {
    check_values(values, size_, job);
    bounds_ = ImageBounds(values, size_, job);
    range_ = range_of(values, size_, job);
    // Within a cell, the slope along an axis is a mean of those of its edges.
    lipschitz_ = lipschitz_of(steepest(values, size_, job));
  });
  value_slack_ = value_slack(std::max(std::abs(range_.low), std::abs(range_.high)));
}

double Image::value(Vec3 u) const {
  const Located x = locate(u.x, 0), y = locate(u.y, 1), z = locate(u.z, 2);
  return visit([&](const auto* values) {
    const auto line = row(values, y, z);
    const uint64_t next = x.cell + (size_[0] > 1);
    return join(line.at(x.cell), line.at(next), x.fraction);
  });
}

Box3 Image::to_voxels(const Box3& box) const {
  const Vec3 centre = (box.min + box.max) * 0.5, half = box.extent() * 0.5;
  const auto& m = frame_.rotation.m;
  const Vec3 c = to_voxels(centre);
  const double slack = position_slack(max_magnitude(box.min) + max_magnitude(box.max));
  Box3 out;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = std::abs(m[axis]) * half.x + std::abs(m[3 + axis]) * half.y +
                         std::abs(m[6 + axis]) * half.z;
    const double around = (reach + slack) * scale_[axis];
    out.min[axis] = c[axis] - around;
    out.max[axis] = c[axis] + around;
  }
  return out;
}

VoxelRange Image::cells_in(const Box3& voxels) const {
  VoxelRange range;
  for (int axis = 0; axis < 3; ++axis) {
    range.low[axis] = locate(voxels.min[axis], axis).cell;
    // NaN: all cells.
    range.high[axis] = voxels.max[axis] < static_cast<double>(size_[axis])
                           ? locate(voxels.max[axis], axis).cell
                           : cells(axis) - 1;
  }
  return range;
}

Interval Image::samples_of(const VoxelRange& cells) const {
  uint64_t count[3];
  for (int axis = 0; axis < 3; ++axis)
    count[axis] = cells.high[axis] - cells.low[axis] + (size_[axis] > 1 ? 2 : 1);
  return visit([&](const auto* values) {
    const auto* corner =
        values + (cells.low[2] * size_[1] + cells.low[1]) * size_[0] + cells.low[0];
    auto least = *corner, most = least;
    for (uint64_t k = 0; k < count[2]; ++k)
      for (uint64_t j = 0; j < count[1]; ++j) {
        const auto* row = corner + (k * size_[1] + j) * size_[0];
        for (uint64_t i = 0; i < count[0]; ++i) {
          least = std::min(least, row[i]);
          most = std::max(most, row[i]);
        }
      }
    return Interval{static_cast<double>(least), static_cast<double>(most)};
  });
}

bool Image::is_constant(const Box3& box) const {
  if (range_.low == range_.high) return true;
  const Interval range = bounds_.over(cells_in(to_voxels(box)));
  return range.low == range.high;
}

bool Image::are_few(const VoxelRange& cells, uint64_t max_samples) {
  uint64_t samples = 1;
  for (int axis = 0; axis < 3 && samples <= max_samples; ++axis)
    samples *= cells.high[axis] - cells.low[axis] + 2;
  return samples <= max_samples;
}

double Image::lipschitz_of(Vec3 slope) const {
  const Vec3 by_length = slope * scale_;
  return std::hypot(by_length.x, by_length.y, by_length.z) * (1 + 0x1p-48);
}

double Image::lipschitz(const Box3& box) const {
  const VoxelRange cells = cells_in(to_voxels(box));
  if (are_few(cells)) return lipschitz_of(spread_over(cells).steepest());
  const Interval range = bounds_.over(cells);
  const double most = range.high - range.low;
  return std::min(lipschitz_, lipschitz_of({most, most, most}));
}

bool Image::slopes(const Box3& box, Box3& slopes, double& rounding) const {
  constexpr uint64_t max_samples = 2048;
  const Box3 voxels = to_voxels(box);
  const VoxelRange cells = cells_in(voxels);
  if (!is_finite(voxels.min) || !is_finite(voxels.max) || !are_few(cells, max_samples))
    return false;
  // Within a cell, the slope along an axis is a mean of those of its edges, or of the edges of the
  // part of the cell that is in the box. Beyond the image it is 0.
  Box3 edges = are_few(cells)
                   ? visit([&](const auto* values) { return slopes_of(values, cells, voxels); })
                   : spread_over(cells).slopes;
  const Vec3 steepest = msq::max(edges.max, edges.min * -1);
  for (int axis = 0; axis < 3; ++axis) {
    const double top = static_cast<double>(size_[axis] - 1);
    if (!(voxels.min[axis] >= 0 && voxels.max[axis] <= top)) {
      edges.min[axis] = std::min(edges.min[axis], 0.0);
      edges.max[axis] = std::max(edges.max[axis], 0.0);
    }
  }
  edges = {edges.min * scale_, edges.max * scale_};
  slopes = {};
  const auto& m = frame_.rotation.m;
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double by = m[static_cast<size_t>(3 * i + axis)];
      slopes.min[i] += std::min(by * edges.min[axis], by * edges.max[axis]);
      slopes.max[i] += std::max(by * edges.min[axis], by * edges.max[axis]);
    }
  // Of values, of positions, and of these slopes times the way across the box.
  const double magnitude = max_magnitude(box.min) + max_magnitude(box.max);
  rounding = value_slack_ + lipschitz_of(steepest) *
                                (2 * position_slack(magnitude) + 0x1p-46 * length(box.extent()));
  return true;
}

Interval Image::range(const Box3& box) const {
  const Box3 voxels = to_voxels(box);
  const VoxelRange cells = cells_in(voxels);
  if (!are_few(cells)) {
    const Interval bound = bounds_.over(cells);
    return {std::max(bound.low, range_.low), std::min(bound.high, range_.high)};
  }
  const ImageSpread spread = spread_over(cells);
  // From the middle to any point of the box, the steepest edge along each axis bounds the change of
  // the function. Beyond the image the function does not change.
  const Vec3 half = voxels.extent() * 0.5;
  const double middle = value((voxels.min + voxels.max) * 0.5);
  const double reach = dot(spread.steepest(), half) * (1 + 0x1p-40) + 2 * value_slack_;
  return {std::max(middle - reach, spread.range.low), std::min(middle + reach, spread.range.high)};
}

template <class T>
Box3 Image::slopes_of(const T* values, const VoxelRange& cells, const Box3& voxels) const {
  constexpr size_t most = max_few_samples;
  size_t count[3], step[3], all = 1;
  for (int axis = 0; axis < 3; ++axis) {
    count[axis] = cells.high[axis] - cells.low[axis] + (size_[axis] > 1 ? 2 : 1);
    step[axis] = all;
    all *= count[axis];
  }
  double samples[most];
  for (size_t k = 0; k < count[2]; ++k)
    for (size_t j = 0; j < count[1]; ++j) {
      const T* row = values + ((cells.low[2] + k) * size_[1] + cells.low[1] + j) * size_[0];
      for (size_t i = 0; i < count[0]; ++i)
        samples[k * step[2] + j * step[1] + i] = static_cast<double>(row[cells.low[0] + i]);
    }
  const auto for_each_line = [&](int axis, auto&& visit_first) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    for (size_t j = 0; j < count[b]; ++j)
      for (size_t k = 0; k < count[c]; ++k) visit_first(j * step[b] + k * step[c]);
  };
  Box3 slopes;
  for (int axis = 0; axis < 3; ++axis) {
    if (count[axis] == 1) continue;
    // The ends of lines along the other axes move to the sides of the box.
    double moved[most];
    std::copy(samples, samples + all, moved);
    for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
      if (count[other] == 1) continue;
      const auto part = [&](double at, uint64_t cell) {
        return std::clamp(at - static_cast<double>(cell), 0.0, 1.0);
      };
      const double low = part(voxels.min[other], cells.low[other]);
      const double high = part(voxels.max[other], cells.high[other]);
      for_each_line(other, [&](size_t first) {
        double *const a = moved + first, *const z = a + (count[other] - 1) * step[other];
        const double rise = a[step[other]] - *a, last_rise = *z - *(z - step[other]);
        const double begin = *a + low * rise;
        *z = *(z - step[other]) + high * last_rise;
        *a = begin;
      });
    }
    double fall = std::numeric_limits<double>::infinity(), rise = -fall;
    for_each_line(axis, [&](size_t first) {
      const double* at = moved + first;
      for (size_t i = 1; i < count[axis]; ++i, at += step[axis]) {
        fall = std::min(fall, at[step[axis]] - *at);
        rise = std::max(rise, at[step[axis]] - *at);
      }
    });
    // Each of these differences loses less than a dozen units of 2^-53 of the largest sample.
    slopes.min[axis] = fall - value_slack_;
    slopes.max[axis] = rise + value_slack_;
  }
  return slopes;
}

ImageSpread Image::spread_over(const VoxelRange& cells) const {
  uint64_t count[3];
  for (int axis = 0; axis < 3; ++axis)
    count[axis] = cells.high[axis] - cells.low[axis] + (size_[axis] > 1 ? 2 : 1);
  const uint64_t dy = size_[0], dz = size_[0] * size_[1];
  return visit([&](const auto* values) {
    return spread_of(values + cells.low[2] * dz + cells.low[1] * dy + cells.low[0], count, dy, dz);
  });
}

void Image::describe(HashInput& input) const {
  input.integer(static_cast<uint64_t>(type_));
  for (uint64_t size : size_) input.integer(size);
  input.point(frame_.origin);
  input.point(frame_.spacing);
  input.rotation(frame_.rotation);
  visit([&](const auto* values) { input.list(values, size_[0] * size_[1] * size_[2]); });
}

}  // namespace msq
