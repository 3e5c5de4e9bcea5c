// SPDX-License-Identifier: Apache-2.0
// The error and the processor time of pictures by the number of samples and occlusion rays: a
// window of the picture of README, against 144 samples of 16 rays. usage: pictures [results.json]
// [model]
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "setup.h"

namespace {

constexpr uint32_t width = 200, height = 144;
constexpr double windows = 5;  // as many beside each other make the whole picture

using Picture = std::vector<uint8_t>;

class Scene {
 public:
  Scene(msq_context* context, const char* path) {
    msq_document* document;
    bench::check(msq_document_from_file(context, path, nullptr, &document, nullptr));
    bench::check(msq_document_model(document, &model_));
    bench::check(msq_camera_init(&camera_, sizeof camera_));
    bench::check(msq_render_def_init(&def_, sizeof def_));
    bench::check(msq_document_view(document, &camera_, &def_));
    def_.width = width;
    def_.height = height;
    def_.background[0] = def_.background[1] = def_.background[2] = 0.95;
    def_.background[3] = 1;
    camera_.height /= windows;
    colours_.assign(def_.colours, def_.colours + 3 * def_.colour_count);
    def_.colours = colours_.data();
    msq_document_release(document);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() { msq_model_release(model_); }

  Picture render(uint32_t samples, uint32_t occlusion_rays) const {
    Picture rgba(4 * width * height);
    msq_frame frame;
    bench::check(msq_frame_init(&frame, sizeof frame));
    frame.rgba = rgba.data();
    msq_render_def def = def_;
    def.samples = samples;
    def.occlusion_rays = occlusion_rays;
    bench::check(msq_render(model_, &camera_, &def, nullptr, &frame, nullptr, nullptr, nullptr));
    return rgba;
  }

 private:
  msq_model* model_;
  msq_camera camera_;
  msq_render_def def_;
  std::vector<double> colours_;
};

/// Root of the mean square of the differences of red, green and blue, which are from 0 to 255.
double error_of(const Picture& picture, const Picture& reference) {
  double sum = 0;
  for (size_t i = 0; i < picture.size(); ++i)
    if (i % 4 != 3) sum += std::pow(picture[i] - reference[i], 2);
  return std::sqrt(sum / (3.0 * width * height));
}

}  // namespace

int main(int count, char** arguments) try {
  bench::Report report("a window of 200 x 144 pixels, processor time");
  msq_context* context = bench::make_context(1);
  {
    const Scene scene(context, count > 2 ? arguments[2] : "examples/models/bracket.json");
    scene.render(1, 1);  // builds what all pictures share
    const Picture reference = scene.render(12, 16);
    struct Setting {
      uint32_t samples, occlusion_rays;
    };
    for (const Setting& setting : std::vector<Setting>{{2, 8}, {3, 8}, {3, 12}, {4, 8}, {5, 4}}) {
      Picture picture;
      const double seconds = bench::min_processor_seconds(
          [&] { picture = scene.render(setting.samples, setting.occlusion_rays); });
      const std::string side = std::to_string(setting.samples);
      const std::string name = side + " x " + side + " samples of " +
                               std::to_string(setting.occlusion_rays) + " occlusion rays";
      report.add(name, seconds, width * height, "pixel");
      report.note(name + ": RMS error", error_of(picture, reference), "of 255");
    }
  }
  msq_context_release(context);
  report.write(count, arguments);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
