// SPDX-License-Identifier: Apache-2.0
// AMF files (ISO/ASTM 52915), plain or zipped: objects and constellations. Curved triangles are
// read as flat ones. msq reads them itself because Assimp 5.2.5 ignores the unit and does not check
// indices.
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/status.h"
#include "io/assembly.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/xml_document.h"
#include "io/zip_package.h"

namespace msq {
namespace {

constexpr struct {
  const char* name;
  double millimetres;
} units[] = {{"millimeter", 1}, {"inch", 25.4},    {"feet", 304.8},      {"foot", 304.8},
             {"meter", 1000},   {"micron", 0.001}, {"micrometer", 0.001}};

double unit_of(const pugi::xml_node& amf) {
  const std::string_view name = amf.attribute("unit").as_string("millimeter");
  for (const auto& known : units)
    if (equal_ignoring_case(name, known.name)) return known.millimetres;
  fail(Status::io, "AMF: \"%s\" is not a unit", Quoted(name).text);
}

/// The only word inside an element.
std::string_view word_in(const pugi::xml_node& node) {
  return TextCursor(node.child_value()).word();
}

/// An object or a constellation.
struct Entry {
  Assembly assembly;
  bool is_used = false;  ///< by an instance
};

struct Reference {
  Assembly* owner;  ///< the constellation
  std::string id;
  Transform transform;
};

/// Turned about x, then y, then z, then moved.
Transform parse_transform(const pugi::xml_node& instance) {
  const auto number = [&](const char* name) {
    const pugi::xml_node node = instance.child(name);
    return node ? parse_real(word_in(node), "AMF: instance") : 0;
  };
  const auto turn = [&](const char* name, int axis) {
    const double degrees = number(name);
    // Quarter turns are exact.
    const double quarters = degrees / 90;
    double c = std::cos(degrees * (std::numbers::pi / 180));
    double s = std::sin(degrees * (std::numbers::pi / 180));
    if (quarters == std::floor(quarters)) c = std::round(c), s = std::round(s);
    Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    axes[u][u] = c, axes[u][v] = s;
    axes[v][u] = -s, axes[v][v] = c;
    return Transform{axes[0], axes[1], axes[2], {}};
  };
  Transform transform = turn("rz", 2).after(turn("ry", 1)).after(turn("rx", 0));
  transform.origin = {number("deltax"), number("deltay"), number("deltaz")};
  return transform;
}

class Reader {
 public:
  explicit Reader(SoupBuilder& soup) : soup_(soup) {}

  double read(const pugi::xml_node& amf) {
    const double unit = unit_of(amf);
    for (const pugi::xml_node& node : amf.children()) {
      const std::string_view name = node.name();
      if (name == "object")
        read_mesh(node, add(node).mesh);
      else if (name == "constellation")
        read_constellation(node, add(node));
    }
    for (const Reference& reference : references_) {
      const auto found = entries_.find(reference.id);
      if (found == entries_.end())
        fail(Status::io, "AMF: there is no object of id \"%s\"", Quoted(reference.id).text);
      found->second.is_used = true;
      reference.owner->instances.push_back({&found->second.assembly, reference.transform});
    }
    // All are counted, since constellations that contain one another are all in use.
    for (auto& [id, entry] : entries_) count_parts(entry.assembly);
    // Entries that no instance refers to stand where they are.
    uint64_t total = 0;
    for (const Entry* entry : order_)
      if (!entry->is_used) total = saturating_sum(total, entry->assembly.triangles);
    soup_.expect_triangles(total);
    for (const Entry* entry : order_)
      if (!entry->is_used) place(entry->assembly, {}, soup_);
    return unit;
  }

 private:
  Assembly& add(const pugi::xml_node& node) {
    const std::string id = node.attribute("id").value();
    const auto [found, is_new] = entries_.try_emplace(id);
    if (!is_new) fail(Status::io, "AMF: two objects have the id \"%s\"", Quoted(id).text);
    order_.push_back(&found->second);
    return found->second.assembly;
  }

  void read_constellation(const pugi::xml_node& node, Assembly& owner) {
    for (const pugi::xml_node& child : node.children("instance"))
      references_.push_back({&owner, child.attribute("objectid").value(), parse_transform(child)});
  }

  void read_mesh(const pugi::xml_node& object, TriangleSoup& mesh) const {
    CancelPoll poll(soup_.job());
    const pugi::xml_node node = object.child("mesh");
    for (const pugi::xml_node& vertex : node.child("vertices").children("vertex")) {
      poll();
      const pugi::xml_node coordinates = vertex.child("coordinates");
      const auto coordinate = [&](const char* axis) {
        return parse_real(word_in(coordinates.child(axis)), "AMF: vertex");
      };
      soup_.expect_vertices(mesh.vertices.size() + 1);
      mesh.vertices.push_back({coordinate("x"), coordinate("y"), coordinate("z")});
    }
    for (const pugi::xml_node& volume : node.children("volume"))
      for (const pugi::xml_node& child : volume.children("triangle")) {
        poll();
        Triangle triangle;
        constexpr const char* names[] = {"v1", "v2", "v3"};
        for (size_t k = 0; k < 3; ++k) {
          const int64_t index = parse_integer(word_in(child.child(names[k])), "AMF: vertex index");
          if (index < 0 || static_cast<uint64_t>(index) >= mesh.vertices.size())
            fail(Status::mesh, "AMF: triangle %zu has vertex index %lld; there are %zu vertices",
                 mesh.triangles.size(), static_cast<long long>(index), mesh.vertices.size());
          triangle[k] = static_cast<uint32_t>(index);
        }
        soup_.expect_triangles(mesh.triangles.size() + 1);
        mesh.triangles.push_back(triangle);
      }
    // So that instances cannot multiply vertices out of proportion.
    drop_unused_vertices(mesh);
  }

  SoupBuilder& soup_;
  std::map<std::string, Entry> entries_;
  std::vector<const Entry*> order_;  // as in the file
  std::vector<Reference> references_;
};

}  // namespace

double read_amf(std::string_view file, UnpackLimit limit, SoupBuilder& soup) {
  std::string content;
  if (ZipPackage::is_zip(file)) {
    ZipPackage zip(file, limit, soup.job());
    const std::string name = zip.find_by_ending(".amf");
    std::optional<std::string> entry = zip.read(name);
    if (!entry) fail(Status::io, "AMF: the archive has no file in it");
    content = std::move(*entry);
  } else {
    content = file;
  }
  const XmlDocument document(std::move(content), "AMF");
  if (std::string_view(document.root().name()) != "amf")
    fail(Status::io, "AMF: the file holds <%s>, not <amf>", Quoted(document.root().name()).text);
  return Reader(soup).read(document.root());
}

}  // namespace msq
