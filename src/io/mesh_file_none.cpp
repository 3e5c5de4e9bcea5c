// SPDX-License-Identifier: Apache-2.0
// Stands in for the mesh reader in builds without Assimp.
#include "base/status.h"
#include "io/mesh_file.h"

namespace msq {

bool can_read_mesh_files() {
  return false;
}

TriangleSoup read_mesh_file(const std::string&, const MeshFileOptions&) {
  fail(Status::unsupported, "this build of msq has no mesh reader (MSQ_WITH_ASSIMP is off)");
}

TriangleSoup read_mesh_memory(const void*, uint64_t, const MeshFileOptions&) {
  fail(Status::unsupported, "this build of msq has no mesh reader (MSQ_WITH_ASSIMP is off)");
}

}  // namespace msq
