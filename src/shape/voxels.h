// SPDX-License-Identifier: Apache-2.0
// A voxel image as a coarse shape: where its trilinear function is on one side of a threshold.
//
// Beyond the box that the outermost samples span, everything is outside. Rows along the image's own
// x ask only cells that the threshold crosses: the pyramid of bounds decides most blocks, the
// function at the cells' ends, between which it is linear on a row, the rest. On turned images and
// on grids much coarser than the image, boxes of samples are halved until the pyramid decides them
// or few are left.
#pragma once

#include "shape/image.h"
#include "shape/shape.h"

namespace msq {

class Voxels final : public Shape {
 public:
  enum class Solid { above, below };  ///< the threshold itself is solid on either side

  /// Throws Error(argument) where no sample is solid. At least two samples along each axis.
  Voxels(Image image, double threshold, Solid solid);

  bool inside(Vec3 p) const override;
  void fill_rows(const RowBlock& block) const override;
  /// Both follow the function cell by cell, past blocks that the pyramid decides: no part longer
  /// than the tolerance is lost.
  bool enter(const Ray& ray, double from, double to, double& t) const override;
  double leave(const Ray& ray, double from, double to) const override;

 protected:
  double clearance(Vec3 p) const override;

 private:
  /// Points this far beyond the outermost samples, in voxels, are still in the image: rounding does
  /// not open its border.
  static constexpr double border = 1e-9;

  /// What is known of the samples of cells.
  enum class Side { outside, inside, both };
  Side side(Interval samples) const;
  bool solid(double value) const {
    return solid_ == Solid::above ? value >= threshold_ : value <= threshold_;
  }
  bool in_image(Vec3 voxels) const;
  void measure();
  class RayWalk;
  /// The first t in [from, to], in bounds(), where membership is `wanted`, settled by it.
  bool find(bool wanted, const Ray& ray, double from, double to, double& t) const;

  /// Samples [first, end) of a row of an image that is not turned; u_first is where the first is.
  template <class T>
  void fill_row(const T* values, const SampleGrid& grid, double y, double z, uint64_t* row,
                uint64_t first, uint64_t end) const;
  struct Part;
  void fill_part(const RowBlock& block, const Part& part) const;

  Image image_;
  double threshold_;
  Solid solid_;
};

}  // namespace msq
