// SPDX-License-Identifier: Apache-2.0
// Triangle meshes from files and memory. The only door to Assimp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/memory.h"
#include "base/triangle_soup.h"

namespace msq {

enum class MeshFormat : int32_t {
  automatic = 0,
  stl = 1,
  obj = 2,
  ply = 3,
  off = 4,
  threemf = 5,
  amf = 6
};

struct MeshFileOptions {
  MeshFormat format = MeshFormat::automatic;
  double unit_mm = 1;  ///< for formats that name no unit
  uint64_t max_bytes = uint64_t{4} << 30;
  uint64_t max_triangles = 200000000;
  std::shared_ptr<MemoryBudget> budget;  ///< that reading counts against; null: none
};

/// Whether this build reads files; if not, the functions below throw Error(unsupported).
bool can_read_mesh_files();

/// All triangles of a file in millimetres, instances placed, mirrored ones turned outside out
/// again, not yet welded. Opens no file but this one.
TriangleSoup read_mesh_file(const std::string& path, const MeshFileOptions& options);

/// The same from bytes; options.format must be named.
TriangleSoup read_mesh_memory(const void* data, uint64_t bytes, const MeshFileOptions& options);

}  // namespace msq
