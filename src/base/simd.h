// SPDX-License-Identifier: Apache-2.0
// Which vector instructions Highway's runtime dispatch uses. A file with kernels includes
// hwy/foreach_target.h and hwy/highway.h itself, since both are read once for each target.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <new>

namespace msq {

/// No vector of any instruction set holds more doubles (Scalable Vector Extension: 2048 bits).
/// Highway's own HWY_MAX_BYTES is that of the target being compiled, not of the one dispatched to.
constexpr size_t most_simd_doubles = 32;

/// Aligned to vectors; not set.
using AlignedFloats = hwy::AlignedFreeUniquePtr<float[]>;
inline AlignedFloats allocate_aligned(size_t floats) {
  AlignedFloats made = hwy::AllocateAligned<float>(floats);
  if (!made) throw std::bad_alloc();
  return made;
}

/// Name of the instruction set that the kernels use on this machine; static storage.
const char* simd_target_name();

}  // namespace msq
