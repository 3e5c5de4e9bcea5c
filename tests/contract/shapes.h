// SPDX-License-Identifier: Apache-2.0
// The shapes that the contract suite runs over: clean and dirty meshes under every winding rule,
// primitives, and voxel images.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shape/shape.h"

namespace msq::test {

struct ShapeRow {
  std::string name;
  std::function<Ref<const Shape>()> make;
  double least, most;  ///< part of the bounding box that is inside
};

std::vector<ShapeRow> shape_rows();

}  // namespace msq::test
