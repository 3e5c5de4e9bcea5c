// SPDX-License-Identifier: Apache-2.0
// The way of a packet of rays through slabs of cells, in single precision: as near as the sieve of
// its capsules (strut/capsule_rays.h) needs it.
#pragma once

#include <cstdint>

#include "strut/capsule_rays.h"

namespace msq {

/// Rays from a plane across the grid on, in foam units. Slab n is n slabs behind it; along the two
/// other axes places are from a corner on that plane.
struct PacketPath {
  static constexpr size_t most = RayPacket::most;

  alignas(64) float place[2][most];  ///< on the plane
  alignas(64) float slope[2][most];  ///< change of place by slab
  alignas(64) float step[most];      ///< change of t by slab, above 0
  alignas(64) float from[most];      ///< where rays begin and end; t is 0 on the plane
  alignas(64) float to[most];
};

struct PathSlab {
  int number;
  int axis;     ///< across it
  float begin;  ///< of that axis' coordinate, where rays come in
  float rise;   ///< from there to where they go out
};

/// What part of a packet does in a slab.
struct SlabCrossing {
  uint32_t active = 0;  ///< rays that are in it at all
  uint32_t ended = 0;   ///< and those that end before it
  /// The box of the active ones' places.
  float low[2], high[2];
};

/// Looks at those of `live`. If any is active, it gives the packet the line in their midst, in this
/// slab; `along` is kept where the packet is parallel.
SlabCrossing cross_slab(const PacketPath& path, const PathSlab& slab, uint32_t live,
                        RayPacket& packet);

}  // namespace msq
