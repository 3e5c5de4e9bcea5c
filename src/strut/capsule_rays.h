// SPDX-License-Identifier: Apache-2.0
// Which capsules of a list may be the first that rays meet: a sieve in single precision, before
// those that it leaves are decided exactly.
//
// Rays come in packets that stay close together, or one by one. Lengths are of the order of 1: the
// caller measures from a place near by, in units of its cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>

namespace msq {

/// The axes of capsules of one radius, component by component: an end, and from there to the other.
/// `capsule_padding` more of each, and of the ids, may be read.
struct CapsuleView {
  const float* a[3];
  const float* ab[3];
  /// Tell struts apart: one that comes in several lists has the same in all.
  const uint32_t* ids;
  size_t count;
};
constexpr size_t capsule_padding = 16;

struct RayPacket {
  static constexpr size_t most = 16;

  /// The points origin + t direction, for t in [from, to]; directions of length 1. Lanes beyond
  /// `count` have from > to.
  size_t count = 0;
  alignas(64) float origin[3][most] = {};
  alignas(64) float direction[3][most] = {};
  alignas(64) float from[most], to[most];
  /// Whether rays may begin within capsules or past them. If not, a ray that is past a capsule at
  /// `from` is said to meet it there.
  bool starts = true;
  /// A line, with a direction of length 1, and how far any ray is from it within its [from, to].
  float centre[3] = {}, along[3] = {};
  float spread = 0;
  /// Where along that line rays may meet what is asked for; capsules that they meet elsewhere may
  /// be left out.
  float near = -std::numeric_limits<float>::infinity();
  float far = std::numeric_limits<float>::infinity();
  /// Whether all rays have the direction `along`.
  bool is_parallel = false;
};

/// For each ray of a packet where it may first meet a capsule, and where one with another id: lower
/// bounds, at least `from`; infinite where there is none.
struct PacketHits {
  alignas(64) float first[RayPacket::most], second[RayPacket::most];
  alignas(64) uint32_t id[RayPacket::most];  ///< of the first

  void clear();
};

/// Ids of capsules that a packet was asked about, if they were not crowded out.
class SeenIds {
 public:
  void clear() { std::fill(std::begin(ids_), std::end(ids_), UINT32_MAX); }
  /// Whether it is new; then it is kept.
  bool add(uint32_t id) {
    uint32_t& place = ids_[(id ^ id >> 13) % std::size(ids_)];
    if (place == id) return false;
    place = id;
    return true;
  }

 private:
  uint32_t ids_[256];
};

/// Coordinates of rays and capsules may be up to 8, and their rounding and that of these functions
/// then amounts to less than this in the radius and in t.
constexpr float capsule_ray_slack = 4e-5f;

/// Adds a list of capsules to what the rays meet. `corner` is where the list's coordinates are
/// from, in the rays'. No ray that meets a capsule in [from, to] is left without it, and its bound
/// is at most the t of that; some may be found that are missed by less than twice the slack.
/// Capsules that were `seen` are left out, and those that are asked about are added to it; null:
/// none are.
void meet_capsules(const CapsuleView& capsules, float radius, const float (&corner)[3],
                   const RayPacket& rays, SeenIds* seen, PacketHits& hits);

/// The points origin + t direction of one ray, for t in [0, to], from where the coordinates of a
/// list are; directions of length 1.
struct CapsuleRay {
  float origin[3], direction[3];
  float to;
};
/// Writes the ids of the capsules that a ray meets there, and of some that it misses by less than
/// twice the slack or that lie next to its ends, and returns how many. There is room for
/// capsules.count + capsule_padding.
size_t capsules_on_ray(const CapsuleView& capsules, float radius, const CapsuleRay& ray,
                       uint32_t* ids);

}  // namespace msq
