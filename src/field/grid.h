// SPDX-License-Identifier: Apache-2.0
// Samples on a regular grid, with linear interpolation; constant beyond the border.
#pragma once

#include <utility>

#include "field/field.h"
#include "shape/image.h"

namespace msq {

class GridField final : public Field {
 public:
  explicit GridField(Image image) : image_(std::move(image)) {}

  double at(Vec3 p) const override { return image_.at(p); }
  void values(const Vec3* points, size_t count, double* values) const override {
    for (size_t i = 0; i < count; ++i) values[i] = image_.at(points[i]);
  }
  /// True only where it is constant.
  bool is_linear(const Box3& box, Vec3& gradient) const override {
    gradient = {};
    return image_.is_constant(box);
  }
  Interval range() const override { return image_.range(); }
  Interval range(const Box3& box) const override { return image_.range(box); }
  double lipschitz() const override { return image_.lipschitz(); }
  double lipschitz(const Box3& box) const override { return image_.lipschitz(box); }
  std::optional<Slopes> slopes(const Box3& box) const override;
  const Image& image() const { return image_; }

 private:
  void describe(HashInput& input) const override {
    input.kind("field: grid");
    image_.describe(input);
  }

  Image image_;
};

inline std::optional<Slopes> GridField::slopes(const Box3& box) const {
  Slopes slopes;
  if (!image_.slopes(box, slopes.between, slopes.rounding)) return {};
  return slopes;
}

}  // namespace msq
