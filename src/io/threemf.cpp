// SPDX-License-Identifier: Apache-2.0
// 3MF packages: the core specification, version 1.3, objects in other parts of the package
// (production extension), and, where beams are wanted, beam lattices (threemf_lattice.h). msq reads
// them itself because Assimp 5.2.5 ignores the unit, the parts of the production extension and
// required extensions, does not check indices, follows components that contain themselves without
// end, and reads past the end of short transforms.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/status.h"
#include "io/assembly.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/threemf_lattice.h"
#include "io/xml_document.h"
#include "io/zip_package.h"

namespace msq {
namespace {

using Count = unsigned long long;

constexpr struct {
  const char* name;
  double millimetres;
} units[] = {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10},
             {"inch", 25.4},    {"foot", 304.8},   {"meter", 1000}};

double unit_of(const pugi::xml_node& model) {
  const std::string_view name = model.attribute("unit").as_string("millimeter");
  for (const auto& known : units)
    if (name == known.name) return known.millimetres;
  fail(Status::io, "3MF: \"%s\" is not a unit", Quoted(name).text);
}

/// Extensions that do not change the triangles, or are read here.
constexpr const char* known_extensions[] = {
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
};

[[noreturn]] void refuse_beams() {
  fail(Status::unsupported,
       "3MF: the file has beam lattices, which are not triangles; msq_beam_file_open reads both");
}

void check_extensions(const pugi::xml_node& model, bool with_beams) {
  TextCursor prefixes(model.attribute("requiredextensions").value());
  for (std::string_view prefix = prefixes.word(); !prefix.empty(); prefix = prefixes.word()) {
    const std::string_view name =
        model.attribute(("xmlns:" + std::string(prefix)).c_str()).as_string("");
    bool known = false;
    for (const char* extension : known_extensions) known |= name == extension;
    const bool is_of_beams = name == beam_extension || name == ball_extension;
    if (is_of_beams && !with_beams) refuse_beams();
    if (!known && !is_of_beams)
      fail(Status::unsupported, "3MF: the file requires the extension \"%s\" (%s)",
           Quoted(prefix).text, Quoted(name).text);
  }
}

Transform parse_transform(const char* text) {
  TextCursor words(text);
  double m[12];
  for (double& number : m) {
    const std::string_view word = words.word();
    if (word.empty())
      fail(Status::io, "3MF: the transform \"%s\" lacks numbers", Quoted(text).text);
    number = parse_real(word, "3MF: transform");
  }
  if (!words.word().empty())
    fail(Status::io, "3MF: the transform \"%s\" has more than 12 numbers", Quoted(text).text);
  // Rows of the file act on row vectors, so they are the images of the axes.
  return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}, {m[9], m[10], m[11]}};
}

/// Id of an object: the part that contains it, and its number there.
using Id = std::pair<std::string, uint64_t>;

/// A component of an object, or an item of the build.
struct Reference {
  Assembly* owner;  ///< the object, or the build
  Id id;
  Transform transform;
};

class Package {
 public:
  Package(std::string_view file, UnpackLimit limit, bool with_beams, SoupBuilder& soup)
      : zip_(file, limit, soup.job()), with_beams_(with_beams), soup_(soup) {}

  /// Adds the triangles of the build. Returns the unit in millimetres.
  double read() {
    const std::string root = root_part();
    read_part(root);
    // Parts that references name are added to the queue when they are found.
    while (!waiting_.empty()) {
      const std::string part = waiting_.back();
      waiting_.pop_back();
      if (!parts_.contains(part)) read_part(part);
    }
    for (const Reference& reference : references_) {
      const auto found = objects_.find(reference.id);
      if (found == objects_.end())
        fail(Status::io, "3MF: there is no object of id %llu",
             static_cast<Count>(reference.id.second));
      reference.owner->instances.push_back({&found->second, reference.transform});
    }
    for (const auto& [assembly, id] : clipped_) assembly->clip = clipping_mesh(id);
    count_parts(build_);
    // Before anything is placed: instances may have been multiplied without end.
    soup_.expect_triangles(build_.triangles);
    expect(build_.beams, "beams and balls");
    expect(build_.clip_triangles, "triangles that clip beams");
    place(build_, {}, soup_);
    return parts_.at(root);
  }

  /// The lattices of the build, after read(). Those that nothing clips are one.
  std::vector<BeamLattice> lattices() const {
    std::vector<BeamLattice> made;
    std::optional<size_t> unclipped;
    for_each_placed(build_, {}, [&](const Assembly& part, const Transform& transform) {
      check_cancelled(soup_.job());
      if (!part.lattice || part.lattice->size() == 0) return;
      const BeamLattice& lattice = *part.lattice;
      const bool is_clipped = lattice.clipping != Clipping::none;
      if (is_clipped || !unclipped) {
        if (!is_clipped) unclipped = made.size();
        made.emplace_back().clipping = lattice.clipping;
      }
      BeamLattice& target = is_clipped ? made.back() : made[*unclipped];
      if (lattice.nodes.size() > UINT32_MAX - target.nodes.size())
        fail(Status::limit, "3MF: the beams have more than %u nodes", UINT32_MAX);
      target.append(lattice, transform, scale_of(transform));
      if (!is_clipped) return;
      SoupBuilder clip(soup_.max_triangles());
      clip.add_instance(*part.clip, transform);
      target.clip = clip.take();
    });
    return made;
  }

 private:
  void expect(uint64_t count, const char* what) const {
    if (count > soup_.max_triangles())
      fail(Status::limit, "3MF: the build has %llu %s; max_triangles is %llu",
           static_cast<Count>(count), what, static_cast<Count>(soup_.max_triangles()));
  }

  std::string root_part() {
    const std::optional<std::string> relationships = zip_.read("_rels/.rels");
    if (relationships) {
      const XmlDocument document(*relationships, "3MF: _rels/.rels");
      for (const pugi::xml_node& node : document.root().children())
        if (std::string_view(node.attribute("Type").value()) ==
            "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel")
          return part_name(node.attribute("Target").value());
    }
    return "3D/3dmodel.model";
  }

  /// Names in the package begin with a slash; names in the archive do not.
  static std::string part_name(std::string_view path) {
    while (path.starts_with('/')) path.remove_prefix(1);
    return std::string(path);
  }

  void read_part(const std::string& part) {
    std::optional<std::string> content = zip_.read(part);
    if (!content) fail(Status::io, "3MF: the package has no part \"%s\"", Quoted(part).text);
    const XmlDocument document(std::move(*content), "3MF");
    const pugi::xml_node model = document.root();
    if (local_name(model.name()) != "model")
      fail(Status::io, "3MF: the part \"%s\" holds <%s>, not <model>", Quoted(part).text,
           Quoted(model.name()).text);
    check_extensions(model, with_beams_);
    const double unit = unit_of(model);
    if (!parts_.empty() && unit != parts_.begin()->second)
      fail(Status::unsupported, "3MF: the part \"%s\" has a unit of its own", Quoted(part).text);
    // Elements of extensions may have the same names with another prefix.
    const std::string_view name = model.name();
    prefix_ = name.substr(0, name.size() - local_name(name).size());
    const bool is_root = parts_.empty();
    parts_[part] = unit;
    for (const pugi::xml_node& object : model.child(tag("resources").c_str()).children())
      if (object.name() == tag("object")) read_object(object, part);
    if (is_root)
      for (const pugi::xml_node& item : model.child(tag("build").c_str()).children())
        if (item.name() == tag("item")) add_reference(build_, item, part);
  }

  std::string tag(const char* name) const { return prefix_ + name; }

  void read_object(const pugi::xml_node& node, const std::string& part) {
    const uint64_t id = parse_count(node.attribute("id").value(), "3MF: object id");
    const auto [entry, is_new] = objects_.try_emplace(Id(part, id));
    if (!is_new) fail(Status::io, "3MF: two objects have the id %llu", static_cast<Count>(id));
    Assembly& object = entry->second;
    if (const pugi::xml_node mesh = node.child(tag("mesh").c_str())) read_mesh(mesh, object, part);
    for (const pugi::xml_node& component : node.child(tag("components").c_str()).children())
      if (component.name() == tag("component")) add_reference(object, component, part);
  }

  void read_mesh(const pugi::xml_node& node, Assembly& object, const std::string& part) {
    TriangleSoup& mesh = object.mesh;
    CancelPoll poll(soup_.job());
    const std::string vertex_tag = tag("vertex"), triangle_tag = tag("triangle");
    for (const pugi::xml_node& vertex : node.child(tag("vertices").c_str()).children()) {
      poll();
      if (vertex.name() != vertex_tag) continue;
      const auto coordinate = [&](const char* axis) {
        return parse_real(vertex.attribute(axis).value(), "3MF: vertex");
      };
      soup_.expect_vertices(mesh.vertices.size() + 1);
      mesh.vertices.push_back({coordinate("x"), coordinate("y"), coordinate("z")});
    }
    for (const pugi::xml_node& corners : node.child(tag("triangles").c_str()).children()) {
      poll();
      if (corners.name() != triangle_tag) continue;
      Triangle triangle;
      constexpr const char* names[] = {"v1", "v2", "v3"};
      for (size_t k = 0; k < 3; ++k) {
        const int64_t index =
            parse_integer(corners.attribute(names[k]).value(), "3MF: vertex index");
        if (index < 0 || static_cast<uint64_t>(index) >= mesh.vertices.size())
          fail(Status::mesh, "3MF: triangle %zu has vertex index %lld; there are %zu vertices",
               mesh.triangles.size(), static_cast<long long>(index), mesh.vertices.size());
        triangle[k] = static_cast<uint32_t>(index);
      }
      soup_.expect_triangles(mesh.triangles.size() + 1);
      mesh.triangles.push_back(triangle);
    }
    if (with_beams_)
      read_beams(node, object, part);
    else if (lattice_of(node))  // also in a file that does not say that they are required
      refuse_beams();
    // So that instances cannot multiply vertices out of proportion.
    drop_unused_vertices(mesh);
  }

  void read_beams(const pugi::xml_node& node, Assembly& object, const std::string& part) {
    std::optional<ThreemfLattice> read =
        read_lattice(node, object.mesh.vertices, soup_.max_triangles(), soup_.job());
    if (!read) return;
    object.lattice = std::make_unique<BeamLattice>(std::move(read->lattice));
    if (read->clipping_mesh) clipped_.push_back({&object, Id(part, *read->clipping_mesh)});
  }

  const TriangleSoup* clipping_mesh(const Id& id) const {
    const auto found = objects_.find(id);
    const auto number = static_cast<Count>(id.second);
    if (found == objects_.end())
      fail(Status::io, "3MF: there is no object of id %llu, the clippingmesh", number);
    const Assembly& object = found->second;
    if (object.lattice || !object.instances.empty())
      fail(Status::unsupported, "3MF: object %llu, the clippingmesh, has %s", number,
           object.lattice ? "a beam lattice" : "components");
    if (object.mesh.triangles.empty())
      fail(Status::mesh, "3MF: object %llu, the clippingmesh, has no triangles", number);
    return &object.mesh;
  }

  void add_reference(Assembly& owner, const pugi::xml_node& node, std::string part) {
    const uint64_t number = parse_count(node.attribute("objectid").value(), "3MF: objectid");
    Transform transform;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string_view name = attribute.name();
      if (name == "transform") transform = parse_transform(attribute.value());
      if (name.find(':') != std::string_view::npos && local_name(name) == "path")
        part = part_name(attribute.value());
    }
    if (!parts_.contains(part)) waiting_.push_back(part);
    references_.push_back({&owner, {std::move(part), number}, transform});
  }

  ZipPackage zip_;
  const bool with_beams_;
  SoupBuilder& soup_;
  std::string prefix_;
  std::map<std::string, double> parts_;  // with their units
  std::vector<std::string> waiting_;
  std::map<Id, Assembly> objects_;
  std::vector<Reference> references_;
  /// Objects with clipped lattices, and what clips them.
  std::vector<std::pair<Assembly*, Id>> clipped_;
  Assembly build_;
};

}  // namespace

double read_threemf(std::string_view file, UnpackLimit limit, SoupBuilder& soup) {
  return Package(file, limit, false, soup).read();
}

double read_threemf_beams(std::string_view file, UnpackLimit limit, SoupBuilder& soup,
                          std::vector<BeamLattice>& lattices) {
  Package package(file, limit, true, soup);
  const double unit = package.read();
  lattices = package.lattices();
  return unit;
}

}  // namespace msq
