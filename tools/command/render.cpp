// SPDX-License-Identifier: Apache-2.0
// msq render: draws a picture.
#include <algorithm>
#include <cmath>

#include "output_file.h"
#include "scene.h"
#include "text.h"
#include "watch.h"

extern "C" {
#include "orbit.h"
#include "stage.h"
}

namespace command {

namespace {

constexpr double LIGHT[3] = {-0.55, 0.75, 0.45};  // right, up, towards the eye
constexpr uint32_t WIDTH = 800, HEIGHT = 600;
constexpr double MARGIN = 1.06;
// Linear light: the part's own surface, and the structures.
constexpr double COLOURS[] = {0.80, 0.62, 0.40, 0.85, 0.30, 0.05,
                              0.10, 0.38, 0.55, 0.45, 0.55, 0.12};
constexpr uint32_t OCCLUSION_RAYS = 8;  // per sample; a pixel has several
constexpr double AMBIENT = 0.45;

uint32_t side_of(const Arguments& arguments, double value) {
  if (!(value >= 1) || !(value <= 16384) || value != std::floor(value)) {
    arguments.refuse(
        "size", "a side of '" + arguments.text("size") + "' is no whole number from 1 to 16384");
  }
  return static_cast<uint32_t>(value);
}

void read_size(const Arguments& arguments, msq_render_def& def) {
  if (arguments.has("size")) {
    const std::vector<double> size = arguments.numbers("size", {2});
    def.width = side_of(arguments, size[0]);
    def.height = side_of(arguments, size[1]);
  }
  def.samples = static_cast<uint32_t>(arguments.count("samples", def.samples, 16, 1));
}

void find_direction(const msq_camera& camera, double direction[3]) {
  for (size_t a = 0; a < 3; ++a) direction[a] = camera.target[a] - camera.eye[a];
}

// Whether the camera of a model file is one that was fitted to the model, along a direction.
bool is_fitted(const Scene& scene, const msq_render_def& def, const msq_camera& camera) {
  double direction[3];
  find_direction(camera, direction);
  msq_camera fitted = camera;
  check(msq_camera_fit(scene.model.get(), direction, camera.up, def.width, def.height, &fitted));
  const double room =
      1e-9 * (std::fabs(fitted.height) + std::hypot(direction[0], direction[1], direction[2]));
  bool is_same = std::fabs(fitted.height - camera.height) <= room;
  for (size_t a = 0; a < 3; ++a) {
    is_same = is_same && std::fabs(fitted.eye[a] - camera.eye[a]) <= room &&
              std::fabs(fitted.target[a] - camera.target[a]) <= room;
  }
  return is_same;
}

// Options take the place of what the camera has. file_def: what a model file says, or null.
void place_camera(const Arguments& arguments, const Scene& scene, const msq_render_def& def,
                  const msq_render_def* file_def, msq_camera& camera) {
  const double zoom = arguments.number("zoom", 1);
  if (!(zoom > 0)) arguments.refuse("zoom", arguments.text("zoom") + " is not above 0");
  const bool fits_anew = file_def == nullptr || arguments.has("view") ||
                         arguments.has("perspective") ||
                         (arguments.has("size") && has_bounds(scene.model.get()) &&
                          is_fitted(scene, *file_def, camera));
  if (fits_anew && !has_bounds(scene.model.get())) {
    throw UsageError(
        arguments.operand(0) +
        " fills all space, to which no camera fits; a picture needs a view with a camera "
        "in the model file, without --view and --perspective");
  }
  double direction[3];
  if (arguments.has("view") || file_def == nullptr) {
    std::vector<double> view = {32, 30};
    if (arguments.has("view")) view = arguments.numbers("view", {2});
    orbit_direction(view[0], view[1], direction);
  } else {
    find_direction(camera, direction);
  }
  if (arguments.has("perspective")) {
    camera.projection = MSQ_CAMERA_PERSPECTIVE;
    camera.field_of_view = arguments.number("perspective", 40);
  }
  double nearer = 1 / zoom;
  if (fits_anew) {
    const bool keeps_up = file_def != nullptr && !arguments.has("view");
    const std::vector<double> up(camera.up, camera.up + 3);
    check(msq_camera_fit(scene.model.get(), direction, keeps_up ? up.data() : nullptr, def.width,
                         def.height, &camera));
    if (!keeps_up || arguments.has("perspective")) nearer *= MARGIN;
  }
  std::vector<double> at(camera.target, camera.target + 3);
  if (arguments.has("at")) at = arguments.numbers("at", {3});
  const bool is_perspective = camera.projection == MSQ_CAMERA_PERSPECTIVE;
  camera.height *= nearer;
  for (size_t a = 0; a < 3; ++a) {
    const double back = camera.eye[a] - camera.target[a];
    camera.target[a] = at[a];
    camera.eye[a] = at[a] + back * (is_perspective ? nearer : 1);
  }
}

void save(const Arguments& arguments, const msq_render_def& def, uint32_t channels,
          const std::vector<uint8_t>& pixels) {
  heed_signals();
  check_io(msq_io_picture_save(arguments.text("output").c_str(), def.width, def.height, channels,
                               pixels.data(), 0, 1));
}

}  // namespace

void run_render(const Arguments& arguments) {
  arguments.require("output");
  if (ending(arguments.text("output")) != ".png") {
    arguments.refuse("output", "'" + arguments.text("output") + "' does not end in .png");
  }
  const bool is_plain = arguments.has("plain"), has_glass = arguments.has("glass");
  if (is_plain && has_glass) arguments.refuse("glass", "does not go with --plain");
  auto def = defaults(msq_render_def_init);
  auto camera = defaults(msq_camera_init);
  const Scene scene = open_scene(arguments);
  if (scene.has_view) {
    check(msq_document_view(scene.document.get(), &camera, &def));
    if (def.width == 0) def.width = WIDTH;
    if (def.height == 0) def.height = HEIGHT;
  } else {
    def.width = WIDTH;
    def.height = HEIGHT;
    def.samples = 2;
    def.colour_by = MSQ_COLOUR_SCALE;
    def.colours = COLOURS;
    def.colour_count = std::size(COLOURS) / 3;
    std::copy(LIGHT, LIGHT + 3, def.light);
    def.ambient = AMBIENT;
    def.shadows = 1;
    def.occlusion_rays = OCCLUSION_RAYS;
  }
  if (is_plain) {
    def.shadows = 0;
    def.occlusion_rays = 0;
    def.background[3] = 0;
  }
  const msq_render_def file_def = def;
  read_size(arguments, def);
  place_camera(arguments, scene, def, scene.has_view ? &file_def : nullptr, camera);

  const size_t pixels = size_t{def.width} * def.height;
  std::vector<uint8_t> rgba(4 * pixels);
  auto frame = defaults(msq_frame_init);
  frame.rgba = rgba.data();
  std::vector<float> depth(is_plain ? 0 : pixels);
  if (!is_plain) frame.depth = depth.data();
  {
    Work work("drawing");
    check(msq_render(scene.model.get(), &camera, &def, nullptr, &frame, nullptr, nullptr,
                     work.job()));
  }
  if (is_plain) {
    save(arguments, def, 4, rgba);
    return;
  }
  double min[3], max[3];
  check(msq_model_bounds(scene.model.get(), min, max));
  stage around = {};
  around.model = scene.model.get();
  around.camera = &camera;
  around.width = def.width;
  around.height = def.height;
  std::copy(def.light, def.light + 3, around.light);
  around.glass = has_glass;
  around.depth = depth.data();
  around.ground = min[2];
  around.has_ground = camera.eye[2] > camera.target[2] && std::isfinite(min[2]);
  std::vector<uint8_t> rgb(3 * pixels);
  check(stage_compose(&around, rgba.data(), rgb.data()));
  save(arguments, def, 3, rgb);
}

}  // namespace command
