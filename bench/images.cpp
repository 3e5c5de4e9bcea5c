// SPDX-License-Identifier: Apache-2.0
// Layers per second of a foam of 32^3 cells: from the engine alone, and into PNG files and SL1
// archives of msq_io, with two threads each.
//
// usage: images [results.json] [pixels along a side, default 2048] [layers, default 2048] [folder]
#include <cstdlib>
#include <filesystem>

#include "msq_io.h"
#include "setup.h"

namespace {

void check_io(msq_status status) {
  if (status != MSQ_OK) throw std::runtime_error(msq_io_error_message());
}

enum class Way { engine, png_fast, png_libpng, sl1_fast, sl1_libpng };

struct Work {
  const char* name;
  Way way;
  int32_t output;
};
constexpr Work works[] = {
    {"engine alone, bits", Way::engine, MSQ_LAYER_BITS},
    {"PNG stack, bits, level 0 (ISA-L)", Way::png_fast, MSQ_LAYER_BITS},
    {"PNG stack, bits, level 1 (libpng)", Way::png_libpng, MSQ_LAYER_BITS},
    {"engine alone, grey 4 x 4", Way::engine, MSQ_LAYER_GREY},
    {"SL1, grey 4 x 4, level 0 (ISA-L)", Way::sl1_fast, MSQ_LAYER_GREY},
    {"SL1, grey 4 x 4, level 1 (libpng)", Way::sl1_libpng, MSQ_LAYER_GREY},
};

class Images {
 public:
  Images(uint32_t resolution, std::string folder)
      : resolution_(resolution), folder_(std::move(folder)) {
    msq_context* context = bench::make_context(2);
    msq_foam_def foam;
    bench::check(msq_foam_def_init(&foam, sizeof foam));
    for (double& side : foam.grid.cell_size) side = 1.0 / 32;
    foam.radius.value = 0.1 / 32;
    msq_structure* structure;
    bench::check(msq_structure_foam(context, &foam, &structure));
    model_ = bench::make_model(context, bench::make_cube(context), structure);
    msq_context_release(context);
    check_io(msq_io_panel_def_init(&panel_, sizeof panel_));
    panel_.portrait = 0;
    panel_.mirror[0] = 0;
    panel_.mirror[1] = 1;  // images as the layers are
    for (int axis = 0; axis < 2; ++axis) {
      panel_.pixels[axis] = resolution;
      panel_.size[axis] = 1;
    }
  }
  ~Images() { msq_model_release(model_); }
  Images(const Images&) = delete;

  /// Bytes of the file or files per layer.
  double run(const Work& work, uint64_t count) const {
    msq_slicer_def def;
    bench::check(msq_slicer_def_init(&def, sizeof def));
    def.layer_height = 1.0 / resolution_;
    check_io(msq_io_panel_plan(model_, &panel_, &def));
    def.output = work.output;
    msq_slicer* slicer;
    bench::check(msq_slicer_create(model_, &def, &slicer));
    const double bytes = write(work, slicer, count);
    msq_slicer_release(slicer);
    std::filesystem::remove_all(path());
    return bytes / static_cast<double>(count);
  }

 private:
  std::string path() const { return folder_ + "/bench_images"; }
  double write(const Work& work, const msq_slicer* slicer, uint64_t count) const {
    if (work.way == Way::engine) {
      bench::Reader reader;
      bench::check(msq_slicer_run(slicer, 0, count, bench::Reader::take, &reader, nullptr));
      return 0;
    }
    msq_io_writer_def common;
    check_io(msq_io_writer_def_init(&common, sizeof common));
    common.threads = 2;
    common.layer_count = count;
    msq_io_writer* writer;
    if (work.way == Way::png_fast || work.way == Way::png_libpng) {
      msq_io_png_def png;
      check_io(msq_io_png_def_init(&png, sizeof png));
      png.level = work.way == Way::png_libpng;
      check_io(msq_io_png_create(slicer, path().c_str(), &common, &png, &writer));
    } else {
      msq_io_sl1_def sl1;
      check_io(msq_io_sl1_def_init(&sl1, sizeof sl1));
      sl1.panel = &panel_;
      sl1.level = work.way == Way::sl1_libpng;
      check_io(msq_io_sl1_create(slicer, path().c_str(), &common, &sl1, &writer, nullptr));
    }
    bench::check(msq_slicer_run(slicer, 0, count, msq_io_writer_layer, writer, nullptr));
    check_io(msq_io_writer_finish(writer));
    msq_io_writer_report report{};
    report.struct_size = sizeof report;
    check_io(msq_io_writer_info(writer, &report));
    msq_io_writer_release(writer);
    return static_cast<double>(report.bytes);
  }

  uint32_t resolution_;
  std::string folder_;
  msq_model* model_;
  msq_io_panel_def panel_;
};

}  // namespace

int main(int count, char** arguments) {
  const uint32_t resolution = count > 2 ? static_cast<uint32_t>(std::atoi(arguments[2])) : 2048;
  const uint64_t layers = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 2048;
  const Images images(resolution, count > 4 ? arguments[4] : ".");
  bench::Report report("images: " + std::to_string(resolution) + "^2 pixels, " +
                       std::to_string(layers) + " layers, two threads");
  for (const Work& work : works) {
    // Grey costs 16 times the samples, and rates settle soon.
    const uint64_t taken =
        work.output == MSQ_LAYER_GREY ? std::max<uint64_t>(layers / 8, 2) : layers;
    const double start = bench::processor_seconds();
    double bytes = 0;
    const double seconds = bench::seconds_of([&] { bytes = images.run(work, taken); });
    const double processor = bench::processor_seconds() - start;
    report.add(work.name, seconds, static_cast<double>(taken), "layer");
    const std::string name = work.name;
    report.note(name + ": processor time", processor / static_cast<double>(taken) * 1e3,
                "ms per layer");
    if (bytes > 0) report.note(name + ": size", bytes / 1e3, "kB per layer");
    if (work.way == Way::png_fast)
      report.mark("PNG stack of bits", static_cast<double>(taken) / seconds, "layers per second",
                  1200, true);
  }
  report.write(count, arguments);
}
