// SPDX-License-Identifier: Apache-2.0
#include "atomic_file.h"
#include "defs.h"
#include "layer_folder.h"
#include "names.h"
#include "png_stream.h"

using namespace msq_io;

namespace {

msq_io_png_def png_defaults() {
  msq_io_png_def def{};
  def.digits = 5;
  return def;
}

class PngStack : public LayerFolder {
 public:
  PngStack(const WriterPlan& plan, const std::filesystem::path& path, std::string prefix,
           uint32_t digits, int level)
      : LayerFolder(plan, path, std::move(prefix), digits, ".png"), level_(level) {}

  void take(const msq_layer&, const msq_output& output, Packet& packet) override {
    packet.depth = take_pixels(output, true, packet).depth;
  }
  void encode(Packet& packet) override {
    std::vector<uint8_t> stream;
    encode_png({packet.width, packet.height, packet.depth, 1}, packet.input, level_, stream);
    write(packet.number, stream.data(), stream.size());
  }

 private:
  const int level_;
};

}  // namespace

msq_status msq_io_png_def_init(msq_io_png_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, png_defaults(), "msq_io_png_def"); });
}

msq_status msq_io_png_create(const msq_slicer* slicer, const char* path,
                             const msq_io_writer_def* writer_def, const msq_io_png_def* host_def,
                             msq_io_writer** writer) {
  return guard([&] {
    require(writer, "writer");
    const std::filesystem::path folder = read_path(path);
    const WriterPlan plan = read_plan(slicer, writer_def);
    const msq_io_png_def def = read_def(host_def, png_defaults(), "def");
    const int level = require_range(def.level, 0, 9, "level");
    const uint32_t digits = require_range<uint32_t>(def.digits, 1, 20, "digits");
    std::string prefix = read_prefix(def.prefix, "layer", "prefix");
    *writer = make_writer(
                  plan, std::make_unique<PngStack>(plan, folder, std::move(prefix), digits, level))
                  .release();
  });
}

msq_status msq_io_picture_save(const char* path, uint32_t width, uint32_t height, uint32_t channels,
                               const uint8_t* pixels, uint64_t stride, int32_t replace) {
  return guard([&] {
    const std::filesystem::path name = read_path(path);
    if (width == 0 || height == 0)
      fail(MSQ_E_ARGUMENT, "a picture of %u x %u pixels is empty", width, height);
    if (channels != 1 && channels != 3 && channels != 4)
      fail(MSQ_E_ARGUMENT, "channels is %u; it must be 1, 3 or 4", channels);
    const uint64_t row = uint64_t{width} * channels;
    if (stride != 0 && stride < row)
      fail(MSQ_E_ARGUMENT, "stride is %llu bytes; a row has %llu",
           static_cast<unsigned long long>(stride), static_cast<unsigned long long>(row));
    require(pixels, "pixels");
    const bool replaces = require_range(replace, 0, 1, "replace") != 0;
    const PngRows image{width, height, 8, channels};
    std::vector<uint8_t> rows, stream;
    copy_rows(image, pixels, stride ? stride : row, rows);
    encode_by_libpng(image, rows, 6, false, stream);
    AtomicFile file(name, replaces);
    file.write(stream.data(), stream.size());
    file.commit();
  });
}
