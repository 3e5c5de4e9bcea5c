// SPDX-License-Identifier: Apache-2.0
// Seeds are excluded for the eighth; the remaining ones for cells; and the remaining ones of those
// for boxes. A box is cut into eight if its seeds may own edges from a brick that is not
// yet found, up to a maximum depth.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/rays/owning_bricks.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>
#include <memory>

#include "base/compress-inl.h"
#include "structure/foam/rays/owning_bricks.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

constexpr int side = owning_bricks_side;
constexpr int half_side = side / 2;
/// Cells around a cell that may contain the nearest seed to a point near it; the same plus the
/// eighth.
constexpr int out = 2, wide = half_side + 2 * out;
/// Depth of the subdivision of a cell into eight boxes each.
constexpr int cuts = 2;

using D = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;

/// Seeds in the order of their cells, relative to the brick's middle.
struct Seeds {
  static constexpr size_t padding = 16, room = wide * wide * wide + padding;
  alignas(64) float x[room], y[room], z[room];
  /// Squared distance from the origin.
  alignas(64) float squared[room];
  /// Bit i for the brick of bit i of a cell's; bit 0 for the brick itself.
  alignas(64) uint32_t brick[room];
  size_t count = 0;

  void add(const Vec3& p, uint32_t of_brick) {
    x[count] = static_cast<float>(p.x);
    y[count] = static_cast<float>(p.y);
    z[count] = static_cast<float>(p.z);
    squared[count] = x[count] * x[count] + y[count] * y[count] + z[count] * z[count];
    brick[count++] = of_brick;
  }
  /// Adds those of another list, from number i on, that are in a mask.
  HWY_INLINE void add(const Seeds& from, size_t i, hn::Mask<D> mask) {
    const D d;
    const DU du;
    const Compression<D> compressed(mask);
    const size_t end = count;
    hn::StoreU(compressed(hn::Load(d, from.x + i)), d, x + end);
    hn::StoreU(compressed(hn::Load(d, from.y + i)), d, y + end);
    hn::StoreU(compressed(hn::Load(d, from.z + i)), d, z + end);
    hn::StoreU(compressed(hn::Load(d, from.squared + i)), d, squared + end);
    hn::StoreU(compressed(hn::Load(du, from.brick + i)), du, brick + end);
    count = end + hn::CountTrue(d, mask);
  }
  /// Adds seeds that are never the nearest, to fill the last vector.
  void pad() {
    const D d;
    for (float* v : {x, y, z}) hn::StoreU(hn::Zero(d), d, v + count);
    hn::StoreU(hn::Set(d, no_power), d, squared + count);
    hn::StoreU(hn::Zero(DU()), DU(), brick + count);
  }
  static constexpr float no_power = 1e6f;
};

struct Box {
  float middle[3], half[3];
};

class Finder {
 public:
  Finder(const FoamSeeds& seeds, CellIndex corner, unsigned eighth, double around)
      : around_(static_cast<float>(around)) {
    const Vec3 scale = seeds.scale(), middle = scale * (0.5 * side);
    for (int axis = 0; axis < 3; ++axis) {
      size_[axis] = static_cast<float>(scale[axis]);
      first_[axis] = eighth >> axis & 1 ? half_side : 0;
      outside_[axis] = first_[axis] ? 1.0f : -1.0f;
    }
    const auto is_beyond = [](int cell) { return cell < 0 || cell >= side; };
    for (int z = first_[2] - out; z < first_[2] + half_side + out; ++z)
      for (int y = first_[1] - out; y < first_[1] + half_side + out; ++y) {
        const uint64_t row_key = seeds.row_key(corner, y, z);
        for (int x = first_[0] - out; x < first_[0] + half_side + out; ++x) {
          const int across = is_beyond(x) | is_beyond(y) << 1 | is_beyond(z) << 2;
          all_.add(seeds.in_row(row_key, corner, x, y, z) - middle, uint32_t{1} << across);
        }
      }
    all_.pad();
  }

  uint64_t find() {
    // All cells of an eighth of the brick have the same neighbouring bricks.
    keep_nearest(all_, box(first_, half_side), of_eighth_);
    uint64_t found = 0;
    for (int cell = 0; cell < 8; ++cell) {
      const int at[3] = {first_[0] + (cell & 1), first_[1] + (cell >> 1 & 1),
                         first_[2] + (cell >> 2)};
      found |= uint64_t{cell_bricks(at)} << (8 * cell);
    }
    return found;
  }

 private:
  /// Slack for roundings of powers, coordinates up to 4.
  static constexpr float slack = 1e-4f;
  /// Seeds that fit a mask: a cell has more only if struts are very thick.
  static constexpr size_t most = 64;

  /// The box of `count` cells along each axis, grown.
  Box box(const int (&first)[3], int count) const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.middle[axis] =
          (static_cast<float>(first[axis]) + 0.5f * static_cast<float>(count - side)) * size_[axis];
      box.half[axis] = 0.5f * static_cast<float>(count) * size_[axis] + around_;
    }
    return box;
  }

  uint8_t cell_bricks(const int (&at)[3]) {
    // Nearly all cells at a face need the brick beyond it, so this is assumed. The exception is the
    // face of high z: for an owner beyond it, both other seeds of its edge are there, too.
    found_ = 1;
    for (int axis = 0; axis < 3; ++axis)
      if (at[axis] == 0 || (at[axis] == side - 1 && axis < 2)) found_ |= 1u << (1 << axis);
    const Box all = box(at, 1);
    keep_nearest(of_eighth_, all, of_boxes_[0]);
    const size_t count = of_boxes_[0].count;
    if (count > most) return 0xff;
    cut(0, ~uint64_t{0} >> (most - count), all, cuts);
    return static_cast<uint8_t>(found_);
  }

  /// Fills `kept` with the seeds that may be the nearest to a point of a box.
  void keep_nearest(const Seeds& seeds, const Box& box, Seeds& kept) {
    kept.count = 0;
    for_nearer(seeds, box, nearest(seeds, box),
               [&](size_t i, hn::Mask<D> mask) { kept.add(seeds, i, mask); });
    kept.pad();
  }
  /// The same as a mask, for seeds whose number fits a mask.
  HWY_INLINE uint64_t find_nearer(const Seeds& seeds, const Box& box, size_t other) const {
    uint64_t bits = 0;
    for_nearer(seeds, box, other,
               [&](size_t i, hn::Mask<D> mask) { bits |= bits_of(D(), mask) << i; });
    return bits;
  }

  /// Finds the seed nearest to the middle of a box. A seed's power is the square of its distance
  /// minus that of the origin.
  HWY_INLINE size_t nearest(const Seeds& seeds, const Box& box) {
    const D d;
    const size_t lanes = hn::Lanes(d);
    const V x = hn::Set(d, -2 * box.middle[0]), y = hn::Set(d, -2 * box.middle[1]),
            z = hn::Set(d, -2 * box.middle[2]);
    V least = hn::Set(d, Seeds::no_power);
    auto at = hn::Zero(DU());
    for (size_t i = 0; i < seeds.count; i += lanes) {
      const V power = hn::MulAdd(
          hn::Load(d, seeds.x + i), x,
          hn::MulAdd(hn::Load(d, seeds.y + i), y,
                     hn::MulAdd(hn::Load(d, seeds.z + i), z, hn::Load(d, seeds.squared + i))));
      hn::Store(power, d, powers_ + i);
      const auto is_less = hn::Lt(power, least);
      least = hn::Min(least, power);
      at = hn::IfThenElse(hn::RebindMask(DU(), is_less), hn::Set(DU(), static_cast<uint32_t>(i)),
                          at);
    }
    const auto lane =
        static_cast<size_t>(hn::FindKnownFirstTrue(d, hn::Eq(least, hn::MinOfLanes(d, least))));
    alignas(64) uint32_t numbers[16];
    hn::Store(at, DU(), numbers);
    return numbers[lane] + lane;
  }

  /// Calls visit(i, mask) for the seeds from number i on that are as near to some point of a box as
  /// the seed `other`. Call it after nearest(), whose powers it uses. The difference of two powers
  /// is linear, so its minimum is at a corner of the box.
  template <class Visit>
  HWY_INLINE void for_nearer(const Seeds& seeds, const Box& box, size_t other,
                             Visit&& visit) const {
    const D d;
    const V x = hn::Set(d, seeds.x[other]), y = hn::Set(d, seeds.y[other]),
            z = hn::Set(d, seeds.z[other]), power = hn::Set(d, powers_[other] + slack);
    const V wide_x = hn::Set(d, 2 * box.half[0]), wide_y = hn::Set(d, 2 * box.half[1]),
            wide_z = hn::Set(d, 2 * box.half[2]);
    for (size_t i = 0; i < seeds.count; i += hn::Lanes(d)) {
      const V from_x = hn::Abs(hn::Sub(hn::Load(d, seeds.x + i), x)),
              from_y = hn::Abs(hn::Sub(hn::Load(d, seeds.y + i), y)),
              from_z = hn::Abs(hn::Sub(hn::Load(d, seeds.z + i), z));
      const V limit =
          hn::MulAdd(from_x, wide_x, hn::MulAdd(from_y, wide_y, hn::MulAdd(from_z, wide_z, power)));
      visit(i, hn::Le(hn::Load(d, powers_ + i), limit));
    }
  }

  /// Finds the bricks for a box. `of_box` selects its seeds from a list.
  void cut(size_t list, uint64_t of_box, const Box& box, int deeper) {
    if (is_worth_copying(of_boxes_[list], of_box)) {
      copy(of_boxes_[list], of_box, of_boxes_[list + 1]);
      of_box = ~uint64_t{0} >> (most - of_boxes_[++list].count);
    }
    const Seeds& seeds = of_boxes_[list];
    uint32_t before = found_;
    uint64_t left = ~of_found(seeds);
    if (!(possible_owners(of_box) & left)) return;
    // All parts are computed before their results are used, so that they do not wait for each
    // other.
    Box parts[8];
    uint64_t of_parts[8];
    for (unsigned n = 0; n < 8; ++n) {
      parts[n] = part(box, n);
      of_parts[n] = of_box & find_nearer(seeds, parts[n], nearest(seeds, parts[n]));
    }
    for (unsigned n = 0; n < 8; ++n) {
      if (!(possible_owners(of_parts[n]) & left)) continue;
      if (deeper > 1)
        cut(list, of_parts[n], parts[n], deeper - 1);
      else
        add_owners(seeds, of_parts[n], parts[n]);
      if (found_ == before) continue;
      before = found_;
      left = ~of_found(seeds);
    }
  }
  /// An eighth of a box; the outermost of the brick comes first, because it finds most.
  Box part(const Box& box, unsigned n) const {
    Box part;
    for (int axis = 0; axis < 3; ++axis) {
      const float half = 0.5f * box.half[axis];
      part.half[axis] = half;
      part.middle[axis] = box.middle[axis] + (n >> axis & 1 ? -half : half) * outside_[axis];
    }
    return part;
  }

  /// Compares all pairs of a box's seeds, and adds the remaining bricks.
  void add_owners(const Seeds& seeds, uint64_t of_box, const Box& box) {
    nearest(seeds, box);
    for (uint64_t rest = of_box; rest; rest &= rest - 1)
      of_box &= find_nearer(seeds, box, static_cast<size_t>(std::countr_zero(rest)));
    for (uint64_t owners = possible_owners(of_box); owners; owners &= owners - 1)
      found_ |= seeds.brick[std::countr_zero(owners)];
  }

  /// The seeds of a box that come before at least two others.
  static uint64_t possible_owners(uint64_t seeds) {
    seeds ^= std::bit_floor(seeds);
    return seeds ^ std::bit_floor(seeds);
  }
  /// The seeds of a list whose bricks are already found.
  HWY_INLINE uint64_t of_found(const Seeds& seeds) const {
    const DU d;
    const auto found = hn::Set(d, found_);
    uint64_t bits = 0;
    for (size_t i = 0; i < seeds.count; i += hn::Lanes(d))
      bits |= bits_of(d, hn::TestBit(found, hn::Load(d, seeds.brick + i))) << i;
    return bits;
  }

  /// Whether copying some seeds of a list reduces the number of vectors.
  static bool is_worth_copying(const Seeds& seeds, uint64_t some) {
    const size_t lanes = hn::Lanes(D()), count = static_cast<size_t>(std::popcount(some));
    return (count + lanes - 1) / lanes < (seeds.count + lanes - 1) / lanes;
  }
  static void copy(const Seeds& seeds, uint64_t some, Seeds& copies) {
    const D d;
    copies.count = 0;
    for (size_t i = 0; i < seeds.count; i += hn::Lanes(d))
      copies.add(seeds, i, lanes_of(d, some >> i));
    copies.pad();
  }

  float size_[3], around_;
  int first_[3];  // cell of the eighth
  Seeds all_, of_eighth_, of_boxes_[cuts + 1];
  /// The direction of the brick's faces next to the eighth.
  float outside_[3];
  /// For the current cell.
  uint32_t found_ = 0;
  alignas(64) float powers_[Seeds::room];
};

uint64_t find(const FoamSeeds& seeds, CellIndex corner, unsigned eighth, double around) {
  // On the heap: too large for the stacks of a host's threads.
  return std::make_unique<Finder>(seeds, corner, eighth, around)->find();
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(find);

uint64_t find_owning_bricks(const FoamSeeds& seeds, CellIndex corner, unsigned eighth,
                            double around) {
  return HWY_DYNAMIC_DISPATCH(find)(seeds, corner, eighth, around);
}

}  // namespace msq
#endif
