// SPDX-License-Identifier: Apache-2.0
// A voxel image as a coarse shape: the solid is where its trilinear function is on one side of a
// threshold.
//
// Everything beyond the box of the outermost samples is outside. Rows along the image's own x
// evaluate only cells that the threshold crosses. The pyramid of bounds decides most blocks. The
// function at the cells' ends decides the others, since it is linear between them on a row. On
// turned images and on grids much coarser than the image, boxes of samples are bisected until the
// pyramid decides them or few samples are left.
#pragma once

#include "shape/image.h"
#include "shape/shape.h"

namespace msq {

class Voxels final : public Shape {
 public:
  enum class Solid { above, below };  ///< the threshold itself is solid on either side

  /// Throws Error(argument) if no sample is solid. Requires at least two samples along each axis.
  Voxels(Image image, double threshold, Solid solid);

  bool inside(Vec3 p) const override;
  void fill_rows(const RowBlock& block) const override;
  /// Both follow the function cell by cell, and skip blocks that the pyramid decides: no part
  /// longer than the tolerance is missed.
  bool enter(const Ray& ray, double from, double to, double& t, const Job* job) const override;
  double leave(const Ray& ray, double from, double to, const Job* job) const override;
  /// Where the ray enters through a face of the image, that of the face; else the gradient of the
  /// function.
  Vec3 normal(const Ray& ray, double t) const override;

  const Image& image() const { return image_; }

 protected:
  double distance_bound(Vec3 p) const override;

 private:
  void describe(HashInput& input) const override;
  /// Points this far beyond the outermost samples, in voxels, still belong to the image: rounding
  /// does not open its border.
  static constexpr double border = 1e-9;

  /// Where the samples of cells are.
  enum class Side { outside, inside, both };
  Side side(Interval samples) const;
  bool solid(double value) const {
    return solid_ == Solid::above ? value >= threshold_ : value <= threshold_;
  }
  bool in_image(Vec3 voxels) const;
  void measure();
  class RayWalk;
  /// Finds the first t in [from, to], in bounds(), where membership is `wanted`; membership
  /// corrects it.
  bool find(bool wanted, const Ray& ray, double from, double to, double& t, const Job* job) const;

  /// Samples [first, end) of a row of an image that is not turned; u_first is the position of the
  /// first.
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
