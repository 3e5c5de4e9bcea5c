// SPDX-License-Identifier: Apache-2.0
// The rows that meet the void of a cell, layer by layer. Included once for each instruction set.
//
// A row has a sample between each plane on the left and each on the right (Fourier and Motzkin):
// two such planes bound y in a layer. Of a cell of 16 samples, whose box has 18 x 18 rows, a third
// of the rows meet no void.
#if defined(MSQ_STRUCTURE_FOAM_WALLS_ROWS_MET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_FOAM_WALLS_ROWS_MET_INL_H
#undef MSQ_STRUCTURE_FOAM_WALLS_ROWS_MET_INL_H
#else
#define MSQ_STRUCTURE_FOAM_WALLS_ROWS_MET_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "base/compress-inl.h"
#include "structure/foam/walls/void_work.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

/// Bounds from two planes count if the difference of their slopes is at least this part of their
/// numbers. Each of these is off by at most 2^-21 of itself, coordinates are below 4, and so the
/// bound is off by less than 2^-12 foam units, the room that bounds have.
constexpr float min_difference = 0x1p-7f, bound_room = 0x1p-12f;

HWY_INLINE void bound_rows(VoidWork& work) {
  const hn::CappedTag<float, 8> d;
  const size_t lanes = hn::Lanes(d);
  const SidePlanes &right = work.right, &left = work.left;
  const size_t room = right.count * (left.count + lanes) + lanes;
  if (work.up_base.size() < room)
    for (std::vector<float>* v : {&work.up_base, &work.up_slope, &work.down_base, &work.down_slope})
      v->resize(room);
  size_t ups = 0, downs = 0;
  for (size_t r = 0; r < right.count; ++r) {
    const auto base_r = hn::Set(d, right.base[r] + right.shift[r]),
               y_r = hn::Set(d, right.y_slope[r]), z_r = hn::Set(d, right.z_slope[r]);
    const auto size_r = hn::Set(d, std::abs(right.base[r]) + std::abs(right.shift[r]) +
                                       std::abs(right.y_slope[r]) + std::abs(right.z_slope[r]));
    for (size_t l = 0; l < left.count; l += lanes) {
      const auto base_l = hn::LoadU(d, &left.base[l]), shift_l = hn::LoadU(d, &left.shift[l]),
                 y_l = hn::LoadU(d, &left.y_slope[l]), z_l = hn::LoadU(d, &left.z_slope[l]);
      const auto size = hn::Add(hn::Add(size_r, hn::Add(hn::Abs(base_l), hn::Abs(shift_l))),
                                hn::Add(hn::Abs(y_l), hn::Abs(z_l)));
      const auto difference = hn::Sub(y_r, y_l);
      const auto counts =
          hn::And(hn::FirstN(d, left.count - l),
                  hn::Ge(hn::Abs(difference), hn::Mul(size, hn::Set(d, min_difference))));
      const auto inverse = hn::Div(hn::Set(d, 1), difference);
      const auto base = hn::Mul(hn::Sub(base_r, hn::Add(base_l, shift_l)), inverse),
                 slope = hn::Mul(hn::Sub(z_r, z_l), inverse);
      const auto put = [&](hn::Mask<decltype(d)> which, std::vector<float>& bases,
                           std::vector<float>& slopes, size_t& count) {
        const Compression<decltype(d)> chosen(which);
        hn::StoreU(chosen(base), d, &bases[count]);
        hn::StoreU(chosen(slope), d, &slopes[count]);
        count += hn::CountTrue(d, which);
      };
      const auto is_up = hn::Gt(difference, hn::Zero(d));
      put(hn::And(counts, is_up), work.up_base, work.up_slope, ups);
      put(hn::AndNot(is_up, counts), work.down_base, work.down_slope, downs);
    }
  }
  work.ups = ups;
  work.downs = downs;
}

/// Sets `first` and `count` of each layer. Returns false, and sets nothing, if rows are too close
/// or too many for single precision.
HWY_INLINE bool find_rows_met(const VoidRows& rows, VoidWork& work) {
  const hn::ScalableTag<float> d;
  const hn::RebindToSigned<decltype(d)> di;
  const size_t lanes = hn::Lanes(d);
  const float y0 = rows.y[0], extent = rows.y[rows.rows - 1] - y0;
  if (!(extent > 0x1p-20f) || rows.rows > size_t{1} << 22) return false;
  bound_rows(work);
  const auto all = static_cast<float>(rows.rows);
  const float per_unit = (all - 1) / extent;
  const auto zero = hn::Zero(d), most = hn::Set(d, all);
  for (size_t k = 0; k < rows.layers; k += lanes) {
    const auto z = hn::LoadU(d, rows.z + k);
    auto up = hn::Set(d, 8), down = hn::Set(d, -8);
    for (size_t i = 0; i < work.ups; ++i)
      up = hn::Min(up, hn::NegMulAdd(hn::Set(d, work.up_slope[i]), z, hn::Set(d, work.up_base[i])));
    for (size_t i = 0; i < work.downs; ++i)
      down = hn::Max(
          down, hn::NegMulAdd(hn::Set(d, work.down_slope[i]), z, hn::Set(d, work.down_base[i])));
    const auto row = [&](hn::Vec<decltype(d)> y, float room) {
      const auto at =
          hn::Mul(hn::Sub(hn::Add(y, hn::Set(d, room)), hn::Set(d, y0)), hn::Set(d, per_unit));
      return hn::Min(hn::Max(at, hn::Set(d, -1)), most);
    };
    const auto first = hn::Max(zero, hn::Ceil(row(down, -bound_room)));
    const auto end = hn::Min(most, hn::Add(hn::Floor(row(up, bound_room)), hn::Set(d, 1)));
    hn::StoreU(hn::ConvertTo(di, first), di, &work.first[k]);
    hn::StoreU(hn::ConvertTo(di, hn::Max(zero, hn::Sub(end, first))), di, &work.count[k]);
  }
  return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
