// SPDX-License-Identifier: Apache-2.0
#include "structure/structure.h"

#include "structure/sampled_rows.h"

namespace msq {

void Structure::keep_points(const Vec3* points, uint8_t* alive, size_t count) const {
  for (size_t i = 0; i < count; ++i)
    if (alive[i] && !inside(points[i])) alive[i] = 0;
}

void Structure::keep_rows(const RowBlock& block, const Job* job) const {
  SampledRows(*this, block, job).keep();
}

}  // namespace msq
