// SPDX-License-Identifier: Apache-2.0
// Triangle meshes from files and memory.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/job.h"
#include "base/memory.h"
#include "base/triangle_soup.h"
#include "io/beam_lattice.h"

namespace msq {

enum class MeshFormat : int32_t {
  automatic = 0,
  stl = 1,
  obj = 2,
  ply = 3,
  off = 4,
  threemf = 5,
  amf = 6,
  gltf = 7
};

struct MeshFileOptions {
  MeshFormat format = MeshFormat::automatic;
  double unit_mm = 1;  ///< for formats without a unit
  uint64_t max_bytes = uint64_t{4} << 30;
  uint64_t max_triangles = 200000000;
  std::shared_ptr<MemoryBudget> budget;  ///< to which reading is charged; null: none
  JobPart part;                          ///< of the call; throws Error(cancelled) if its job is
                                         ///< cancelled
};

/// Whether this build reads binary STL, 3MF and AMF; if not, it throws Error(unsupported) for them.
bool can_read_all_mesh_files();

/// All triangles of a file in millimetres. Instances are placed, and mirrored ones are reversed so
/// that their normals point outwards. Vertices are not welded. Opens no file except this one.
TriangleSoup read_mesh_file(const std::string& path, const MeshFileOptions& options);

/// The same from bytes; requires options.format.
TriangleSoup read_mesh_memory(const void* data, uint64_t bytes, const MeshFileOptions& options);

/// What a file of beams holds, in millimetres.
struct BeamFile {
  /// At least one. Those that nothing clips are one.
  std::vector<BeamLattice> lattices;
  /// The triangles of the build; may have none.
  TriangleSoup mesh;
};

/// The same for files of beams, which are 3MF.
BeamFile read_beam_file(const std::string& path, const MeshFileOptions& options);
BeamFile read_beam_memory(const void* data, uint64_t bytes, const MeshFileOptions& options);

}  // namespace msq
