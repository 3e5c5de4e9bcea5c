// SPDX-License-Identifier: Apache-2.0
// Selects the vector instructions for Highway's runtime dispatch. A file with kernels includes
// hwy/foreach_target.h and hwy/highway.h itself, since both are read once for each target.
//
// Functions that only prefetch are HWY_INLINE: GCC 12 may drop calls of them.
#pragma once

#include <hwy/aligned_allocator.h>
#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <new>

namespace msq {

/// Upper bound on the doubles in a vector of any instruction set (Scalable Vector Extension: 2048
/// bits). Highway's own HWY_MAX_BYTES is for the target being compiled, not for the one dispatched
/// to.
constexpr size_t max_simd_doubles = 32;

/// Begins to load memory that will be read in any order.
HWY_INLINE void prefetch_all(const void* data, size_t size) {
  constexpr size_t line = 64;
  const char* const first = static_cast<const char*>(data);
  for (size_t i = 0; i < size + line - 1; i += line) hwy::Prefetch(first + std::min(i, size - 1));
}

/// Begins to load values that will be written: the lines of the first and of the last one.
template <class T>
HWY_INLINE void prefetch_to_write([[maybe_unused]] T* values, [[maybe_unused]] size_t count = 1) {
#ifdef __GNUC__
  auto* const first = reinterpret_cast<unsigned char*>(values);
  __builtin_prefetch(first, 1);
  __builtin_prefetch(first + count * sizeof(T) - 1, 1);
#endif
}

/// Aligned to vectors; uninitialised.
template <class T>
using AlignedArray = hwy::AlignedFreeUniquePtr<T[]>;
template <class T = float>
AlignedArray<T> allocate_aligned(size_t count) {
  AlignedArray<T> made = hwy::AllocateAligned<T>(count ? count : 1);
  if (!made) throw std::bad_alloc();
  return made;
}
using AlignedFloats = AlignedArray<float>;

/// Name of the instruction set that the kernels use on this machine; static storage.
const char* simd_target_name();

}  // namespace msq
