// SPDX-License-Identifier: Apache-2.0
// Struts as a beam lattice. Source: 3MF Consortium, "Beam Lattice Extension", version 1.2.0.
#include <algorithm>
#include <cmath>
#include <vector>

#include "defs.h"
#include "names.h"
#include "threemf_text.h"

using namespace msq_io;

namespace {

msq_io_beams_def beams_defaults() {
  msq_io_beams_def def{};
  def.clipping = MSQ_CLIPPING_NONE;
  return def;
}

constexpr const char* cap_names[] = {"sphere", "hemisphere", "butt"};

/// Struts of no length are balls; the others are beams.
class Lattice {
 public:
  explicit Lattice(const msq_strut_graph* graph) {
    report_.struct_size = sizeof report_;
    check_msq(msq_strut_graph_info(graph, &report_));
    if (report_.strut_count == 0) fail(MSQ_E_ARGUMENT, "the graph has no struts");
    if (report_.strut_count > INT32_MAX || report_.node_count > INT32_MAX)
      fail(MSQ_E_LIMIT, "the graph has %llu struts and %llu nodes; the limit is %d of each",
           static_cast<unsigned long long>(report_.strut_count),
           static_cast<unsigned long long>(report_.node_count), INT32_MAX);
    double shortest = INFINITY;
    for (uint64_t i = 0; i < report_.strut_count; ++i) {
      const double length = length_of(i);
      if (is_beam(i, length)) {
        shortest = std::min(shortest, length);
        if (first_ == UINT64_MAX) first_ = i;
      } else if (!(length > 0)) {
        for (uint64_t end : {0, 1})
          if (report_.caps[2 * i + end] != MSQ_CAP_BUTT && report_.radii[2 * i + end] > 0)
            balls_.push_back(2 * i + end);
      }
    }
    if (!has_beams() && balls_.empty())
      fail(MSQ_E_ARGUMENT, "the graph has no volume: the radii of all %llu struts are 0",
           static_cast<unsigned long long>(report_.strut_count));
    // A reader drops beams shorter than this; its rounding must drop none.
    min_length_ = std::isfinite(shortest) ? 0.5 * shortest : 1e-6;
  }

  const msq_strut_graph_report& report() const { return report_; }
  bool has_beams() const { return first_ != UINT64_MAX; }
  const std::vector<uint64_t>& balls() const { return balls_; }
  double min_length() const { return min_length_; }
  /// What beams have unless they say otherwise: that of the first one.
  double radius() const {
    const double* radii = report_.radii + 2 * (has_beams() ? first_ : 0);
    return std::max(radii[0], radii[1]);
  }
  uint8_t cap() const { return has_beams() ? report_.caps[2 * first_] : uint8_t{0}; }

  void write_vertices(uint64_t first, uint64_t count, XmlText& text) const {
    for (uint64_t i = first; i < first + count; ++i) {
      const double* p = report_.nodes + 3 * i;
      text << "<vertex x=\"" << p[0] << "\" y=\"" << p[1] << "\" z=\"" << p[2] << "\"/>\n";
    }
  }
  void write_beams(uint64_t first, uint64_t count, uint64_t base, XmlText& text) const {
    for (uint64_t i = first; i < first + count; ++i) {
      if (!is_beam(i, length_of(i))) continue;
      const uint32_t* ends = report_.struts + 2 * i;
      const double* radii = report_.radii + 2 * i;
      const uint8_t* caps = report_.caps + 2 * i;
      text << "<b:beam v1=\"" << base + ends[0] << "\" v2=\"" << base + ends[1] << "\"";
      if (radii[0] != radius() || radii[1] != radii[0]) text << " r1=\"" << radii[0] << "\"";
      if (radii[1] != radii[0]) text << " r2=\"" << radii[1] << "\"";
      if (caps[0] != cap()) text << " cap1=\"" << cap_names[caps[0]] << "\"";
      if (caps[1] != cap()) text << " cap2=\"" << cap_names[caps[1]] << "\"";
      text << "/>\n";
    }
  }
  void write_ball(uint64_t end, uint64_t base, XmlText& text) const {
    text << "<b2:ball vindex=\"" << base + report_.struts[end] << "\" r=\"" << report_.radii[end]
         << "\"/>\n";
  }

 private:
  /// Struts of radius 0 at both ends have no volume, and 3MF has no such beams.
  bool is_beam(uint64_t strut, double length) const {
    const double* radii = report_.radii + 2 * strut;
    return length > 0 && (radii[0] > 0 || radii[1] > 0);
  }
  double length_of(uint64_t strut) const {
    const double* a = report_.nodes + uint64_t{3} * report_.struts[2 * strut];
    const double* b = report_.nodes + uint64_t{3} * report_.struts[2 * strut + 1];
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }

  msq_strut_graph_report report_{};
  uint64_t first_ = UINT64_MAX;  ///< the first strut that is a beam
  std::vector<uint64_t> balls_;  ///< 2 * strut + end
  double min_length_ = 0;
};

/// An entry of the archive, written in pieces of some megabytes.
class Entry {
 public:
  Entry(ZipFile& zip, const char* name, bool is_large) : zip_(zip), text_(buffer_) {
    zip_.begin(name, true, is_large);
  }
  XmlText& text() { return text_; }
  /// Calls part(first, count) until `total` elements are written.
  template <class Part>
  void write_all(uint64_t total, const Part& part) {
    constexpr uint64_t at_once = 1 << 14;
    for (uint64_t first = 0; first < total; first += at_once) {
      part(first, std::min(at_once, total - first));
      flush();
    }
  }
  void flush() {
    if (buffer_.size() < (1 << 20)) return;
    zip_.append(buffer_.data(), buffer_.size());
    buffer_.clear();
  }
  void end() {
    zip_.append(buffer_.data(), buffer_.size());
    zip_.end();
  }

 private:
  ZipFile& zip_;
  std::string buffer_;
  XmlText text_;
};

void write_mesh(const HostMesh& mesh, Entry& entry) {
  entry.text() << "<triangles>\n";
  entry.write_all(mesh.triangle_count(), [&](uint64_t first, uint64_t count) {
    mesh.write_triangles(first, count, entry.text());
  });
  entry.text() << "</triangles>\n";
}

void write_model(const Lattice& lattice, const HostMesh& mesh, int32_t clipping, Entry& entry) {
  XmlText& text = entry.text();
  const bool has_balls = !lattice.balls().empty();
  begin_model(text, has_balls ? "b b2" : "b",
              has_balls ? "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/"
                          "2017/02\" xmlns:b2=\"http://schemas.microsoft.com/3dmanufacturing/"
                          "beamlattice/balls/2020/07\""
                        : "xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/"
                          "2017/02\"");
  const auto write_vertices_of_mesh = [&] {
    entry.write_all(mesh.vertex_count(), [&](uint64_t first, uint64_t count) {
      mesh.write_vertices(first, count, text);
    });
  };
  const bool is_clipped = clipping != MSQ_CLIPPING_NONE;
  if (is_clipped) {
    text << "<object id=\"1\" type=\"model\"><mesh>\n<vertices>\n";
    write_vertices_of_mesh();
    text << "</vertices>\n";
    write_mesh(mesh, entry);
    text << "</mesh></object>\n";
  }
  text << "<object id=\"2\" type=\"model\"><mesh>\n<vertices>\n";
  const uint64_t base = is_clipped ? 0 : mesh.vertex_count();
  if (!is_clipped) write_vertices_of_mesh();
  entry.write_all(lattice.report().node_count, [&](uint64_t first, uint64_t count) {
    lattice.write_vertices(first, count, text);
  });
  text << "</vertices>\n";
  if (is_clipped)
    text << "<triangles/>\n";
  else
    write_mesh(mesh, entry);
  text << "<b:beamlattice minlength=\"" << lattice.min_length() << "\" radius=\""
       << lattice.radius() << "\" cap=\"" << cap_names[lattice.cap()] << "\"";
  if (is_clipped)
    text << " clippingmode=\"" << (clipping == MSQ_CLIPPING_INSIDE ? "inside" : "outside")
         << "\" clippingmesh=\"1\"";
  if (has_balls)
    text << " b2:ballmode=\"mixed\" b2:ballradius=\"" << lattice.report().radii[lattice.balls()[0]]
         << "\"";
  text << ">\n<b:beams>\n";
  entry.write_all(lattice.report().strut_count, [&](uint64_t first, uint64_t count) {
    lattice.write_beams(first, count, base, text);
  });
  text << "</b:beams>\n";
  if (has_balls) {
    text << "<b2:balls>\n";
    entry.write_all(lattice.balls().size(), [&](uint64_t first, uint64_t count) {
      for (uint64_t i = first; i < first + count; ++i)
        lattice.write_ball(lattice.balls()[i], base, text);
    });
    text << "</b2:balls>\n";
  }
  text << "</b:beamlattice></mesh></object>\n";
  end_model(text, 2);
}

}  // namespace

msq_status msq_io_beams_def_init(msq_io_beams_def* def, size_t size) {
  return guard([&] { set_defaults(def, size, beams_defaults(), "msq_io_beams_def"); });
}

msq_status msq_io_beams_save(const msq_strut_graph* graph, const msq_io_beams_def* host_def,
                             const char* path, int32_t replace) {
  return guard([&] {
    require(graph, "graph");
    const std::filesystem::path name = read_path(path);
    const msq_io_beams_def def = read_def(host_def, beams_defaults(), "def");
    require_range<int32_t>(def.clipping, MSQ_CLIPPING_NONE, MSQ_CLIPPING_OUTSIDE, "clipping");
    const bool replaces = require_range(replace, 0, 1, "replace") != 0;
    if (def.clipping != MSQ_CLIPPING_NONE && !def.mesh)
      fail(MSQ_E_ARGUMENT, "clipping is %d and mesh is NULL; only a mesh can clip", def.clipping);
    const HostMesh mesh(def.mesh);
    const Lattice lattice(graph);
    constexpr int64_t year_1980 = 315532800;  // the same bytes at any time
    ZipFile zip(name, replaces, year_1980);
    add_package_parts(zip);
    // No element has more bytes than this.
    constexpr uint64_t element = 250, four_gb = 0xf0000000u;
    const uint64_t elements = mesh.vertex_count() + mesh.triangle_count() +
                              lattice.report().node_count + 2 * lattice.report().strut_count;
    Entry entry(zip, threemf_part, elements > four_gb / element);
    write_model(lattice, mesh, def.clipping, entry);
    entry.end();
    zip.commit();
  });
}
