// SPDX-License-Identifier: Apache-2.0
// Hashes of cells, for tables of per-cell data.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/random.h"
#include "cell/neighbourhood.h"

namespace msq {

/// `key` identifies the owner of the cell, in tables for several owners.
inline uint64_t hash_of(CellIndex cell, uint64_t key = 0) {
  const uint64_t yz =
      static_cast<uint32_t>(cell.y) | static_cast<uint64_t>(static_cast<uint32_t>(cell.z)) << 32;
  return splitmix_output(splitmix_finalise(yz) ^ key, static_cast<uint32_t>(cell.x));
}

struct CellHash {
  size_t operator()(CellIndex cell) const { return static_cast<size_t>(hash_of(cell)); }
};

}  // namespace msq
