// SPDX-License-Identifier: Apache-2.0
// A mesh as the bytes of a file, which are passed on as they are made.
#pragma once

#include <cstdint>
#include <functional>

#include "base/job.h"
#include "model/model.h"
#include "surface/mesher.h"

namespace msq {

enum class SurfaceFormat : int32_t { stl = 1, ply = 2 };

/// Some bytes of a file of a known size.
struct FilePart {
  uint64_t offset, size, total;
  const uint8_t* bytes;
};

/// Calls take(part) on this thread: each byte of the file is in one part. Those of binary STL are
/// in order; of PLY, vertices and triangles are two runs that grow in turn. Throws Error(limit) for
/// 2^32 triangles.
void write_mesh(const Model& model, const MeshPlan& plan, SurfaceFormat format,
                const std::function<void(const FilePart&)>& take, Job* job);

}  // namespace msq
