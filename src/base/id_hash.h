// SPDX-License-Identifier: Apache-2.0
// Ids of 128 bits, and ids made from many numbers. Two sums, each a bijection of its state for each
// number taken, so ids of unlike numbers are equal with a probability of about 2^-128.
#pragma once

#include <bit>
#include <cstdint>

#include "base/random.h"
#include "base/vec.h"

namespace msq {

struct Id {
  uint64_t low = 0, high = 0;

  friend bool operator==(Id a, Id b) { return a.low == b.low && a.high == b.high; }
  friend bool operator<(Id a, Id b) { return a.high != b.high ? a.high < b.high : a.low < b.low; }
};

class IdHash {
 public:
  /// `kind` keeps ids of unlike things apart.
  explicit IdHash(uint64_t kind) { add(kind); }

  void add(uint64_t number) {
    low_ = splitmix_finalise((low_ ^ number) + 0x9e3779b97f4a7c15ULL);
    high_ = splitmix_finalise((std::rotl(high_, 29) ^ (number * 0xd6e8feb86659fd93ULL)) +
                              0xc2b2ae3d27d4eb4fULL);
  }
  /// 0 and -0 are equal.
  void add(double number) { add(std::bit_cast<uint64_t>(number + 0.0)); }
  void add(Vec3 v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  Id id() const { return {low_, high_}; }

 private:
  uint64_t low_ = 0x243f6a8885a308d3ULL, high_ = 0x13198a2e03707344ULL;
};

}  // namespace msq
