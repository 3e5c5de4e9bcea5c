// SPDX-License-Identifier: Apache-2.0
// Cameras: the ray of each position of a picture.
//
// Directions of rays are not normalised: their component along the view is 1. So t of a ray is the
// depth, the distance from the eye along the view.
#pragma once

#include <cstdint>
#include <limits>

#include "base/vec.h"

namespace msq {

struct Camera {
  bool is_perspective = false;
  Vec3 eye, target, up{0, 0, 1};
  double height = 0;          ///< orthographic: of the picture, in model units
  double field_of_view = 40;  ///< perspective: from its lower to its upper edge, degrees
  double clip_near = 0, clip_far = std::numeric_limits<double>::infinity();
};

/// A picture of width x height pixels as a camera sees it. Positions are in pixels, from the upper
/// left corner of the picture to the right and down.
class View {
 public:
  /// Throws Error(argument) if the camera has no frame or its numbers overflow.
  View(const Camera& camera, uint32_t width, uint32_t height);

  const Camera& camera() const { return camera_; }
  uint32_t width() const { return width_; }
  uint32_t height() const { return height_; }
  /// Unit vectors: along the view, and to the right and upwards in the picture.
  Vec3 forward() const { return forward_; }
  Vec3 right() const { return right_; }
  Vec3 up() const { return up_; }

  Vec3 origin(double x, double y) const {
    return camera_.is_perspective ? camera_.eye : camera_.eye + offset(x, y);
  }
  Vec3 direction(double x, double y) const {
    return camera_.is_perspective ? forward_ + offset(x, y) : forward_;
  }

 private:
  /// Offset from the middle of the picture, in the eye's plane or, in perspective, at depth 1.
  Vec3 offset(double x, double y) const {
    return right_ * ((x - middle_x_) * pixel_) + up_ * ((middle_y_ - y) * pixel_);
  }

  Camera camera_;
  uint32_t width_, height_;
  double middle_x_, middle_y_;
  double pixel_;  ///< side of a pixel at the depth of offset()
  Vec3 forward_, right_, up_;
};

/// The upward direction if the host gives none: z, or y if z is almost along the view.
Vec3 default_up(Vec3 direction);

/// The camera with eye, target, up and height set so that a box just fits the picture, seen along a
/// direction.
Camera fitted(Camera camera, const Box3& box, Vec3 direction, Vec3 up, uint32_t width,
              uint32_t height);

}  // namespace msq
