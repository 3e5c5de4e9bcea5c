// SPDX-License-Identifier: Apache-2.0
#include "ray/render.h"

#include "api/guard.h"
#include "api/points.h"

using namespace msq;
using namespace msq::api;

namespace {

constexpr uint32_t max_pixels = 16384, max_step = 64, max_occlusion_rays = 256;
constexpr uint64_t max_colours = 65536;
constexpr double min_angle = 0.001, max_angle = 179;

void write_vector(Vec3 v, double* out) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = v[axis];
}

msq_camera camera_defaults() {
  const Camera defaults;
  msq_camera camera{};
  camera.projection = MSQ_CAMERA_ORTHOGRAPHIC;
  write_vector(defaults.up, camera.up);
  camera.field_of_view = defaults.field_of_view;
  camera.clip_far = defaults.clip_far;
  return camera;
}

msq_render_def render_defaults() {
  const Shading defaults;
  msq_render_def def{};
  def.samples = 1;
  def.first_step = 1;
  for (int axis = 0; axis < 3; ++axis) def.light[axis] = defaults.light[axis];
  def.ambient = defaults.ambient;
  return def;
}

uint32_t require_count(uint32_t value, uint32_t low, uint32_t high, const char* name) {
  if (value < low || value > high)
    fail(Status::argument, "%s is %u; it must be from %u to %u", name, value, low, high);
  return value;
}

double require_part(double value, const char* name) {
  if (!(value >= 0 && value <= 1))
    fail(Status::argument, "%s is %g; it must be from 0 to 1", name, value);
  return value;
}

/// Without what msq_camera_fit() sets.
Camera read_lens(const msq_camera& known) {
  Camera camera;
  camera.is_perspective =
      require_range(known.projection, MSQ_CAMERA_ORTHOGRAPHIC, MSQ_CAMERA_PERSPECTIVE,
                    "projection") == MSQ_CAMERA_PERSPECTIVE;
  camera.field_of_view = known.field_of_view;
  if (camera.is_perspective &&
      !(known.field_of_view >= min_angle && known.field_of_view <= max_angle))
    fail(Status::argument, "field_of_view is %g; it must be from %g to %g", known.field_of_view,
         min_angle, max_angle);
  camera.clip_near = known.clip_near;
  camera.clip_far = known.clip_far;
  if (!(known.clip_near >= 0) || !std::isfinite(known.clip_near))
    fail(Status::argument, "clip_near is %g; it must be finite and not negative", known.clip_near);
  if (!(known.clip_far > known.clip_near))
    fail(Status::argument, "clip_far is %g; it must be greater than clip_near, which is %g",
         known.clip_far, known.clip_near);
  return camera;
}

View read_view(const msq_camera* given, uint32_t width, uint32_t height) {
  const msq_camera known = read_def(given, camera_defaults(), "camera");
  Camera camera = read_lens(known);
  camera.eye = require_vector(known.eye, "eye");
  camera.target = require_vector(known.target, "target");
  camera.up = require_vector(known.up, "up");
  camera.height = camera.is_perspective ? known.height : require_positive(known.height, "height");
  return View(camera, require_count(width, 1, max_pixels, "width"),
              require_count(height, 1, max_pixels, "height"));
}

std::vector<Vec3> read_colours(const msq_render_def& known) {
  if (!known.colours) {
    if (known.colour_count != 0)
      fail(Status::argument, "colours is NULL and colour_count is %llu",
           static_cast<unsigned long long>(known.colour_count));
    return palette();
  }
  if (known.colour_count < 1 || known.colour_count > max_colours)
    fail(Status::argument, "colour_count is %llu; it must be from 1 to %llu",
         static_cast<unsigned long long>(known.colour_count),
         static_cast<unsigned long long>(max_colours));
  std::vector<Vec3> colours(known.colour_count);
  for (size_t i = 0; i < colours.size(); ++i)
    for (int part = 0; part < 3; ++part)
      colours[i][part] =
          require_part(known.colours[3 * i + static_cast<size_t>(part)], "a part of colours");
  return colours;
}

Shading read_shading(const msq_render_def& known) {
  Shading shading;
  shading.colour_by = static_cast<ColourBy>(
      require_range(known.colour_by, MSQ_COLOUR_PLAIN, MSQ_COLOUR_NORMAL, "colour_by"));
  shading.colours = read_colours(known);
  for (const double part : known.background) require_part(part, "a part of background");
  const double opacity = known.background[3];
  shading.background =
      colour_of(Vec3{known.background[0], known.background[1], known.background[2]} * opacity);
  shading.background.opacity = static_cast<float>(opacity);
  shading.light = require_vector(known.light, "light");
  const double size = max_magnitude(shading.light);
  if (!(size >= std::numeric_limits<double>::min()))
    fail(Status::argument, "light is (%g, %g, %g); its length must not be 0", known.light[0],
         known.light[1], known.light[2]);
  shading.light = {shading.light.x / size, shading.light.y / size, shading.light.z / size};
  shading.ambient = require_part(known.ambient, "ambient");
  shading.has_shadows = require_range(known.shadows, 0, 1, "shadows") != 0;
  shading.occlusion_rays =
      require_count(known.occlusion_rays, 0, max_occlusion_rays, "occlusion_rays");
  shading.occlusion_distance = known.occlusion_distance;
  if (!(known.occlusion_distance >= 0) || !std::isfinite(known.occlusion_distance))
    fail(Status::argument, "occlusion_distance is %g; it must be finite and not negative",
         known.occlusion_distance);
  return shading;
}

void read_tile_side(const char* axis, uint32_t first, uint32_t size, uint32_t pixels) {
  if (size < 1 || first >= pixels || size > pixels - first)
    fail(Status::argument, "the tile has %u pixels along %s from %u on; the picture has %u", size,
         axis, first, pixels);
}

RenderPlan read_plan(const msq_render_def& known) {
  RenderPlan plan;
  plan.tile_x = known.tile_x;
  plan.tile_y = known.tile_y;
  plan.tile_width = known.tile_width;
  plan.tile_height = known.tile_height;
  if (!(known.tile_x || known.tile_y || known.tile_width || known.tile_height)) {
    plan.tile_width = known.width;
    plan.tile_height = known.height;
  }
  read_tile_side("x", plan.tile_x, plan.tile_width, known.width);
  read_tile_side("y", plan.tile_y, plan.tile_height, known.height);
  plan.samples = require_count(known.samples, 1, max_render_samples, "samples");
  plan.first_step = known.first_step;
  if (plan.first_step < 1 || plan.first_step > max_step ||
      (plan.first_step & (plan.first_step - 1)) != 0)
    fail(Status::argument, "first_step is %u; it must be a power of two from 1 to %u",
         known.first_step, max_step);
  plan.shading = read_shading(known);
  return plan;
}

/// All rays of a picture, and those around what they hit, are in the hull of the picture's corners
/// at both ends of the depth.
void check_view_of_all_space(const Model& model, const Scales& resolved, const View& view,
                             const Shading& shading) {
  if (!std::isfinite(view.camera().clip_far))
    fail(Status::argument, "clip_far is %g; in a model of all space it must be finite",
         view.camera().clip_far);
  if (shading.has_shadows)
    fail(Status::argument, "shadows is 1; in a model of all space it must be 0");
  if (shading.occlusion_rays > 0 && !(shading.occlusion_distance > 0))
    fail(Status::argument, "occlusion_distance is %g; in a model of all space it must be positive",
         shading.occlusion_distance);
  const double around = shading.occlusion_rays > 0 ? shading.occlusion_distance : 0;
  for (const double x : {0.0, static_cast<double>(view.width())})
    for (const double y : {0.0, static_cast<double>(view.height())})
      for (const double depth : {view.camera().clip_near, view.camera().clip_far}) {
        const Vec3 corner = view.origin(x, y) + view.direction(x, y) * depth;
        require_reach(model, resolved, Box3{corner, corner}.grown(around), "the picture");
      }
}

Frame read_frame(const msq_frame* given, const RenderPlan& plan) {
  const msq_frame known = read_def(given, msq_frame{}, "frame");
  Frame frame;
  frame.row_pixels = known.row_pixels ? known.row_pixels : plan.tile_width;
  if (frame.row_pixels < plan.tile_width)
    fail(Status::argument, "row_pixels is %u; the tile has %u", known.row_pixels, plan.tile_width);
  frame.depth = known.depth;
  frame.normal = known.normal;
  frame.scale = known.scale;
  frame.material = known.material;
  frame.rgba = known.rgba;
  if (!frame.has_data() && !frame.rgba) fail(Status::argument, "all arrays of the frame are NULL");
  return frame;
}

}  // namespace

msq_status msq_camera_init(msq_camera* camera, size_t size) {
  return guard([&] { set_defaults(camera, size, camera_defaults(), "msq_camera"); });
}

msq_status msq_camera_fit(const msq_model* model, const double direction[3], const double up[3],
                          uint32_t width, uint32_t height, msq_camera* camera) {
  return guard([&] {
    const Model& known = object(model, "model");
    const Vec3 along = require_vector(direction, "direction");
    require_count(width, 1, max_pixels, "width");
    require_count(height, 1, max_pixels, "height");
    const Camera lens = read_lens(read_def(camera, camera_defaults(), "camera"));
    if (!known.shape().is_bounded())
      fail(Status::argument, "a model of all space has no bounds that a camera could fit");
    const Vec3 upwards = up ? require_vector(up, "up") : default_up(along);
    const Camera camera_that_fits = fitted(lens, known.bounds(), along, upwards, width, height);
    write_vector(camera_that_fits.eye, camera->eye);
    write_vector(camera_that_fits.target, camera->target);
    write_vector(camera_that_fits.up, camera->up);
    camera->height = camera_that_fits.height;
  });
}

msq_status msq_camera_ray(const msq_camera* camera, uint32_t width, uint32_t height,
                          const double position[2], double origin[3], double direction[3]) {
  return guard([&] {
    const View view = read_view(camera, width, height);
    require(position, "position");
    require(origin, "origin");
    require(direction, "direction");
    const double x = require_finite(position[0], "position[0]");
    const double y = require_finite(position[1], "position[1]");
    write_vector(view.origin(x, y), origin);
    write_vector(view.direction(x, y), direction);
  });
}

msq_status msq_render_def_init(msq_render_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, render_defaults(), "msq_render_def"); });
}

msq_status msq_frame_init(msq_frame* frame, size_t size) {
  return guard([&] { set_defaults(frame, size, msq_frame{}, "msq_frame"); });
}

msq_status msq_render(const msq_model* model, const msq_camera* camera, const msq_render_def* def,
                      const msq_query_def* query, const msq_frame* frame, msq_render_fn fn,
                      void* user, msq_job* job) {
  return guard([&] {
    // The callback may release the host's last references.
    const Ref<const Model> known(&object(model, "model"));
    const Ref<Job> work(job ? &object(job, "job") : nullptr);
    const msq_render_def definition = read_def(def, render_defaults(), "def");
    const View view = read_view(camera, definition.width, definition.height);
    const RenderPlan plan = read_plan(definition);
    const Frame pixels = read_frame(frame, plan);
    const Scales resolved = known->resolved(read_query(query).length_scale);
    if (!known->shape().is_bounded()) check_view_of_all_space(*known, resolved, view, plan.shading);
    std::function<void(const RenderPass&)> on_pass;
    if (fn)
      on_pass = [&](const RenderPass& done) {
        msq_render_pass pass{};
        pass.struct_size = sizeof pass;
        pass.step = done.step;
        pass.samples = done.samples;
        pass.is_last = done.is_last;
        const int32_t code = call_host(fn, user, &pass);
        if (code != 0)
          throw Error(Status::host,
                      "the callback of msq_render returned " + std::to_string(code) +
                          " after the pass of step " + std::to_string(done.step),
                      code);
      };
    render(*known, resolved, view, plan, pixels, on_pass, work.get());
    warn_of_cache(known->context());
  });
}
