// SPDX-License-Identifier: Apache-2.0
// Samples on a regular grid in its own frame, with linear interpolation along each axis.
//
// There is one scalar definition, value(). It interpolates the cell's samples along z, then y, then
// x, each time as a + f (b - a), clamped between a and b. So no value leaves the range of its
// cell's samples. On a row along the image's own x, everything except the last step depends on the
// sample's column alone.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "base/hash_input.h"
#include "base/job.h"
#include "base/memory.h"
#include "base/vec.h"
#include "shape/image_bounds.h"
#include "shape/image_spread.h"

namespace msq {

/// Sample (i, j, k) stands at origin + rotation * ((i, j, k) * spacing).
struct ImageFrame {
  Vec3 origin, spacing{1, 1, 1};
  Rotation rotation;

  bool is_turned() const { return rotation.m != Rotation{}.m; }
};

class Image {
 public:
  enum class Type { uint8, int16, uint16, float32, float64 };
  static constexpr uint64_t max_size = 1 << 20;  ///< samples along an axis
  static constexpr double max_value = 1e100;     ///< in magnitude

  /// A host's samples, x fastest; strides in bytes.
  struct Source {
    const void* values;
    Type type;
    uint64_t size[3];
    uint64_t row_stride, layer_stride;
  };
  /// Copies the samples. Throws Error(argument) if a value is not finite or too large, Error(limit)
  /// if the budget is exceeded, Error(cancelled) if the job, which may be null, is cancelled.
  Image(const Source& source, const ImageFrame& frame, std::shared_ptr<MemoryBudget> budget,
        const Job* job = nullptr);

  const ImageFrame& frame() const { return frame_; }
  uint64_t size(int axis) const { return size_[axis]; }
  uint64_t cells(int axis) const { return size_[axis] > 1 ? size_[axis] - 1 : 1; }
  const ImageBounds& bounds() const { return bounds_; }
  /// Minimum and maximum sample.
  Interval range() const { return range_; }
  void describe(HashInput& input) const;
  /// Bound of the rounding error of value(), at the same coordinates.
  double value_slack() const { return value_slack_; }
  /// The same where no sample around exceeds a magnitude: each of seven interpolations loses at
  /// most five units of 2^-53 of it, three in a row.
  static double value_slack(double largest) { return 0x1p-48 * largest; }
  /// Lipschitz constant in model units, of the function without rounding.
  double lipschitz() const { return lipschitz_; }
  /// The same for the function in a box.
  double lipschitz(const Box3& box) const;

  /// Sample (i, j, k) is at (i, j, k).
  Vec3 to_voxels(Vec3 p) const { return frame_.rotation.apply_inverse(p - frame_.origin) * scale_; }
  /// Contains to_voxels() of the points of a box, as computed and without rounding.
  Box3 to_voxels(const Box3& box) const;
  /// The cells that contain points of the box, in voxel coordinates, or are nearest to them.
  VoxelRange cells_in(const Box3& voxels) const;
  /// Bound of the rounding of to_voxels(p), in model units, for points up to that magnitude.
  double position_slack(double magnitude) const {
    return 0x1p-47 * (magnitude + max_magnitude(frame_.origin));
  }
  /// 1 / spacing as in to_voxels().
  Vec3 scale() const { return scale_; }

  /// The cell of a coordinate, and the position in the cell, clamped to the image.
  struct Located {
    uint64_t cell;
    double fraction;
  };
  Located locate(double u, int axis) const {
    const double top = static_cast<double>(size_[axis] - 1);
    const double within = u > 0 ? (u < top ? u : top) : 0;  // NaN: 0
    const uint64_t cell = std::min(static_cast<uint64_t>(within), cells(axis) - 1);
    return {cell, within - static_cast<double>(cell)};
  }
  static double join(double a, double b, double f) {
    return std::clamp(a + f * (b - a), std::min(a, b), std::max(a, b));
  }

  /// The samples of one row of cells along x, interpolated along z and y. value() of a point of the
  /// row is join(at(i), at(i + 1), fraction).
  template <class T>
  struct Row {
    const T *v00, *v01, *v10, *v11;  ///< first bit y, second z
    double y, z;
    double at(uint64_t i) const {
      return join(join(v00[i], v01[i], z), join(v10[i], v11[i], z), y);
    }
  };
  template <class T>
  Row<T> row(const T* values, Located y, Located z) const {
    const uint64_t dy = size_[1] > 1 ? size_[0] : 0, dz = size_[2] > 1 ? size_[0] * size_[1] : 0;
    const T* v = values + (z.cell * size_[1] + y.cell) * size_[0];
    return {v, v + dz, v + dy, v + dy + dz, y.fraction, z.fraction};
  }
  /// At voxel coordinates; beyond the image, the value of its border.
  double value(Vec3 u) const;
  double at(Vec3 p) const { return value(to_voxels(p)); }
  /// Encloses at(p) for all p of a box.
  Interval range(const Box3& box) const;
  /// Encloses the gradient of the function in a box. rounding: bound of the difference of at(p) and
  /// the function. False if the box has too many samples.
  bool slopes(const Box3& box, Box3& slopes, double& rounding) const;
  /// Minimum and maximum sample of cells, examined one by one.
  Interval samples_of(const VoxelRange& cells) const;
  /// Whether at(p) is constant in a box, to the last bit.
  bool is_constant(const Box3& box) const;

  /// Calls body(first sample) with a pointer of the samples' type.
  template <class Body>
  decltype(auto) visit(Body&& body) const {
    const void* values = bytes_.get();
    switch (type_) {
      case Type::uint8:
        return body(static_cast<const uint8_t*>(values));
      case Type::int16:
        return body(static_cast<const int16_t*>(values));
      case Type::uint16:
        return body(static_cast<const uint16_t*>(values));
      case Type::float32:
        return body(static_cast<const float*>(values));
      default:
        return body(static_cast<const double*>(values));
    }
  }
  /// Samples of a cell: bit 0 of their number for x, bit 1 for y, bit 2 for z. At least two samples
  /// along each axis.
  void corners(const uint64_t (&cell)[3], double (&samples)[8]) const {
    visit([&](const auto* values) {
      const uint64_t dy = size_[0], dz = size_[0] * size_[1];
      const auto* v = values + cell[2] * dz + cell[1] * dy + cell[0];
      for (unsigned i = 0; i < 8; ++i)
        samples[i] = static_cast<double>(v[(i & 1) + (i & 2 ? dy : 0) + (i & 4 ? dz : 0)]);
    });
  }
  static uint64_t bytes_of(Type type);

 private:
  /// Of the samples of some cells.
  ImageSpread spread_over(const VoxelRange& cells) const;
  /// Slopes along each axis, in samples, of the function in the part of the cells that a box of
  /// voxel coordinates covers. Few cells only.
  template <class T>
  Box3 slopes_of(const T* values, const VoxelRange& cells, const Box3& voxels) const;
  /// Whether they have so few samples that all may be examined.
  static constexpr uint64_t max_few_samples = 64;
  static bool are_few(const VoxelRange& cells, uint64_t max_samples = max_few_samples);
  double lipschitz_of(Vec3 slope) const;

  Type type_;
  uint64_t size_[3];
  ImageFrame frame_;
  Vec3 scale_;
  Reservation reservation_;
  std::unique_ptr<unsigned char[]> bytes_;  // new aligns it for any number
  ImageBounds bounds_;
  Interval range_;
  double value_slack_ = 0, lipschitz_ = 0;
};

}  // namespace msq
