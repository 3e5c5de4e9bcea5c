// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/job.h"
#include "base/triangle_soup.h"

namespace msq {

/// Appends the n - 2 triangles of a polygon of n >= 3 vertices, which keep its orientation. Indices
/// must be in range. Throws Error(limit) on concave polygons of more than 4096 vertices,
/// Error(cancelled) if the job, which may be null, is cancelled.
void triangulate_polygon(const std::vector<Vec3>& vertices, std::span<const uint32_t> polygon,
                         std::vector<Triangle>& triangles, const Job* job);

}  // namespace msq
