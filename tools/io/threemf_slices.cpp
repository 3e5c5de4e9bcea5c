// SPDX-License-Identifier: Apache-2.0
// Contours as a stack of slices. Source: 3MF Consortium, "Slice Extension", version 1.0.2.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <vector>

#include "contour_packet.h"
#include "defs.h"
#include "names.h"
#include "threemf_text.h"
#include "writer.h"

using namespace msq_io;

namespace {

msq_io_slices_def slices_defaults() {
  msq_io_slices_def def{};
  def.units = 1;
  return def;
}

/// Rectangle of the points so far.
struct Extent {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};

  void add(const double (&p)[2]) {
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  void add(const Extent& other) {
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
};

/// The heights at which slices end: halfway between layers. The first is the bottom of the stack.
/// Those of a part of a stack are those of the whole: layers below and above the part count, too.
std::vector<double> read_heights(const msq_slicer* slicer, const WriterPlan& plan, double height) {
  std::vector<double> ends;
  const auto z_of = [&](uint64_t layer) {
    double z = 0;
    check_msq(msq_slicer_layer_z(slicer, layer, &z));
    return z;
  };
  const uint64_t first = plan.first_layer, end = first + plan.layer_count;
  if (plan.stack_layers == 1) {
    if (!(height > 0))
      fail(MSQ_E_ARGUMENT, "layer_height is %s; with one layer it must be positive",
           text_of(height).c_str());
    ends = {z_of(0) - 0.5 * height, z_of(0) + 0.5 * height};
  } else {
    const auto middle = [&](uint64_t layer) { return 0.5 * (z_of(layer - 1) + z_of(layer)); };
    // The outermost layers reach as far outwards as inwards.
    ends.push_back(first > 0 ? middle(first) : z_of(0) - (middle(1) - z_of(0)));
    for (uint64_t i = first + 1; i < end; ++i) ends.push_back(middle(i));
    ends.push_back(end < plan.stack_layers ? middle(end)
                                           : z_of(end - 1) + (z_of(end - 1) - middle(end - 1)));
  }
  for (uint64_t i = 1; i < ends.size(); ++i)
    if (!(ends[i] > ends[i - 1]))
      fail(MSQ_E_ARGUMENT,
           "layer %llu at z = %s would be a slice from %s to %s; it must have a height",
           static_cast<unsigned long long>(first + i - 1), text_of(z_of(first + i - 1), 9).c_str(),
           text_of(ends[i - 1], 9).c_str(), text_of(ends[i], 9).c_str());
  return ends;
}

class ThreemfSlices : public Format {
 public:
  ThreemfSlices(const WriterPlan& plan, const std::filesystem::path& path,
                std::vector<double> heights, double units)
      : heights_(std::move(heights)), units_(units), zip_(path, plan.replace, year_1980) {
    add_package_parts(zip_);
    zip_.begin(threemf_part, true, false);
    std::string head;
    XmlText text(head);
    begin_model(text, "s",
                "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\"");
    text << "<s:slicestack id=\"1\" zbottom=\"" << heights_[0] << "\">\n";
    append(head);
  }

  void take(const msq_layer&, const msq_output& output, Packet& packet) override {
    take_contours(output, packet);
  }

  void encode(Packet& packet) override {
    std::string made;
    XmlText text(made);
    Extent extent;
    write_slice(packet, text, extent);
    packet.output.resize(sizeof extent + made.size());
    std::memcpy(packet.output.data(), &extent, sizeof extent);
    std::memcpy(packet.output.data() + sizeof extent, made.data(), made.size());
  }

  void deliver(Packet& packet) override {
    Extent extent;
    std::memcpy(&extent, packet.output.data(), sizeof extent);
    extent_.add(extent);
    append(packet.output.data() + sizeof extent, packet.output.size() - sizeof extent);
  }

  void commit() override {
    if (!(extent_.low[0] <= extent_.high[0]))
      fail(MSQ_E_ARGUMENT, "all layers are empty; an object of 3MF needs a solid");
    std::string end;
    XmlText text(end);
    text << "</s:slicestack>\n";
    write_box(text);
    end_model(text, 2);
    append(end);
    zip_.end();
    zip_.commit();
    bytes_ = zip_.size();
  }
  uint64_t bytes() const override { return bytes_; }

 private:
  static constexpr int64_t year_1980 = 315532800;

  void append(const std::string& text) { append(text.data(), text.size()); }
  void append(const void* bytes, uint64_t size) {
    constexpr uint64_t four_gb = 0xf0000000u;
    if (size > four_gb - text_bytes_)
      fail(MSQ_E_LIMIT, "the slices have more than %llu bytes of text before compression",
           static_cast<unsigned long long>(four_gb));
    text_bytes_ += size;
    zip_.append(bytes, size);
    bytes_ = zip_.size();
  }

  void write_slice(const Packet& packet, XmlText& text, Extent& extent) const {
    const Rings rings(packet.contours.get(), units_);
    text << "<s:slice ztop=\"" << heights_[packet.number + 1] << "\">\n";
    if (rings.point_count() > 0) {
      text << "<s:vertices>\n";
      for (uint64_t i = 0; i < rings.point_count(); ++i) {
        const double p[2] = {rings.at(i, 0), rings.at(i, 1)};
        extent.add(p);
        text << "<s:vertex x=\"" << p[0] << "\" y=\"" << p[1] << "\"/>\n";
      }
      text << "</s:vertices>\n";
    }
    for (uint64_t ring = 0; ring < rings.count(); ++ring) {
      const uint64_t first = rings.begin(ring), end = rings.begin(ring + 1);
      text << "<s:polygon startv=\"" << first << "\">";
      for (uint64_t i = first + 1; i < end; ++i) text << "<s:segment v2=\"" << i << "\"/>";
      text << "<s:segment v2=\"" << first << "\"/></s:polygon>\n";
    }
    text << "</s:slice>\n";
  }

  /// The object: a box about all slices, of lower resolution than they are.
  void write_box(XmlText& text) const {
    static constexpr int triangles[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                             {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                             {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    text << "<object id=\"2\" type=\"model\" s:slicestackid=\"1\" s:meshresolution=\"lowres\">"
            "<mesh>\n<vertices>\n";
    for (int i = 0; i < 8; ++i)
      text << "<vertex x=\"" << (i & 1 ? extent_.high[0] : extent_.low[0]) << "\" y=\""
           << (i & 2 ? extent_.high[1] : extent_.low[1]) << "\" z=\""
           << (i & 4 ? heights_.back() : heights_.front()) << "\"/>\n";
    text << "</vertices>\n<triangles>\n";
    for (const auto& t : triangles)
      text << "<triangle v1=\"" << static_cast<uint64_t>(t[0]) << "\" v2=\""
           << static_cast<uint64_t>(t[1]) << "\" v3=\"" << static_cast<uint64_t>(t[2]) << "\"/>\n";
    text << "</triangles>\n</mesh></object>\n";
  }

  const std::vector<double> heights_;
  const double units_;
  ZipFile zip_;
  Extent extent_;
  uint64_t text_bytes_ = 0;
  std::atomic<uint64_t> bytes_{0};
};

}  // namespace

msq_status msq_io_slices_def_init(msq_io_slices_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, slices_defaults(), "msq_io_slices_def"); });
}

msq_status msq_io_slices_create(const msq_slicer* slicer, const char* path,
                                const msq_io_writer_def* writer_def,
                                const msq_io_slices_def* host_def, msq_io_writer** writer) {
  return guard([&] {
    require(writer, "writer");
    const std::filesystem::path name = read_path(path);
    const WriterPlan plan = read_plan(slicer, writer_def);
    const msq_io_slices_def def = read_def(host_def, slices_defaults(), "def");
    require_range<uint32_t>(def.reserved, 0, 0, "reserved");
    require_positive(def.units, "units");
    require_not_negative(def.layer_height, "layer_height");
    std::vector<double> heights = read_heights(slicer, plan, def.layer_height);
    *writer = make_writer(
                  plan, std::make_unique<ThreemfSlices>(plan, name, std::move(heights), def.units))
                  .release();
  });
}
