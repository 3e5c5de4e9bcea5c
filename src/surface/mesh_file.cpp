// SPDX-License-Identifier: Apache-2.0
// The number of triangles is in the head of both formats, so connections are found twice: first
// alone, to count them, which takes no rays.
#include "surface/mesh_file.h"

#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "base/status.h"

namespace msq {

namespace {

/// Of the work, what counting takes.
constexpr double part_of_count = 0.1;
constexpr uint64_t stl_head = 84, stl_triangle = 50, ply_vertex = 24, ply_triangle = 13;

/// Numbers with the low byte first, as both formats have them.
class Bytes {
 public:
  void clear() { bytes_.clear(); }
  void put(uint8_t byte) { bytes_.push_back(byte); }
  void put(uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8) put(static_cast<uint8_t>(number >> shift));
  }
  void put(float number) { put(std::bit_cast<uint32_t>(number)); }
  void put(Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) put(static_cast<float>(v[axis]));
  }
  void put(const std::string& text) { bytes_.insert(bytes_.end(), text.begin(), text.end()); }
  const std::vector<uint8_t>& all() const { return bytes_; }

 private:
  std::vector<uint8_t> bytes_;
};

/// Bytes that the next ones are passed on with.
constexpr size_t enough = size_t{1} << 20;

class Writer {
 public:
  Writer(const std::function<void(const FilePart&)>& take, uint64_t total)
      : take_(take), total_(total) {}

  void write(uint64_t& offset, Bytes& bytes) {
    if (bytes.all().empty()) return;
    take_({offset, bytes.all().size(), total_, bytes.all().data()});
    offset += bytes.all().size();
    bytes.clear();
  }

 private:
  const std::function<void(const FilePart&)>& take_;
  const uint64_t total_;
};

Vec3 unit_normal(Vec3 v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec3{};
}

void write_stl(const Model& model, const MeshPlan& plan, MeshSize size,
               const std::function<void(const FilePart&)>& take, JobPart progress) {
  Writer writer(take, stl_head + stl_triangle * size.triangles);
  Bytes bytes;
  uint64_t offset = 0;
  std::string head = "binary STL, written by msq";  // a head that began with solid would be text
  head.resize(80, ' ');
  bytes.put(head);
  bytes.put(static_cast<uint32_t>(size.triangles));
  make_mesh(
      model, plan,
      [&](const MeshSlab& slab) {
        for (uint64_t t = 0; t < slab.triangle_count; ++t) {
          Vec3 p[3];
          for (size_t i = 0; i < 3; ++i)
            p[i] = slab.known[slab.triangles[3 * t + i] - slab.first_known];
          bytes.put(unit_normal(cross(p[1] - p[0], p[2] - p[0])));
          for (const Vec3& v : p) bytes.put(v);
          bytes.put(uint8_t{0});
          bytes.put(uint8_t{0});
          if (bytes.all().size() >= enough) writer.write(offset, bytes);
        }
      },
      progress);
  writer.write(offset, bytes);
}

void write_ply(const Model& model, const MeshPlan& plan, MeshSize size,
               const std::function<void(const FilePart&)>& take, JobPart progress) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment written by msq\nelement vertex " +
      std::to_string(size.vertices) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float "
      "ny\nproperty float nz\nelement face " +
      std::to_string(size.triangles) + "\nproperty list uchar int vertex_indices\nend_header\n";
  uint64_t at_vertex = 0, at_face = head.size() + ply_vertex * size.vertices;
  Writer writer(take, at_face + ply_triangle * size.triangles);
  Bytes vertices, faces;
  vertices.put(head);
  make_mesh(
      model, plan,
      [&](const MeshSlab& slab) {
        for (uint64_t v = 0; v < slab.vertex_count; ++v) {
          vertices.put(slab.vertices[v]);
          for (size_t i = 0; i < 3; ++i) vertices.put(slab.normals[3 * v + i]);
          if (vertices.all().size() >= enough) writer.write(at_vertex, vertices);
        }
        for (uint64_t t = 0; t < slab.triangle_count; ++t) {
          faces.put(uint8_t{3});
          for (size_t i = 0; i < 3; ++i) faces.put(slab.triangles[3 * t + i]);
          if (faces.all().size() >= enough) writer.write(at_face, faces);
        }
      },
      progress);
  writer.write(at_vertex, vertices);
  writer.write(at_face, faces);
}

}  // namespace

void write_mesh(const Model& model, const MeshPlan& plan, SurfaceFormat format,
                const std::function<void(const FilePart&)>& take, Job* job) {
  const MeshSize size = count_mesh(model, plan, {job, 0, part_of_count});
  // PLY counts vertices in numbers with a sign.
  if (size.triangles > UINT32_MAX || size.vertices > INT32_MAX)
    fail(Status::limit, "%llu triangles and %llu vertices; a file has at most %llu and %llu",
         static_cast<unsigned long long>(size.triangles),
         static_cast<unsigned long long>(size.vertices),
         static_cast<unsigned long long>(UINT32_MAX), static_cast<unsigned long long>(INT32_MAX));
  (format == SurfaceFormat::stl ? write_stl : write_ply)(model, plan, size, take,
                                                         {job, part_of_count, 1});
}

}  // namespace msq
