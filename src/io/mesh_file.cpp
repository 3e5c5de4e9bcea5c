// SPDX-License-Identifier: Apache-2.0
#include "io/mesh_file.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <string_view>

#include "base/status.h"
#include "io/readers.h"
#include "io/text_cursor.h"
#include "io/whole_file.h"

namespace msq {
namespace {

constexpr struct {
  const char* extension;
  MeshFormat format;
} formats[] = {{"stl", MeshFormat::stl},   {"obj", MeshFormat::obj},     {"ply", MeshFormat::ply},
               {"off", MeshFormat::off},   {"3mf", MeshFormat::threemf}, {"amf", MeshFormat::amf},
               {"gltf", MeshFormat::gltf}, {"glb", MeshFormat::gltf}};

MeshFormat format_of(const std::string& path) {
  const size_t slash = path.find_last_of("/\\");
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  const size_t dot = name.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : name.substr(dot + 1);
  for (const auto& known : formats)
    if (equal_ignoring_case(extension, known.extension)) return known.format;
  fail(Status::unsupported,
       "%s: the extension \"%s\" is none of stl, obj, ply, off, 3mf, amf, gltf, glb",
       shown(path).c_str(), shown(extension).c_str());
}

void check(const MeshFileOptions& options) {
  const auto format = static_cast<int32_t>(options.format);
  if (format < 0 || format > static_cast<int32_t>(MeshFormat::gltf))
    fail(Status::argument, "format is %d; it must be 0 to %d", format,
         static_cast<int>(MeshFormat::gltf));
  if (!(options.unit_mm > 0) || !std::isfinite(options.unit_mm))
    fail(Status::argument, "unit_mm is %g; it must be finite and more than 0", options.unit_mm);
}

/// Memory for reading a file, as a multiple of its bytes: its content, a library's data, the
/// growing vertices and triangles.
constexpr uint64_t working_factor = 8;

Reservation reserve_reading(uint64_t bytes, const MeshFileOptions& options) {
  return options.budget ? Reservation(options.budget, bytes * working_factor, "reading a mesh file")
                        : Reservation();
}

UnpackLimit unpack_limit(const MeshFileOptions& options) {
  const uint64_t memory_limit = options.budget ? options.budget->limit() : 0;
  if (memory_limit && memory_limit / working_factor < options.max_bytes)
    return {memory_limit / working_factor, memory_limit};
  return {options.max_bytes};
}

void check_size(uint64_t bytes, const MeshFileOptions& options) {
  if (bytes > options.max_bytes)
    fail(Status::limit, "the file has %llu bytes; max_bytes is %llu",
         static_cast<unsigned long long>(bytes),
         static_cast<unsigned long long>(options.max_bytes));
}

TriangleSoup read(std::string_view file, MeshFormat format, const MeshFileOptions& options) {
  SoupBuilder soup(options.max_triangles, options.part, file.size());
  double scale = options.unit_mm;
  switch (format) {
    case MeshFormat::stl:
      read_stl(file, soup);
      break;
    case MeshFormat::obj:
      read_obj(file, soup);
      break;
    case MeshFormat::ply:
      read_ply(file, soup);
      break;
    case MeshFormat::off:
      read_off(file, soup);
      break;
    case MeshFormat::threemf:
      scale = read_threemf(file, unpack_limit(options), soup);
      break;
    case MeshFormat::amf:
      scale = read_amf(file, unpack_limit(options), soup);
      break;
    case MeshFormat::gltf:
      scale = read_gltf(file, soup);
      break;
    case MeshFormat::automatic:
      fail(Status::internal, "no mesh format");
  }
  return soup.finish(scale);
}

void check_finite(const BeamLattice& lattice) {
  for (size_t i = 0; i < lattice.nodes.size(); ++i) {
    const Vec3& p = lattice.nodes[i];
    constexpr double most = 1e75;  // of structures of beams
    if (!is_finite(p) || max_magnitude(p) > most)
      fail(Status::mesh, "node %zu of the beams is at (%g, %g, %g); the limit is %g", i, p.x, p.y,
           p.z, most);
  }
}

BeamFile read_beams(std::string_view file, MeshFormat format, const MeshFileOptions& options) {
  if (format != MeshFormat::threemf)
    fail(Status::unsupported, "format is %d; files of beams are 3MF, which is %d",
         static_cast<int>(format), static_cast<int>(MeshFormat::threemf));
  SoupBuilder soup(options.max_triangles, options.part, file.size());
  BeamFile made;
  std::vector<BeamLattice> lattices;
  const double unit = read_threemf_beams(file, unpack_limit(options), soup, lattices);
  if (lattices.empty()) fail(Status::mesh, "the file has no beams");
  for (BeamLattice& lattice : lattices) {
    BeamLattice& scaled = made.lattices.emplace_back();
    Transform to_mm;
    to_mm.x_axis.x = to_mm.y_axis.y = to_mm.z_axis.z = unit;
    scaled.append(lattice, to_mm, unit);
    scaled.clipping = lattice.clipping;
    scaled.clip = std::move(lattice.clip);
    for (Vec3& vertex : scaled.clip.vertices) {
      vertex = vertex * unit;
      if (!is_finite(vertex)) fail(Status::mesh, "a vertex of a clippingmesh is not finite");
    }
    lattice = {};
    check_finite(scaled);
  }
  if (soup.triangles() > 0) made.mesh = soup.finish(unit);
  return made;
}

/// What read(content, format) makes of a file.
template <class Read>
auto read_from_path(const std::string& path, const MeshFileOptions& options,
                    const Read& read_content) {
  check(options);
  const MeshFormat format =
      options.format == MeshFormat::automatic ? format_of(path) : options.format;
  Reservation reservation;
  const FileContent content = read_whole_file(path, options.part.job, [&](uint64_t bytes) {
    check_size(bytes, options);
    reservation = reserve_reading(bytes, options);
  });
  try {
    return read_content(content.view(), format, options);
  } catch (const Error& error) {
    if (error.status == Status::cancelled) throw;
    throw Error(error.status, shown(path) + ": " + error.what());
  }
}

template <class Read>
auto read_from_memory(const void* data, uint64_t bytes, const MeshFileOptions& options,
                      const Read& read_content) {
  check(options);
  if (options.format == MeshFormat::automatic)
    fail(Status::argument, "format is automatic; a file in memory needs a named one");
  if (!data && bytes)
    fail(Status::argument, "data is NULL with %llu bytes", static_cast<unsigned long long>(bytes));
  check_size(bytes, options);
  const Reservation reservation = reserve_reading(bytes, options);
  return read_content(std::string_view(static_cast<const char*>(data), bytes), options.format,
                      options);
}

}  // namespace

TriangleSoup read_mesh_file(const std::string& path, const MeshFileOptions& options) {
  return read_from_path(path, options, read);
}

TriangleSoup read_mesh_memory(const void* data, uint64_t bytes, const MeshFileOptions& options) {
  return read_from_memory(data, bytes, options, read);
}

BeamFile read_beam_file(const std::string& path, const MeshFileOptions& options) {
  return read_from_path(path, options, read_beams);
}

BeamFile read_beam_memory(const void* data, uint64_t bytes, const MeshFileOptions& options) {
  return read_from_memory(data, bytes, options, read_beams);
}

}  // namespace msq
