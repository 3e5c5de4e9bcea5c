// SPDX-License-Identifier: Apache-2.0
// Neighbouring rays of a batch, component by component, in vectors of rays.
#pragma once

#include <cstdint>

#include "structure/foam/rays/strut_entry.h"
#include "strut/capsule_rays.h"

namespace msq {

struct PacketRays {
  static constexpr size_t most = RayPacket::most;

  const RaySearch* searches = nullptr;  ///< of all lanes, one after the other
  // As in FoamRay.
  alignas(64) double origin[3][most] = {}, direction[3][most] = {};
  alignas(64) double from[most] = {}, to[most] = {}, error[most] = {}, tolerance[most] = {};

  /// As FoamFrame::ray(), with its bits, for 1 to `most` rays, whose `from` and `to` are finite.
  /// Lanes beyond `count` have from > to.
  void set(const FoamFrame& frame, const RaySearch* first, size_t count);
  FoamRay ray(size_t lane) const {
    FoamRay ray;
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = origin[axis][lane];
      ray.direction[axis] = direction[axis][lane];
    }
    ray.from = from[lane];
    ray.to = to[lane];
    ray.error = error[lane];
    ray.tolerance = tolerance[lane];
    ray.search = searches + lane;
    return ray;
  }
  Vec3 at(size_t lane, double t) const {
    return Vec3{origin[0][lane], origin[1][lane], origin[2][lane]} +
           Vec3{direction[0][lane], direction[1][lane], direction[2][lane]} * t;
  }

  /// The lanes, as bits, whose rays begin at most `max_apart` beside the line of the ray in lane
  /// `first`, and whose directions differ from its direction by at most `max_turned`.
  uint32_t beside(size_t first, double max_apart, double max_turned) const;
};

}  // namespace msq
