// SPDX-License-Identifier: Apache-2.0
// Triangles as read from a file or passed by a host, before any check.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec.h"

namespace msq {

using Triangle = std::array<uint32_t, 3>;

struct TriangleSoup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

}  // namespace msq
