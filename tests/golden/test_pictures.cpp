// SPDX-License-Identifier: Apache-2.0
// Pictures against make_pictures.py, which casts each ray by itself: see there for the scenes.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "msq_test.h"

namespace {

constexpr uint32_t width = 22, height = 14;
constexpr size_t pixel_count = size_t{width} * height;

struct Golden {
  std::string camera, solid;
  std::vector<double> depths;
  std::vector<int> bytes;
};

double number_of(const std::string& text) {
  return text == "inf" ? std::numeric_limits<double>::infinity() : std::stod(text);
}

std::vector<Golden> read_golden() {
  std::ifstream file(MSQ_SOURCE_DIR "/tests/golden/pictures.txt");
  std::vector<Golden> all;
  for (std::string line; file.peek() == '#';) std::getline(file, line);
  for (Golden g; file >> g.camera >> g.solid; all.push_back(g)) {
    g.depths.clear();
    g.bytes.clear();
    for (size_t i = 0; i < pixel_count; ++i) {
      std::string depth;
      int rgba[4];
      file >> depth >> rgba[0] >> rgba[1] >> rgba[2] >> rgba[3];
      g.depths.push_back(number_of(depth));
      g.bytes.insert(g.bytes.end(), rgba, rgba + 4);
    }
    assert_false(file.fail());
  }
  return all;
}

msq_model* make_solid(msq_context* context, const std::string& name) {
  const double centre[3] = {1, 2, 3}, low[3] = {-1, 0.5, 1}, high[3] = {2.5, 4, 4.25};
  msq_shape* shape;
  assert_ok(name == "ball" ? msq_shape_from_sphere(context, centre, 2.25, &shape)
                           : msq_shape_from_box(context, low, high, &shape));
  msq_scale_def scale = {};
  scale.shape = shape;
  msq_model_def def;
  msq_model* model;
  assert_ok(msq_model_def_init(&def, sizeof def));
  def.scales = &scale;
  def.scale_count = 1;
  assert_ok(msq_model_create(context, &def, &model));
  msq_shape_release(shape);
  return model;
}

void set(double* vector, double x, double y, double z) {
  vector[0] = x;
  vector[1] = y;
  vector[2] = z;
}

msq_camera make_camera(const std::string& name) {
  msq_camera camera;
  assert_ok(msq_camera_init(&camera, sizeof camera));
  set(camera.eye, 7, -4, 6);
  set(camera.target, 0.5, 2.5, 3);
  camera.field_of_view = 44;
  camera.projection = MSQ_CAMERA_PERSPECTIVE;
  if (name == "orthographic") {
    camera.projection = MSQ_CAMERA_ORTHOGRAPHIC;
    set(camera.target, 1, 2, 2.5);
    camera.height = 6.5;
  } else if (name == "perspective") {
    set(camera.up, 0.3, -0.1, 1);
  } else {
    set(camera.up, 0, 0, 2);
    camera.clip_near = 7.75;
    camera.clip_far = 9.5;
  }
  return camera;
}

msq_render_def make_def() {
  static const double colour[3] = {0.75, 0.5, 0.25};
  const double background[4] = {0.125, 0.25, 0.5, 0.8};
  msq_render_def def;
  assert_ok(msq_render_def_init(&def, sizeof def));
  def.width = width;
  def.height = height;
  def.samples = 3;
  def.colours = colour;
  def.colour_count = 1;
  std::copy_n(background, 4, def.background);
  set(def.light, -0.5, 1, 0.75);
  def.ambient = 0.2;
  return def;
}

void test_pictures(void**) {
  msq_context* context;
  assert_ok(msq_context_create(nullptr, &context));
  const std::vector<Golden> all = read_golden();
  assert_int_equal(all.size(), 6);
  for (const Golden& g : all) {
    msq_model* model = make_solid(context, g.solid);
    const msq_camera camera = make_camera(g.camera);
    const msq_render_def def = make_def();
    std::vector<float> depths(pixel_count);
    std::vector<uint8_t> bytes(4 * pixel_count);
    msq_frame frame;
    assert_ok(msq_frame_init(&frame, sizeof frame));
    frame.depth = depths.data();
    frame.rgba = bytes.data();
    assert_ok(msq_render(model, &camera, &def, nullptr, &frame, nullptr, nullptr, nullptr));
    size_t hits = 0, rounded_otherwise = 0;
    for (size_t i = 0; i < pixel_count; ++i) {
      const double depth = depths[i];
      if (!(depth == g.depths[i] || std::abs(depth - g.depths[i]) < 2e-6))
        fail_msg("%s %s: depth %zu is %.9g, not %.9g", g.camera.c_str(), g.solid.c_str(), i, depth,
                 g.depths[i]);
      hits += std::isfinite(depth);
      for (size_t b = 4 * i; b < 4 * i + 4; ++b) {
        rounded_otherwise += bytes[b] != g.bytes[b];
        if (std::abs(bytes[b] - g.bytes[b]) > 1)
          fail_msg("%s %s: byte %zu is %d, not %d", g.camera.c_str(), g.solid.c_str(), b, bytes[b],
                   g.bytes[b]);
      }
    }
    assert_true(hits > 50 && hits < pixel_count - 50);
    assert_true(rounded_otherwise < 10);
    msq_model_release(model);
  }
  msq_context_release(context);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(test_pictures)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
