// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/vec.h"

namespace msq {

struct Ball {
  Vec3 centre;
  double radius;
};

/// The middle of a box, and a radius about it within which all samples of the box lie.
inline Ball ball_about(const Box3& box) {
  return {(box.min + box.max) * 0.5,
          (0.5 + 0x1p-40) * length(box.max - box.min) +
              0x1p-48 * (max_magnitude(box.min) + max_magnitude(box.max))};
}

}  // namespace msq
