// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/beyond_faces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "structure/foam/beyond_faces.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int side = beyond_faces_side;
/// With the cells around the brick.
constexpr int wide = side + 2;
/// Boxes of a cell along each axis.
constexpr int cuts = 4, boxes = cuts * cuts * cuts;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

class Finder {
 public:
  Finder(const SeedBlock& block, Vec3 scale, double around) {
    for (int axis = 0; axis < 3; ++axis) {
      size_[axis] = static_cast<float>(scale[axis]);
      around_[axis] = static_cast<float>(around);
      half_[axis] = (0.5f * size_[axis] + around_[axis]) / cuts;
    }
    diagonal_ = std::sqrt(half_[0] * half_[0] + half_[1] * half_[1] + half_[2] * half_[2]);
    for (int i = 0; i < boxes; ++i) {
      const int box[3] = {i & 3, (i >> 2 & 1) + 2 * (i >> 4 & 1), (i >> 3 & 1) + 2 * (i >> 5)};
      for (int axis = 0; axis < 3; ++axis)
        middle_[axis][i] = half_[axis] * static_cast<float>(2 * box[axis] - cuts + 1);
    }
    for (int z = 0, i = 0; z < wide; ++z)
      for (int y = 0; y < wide; ++y)
        for (int x = 0; x < wide; ++x, ++i) {
          const Vec3 p = block.position(block.index(x - 1, y - 1, z - 1));
          for (int axis = 0; axis < 3; ++axis) seed_[axis][i] = static_cast<float>(p[axis]);
        }
  }

  uint8_t cell(int x, int y, int z) {
    const int at[3] = {x, y, z};
    uint8_t beyond = 0, asked = 0;
    for (int axis = 0; axis < 3; ++axis)
      (at[axis] == 0 || at[axis] == side - 1 ? beyond : asked) |= static_cast<uint8_t>(1 << axis);
    if (!asked) return beyond;
    // Seeds of the cells around, from the cell's middle.
    for (int i = 0; i < 27; ++i) {
      const int from = ((z + i / 9) * wide + y + i / 3 % 3) * wide + x + i % 3;
      for (int axis = 0; axis < 3; ++axis)
        near_[axis][i] = seed_[axis][from] - (static_cast<float>(at[axis]) + 0.5f) * size_[axis];
    }
    const D d;
    for (size_t i = 0; i < boxes; i += hn::Lanes(d)) {
      nearest(i);
      for (int axis = 0; axis < 3; ++axis)
        if (asked >> axis & 1 && may_be_beyond(i, axis, at)) {
          beyond |= static_cast<uint8_t>(1 << axis);
          asked &= static_cast<uint8_t>(~(1 << axis));
        }
      if (!asked) break;
    }
    return beyond;
  }

 private:
  /// Room for roundings of squares, coordinates below 8.
  static constexpr float slack = 1e-4f;

  /// Finds the seeds nearest to the middles of the boxes from i on, of the twelve cells next to the
  /// quarter of the cell, across x, that the boxes are in.
  void nearest(size_t i) {
    const D d;
    const V x = hn::Load(d, middle_[0] + i), y = hn::Load(d, middle_[1] + i),
            z = hn::Load(d, middle_[2] + i);
    V best = hn::Set(d, 1e6f), best_x = x, best_y = y, best_z = z;
    const int first_y = i / 16 % 2 ? 1 : 0, first_z = i / 32 ? 1 : 0;
    for (int k = 0; k < 12; ++k) {
      const int n = ((first_z + k / 6) * 3 + first_y + k / 3 % 2) * 3 + k % 3;
      const V sx = hn::Set(d, near_[0][n]), sy = hn::Set(d, near_[1][n]),
              sz = hn::Set(d, near_[2][n]);
      const V squared = distance_squared(hn::Sub(sx, x), hn::Sub(sy, y), hn::Sub(sz, z));
      const auto is_nearer = hn::Lt(squared, best);
      best = hn::Min(best, squared);
      best_x = hn::IfThenElse(is_nearer, sx, best_x);
      best_y = hn::IfThenElse(is_nearer, sy, best_y);
      best_z = hn::IfThenElse(is_nearer, sz, best_z);
    }
    hn::Store(best, d, best_squared_);
    hn::Store(best_x, d, best_[0]);
    hn::Store(best_y, d, best_[1]);
    hn::Store(best_z, d, best_[2]);
  }

  /// Whether a seed beyond the face across an axis may be the nearest to a point of these boxes.
  bool may_be_beyond(size_t i, int axis, const int (&at)[3]) const {
    const D d;
    const bool is_low = at[axis] < side / 2;
    const V best = hn::Load(d, best_squared_);
    // No point of a box has its nearest seed farther than this.
    const V farthest = hn::Add(hn::Sqrt(best), hn::Set(d, diagonal_ + slack));
    const V middle = hn::Load(d, middle_[axis] + i);
    const V to_face =
        hn::Sub(hn::Set(d, 1.5f * size_[axis] - half_[axis]), is_low ? hn::Neg(middle) : middle);
    const auto rest = hn::Ge(farthest, to_face);
    if (hn::AllFalse(d, rest)) return false;
    // Seeds beyond the face are those of nine cells, or farther than this.
    const int other[2] = {(axis + 1) % 3, (axis + 2) % 3};
    const float gap = size_[axis] - around_[axis];
    const float aside = std::min(size_[other[0]], size_[other[1]]) - around_[axis];
    if (!(gap > 0 && aside > 0)) return true;
    const float known =
        std::min(2 * size_[axis] - around_[axis], std::sqrt(gap * gap + aside * aside));
    if (!hn::AllTrue(d, hn::Lt(farthest, hn::Set(d, known)))) return true;
    const V x = hn::Load(d, middle_[0] + i), y = hn::Load(d, middle_[1] + i),
            z = hn::Load(d, middle_[2] + i);
    const V best_x = hn::Load(d, best_[0]), best_y = hn::Load(d, best_[1]),
            best_z = hn::Load(d, best_[2]);
    const V wx = hn::Set(d, 2 * half_[0]), wy = hn::Set(d, 2 * half_[1]),
            wz = hn::Set(d, 2 * half_[2]);
    for (int v = -1; v <= 1; ++v)
      for (int u = -1; u <= 1; ++u) {
        int cell[3];
        cell[axis] = is_low ? -1 : side;
        cell[other[0]] = at[other[0]] + u;
        cell[other[1]] = at[other[1]] + v;
        const int n = ((cell[2] + 1) * wide + cell[1] + 1) * wide + cell[0] + 1;
        const auto place = [&](int a) {
          return hn::Set(d, seed_[a][n] - (static_cast<float>(at[a]) + 0.5f) * size_[a]);
        };
        const V sx = place(0), sy = place(1), sz = place(2);
        // The difference of squared distances, which is linear, is least at a corner of the box.
        const V squared = distance_squared(hn::Sub(sx, x), hn::Sub(sy, y), hn::Sub(sz, z));
        const V change = hn::MulAdd(hn::Abs(hn::Sub(sx, best_x)), wx,
                                    hn::MulAdd(hn::Abs(hn::Sub(sy, best_y)), wy,
                                               hn::Mul(hn::Abs(hn::Sub(sz, best_z)), wz)));
        const V least = hn::Sub(hn::Sub(squared, best), change);
        if (!hn::AllFalse(d, hn::And(rest, hn::Le(least, hn::Set(d, slack))))) return true;
      }
    return false;
  }

  static HWY_INLINE V distance_squared(V x, V y, V z) {
    return hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  }

  float size_[3], around_[3], half_[3], diagonal_;
  /// Boxes come in quarters of the cell across x, 16 each: that of the lower y and z first.
  alignas(64) float middle_[3][boxes];
  float seed_[3][wide * wide * wide], near_[3][27];
  alignas(64) float best_squared_[16], best_[3][16];
};

void find(const SeedBlock& block, Vec3 scale, double around, BeyondFaces& found) {
  Finder finder(block, scale, around);
  size_t i = 0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) found[i++] = finder.cell(x, y, z);
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(find);

BeyondFaces find_beyond_faces(const SeedBlock& block, Vec3 scale, double around) {
  BeyondFaces found;
  HWY_DYNAMIC_DISPATCH(find)(block, scale, around, found);
  return found;
}

}  // namespace msq
#endif
