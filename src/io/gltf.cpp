// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, as text or binary (GLB). Source: Khronos Group, "glTF 2.0 Specification", 2021.
//
// msq reads it itself. Assimp 5.2.5 does not compare the counts of sparse
// accessors with their buffers, and leaves out offsets where it compares others, so malformed files
// make it read beyond them (docs/decisions/007-mesh-files.md).
#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/status.h"
#include "io/assembly.h"
#include "io/base64.h"
#include "io/gltf_value.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/text_lines.h"

namespace msq {
namespace {

using Count = unsigned long long;
using Json = GltfValue;

/// Types of the components of an accessor.
enum ComponentType {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

uint64_t bytes_of(int type) {
  return type == int8 || type == uint8 ? 1 : type == int16 || type == uint16 ? 2 : 4;
}

/// Modes of primitives that are triangles.
enum Mode { triangles = 4, strip = 5, fan = 6 };

/// Extensions of a file that do not change where its triangles are, or are read here.
constexpr const char* known_extensions[] = {"KHR_mesh_quantization", "KHR_lights_punctual",
                                            "KHR_xmp_json_ld",       "KHR_materials_",
                                            "KHR_texture_",          "EXT_texture_"};

void check_extension(std::string_view name) {
  for (const std::string_view known : known_extensions)
    if (known.ends_with('_') ? name.starts_with(known) : name == known) return;
  fail(Status::unsupported, "glTF: the file requires the extension \"%s\"", Quoted(name).text);
}

/// Part of a buffer with elements of the same form.
struct View {
  std::string_view bytes;
  uint64_t stride;  ///< 0: tightly packed
};

struct Accessor {
  const char* data = nullptr;
  uint64_t count = 0, stride = 0;
  uint64_t components = 0;
  int type = 0;
  bool is_normalized = false;

  template <class T>
  T get(uint64_t i, uint64_t k) const {
    T value;  // may be unaligned
    std::memcpy(&value, data + i * stride + k * sizeof(T), sizeof value);
    return value;
  }
  uint32_t index(uint64_t i) const {
    return type == uint8    ? get<uint8_t>(i, 0)
           : type == uint16 ? get<uint16_t>(i, 0)
                            : get<uint32_t>(i, 0);
  }
  /// A component of a position, by the rules of KHR_mesh_quantization.
  double number(uint64_t i, uint64_t k) const {
    switch (type) {
      case int8:
        return scaled(get<int8_t>(i, k), 127);
      case uint8:
        return scaled(get<uint8_t>(i, k), 255);
      case int16:
        return scaled(get<int16_t>(i, k), 32767);
      case uint16:
        return scaled(get<uint16_t>(i, k), 65535);
      default:
        return get<float>(i, k);
    }
  }

 private:
  double scaled(double value, double most) const {
    return is_normalized ? std::max(value / most, -1.0) : value;
  }
};

class Reader {
 public:
  Reader(Json root, std::string_view binary, SoupBuilder& soup)
      : root_(root), binary_(binary), soup_(soup) {}

  void run() {
    check_header();
    read_buffers();
    accessors_ = root_.list("accessors");
    known_accessors_.resize(accessors_.size());
    read_meshes();
    read_nodes();
    Assembly scene;
    for (const Json& node : current_scene().list("nodes"))
      scene.instances.push_back({&item(nodes_, node, "node"), {}});
    count_parts(scene);
    soup_.expect_triangles(scene.triangles);
    // y is up in the file, and z in msq, as in 3MF.
    place(scene, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}}, soup_);
  }

 private:
  /// The item that a value names by its number.
  template <class T>
  static T& item(std::vector<T>& items, const Json& value, const char* what) {
    const uint64_t number = value.whole();
    if (number >= items.size())
      fail(Status::mesh, "glTF: %s: there is no %s %llu; the file has %zu", value.where().c_str(),
           what, static_cast<Count>(number), items.size());
    return items[number];
  }

  void check_header() const {
    const Json asset = root_.member("asset");
    const std::string_view version = asset ? asset.text("version") : std::string_view();
    if (!version.starts_with("2."))
      fail(Status::unsupported, "glTF: the version is \"%s\"; 2.0 is read", Quoted(version).text);
    for (const Json& name : root_.list("extensionsRequired")) check_extension(name.text());
  }

  Json current_scene() const {
    const std::vector<Json> scenes = root_.list("scenes");
    const uint64_t index = root_.whole("scene", 0);
    if (index >= scenes.size())
      fail(Status::mesh, "glTF: there is no scene %llu; the file has %zu",
           static_cast<Count>(index), scenes.size());
    return scenes[index];
  }

  void read_buffers() {
    std::vector<std::string_view> buffers;
    const std::vector<Json> all = root_.list("buffers");
    decoded_.reserve(all.size());  // buffers refer to these
    for (const Json& buffer : all) {
      const size_t number = buffers.size();
      const uint64_t size = buffer.required("byteLength");
      std::string_view content = binary_;
      if (buffer.member("uri"))
        content = data_of(buffer.text("uri"), number);
      else if (number > 0 || !binary_.data())
        fail(Status::io, "glTF: %s: buffer %zu has no data", buffer.where().c_str(), number);
      if (size > content.size())
        fail(Status::io, "glTF: %s: buffer %zu has %zu bytes; byteLength is %llu",
             buffer.where().c_str(), number, content.size(), static_cast<Count>(size));
      buffers.push_back(content.substr(0, size));
    }
    for (const Json& view : root_.list("bufferViews")) {
      if (!view.member("buffer")) view.required("buffer");
      const std::string_view buffer = item(buffers, view.member("buffer"), "buffer");
      const uint64_t offset = view.whole("byteOffset", 0), size = view.required("byteLength");
      if (offset > buffer.size() || size > buffer.size() - offset)
        fail(Status::io, "glTF: %s: %llu bytes from byte %llu on are beyond the buffer's %zu",
             view.where().c_str(), static_cast<Count>(size), static_cast<Count>(offset),
             buffer.size());
      views_.push_back({buffer.substr(offset, size), view.whole("byteStride", 0)});
    }
  }

  std::string_view data_of(std::string_view uri, size_t number) {
    constexpr std::string_view mark = ";base64,";
    const size_t at = uri.substr(0, 200).find(mark);
    if (!uri.starts_with("data:") || at == std::string_view::npos)
      fail(Status::unsupported,
           "glTF: buffer %zu is in another file, \"%s\"; msq reads files that hold their buffers, "
           "such as GLB",
           number, Quoted(uri).text);
    std::string& content = decoded_.emplace_back();
    if (!decode_base64(uri.substr(at + mark.size()), content, soup_.job()))
      fail(Status::io, "glTF: buffer %zu is not in base64", number);
    return content;
  }

  /// Each accessor is looked at once, however many primitives name it.
  const Accessor& accessor(const Json& reference) {
    std::optional<Accessor>& known = item(known_accessors_, reference, "accessor");
    if (!known) known = read_accessor(accessors_[reference.whole()]);
    return *known;
  }

  Accessor read_accessor(const Json& from) {
    if (from.member("sparse"))
      fail(Status::unsupported, "glTF: %s: the accessor is sparse, which is not read",
           from.where().c_str());
    Accessor made;
    const std::string_view type = from.text("type");
    made.components = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 0;
    if (!made.components)
      fail(Status::io, "glTF: %s: the type \"%s\" is neither SCALAR nor VEC3", from.where().c_str(),
           Quoted(type).text);
    made.count = from.required("count");
    const uint64_t component = from.required("componentType");
    if (component < int8 || component > float32 || component == 5124)
      fail(Status::io, "glTF: %s: componentType is %llu", from.where().c_str(),
           static_cast<Count>(component));
    made.type = static_cast<int>(component);
    made.is_normalized = from.truth("normalized");
    if (!from.member("bufferView")) from.required("bufferView");
    const View& view = item(views_, from.member("bufferView"), "bufferView");
    const uint64_t offset = from.whole("byteOffset", 0);
    const uint64_t element = made.components * bytes_of(made.type);
    made.stride = view.stride ? view.stride : element;
    // In this order, so that nothing overflows.
    const uint64_t room = view.bytes.size();
    if (offset > room ||
        (made.count > 0 &&
         (element > room - offset || made.count - 1 > (room - offset - element) / made.stride)))
      fail(Status::io,
           "glTF: %s: %llu elements from byte %llu on are beyond the bufferView's %llu bytes",
           from.where().c_str(), static_cast<Count>(made.count), static_cast<Count>(offset),
           static_cast<Count>(room));
    made.data = view.bytes.data() + offset;
    return made;
  }

  void read_meshes() {
    const std::vector<Json> all = root_.list("meshes");
    meshes_ = std::vector<Assembly>(all.size());
    for (size_t i = 0; i < all.size(); ++i)
      for (const Json& primitive : all[i].list("primitives"))
        read_primitive(primitive, meshes_[i].mesh);
  }

  void read_primitive(const Json& primitive, TriangleSoup& mesh) {
    check_cancelled(soup_.job());
    const uint64_t mode = primitive.whole("mode", triangles);
    if (mode > fan)
      fail(Status::io, "glTF: %s: mode is %llu", primitive.where().c_str(),
           static_cast<Count>(mode));
    if (mode < triangles) return;  // points and lines
    if (const Json extensions = primitive.member("extensions"))
      for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
        if (extensions.member(name))
          fail(Status::unsupported, "glTF: %s: the mesh is compressed by %s, which is not read",
               primitive.where().c_str(), name);
    const Json attributes = primitive.member("attributes");
    const Json position = attributes ? attributes.member("POSITION") : Json();
    if (!position) return;
    const Accessor positions = accessor(position);
    if (positions.components != 3 || positions.type == uint32)
      fail(Status::io, "glTF: %s: POSITION is not of three numbers", position.where().c_str());
    const Json given = primitive.member("indices");
    Accessor indices;
    if (given) {
      indices = accessor(given);
      if (indices.components != 1 ||
          (indices.type != uint8 && indices.type != uint16 && indices.type != uint32))
        fail(Status::io, "glTF: %s: indices are not whole numbers from 0", given.where().c_str());
    }
    const uint64_t corners = given ? indices.count : positions.count;
    const uint64_t count = mode == triangles ? corners / 3 : corners < 3 ? 0 : corners - 2;
    gathered_ = saturating_sum(gathered_, count);
    soup_.expect_triangles(gathered_);

    // Vertices are numbered where triangles use them, so that many primitives over one accessor
    // take no more memory than their triangles.
    VertexNumbers numbers(positions.count, 3 * count);
    CancelPoll poll(soup_.job());
    const auto corner = [&](uint64_t i) {
      const uint64_t vertex = given ? indices.index(i) : i;
      if (vertex >= positions.count)
        fail(Status::mesh, "glTF: %s: vertex index %llu; there are %llu vertices",
             primitive.where().c_str(), static_cast<Count>(vertex),
             static_cast<Count>(positions.count));
      uint32_t& known = numbers.of(vertex);
      if (known == VertexNumbers::none) {
        soup_.expect_vertices(mesh.vertices.size() + 1);
        known = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back({positions.number(vertex, 0), positions.number(vertex, 1),
                                 positions.number(vertex, 2)});
      }
      return known;
    };
    for (uint64_t i = 0; i < count; ++i) {
      poll();
      if (mode == triangles)
        mesh.triangles.push_back({corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)});
      else if (mode == fan)
        mesh.triangles.push_back({corner(i + 1), corner(i + 2), corner(0)});
      else
        mesh.triangles.push_back({corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)});
    }
  }

  /// The number of each vertex of an accessor among those used: a table, or a map if few are.
  class VertexNumbers {
   public:
    static constexpr uint32_t none = UINT32_MAX;
    VertexNumbers(uint64_t vertices, uint64_t corners) {
      if (vertices / 8 <= corners) table_.resize(vertices, none);
    }
    uint32_t& of(uint64_t vertex) {
      return table_.empty() ? map_.try_emplace(vertex, none).first->second : table_[vertex];
    }

   private:
    std::vector<uint32_t> table_;
    std::unordered_map<uint64_t, uint32_t> map_;
  };

  static Transform transform_of(const Json& node) {
    double m[16], r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1}, t[3] = {0, 0, 0};
    if (node.numbers("matrix", m))
      return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    node.numbers("translation", t);
    node.numbers("rotation", r);
    node.numbers("scale", s);
    const double x = r[0], y = r[1], z = r[2], w = r[3];
    Transform made;
    made.x_axis = Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)} * s[0];
    made.y_axis = Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)} * s[1];
    made.z_axis = Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)} * s[2];
    made.origin = {t[0], t[1], t[2]};
    return made;
  }

  /// An assembly for each node, which holds its mesh and children in the node's place.
  void read_nodes() {
    const std::vector<Json> all = root_.list("nodes");
    nodes_ = std::vector<Assembly>(all.size());
    for (size_t i = 0; i < all.size(); ++i) {
      const Transform transform = transform_of(all[i]);
      if (const Json mesh = all[i].member("mesh")) {
        if (all[i].member("skin"))
          fail(Status::unsupported, "glTF: %s: the node has a skin, which is not read",
               all[i].where().c_str());
        nodes_[i].instances.push_back({&item(meshes_, mesh, "mesh"), transform});
      }
      for (const Json& child : all[i].list("children"))
        nodes_[i].instances.push_back({&item(nodes_, child, "node"), transform});
    }
  }

  const Json root_;
  const std::string_view binary_;
  SoupBuilder& soup_;
  std::vector<std::string> decoded_;
  std::vector<View> views_;
  std::vector<Json> accessors_;
  std::vector<std::optional<Accessor>> known_accessors_;
  std::vector<Assembly> meshes_, nodes_;
  uint64_t gathered_ = 0;
};

/// The two chunks of a binary file.
struct Chunks {
  std::string_view json, binary;
};

uint32_t number_at(std::string_view file, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value |= uint32_t{static_cast<uint8_t>(file[at + i])} << (8 * i);
  return value;
}

std::string_view chunk_at(std::string_view file, size_t at, uint32_t kind, const char* name) {
  if (file.size() - at < 8 || file.size() - at - 8 < number_at(file, at))
    fail(Status::io, "glTF: the %s chunk is truncated: the file has %zu bytes", name, file.size());
  if (number_at(file, at + 4) != kind)
    fail(Status::io, "glTF: chunk of type %08x in place of %s", number_at(file, at + 4), name);
  return file.substr(at + 8, number_at(file, at));
}

Chunks split(std::string_view file) {
  if (!file.starts_with("glTF")) return {without_byte_order_mark(file), {}};
  constexpr size_t header = 12;
  if (file.size() < header) fail(Status::io, "glTF: the file ends in its header");
  if (number_at(file, 4) != 2)
    fail(Status::unsupported, "glTF: the version of the container is %u; 2 is read",
         number_at(file, 4));
  if (number_at(file, 8) > file.size())
    fail(Status::io, "glTF: expected %u bytes; the file has %zu", number_at(file, 8), file.size());
  Chunks chunks;
  chunks.json = chunk_at(file, header, 0x4e4f534a, "JSON");
  const size_t next = header + 8 + chunks.json.size();
  if (next < number_at(file, 8)) chunks.binary = chunk_at(file, next, 0x004e4942, "BIN");
  return chunks;
}

/// Values, of 40 bytes and their keys, are bounded by the bytes that they are read from.
JsonTree parse(std::string_view text, const Job* job) {
  if (is_wide_text(text)) refuse_wide_text(text, "glTF");
  try {
    return JsonTree(text, {100000 + text.size() / 4, 100}, job);
  } catch (const Error& error) {
    const bool is_malformed = error.status == Status::argument;
    if (!is_malformed && error.status != Status::limit) throw;
    throw Error(is_malformed ? Status::io : Status::limit, std::string("glTF: ") + error.what());
  }
}

}  // namespace

double read_gltf(std::string_view file, SoupBuilder& soup) {
  if (!can_read_json())
    fail(Status::unsupported, "this build of msq does not read glTF files (MSQ_WITH_JSON is off)");
  constexpr double metre = 1000;
  const Chunks chunks = split(file);
  const JsonTree tree = parse(chunks.json, soup.job());
  Reader(Json(tree, 0), chunks.binary, soup).run();
  return metre;
}

}  // namespace msq
