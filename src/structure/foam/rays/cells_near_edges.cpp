// SPDX-License-Identifier: Apache-2.0
// Most edges reach into at most two cells along each axis. Then eight cells, or those of them that
// exist, are tested at once.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/rays/cells_near_edges.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "base/compress-inl.h"
#include "structure/foam/rays/cells_near_edges.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Slack for rounding of products of coordinates.
constexpr float slack = 1e-5f;

/// For a block of edges: their middles; half the vectors from end to end; the maximum distance of a
/// grown cell along the normal of each separating plane; and the cells of their boxes.
struct Block {
  static constexpr size_t most = 64;
  alignas(64) float middle[3][most], half[3][most], limit[3][most];
  alignas(64) int32_t first[3][most], last[3][most];
};

void measure(const EdgeEnds& edges, size_t begin, size_t end, const CellBox& box, float reach,
             Block& block) {
  const hn::CappedTag<float, 16> d;
  const hn::RebindToSigned<decltype(d)> di;
  const auto half = hn::Set(d, 0.5f), out = hn::Set(d, reach);
  for (size_t i = begin; i < end; i += hn::Lanes(d)) {
    const size_t at = i - begin;
    for (size_t axis = 0; axis < 3; ++axis) {
      const auto a = hn::LoadU(d, edges.values(axis) + i);
      const auto b = hn::LoadU(d, edges.values(axis + 3) + i);
      const auto to_cell = hn::Set(d, 1 / box.size[axis]);
      const auto low = hn::Floor(hn::Mul(hn::Sub(hn::Min(a, b), out), to_cell));
      const auto high = hn::Floor(hn::Mul(hn::Add(hn::Max(a, b), out), to_cell));
      const auto least = hn::Set(di, box.first[axis]);
      const auto most = hn::Set(di, box.first[axis] + box.count[axis] - 1);
      hn::Store(hn::Max(hn::ConvertTo(di, low), least), di, block.first[axis] + at);
      hn::Store(hn::Min(hn::ConvertTo(di, high), most), di, block.last[axis] + at);
      hn::Store(hn::Mul(half, hn::Add(a, b)), d, block.middle[axis] + at);
      hn::Store(hn::Mul(half, hn::Sub(b, a)), d, block.half[axis] + at);
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto extent_u = hn::Set(d, 0.5f * box.size[u] + reach);
      const auto extent_v = hn::Set(d, 0.5f * box.size[v] + reach);
      const auto wide_u = hn::Abs(hn::Load(d, block.half[u] + at));
      const auto wide_v = hn::Abs(hn::Load(d, block.half[v] + at));
      hn::Store(hn::MulAdd(extent_u, wide_v, hn::MulAdd(extent_v, wide_u, hn::Set(d, slack))), d,
                block.limit[axis] + at);
    }
  }
}

/// Finds cells in groups of two along each axis, by whether a segment comes near them.
class Eight {
 public:
  /// Cells that are written at once.
  static constexpr size_t most = 8;

  explicit Eight(const CellBox& box) {
    const auto across = static_cast<uint32_t>(box.count[0]);
    const uint32_t steps[3] = {1, across, across * static_cast<uint32_t>(box.count[1])};
    for (size_t lane = 0; lane < most; ++lane) {
      step_[lane] = 0;
      for (size_t axis = 0; axis < 3; ++axis) {
        const bool is_second = lane >> axis & 1;
        offset_[axis][lane] = is_second ? box.size[axis] : 0;
        step_[lane] += is_second ? steps[axis] : 0;
      }
    }
    // For axes along which only the first cell exists.
    for (uint32_t alone = 0; alone < 8; ++alone)
      for (uint32_t lane = 0; lane < most; ++lane) is_there_[alone][lane] = lane & alone ? 0 : 1;
  }

  /// Writes the cells that edge i of the block comes near, among those from `cell` on, whose number
  /// is `number`, and arbitrary ones up to `most`. Returns their number. `alone` has the bits of
  /// the axes along which the first cell is the last.
  HWY_INLINE size_t find(const Block& block, size_t i, uint32_t edge, const CellBox& box,
                         const int (&cell)[3], uint32_t number, uint32_t alone,
                         NearCell* found) const {
    const D d;
    const DU du;
    size_t count = 0;
    for (size_t lane = 0; lane < most; lane += hn::Lanes(d)) {
      hn::Vec<D> p[3], half[3];
      for (size_t axis = 0; axis < 3; ++axis) {
        const float from = (static_cast<float>(cell[axis]) + 0.5f) * box.size[axis];
        p[axis] =
            hn::Sub(hn::Set(d, block.middle[axis][i] - from), hn::Load(d, offset_[axis] + lane));
        half[axis] = hn::Set(d, block.half[axis][i]);
      }
      auto is_near = hn::Le(hn::Abs(hn::MulSub(p[1], half[2], hn::Mul(p[2], half[1]))),
                            hn::Set(d, block.limit[0][i]));
      is_near = hn::And(is_near, hn::Le(hn::Abs(hn::MulSub(p[2], half[0], hn::Mul(p[0], half[2]))),
                                        hn::Set(d, block.limit[1][i])));
      is_near = hn::And(is_near, hn::Le(hn::Abs(hn::MulSub(p[0], half[1], hn::Mul(p[1], half[0]))),
                                        hn::Set(d, block.limit[2][i])));
      is_near = hn::And(
          is_near, hn::RebindMask(d, hn::Ne(hn::Load(du, is_there_[alone] + lane), hn::Zero(du))));
      const Compression<D> compressed(is_near);
      const auto cells = hn::Add(hn::Set(du, number), hn::Load(du, step_ + lane));
      hn::StoreInterleaved2(compressed(cells), hn::Set(du, edge), du,
                            reinterpret_cast<uint32_t*>(found + count));
      count += hn::CountTrue(d, is_near);
    }
    return count;
  }

 private:
  using D = hn::CappedTag<float, most>;
  using DU = hn::RebindToUnsigned<D>;
  alignas(32) float offset_[3][most];
  alignas(32) uint32_t step_[most], is_there_[8][most];
};

void find(const EdgeEnds& edges, const CellBox& box, float reach, std::vector<NearCell>& found) {
  const auto across = static_cast<uint32_t>(box.count[0]);
  const uint32_t layer = across * static_cast<uint32_t>(box.count[1]);
  const Eight eight(box);
  Block block;
  size_t found_count = 0;
  const size_t count = edges.count();
  for (size_t begin = 0; begin < count; begin += Block::most) {
    const size_t end = std::min(count, begin + Block::most);
    measure(edges, begin, end, box, reach, block);
    for (size_t i = 0; i < end - begin; ++i) {
      int cell[3];
      for (cell[2] = block.first[2][i]; cell[2] <= block.last[2][i]; cell[2] += 2)
        for (cell[1] = block.first[1][i]; cell[1] <= block.last[1][i]; cell[1] += 2)
          for (cell[0] = block.first[0][i]; cell[0] <= block.last[0][i]; cell[0] += 2) {
            uint32_t alone = 0;
            for (size_t axis = 0; axis < 3; ++axis)
              alone |= uint32_t{cell[axis] == block.last[axis][i]} << axis;
            const uint32_t number = static_cast<uint32_t>(cell[2] - box.first[2]) * layer +
                                    static_cast<uint32_t>(cell[1] - box.first[1]) * across +
                                    static_cast<uint32_t>(cell[0] - box.first[0]);
            if (found.size() < found_count + Eight::most)
              found.resize(2 * found_count + Eight::most);
            found_count += eight.find(block, i, static_cast<uint32_t>(begin + i), box, cell, number,
                                      alone, found.data() + found_count);
          }
    }
  }
  found.resize(found_count);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(find);

void find_cells_near_edges(const EdgeEnds& edges, const CellBox& box, float reach,
                           std::vector<NearCell>& found) {
  HWY_DYNAMIC_DISPATCH(find)(edges, box, reach, found);
}

}  // namespace msq
#endif
