// SPDX-License-Identifier: Apache-2.0
// Exact entries of several rays into one strut, in vectors of rays: where rounding leaves no doubt.
#pragma once

#include <cstdint>

#include "structure/foam/rays/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

/// The rays of a packet, component by component, as FoamRay.
struct PacketRays {
  static constexpr size_t most = RayPacket::most;

  alignas(64) double origin[3][most] = {}, direction[3][most] = {};
  alignas(64) double from[most] = {}, to[most] = {}, error[most] = {}, tolerance[most] = {};

  void set(size_t n, const FoamRay& ray) {
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis][n] = ray.origin[axis];
      direction[axis][n] = ray.direction[axis];
    }
    from[n] = ray.from;
    to[n] = ray.to;
    error[n] = ray.error;
    tolerance[n] = ray.tolerance;
  }
};

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
