// SPDX-License-Identifier: Apache-2.0
// Counter-based random numbers: Steele, Lea and Flood, "Fast splittable pseudorandom number
// generators", OOPSLA 2014 (SplitMix64). Output n of stream `key` is a pure function of (key, n). A
// row of cells is one stream, indexed by the cell's x, so no list of seeds is stored.
#pragma once

#include <cstdint>

namespace msq {

inline uint64_t splitmix_finalise(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

inline uint64_t splitmix_output(uint64_t key, uint64_t n) {
  return splitmix_finalise(key + n * 0x9e3779b97f4a7c15ULL);
}

/// A number in [0, 1) from 64 random bits.
inline double random_fraction(uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace msq
