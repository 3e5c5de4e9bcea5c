// SPDX-License-Identifier: Apache-2.0
// Beams as input, and as stored: in the order of the tree over them.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/simd.h"
#include "structure/beams/beam.h"

namespace msq {

struct BeamSource {
  uint64_t count = 0;  ///< below 2^31
  /// Gets beam i, for i < count. Returns false if the beam is to be left out, which is required if
  /// it has no solid. Several threads call this at once.
  std::function<bool(uint64_t i, Beam& beam)> get;
};

/// A beam that equals one before it in the source.
struct BeamRepeat {
  uint32_t place;   ///< of the other beam, in the order of the tree
  uint32_t number;  ///< in the source
  friend auto operator<=>(const BeamRepeat&, const BeamRepeat&) = default;
};

class BeamList {
 public:
  /// `caps`: the caps of all beams, or null if they differ.
  BeamList(size_t count, const BeamCap* caps) : kept_(count), has_caps_(!caps) {
    if (has_caps_)
      caps_.resize(2 * count);
    else
      common_[0] = caps[0], common_[1] = caps[1];
  }
  static uint64_t bytes(uint64_t count, bool has_caps) {
    return count * (sizeof(Kept) + (has_caps ? 2 * sizeof(BeamCap) : 0));
  }

  size_t size() const { return kept_.size(); }
  Beam at(size_t i) const {
    const Kept& kept = kept_[i];
    const BeamCap* caps = has_caps_ ? caps_.data() + 2 * i : common_;
    return {kept.a, kept.b, kept.radius_a, kept.radius_b, caps[0], caps[1]};
  }
  /// Prefetches beams [begin, end), which at() will read soon.
  HWY_INLINE void prefetch(size_t begin, size_t end) const {
    for (size_t i = begin; i < end; ++i) hwy::Prefetch(kept_.data() + i);
  }
  /// Several threads may set different beams at once.
  void set(size_t i, const Beam& beam) {
    kept_[i] = {beam.a, beam.b, beam.radius_a, beam.radius_b};
    if (!has_caps_) return;
    caps_[2 * i] = beam.cap_a;
    caps_[2 * i + 1] = beam.cap_b;
  }

 private:
  struct Kept {
    Vec3 a, b;
    double radius_a, radius_b;
  };
  static_assert(sizeof(Kept) == 64);

  std::vector<Kept> kept_;
  bool has_caps_;
  BeamCap common_[2] = {};
  std::vector<BeamCap> caps_;
};

}  // namespace msq
