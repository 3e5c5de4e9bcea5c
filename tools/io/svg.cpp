// SPDX-License-Identifier: Apache-2.0
// Contours as SVG. The stack is as Slic3r writes it: a group per layer with its height, polygons
// painted in the order of the rings, so that what lies within a hole comes after it.
#include <atomic>
#include <charconv>
#include <cstring>

#include "atomic_file.h"
#include "contour_packet.h"
#include "defs.h"
#include "layer_folder.h"
#include "names.h"

using namespace msq_io;

namespace {

msq_io_svg_def svg_defaults() {
  msq_io_svg_def def{};
  def.layout = MSQ_IO_SVG_STACK;
  def.units = 1;
  def.decimals = 4;
  def.digits = 5;
  return def;
}

/// The rectangle of the pixels of a slicer, and how coordinates are written.
struct Sheet {
  double left, top, width, height, units;
  int decimals;
};

Sheet read_sheet(const msq_slicer* slicer, const msq_io_svg_def& def) {
  msq_slicer_report report{};
  report.struct_size = sizeof report;
  check_msq(msq_slicer_info(slicer, &report));
  Sheet sheet{};
  const double* pitch = report.pitch;
  const auto corner = [&](int axis, uint64_t pixel) {
    return report.origin[axis] + (static_cast<double>(pixel) - 0.5) * pitch[axis];
  };
  const msq_window& window = report.window;
  sheet.left = corner(0, window.first[0]);
  sheet.top = corner(1, window.first[1] + window.count[1]);
  sheet.width = static_cast<double>(window.count[0]) * pitch[0];
  sheet.height = static_cast<double>(window.count[1]) * pitch[1];
  sheet.units = def.units;
  sheet.decimals = static_cast<int>(def.decimals);
  return sheet;
}

class Text {
 public:
  Text(std::vector<uint8_t>& to, int decimals) : to_(to), decimals_(decimals) {}
  Text& operator<<(const char* text) {
    to_.insert(to_.end(), text, text + std::strlen(text));
    return *this;
  }
  /// Without trailing zeros, and without a sign of 0.
  Text& operator<<(double value) {
    char digits[400];
    char* end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals_)
            .ptr;
    if (decimals_ > 0) {
      while (end[-1] == '0') --end;
      if (end[-1] == '.') --end;
    }
    char* begin = digits;
    if (end == digits + 2 && digits[0] == '-' && digits[1] == '0') ++begin;
    to_.insert(to_.end(), begin, end);
    return *this;
  }
  Text& operator<<(uint64_t value) {
    char digits[24];
    to_.insert(to_.end(), digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    return *this;
  }

 private:
  std::vector<uint8_t>& to_;
  int decimals_;
};

void begin_svg(Text& text, const Sheet& sheet) {
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
       << "<svg width=\"" << sheet.width << "mm\" height=\"" << sheet.height
       << "mm\" viewBox=\"0 0 " << sheet.width << " " << sheet.height
       << "\" xmlns=\"http://www.w3.org/2000/svg\" "
          "xmlns:slic3r=\"http://slic3r.org/namespaces/slic3r\"";
}

/// Writes the points of a ring, with signs between coordinates and between points.
void write_ring(const Rings& rings, uint64_t ring, const Sheet& sheet, const char* between,
                const char* next, Text& text) {
  for (uint64_t i = rings.begin(ring); i < rings.begin(ring + 1); ++i) {
    if (i > rings.begin(ring)) text << next;
    text << rings.at(i, 0) - sheet.left << between << sheet.top - rings.at(i, 1);
  }
}

class SvgStack : public Format {
 public:
  SvgStack(const WriterPlan& plan, const std::filesystem::path& path, const Sheet& sheet)
      : first_(plan.first_layer), sheet_(sheet), file_(path, plan.replace) {
    std::vector<uint8_t> head;
    Text text(head, sheet.decimals);
    begin_svg(text, sheet);
    text << " viewport-fill=\"black\">\n";
    append(head);
  }
  void take(const msq_layer&, const msq_output& output, Packet& packet) override {
    take_contours(output, packet);
  }
  void encode(Packet& packet) override {
    const Rings rings(packet.contours.get(), sheet_.units);
    Text text(packet.output, sheet_.decimals);
    text << "<g id=\"layer" << first_ + packet.number << "\" slic3r:z=\"" << packet.z << "\">\n";
    for (uint64_t i = 0; i < rings.count(); ++i) {
      const bool is_hole = rings.is_hole(i);
      text << "<polygon slic3r:type=\"" << (is_hole ? "hole" : "contour") << "\" points=\"";
      write_ring(rings, i, sheet_, ",", " ", text);
      text << "\" style=\"fill: " << (is_hole ? "black" : "white") << "\"/>\n";
    }
    text << "</g>\n";
  }
  void deliver(Packet& packet) override { append(packet.output); }
  void commit() override {
    static constexpr char end[] = "</svg>\n";
    append({end, end + sizeof end - 1});
    file_.commit();
  }
  uint64_t bytes() const override { return bytes_; }

 private:
  void append(const std::vector<uint8_t>& text) {
    file_.write(text.data(), text.size());
    bytes_ = file_.size();
  }

  const uint64_t first_;
  const Sheet sheet_;
  AtomicFile file_;
  std::atomic<uint64_t> bytes_{0};
};

class SvgFolder : public LayerFolder {
 public:
  SvgFolder(const WriterPlan& plan, const std::filesystem::path& path, std::string prefix,
            uint32_t digits, const Sheet& sheet)
      : LayerFolder(plan, path, std::move(prefix), digits, ".svg"), sheet_(sheet) {}
  void take(const msq_layer&, const msq_output& output, Packet& packet) override {
    take_contours(output, packet);
  }
  void encode(Packet& packet) override {
    const Rings rings(packet.contours.get(), sheet_.units);
    std::vector<uint8_t> file;
    Text text(file, sheet_.decimals);
    begin_svg(text, sheet_);
    text << " slic3r:z=\"" << packet.z << "\">\n<path fill-rule=\"evenodd\" d=\"";
    for (uint64_t i = 0; i < rings.count(); ++i) {
      text << "M";
      write_ring(rings, i, sheet_, " ", "L", text);
      text << "Z\n";
    }
    text << "\"/>\n</svg>\n";
    write(packet.number, file.data(), file.size());
  }

 private:
  const Sheet sheet_;
};

}  // namespace

msq_status msq_io_svg_def_init(msq_io_svg_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, svg_defaults(), "msq_io_svg_def"); });
}

msq_status msq_io_svg_create(const msq_slicer* slicer, const char* path,
                             const msq_io_writer_def* writer_def, const msq_io_svg_def* host_def,
                             msq_io_writer** writer) {
  return guard([&] {
    require(writer, "writer");
    const std::filesystem::path name = read_path(path);
    const WriterPlan plan = read_plan(slicer, writer_def);
    const msq_io_svg_def def = read_def(host_def, svg_defaults(), "def");
    require_range<int32_t>(def.layout, MSQ_IO_SVG_STACK, MSQ_IO_SVG_FILES, "layout");
    require_positive(def.units, "units");
    require_range<uint32_t>(def.decimals, 0, 12, "decimals");
    const uint32_t digits = require_range<uint32_t>(def.digits, 1, 20, "digits");
    std::string prefix = read_prefix(def.prefix, "layer", "prefix");
    const Sheet sheet = read_sheet(slicer, def);
    std::unique_ptr<Format> format;
    if (def.layout == MSQ_IO_SVG_STACK)
      format = std::make_unique<SvgStack>(plan, name, sheet);
    else
      format = std::make_unique<SvgFolder>(plan, name, std::move(prefix), digits, sheet);
    *writer = make_writer(plan, std::move(format)).release();
  });
}
