// SPDX-License-Identifier: Apache-2.0
// Triangles as they come from a file or a host, before anything is known of them.
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

enum class WindingRule : int32_t { nonzero = 0, even_odd = 1, positive = 2 };

}  // namespace msq
