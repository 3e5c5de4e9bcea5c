// SPDX-License-Identifier: Apache-2.0
#include "ray/camera.h"

#include <numbers>

#include "base/status.h"

namespace msq {

namespace {

/// Minimum sine of the angle between the view and the upward direction.
constexpr double min_sine = 1e-6;

struct ViewFrame {
  Vec3 forward, right, up;
};

Vec3 unit(Vec3 v, const char* name) {
  const double size = std::hypot(v.x, v.y, v.z);
  if (!(size >= std::numeric_limits<double>::min()) || !std::isfinite(size))
    fail(Status::argument, "%s is (%g, %g, %g); its length must be positive and finite", name, v.x,
         v.y, v.z);
  return {v.x / size, v.y / size, v.z / size};
}

ViewFrame frame_of(Vec3 view, Vec3 up, const char* view_name) {
  ViewFrame frame;
  frame.forward = unit(view, view_name);
  frame.right = cross(frame.forward, unit(up, "up"));
  const double sine = length(frame.right);
  if (!(sine >= min_sine))
    fail(Status::argument,
         "up is (%g, %g, %g), along the view: the sine of the angle between them is %g; it must be "
         "at least %g",
         up.x, up.y, up.z, sine, min_sine);
  frame.right = frame.right * (1 / sine);
  frame.up = cross(frame.right, frame.forward);
  return frame;
}

/// Half the picture's height at depth 1.
double slope_of(double field_of_view) {
  return std::tan(field_of_view * (std::numbers::pi / 360));
}

}  // namespace

View::View(const Camera& camera, uint32_t width, uint32_t height)
    : camera_(camera),
      width_(width),
      height_(height),
      middle_x_(0.5 * width),
      middle_y_(0.5 * height) {
  const ViewFrame frame = frame_of(camera.target - camera.eye, camera.up, "target - eye");
  forward_ = frame.forward;
  right_ = frame.right;
  up_ = frame.up;
  pixel_ = (camera.is_perspective ? 2 * slope_of(camera.field_of_view) : camera.height) / height;
  for (const double x : {0.0, 1.0 * width})
    for (const double y : {0.0, 1.0 * height})
      if (!is_finite(origin(x, y)) || !std::isfinite(length(direction(x, y))))
        fail(Status::argument,
             "rays at the corners of the picture are not finite: the height is %g", camera.height);
}

Vec3 default_up(Vec3 direction) {
  constexpr double least = 0.045;  // sine of 2.6 degrees
  const Vec3 forward = unit(direction, "direction");
  return std::hypot(forward.x, forward.y) >= least ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
}

Camera fitted(Camera camera, const Box3& box, Vec3 direction, Vec3 up, uint32_t width,
              uint32_t height) {
  const ViewFrame frame = frame_of(direction, up, "direction");
  const Vec3 half = box.extent() * 0.5;
  const double aspect = static_cast<double>(width) / height, radius = length(half);
  const double slope = slope_of(camera.field_of_view);
  double across = 0, distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 from_middle{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                           corner & 4 ? half.z : -half.z};
    const double reach = std::max(std::abs(dot(from_middle, frame.up)),
                                  std::abs(dot(from_middle, frame.right)) / aspect);
    across = std::max(across, 2 * reach);
    distance = std::max(distance, reach / slope - dot(from_middle, frame.forward));
  }
  // If there is nothing to fit, any height is valid.
  if (!(across > 0)) across = radius > 0 ? 2 * radius : 1;
  if (!camera.is_perspective) distance = 2 * radius;
  if (!(distance > 0)) distance = across;
  camera.target = box.min + half;
  camera.eye = camera.target - frame.forward * distance;
  camera.up = up;
  camera.height = across;
  return camera;
}

}  // namespace msq
