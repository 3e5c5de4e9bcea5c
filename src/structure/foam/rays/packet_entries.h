// SPDX-License-Identifier: Apache-2.0
// Exact entries of several rays into one strut, in vectors of rays: where rounding leaves no doubt.
#pragma once

#include <cstdint>

#include "structure/foam/rays/packet_rays.h"

namespace msq {

/// What StrutEntries::find() finds, by the bits of rays. Of the others, only find() can tell.
struct PacketEntries {
  uint32_t met = 0, missed = 0;
  // Of those met:
  alignas(64) double t[PacketRays::most];
  alignas(64) double normal[3][PacketRays::most];  ///< along the grid's axes
};

/// Finds the entries of some rays, as StrutEntries::find() does, in a foam of one radius. Lengths
/// in foam units; `scale`: those of a cell.
void find_packet_entries(const StrutLine& strut, Vec3 scale, double radius, const PacketRays& rays,
                         uint32_t which, PacketEntries& found);

}  // namespace msq
