// SPDX-License-Identifier: Apache-2.0
// The path of a packet of rays through slabs of cells, in single precision, as precise as the sieve
// of its capsules (strut/capsule_rays.h) requires.
#pragma once

#include <cstdint>

#include "strut/capsule_rays.h"

namespace msq {

/// Rays from a plane across the grid on, in foam units. Slab n is n slabs behind the plane. Along
/// the two other axes, positions are relative to a corner on that plane.
struct PacketPath {
  static constexpr size_t most = RayPacket::most;

  alignas(64) float place[2][most];  ///< position on the plane
  alignas(64) float slope[2][most];  ///< change of position per slab
  alignas(64) float step[most];      ///< change of t per slab, above 0
  alignas(64) float from[most];      ///< where rays begin and end; t is 0 on the plane
  alignas(64) float to[most];
};

struct PathSlab {
  int number;
  int axis;     ///< across it
  float begin;  ///< coordinate along that axis where rays enter
  float rise;   ///< from there to where they leave
};

/// What part of a packet does in a slab.
struct SlabCrossing {
  uint32_t active = 0;  ///< rays that are in it
  uint32_t ended = 0;   ///< and rays that end before it
  /// The box of the active rays' positions.
  float low[2], high[2];
};

/// Examines the rays of `live`. If any is active, it sets the packet's line to one in their middle,
/// in this slab. If the packet is parallel, `along` is unchanged.
SlabCrossing cross_slab(const PacketPath& path, const PathSlab& slab, uint32_t live,
                        RayPacket& packet);

}  // namespace msq
