// SPDX-License-Identifier: Apache-2.0
// Finds which capsules of a list may be the first that rays meet: a sieve in single precision. The
// caller then tests the remaining capsules exactly.
//
// Rays come in packets that stay close together, or one by one. Lengths are of the order of 1: the
// caller measures from a nearby point, in units of its cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>

namespace msq {

/// The axes of capsules of one radius, component by component: one end, and the vector to the other
/// end. `capsule_padding` more entries of each array, and of the ids, may be read.
struct CapsuleView {
  const float* a[3];
  const float* ab[3];
  /// Identify struts: a strut that is in several lists has the same id in all.
  const uint32_t* ids;
  size_t count;
};
constexpr size_t capsule_padding = 16;

struct RayPacket {
  static constexpr size_t most = 16;

  /// The points origin + t direction, for t in [from, to]; directions of length 1. Lanes
  /// without a ray have from > to; none is at or beyond `count`.
  size_t count = 0;
  alignas(64) float origin[3][most] = {};
  alignas(64) float direction[3][most] = {};
  alignas(64) float from[most], to[most];
  /// Whether rays may begin inside or beyond capsules. If false, a ray that is past a capsule at
  /// `from` meets it there.
  bool starts = true;
  /// A line with a direction of length 1, and the maximum distance of the rays from it within their
  /// [from, to].
  float centre[3] = {}, along[3] = {};
  float spread = 0;
  /// The part of that line where capsules matter. Capsules that rays meet elsewhere may be left
  /// out.
  float near = -std::numeric_limits<float>::infinity();
  float far = std::numeric_limits<float>::infinity();
  /// Whether all rays have the direction `along`.
  bool is_parallel = false;
};

/// For each ray of a packet, lower bounds on where it meets the first capsule, and the first one
/// with another id. They are at least `from`, and infinite if there is none.
struct PacketHits {
  alignas(64) float first[RayPacket::most], second[RayPacket::most];
  alignas(64) uint32_t id[RayPacket::most];  ///< of the first capsule

  void clear();
};

/// Ids of the capsules that were tested for a packet. Newer ids may overwrite older ones.
class SeenIds {
 public:
  void clear() { std::fill(std::begin(ids_), std::end(ids_), UINT32_MAX); }
  /// Returns whether the id is new, and keeps it.
  bool add(uint32_t id) {
    uint32_t& place = ids_[(id ^ id >> 13) % std::size(ids_)];
    // Without a branch: whether it is new is unpredictable.
    const bool is_new = place != id;
    place = id;
    return is_new;
  }

 private:
  uint32_t ids_[512];
};

/// Bound on the error in the radius and in t, from rounding of the coordinates of rays and capsules
/// and of these functions. Coordinates may be up to 8.
constexpr float capsule_ray_slack = 4e-5f;

/// Adds the capsules of a list to the hits of the rays. `corner` is the origin of the list's
/// coordinates, in the rays' coordinates. If a ray meets a capsule in [from, to], its bound is at
/// most that t. Some capsules that a ray misses by less than twice the slack may be added. Capsules
/// that were `seen` are skipped, and tested ones are added to `seen`. If `seen` is null, none are
/// skipped.
void meet_capsules(const CapsuleView& capsules, float radius, const float (&corner)[3],
                   const RayPacket& rays, SeenIds* seen, PacketHits& hits);

/// The points origin + t direction of one ray, for t in [0, to], relative to the origin of a list's
/// coordinates; directions of length 1.
struct CapsuleRay {
  float origin[3], direction[3];
  float to;
};
/// Writes the ids of the capsules that the ray meets there, and for each a lower bound on where it
/// does; returns their number. It may add capsules that the ray misses by less than twice the
/// slack, or that lie next to its ends. The arrays have room for capsules.count + capsule_padding.
size_t capsules_on_ray(const CapsuleView& capsules, float radius, const CapsuleRay& ray,
                       uint32_t* ids, float* from);

}  // namespace msq
