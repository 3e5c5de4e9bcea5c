// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <numeric>

#include "defs.h"
#include "names.h"
#include "panel.h"
#include "png_stream.h"
#include "sl1_config.h"
#include "writer.h"
#include "zip_file.h"

using namespace msq_io;

namespace {

msq_io_sl1_def sl1_defaults() {
  msq_io_sl1_def def{};
  def.faded_layers = 10;
  def.exposure_time = 8;
  def.initial_exposure_time = 35;
  def.fast_tilt_time = 5;
  def.slow_tilt_time = 8;
  def.area_fill = 50;
  return def;
}

/// A picture of the model, as a PNG.
std::vector<uint8_t> thumbnail(const msq_model* model, uint32_t width, uint32_t height,
                               msq_job* job) {
  msq_camera camera;
  check_msq(msq_camera_init(&camera, sizeof camera));
  const double direction[3] = {-1, 1.5, -1};
  check_msq(msq_camera_fit(model, direction, nullptr, width, height, &camera));
  msq_render_def def;
  check_msq(msq_render_def_init(&def, sizeof def));
  def.width = width;
  def.height = height;
  std::vector<uint8_t> pixels(size_t{4} * width * height), rows, stream;
  msq_frame frame;
  check_msq(msq_frame_init(&frame, sizeof frame));
  frame.rgba = pixels.data();
  check_msq(msq_render(model, &camera, &def, nullptr, &frame, nullptr, nullptr, job));
  const PngRows image{width, height, 8, 4};
  copy_rows(image, pixels.data(), uint64_t{4} * width, rows);
  encode_by_libpng(image, rows, 6, false, stream);
  return stream;
}

class Sl1Archive : public Format {
 public:
  Sl1Archive(const WriterPlan& plan, const std::filesystem::path& path, Sl1Settings settings,
             int level)
      : settings_(std::move(settings)),
        statistics_(settings_),
        level_(level),
        zip_(path, plan.replace, settings_.created) {}

  void add_thumbnail(const msq_model* model, uint32_t width, uint32_t height, msq_job* job) {
    const std::vector<uint8_t> stream = thumbnail(model, width, height, job);
    add("thumbnail/thumbnail" + std::to_string(width) + "x" + std::to_string(height) + ".png",
        stream.data(), stream.size(), false);
  }

  void take(const msq_layer&, const msq_output& output, Packet& packet) override {
    take_pixels(output, false, packet);
  }
  void encode(Packet& packet) override {
    const PngRows image{packet.width, packet.height, 8, 1};
    // The bytes of filters are 0.
    for (uint32_t y = 0; y < packet.height; ++y) {
      const uint8_t* row = packet.input.data() + y * image.row_bytes();
      packet.sum += std::accumulate(row, row + image.row_bytes(), uint64_t{0});
    }
    encode_png(image, packet.input, level_, packet.output);
  }
  void deliver(Packet& packet) override {
    add(numbered_name(settings_.job, packet.number, 5, ".png"), packet.output.data(),
        packet.output.size(), false);
    statistics_.add_layer(packet.sum);
  }
  void commit() override {
    const std::string config = config_ini(settings_, statistics_);
    const std::string profile = prusaslicer_ini(settings_);
    add("config.ini", config.data(), config.size(), true);
    add("prusaslicer.ini", profile.data(), profile.size(), true);
    zip_.commit();
    bytes_ = zip_.size();
  }
  uint64_t bytes() const override { return bytes_; }

 private:
  void add(const std::string& name, const void* bytes, size_t size, bool is_deflated) {
    zip_.add(name, bytes, size, is_deflated);
    bytes_ = zip_.size();
  }

  const Sl1Settings settings_;
  Sl1Statistics statistics_;
  const int level_;
  ZipFile zip_;
  std::atomic<uint64_t> bytes_{0};
};

/// The distance of the layers that will come. For a part of a stack it is that of the whole stack,
/// whose layers must all be evenly spaced, so that parts fit.
double layer_height(const msq_slicer* slicer, const WriterPlan& plan, double given) {
  const uint64_t count = plan.stack_layers;
  if (count == 1 && given == 0)
    fail(MSQ_E_ARGUMENT, "layer_height is 0; with one layer it must be given");
  if (count == 1) return given;
  double first = 0, last = 0;
  check_msq(msq_slicer_layer_z(slicer, 0, &first));
  check_msq(msq_slicer_layer_z(slicer, count - 1, &last));
  const double height = (last - first) / static_cast<double>(count - 1);
  if (given != 0 && std::fabs(height - given) > 1e-3 * height)
    fail(MSQ_E_ARGUMENT, "layer_height is %s; the layers are %s apart", text_of(given).c_str(),
         text_of(height).c_str());
  for (uint64_t i = 1; i < count; ++i) {
    double z = 0;
    check_msq(msq_slicer_layer_z(slicer, i, &z));
    const double even = first + static_cast<double>(i) * height;
    if (std::fabs(z - even) > 1e-3 * height)
      fail(MSQ_E_ARGUMENT,
           "layer %llu is at z = %s; an SL1 archive needs evenly spaced layers, here %s apart with "
           "this one at %s",
           static_cast<unsigned long long>(i), text_of(z, 9).c_str(), text_of(height).c_str(),
           text_of(even, 9).c_str());
  }
  // Heights are given with few digits: without those that rounding adds.
  return given != 0 ? given : std::round(height * 1e9) / 1e9;
}

}  // namespace

msq_status msq_io_sl1_def_init(msq_io_sl1_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, sl1_defaults(), "msq_io_sl1_def"); });
}

msq_status msq_io_sl1_create(const msq_slicer* slicer, const char* path,
                             const msq_io_writer_def* writer_def, const msq_io_sl1_def* host_def,
                             msq_io_writer** writer, msq_job* job) {
  return guard([&] {
    require(writer, "writer");
    const std::filesystem::path name = read_path(path);
    const WriterPlan plan = read_plan(slicer, writer_def);
    const msq_io_sl1_def def = read_def(host_def, sl1_defaults(), "def");
    const int level = require_range(def.level, 0, 9, "level");
    Sl1Settings settings = read_sl1(def);
    const bool is_portrait = settings.panel.portrait != 0;
    const uint32_t* pixels = settings.panel.pixels;
    if (plan.width != pixels[is_portrait] || plan.height != pixels[!is_portrait])
      fail(MSQ_E_ARGUMENT,
           "layers have %u x %u pixels; images of the panel have %u x %u (msq_io_panel_plan)",
           plan.width, plan.height, pixels[is_portrait], pixels[!is_portrait]);
    settings.layer_height = layer_height(slicer, plan, settings.layer_height);
    auto archive = std::make_unique<Sl1Archive>(plan, name, std::move(settings), level);
    if (def.thumbnail_model) {
      archive->add_thumbnail(def.thumbnail_model, 400, 400, job);
      archive->add_thumbnail(def.thumbnail_model, 800, 480, job);
    }
    *writer = make_writer(plan, std::move(archive)).release();
  });
}
