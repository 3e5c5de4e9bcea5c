// SPDX-License-Identifier: Apache-2.0
// Bits that tell of the crossings of rings.
#pragma once

#include <cstdint>

namespace msq {

/// What is known of a crossing besides its place.
namespace ring_kind {
enum : uint8_t {
  horizontal = 1,    ///< its edge
  first_inside = 2,  ///< the first node of its edge
  beyond = 4,        ///< it lies beyond the window
  seam = 8,          ///< it lies on an edge of the window
  saddle = 16,       ///< the cell that follows has four crossings, or is a divided one
  fine = 32          ///< it lies between finer nodes: then a part of a divided cell follows
};
}  // namespace ring_kind

}  // namespace msq
