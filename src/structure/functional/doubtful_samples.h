// SPDX-License-Identifier: Apache-2.0
// Samples whose values in single precision are too near to the level to decide.
#pragma once

#include <bit>

#include "base/sample_grid.h"
#include "structure/functional/functional.h"

namespace msq {

/// Of a row's samples in doubt, the bits of those that are inside. Bit i of `doubt` is sample
/// first + i of row j in layer k. value_at(i) is its value, within `slack` of the definition.
template <class ValueAt>
uint64_t decide_doubtful(const Functional& structure, double slack, const SampleGrid& grid,
                         uint64_t first, uint64_t j, uint64_t k, uint64_t doubt,
                         ValueAt&& value_at) {
  uint64_t in = 0;
  for (; doubt; doubt &= doubt - 1) {
    const size_t i = static_cast<size_t>(std::countr_zero(doubt));
    const Vec3 p = grid.at(first + i, j, k);
    const double value = value_at(i), level = structure.level().at(p);
    if (value <= level - slack || (value <= level + slack && structure.inside(p)))
      in |= doubt & -doubt;
  }
  return in;
}

}  // namespace msq
