// SPDX-License-Identifier: Apache-2.0
// The first point of a set that a condition holds for, in parallel.
#pragma once

#include <atomic>

#include "base/parallel.h"
#include "query/point_set.h"

namespace msq {

/// The number of that point, whichever thread finds it; points.count() if there is none.
template <class Condition>
uint64_t find_first_point(const PointSet& points, const Executor& executor, Condition&& holds) {
  constexpr uint64_t run = 65536, read_at_once = 256;
  const uint64_t count = points.count();
  std::atomic<uint64_t> first{count};
  executor.for_each((count + run - 1) / run, [&](uint64_t r) {
    const uint64_t end = std::min(count, (r + 1) * run);
    Vec3 positions[read_at_once];
    for (uint64_t i = r * run; i < end; i += read_at_once) {
      const uint64_t size = std::min(read_at_once, end - i);
      points.read(i, size, positions);
      for (uint64_t p = 0; p < size; ++p) {
        if (!holds(positions[p])) continue;
        uint64_t known = first.load();
        while (i + p < known && !first.compare_exchange_weak(known, i + p)) {
        }
        return;
      }
    }
  });
  return first;
}

}  // namespace msq
