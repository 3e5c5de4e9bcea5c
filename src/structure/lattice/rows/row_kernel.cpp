// SPDX-License-Identifier: Apache-2.0
// In the plane across the rows, the axis of a strut, with its copies along the rows, projects to a
// segment. A row meets the strut if it comes within the radius r of that segment, and then in one
// interval of x, as a capsule is convex. Let a = (ax, ay, az) be the first end, d the vector to the
// other, (v, w) the row from a, e = v dy + w dz and A = dy^2 + dz^2. Points of the axis's line are
// at s = (x dx + e) / |d|^2 of d. The row is k = |v dz - w dy| / sqrt(A) from that line, and cuts
// the cylinder around it at x = dx e / A -+ sqrt((r^2 - k^2) |d|^2 / A). Where s < 0 or s > 1
// there, the sphere around that end gives the interval's end.
//
// Bounds. All is computed in double precision from coordinates of at most S (RowStruts::extent)
// with errors of a few 2^-53 S. So the error of squared distances and discriminants, times A /
// |d|^2, is less than 2^-48 S^2 for any direction: what is divided by A is a product with d across
// the row. For the level r + m, m = 2^-24 S, the squared radius is larger by 2 r m + m^2 > 2^-48
// S^2: the interval found contains that of r. In the same way the interval of r contains the one
// found for r - m. The error of the ends themselves, and of their buckets, is about 2^-50 S more,
// which is less than the m by which ends move at least.
//
// The samples of whole buckets within the inner interval are inside. The other samples of the outer
// interval, in whole buckets, are compared with the strut one by one: the error of the distance,
// from the difference vector, is less than 2^-48 S. Within the margin the predicate decides.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/lattice/rows/row_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/borrowed.h"
#include "base/mask_bits-inl.h"
#include "base/sample_grid.h"
#include "base/simd.h"
#include "structure/lattice/rows/copy_spans-inl.h"
#include "structure/lattice/rows/mark_section-inl.h"
#include "structure/lattice/rows/row_kernel.h"
#include "structure/lattice/rows/row_struts.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Doubles = hn::ScalableTag<double>;
using V = hn::Vec<Doubles>;

/// Squared distance of rows from the projection of a strut across them, from its end (0, 0) to
/// (dy, dz); inverse: 1 / A.
HWY_INLINE V flat_distance2(V v, V w, V dy, V dz, V inverse) {
  const Doubles d;
  const V along = hn::Mul(hn::MulAdd(v, dy, hn::Mul(w, dz)), inverse);
  const V t = hn::Min(hn::Max(along, hn::Zero(d)), hn::Set(d, 1.0));
  const V flat_v = hn::NegMulAdd(t, dy, v), flat_w = hn::NegMulAdd(t, dz, w);
  return hn::MulAdd(flat_v, flat_v, hn::Mul(flat_w, flat_w));
}

template <size_t section_words>
class SectionRows {
 public:
  SectionRows(const RowStruts& struts, const RowTask& task, RowWorkspace& workspace,
              std::vector<LeftSample>& left)
      : task_(task),
        workspace_(workspace),
        left_(left),
        size_(struts.cell_size[0]),
        to_buckets_(ColumnSets::buckets / size_),
        is_even_(task.is_even()) {}

  HWY_INLINE void draw(const RowStrut& strut);

 private:
  HWY_INLINE void draw_row(size_t lane, size_t row);
  HWY_INLINE void decide(size_t lane, size_t row, size_t samples);

  const RowTask& task_;
  RowWorkspace& workspace_;
  std::vector<LeftSample>& left_;
  const double size_, to_buckets_;
  const bool is_even_;

  // Of the current strut.
  double ax_, dx_, dy_, dz_, factor_, inverse_squared_;
  double w_;
  HWY_ALIGN double v_[max_simd_doubles];
  int32_t low_ = 0, high_ = 0;  // of the widest interval, in the current row
};

template <size_t section_words>
HWY_INLINE void SectionRows<section_words>::draw(const RowStrut& strut) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> di;
  const size_t lanes = hn::Lanes(d);
  ax_ = strut.a[0];
  dx_ = strut.ab[0];
  dy_ = strut.ab[1];
  dz_ = strut.ab[2];
  factor_ = strut.factor;
  w_ = task_.z - strut.a[2];
  const double across = dy_ * dy_ + dz_ * dz_, squared = dx_ * dx_ + across;
  const RowLevel widest = task_.levels[task_.widest];
  inverse_squared_ = squared > 0 ? 1 / squared : 0;
  // So nearly along the rows, or so short, that the projection is a point within the error of S.
  const bool is_along = !(across > std::max(1e-28 * squared, RowStrut::least_square));
  const double inverse_across = is_along ? 0 : 1 / across;

  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const V dx = hn::Set(d, dx_), dy = hn::Set(d, dy_), dz = hn::Set(d, dz_), w = hn::Set(d, w_);
  const V inverse = hn::Set(d, inverse_across), factor = hn::Set(d, factor_);
  const V length2 = hn::Set(d, squared), ax = hn::Set(d, ax_), scale = hn::Set(d, to_buckets_);
  const V stretch = hn::Set(d, squared * inverse_across), slide = hn::Set(d, dx_ * inverse_across);
  const V wb = hn::Sub(w, dz), w2 = hn::Mul(w, w), wb2 = hn::Mul(wb, wb);

  for (size_t j = 0; j < task_.rows; j += lanes) {
    const V v = hn::Sub(hn::LoadU(d, task_.y + j), hn::Set(d, strut.a[1]));
    const V e = hn::MulAdd(v, dy, hn::Mul(w, dz));
    const V flat2 = flat_distance2(v, w, dy, dz, inverse);
    const V of_row = task_.of_row ? hn::LoadU(d, task_.of_row + j) : zero;
    const auto radius_of = [&](const RowLevel& level) HWY_ATTR {
      const V r =
          hn::MulAdd(hn::Add(of_row, hn::Set(d, level.radius)), factor, hn::Set(d, level.margin));
      return hn::Max(r, zero);
    };
    const V reach = radius_of(widest);
    uint64_t met = bits_of(d, hn::Le(flat2, hn::Mul(reach, reach)));
    if (task_.rows - j < lanes) met &= (uint64_t{1} << (task_.rows - j)) - 1;
    if (!met) continue;

    const V cross = hn::MulSub(v, dz, hn::Mul(w, dy));
    const V k2 = hn::Mul(hn::Mul(cross, cross), inverse);
    const V vb = hn::Sub(v, dy);
    const V rho2_a = hn::MulAdd(v, v, w2), rho2_b = hn::MulAdd(vb, vb, wb2);
    const V centre = hn::Mul(slide, e);
    for (size_t l = 0; l < task_.levels.size(); ++l) {
      const V r = radius_of(task_.levels[l]), r2 = hn::Mul(r, r);
      V low, high;
      if (is_along) {
        const V root = hn::Sqrt(hn::Max(hn::Sub(r2, hn::Min(rho2_a, rho2_b)), zero));
        low = hn::Sub(hn::Min(zero, dx), root);
        high = hn::Add(hn::Max(zero, dx), root);
      } else {
        const V root = hn::Sqrt(hn::Mul(hn::Max(hn::Sub(r2, k2), zero), stretch));
        low = hn::Sub(centre, root);
        high = hn::Add(centre, root);
        const V s_low = hn::MulAdd(low, dx, e), s_high = hn::MulAdd(high, dx, e);
        const auto low_a = hn::Lt(s_low, zero), low_b = hn::Gt(s_low, length2);
        const auto high_a = hn::Lt(s_high, zero), high_b = hn::Gt(s_high, length2);
        const auto root_of = [&](hn::Mask<Doubles> at_b) HWY_ATTR {
          return hn::Sqrt(hn::Max(hn::Sub(r2, hn::IfThenElse(at_b, rho2_b, rho2_a)), zero));
        };
        const auto low_round = hn::Or(low_a, low_b), high_round = hn::Or(high_a, high_b);
        if (!hn::AllFalse(d, hn::Or(low_round, high_round))) {
          const V low_end = hn::Sub(hn::IfThenElseZero(low_b, dx), root_of(low_b));
          const V high_end = hn::Add(hn::IfThenElseZero(high_b, dx), root_of(high_b));
          low = hn::IfThenElse(low_round, low_end, low);
          high = hn::IfThenElse(high_round, high_end, high);
        }
      }
      const auto is_met = hn::And(hn::Le(flat2, r2), hn::Gt(r, zero));
      low = hn::Floor(hn::Mul(hn::Add(low, ax), scale));
      high = hn::Floor(hn::Mul(hn::Add(high, ax), scale));
      high = hn::IfThenElse(is_met, high, hn::Sub(low, one));
      hn::Store(hn::DemoteTo(di, low), di, workspace_.low[l]);
      hn::Store(hn::DemoteTo(di, high), di, workspace_.high[l]);
    }
    hn::Store(v, d, v_);
    for (; met; met &= met - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(met));
      if (task_.alive[j + lane]) draw_row(lane, j + lane);
    }
  }
}

template <size_t section_words>
HWY_INLINE void SectionRows<section_words>::draw_row(size_t lane, size_t row) {
  low_ = workspace_.low[task_.widest][lane];
  high_ = workspace_.high[task_.widest][lane];
  size_t words = 0, samples = 0;  // doubtful
  mark_row<section_words>(
      task_, workspace_, is_even_, lane, row, [&](size_t word, uint64_t rest) HWY_ATTR {
        workspace_.doubtful[words] = rest;
        workspace_.first_column[words] = static_cast<uint32_t>(word * bits_per_word);
        words += rest != 0;
        samples += static_cast<size_t>(std::popcount(rest));
      });
  if (samples > 0) decide(lane, row, samples);
}

/// Compares the doubtful samples with the strut.
template <size_t section_words>
HWY_INLINE void SectionRows<section_words>::decide(size_t lane, size_t row, size_t samples) {
  // One loop, so that the processor need not predict how many samples each word has.
  const uint64_t* const doubtful = workspace_.doubtful;
  uint32_t* const column = workspace_.column;
  uint64_t rest = doubtful[0];
  for (size_t n = 0, word = 0; n < samples; ++n) {
    column[n] = workspace_.first_column[word] + static_cast<uint32_t>(std::countr_zero(rest));
    workspace_.x[n] = task_.x[column[n]];
    rest &= rest - 1;
    word += rest == 0;
    rest = rest ? rest : doubtful[word];
  }
  double radius = task_.radius + (task_.of_row ? task_.of_row[row] : 0);
  if (task_.field) {
    std::vector<Vec3>& positions = workspace_.positions;
    positions.clear();
    for (size_t n = 0; n < samples; ++n)
      positions.push_back({task_.sample_x[column[n]], task_.sample_y[row], task_.sample_z});
    task_.field->values(positions.data(), samples, workspace_.r);
  }
  const double v = v_[lane];
  const Doubles dd;
  const V zero = hn::Zero(dd), one = hn::Set(dd, 1.0);
  const V dx = hn::Set(dd, dx_), dy = hn::Set(dd, dy_), dz = hn::Set(dd, dz_);
  const V vv = hn::Set(dd, v), ww = hn::Set(dd, w_), e = hn::Set(dd, v * dy_ + w_ * dz_);
  const V inverse = hn::Set(dd, inverse_squared_), margin = hn::Set(dd, task_.margin);
  // The copy with the nearest middle of the interval; if intervals meet their neighbours, those on
  // either side, too.
  const double middle = (low_ + 0.5 * (high_ + 1 - low_)) / to_buckets_;
  const int beyond =
      high_ - low_ + 3 >= ColumnSets::buckets ? (high_ - low_ + 3) / ColumnSets::buckets : 0;
  const V size = hn::Set(dd, size_), inverse_size = hn::Set(dd, 1 / size_);
  const hn::Rebind<int32_t, Doubles> di;
  for (size_t n = 0; n < samples; n += hn::Lanes(dd)) {
    V x = hn::Sub(hn::LoadU(dd, workspace_.x + n), hn::Set(dd, middle));
    x = hn::NegMulAdd(hn::Round(hn::Mul(x, inverse_size)), size, x);
    x = hn::Add(x, hn::Set(dd, middle - ax_));
    V least = hn::Set(dd, 1e300);
    for (int copy = -beyond; copy <= beyond; ++copy) {
      const V from_a = hn::Add(x, hn::Set(dd, copy * size_));
      const V t = hn::Min(hn::Max(hn::Mul(hn::MulAdd(from_a, dx, e), inverse), zero), one);
      const V px = hn::NegMulAdd(t, dx, from_a), py = hn::NegMulAdd(t, dy, vv),
              pz = hn::NegMulAdd(t, dz, ww);
      least = hn::Min(least, hn::MulAdd(px, px, hn::MulAdd(py, py, hn::Mul(pz, pz))));
    }
    V r;
    if (task_.field) {
      r = hn::LoadU(dd, workspace_.r + n);
    } else {
      const auto columns = hn::LoadU(di, reinterpret_cast<const int32_t*>(column) + n);
      r = hn::MulAdd(hn::PromoteTo(dd, columns), hn::Set(dd, task_.slope), hn::Set(dd, radius));
    }
    r = hn::Mul(r, hn::Set(dd, factor_));
    const V thick = hn::Add(r, margin), thin = hn::Sub(r, margin);
    const size_t here = std::min(hn::Lanes(dd), samples - n);
    const uint64_t some = here == 64 ? ~uint64_t{0} : (uint64_t{1} << here) - 1;
    const uint64_t in =
        some & bits_of(dd, hn::And(hn::Gt(thin, zero), hn::Lt(least, hn::Mul(thin, thin))));
    const uint64_t near = some & ~in & bits_of(dd, hn::Le(least, hn::Mul(thick, thick)));
    uint64_t* const bits = task_.inside + row * task_.row_words();
    for (uint64_t lanes = in; lanes; lanes &= lanes - 1) {
      const uint32_t at = column[n + static_cast<size_t>(std::countr_zero(lanes))];
      bits[at / bits_per_word] |= uint64_t{1} << (at % bits_per_word);
    }
    for (uint64_t lanes = near; lanes; lanes &= lanes - 1)
      left_.push_back(
          {static_cast<uint32_t>(row), column[n + static_cast<size_t>(std::countr_zero(lanes))]});
  }
}

/// Draws a strut that `copies` is set to.
HWY_INLINE void draw_copies(const RowTask& task, const RowStrut& strut, CopySpans& copies) {
  const Doubles d;
  const double w = task.z - strut.a[2];
  const double across = strut.ab[1] * strut.ab[1] + strut.ab[2] * strut.ab[2];
  const V dy = hn::Set(d, strut.ab[1]), dz = hn::Set(d, strut.ab[2]), from_a = hn::Set(d, w);
  const V inverse = hn::Set(d, 1 / across), reach2 = hn::Set(d, copies.reach() * copies.reach());
  for (size_t j = 0; j < task.rows; j += hn::Lanes(d)) {
    const V v = hn::Sub(hn::LoadU(d, task.y + j), hn::Set(d, strut.a[1]));
    uint64_t met = bits_of(d, hn::Le(flat_distance2(v, from_a, dy, dz, inverse), reach2));
    if (task.rows - j < hn::Lanes(d)) met &= (uint64_t{1} << (task.rows - j)) - 1;
    for (; met; met &= met - 1) {
      const size_t row = j + static_cast<size_t>(std::countr_zero(met));
      if (task.alive[row]) copies.draw_row(row, task.y[row] - strut.a[1], w);
    }
  }
}

template <size_t section_words>
HWY_INLINE void mark_sections(const RowStruts& struts, const RowTask& task, RowWorkspace& workspace,
                              std::vector<LeftSample>& left) {
  SectionRows<section_words> rows(struts, task, workspace, left);
  CopySpans copies(struts, task, workspace, left);
  const bool by_copies = CopySpans::pays(task, struts.cell_size[0]);
  size_t max_left = size_t{1} << 16;
  const RowLevel widest = task.levels[task.widest];
  const double max_of_row =
      task.of_row ? *std::max_element(task.of_row, task.of_row + task.rows) : 0;
  for (const RowStrut& strut : struts.struts) {
    const double reach = strut.factor * (widest.radius + max_of_row) + widest.margin;
    const double w = task.z - strut.a[2];
    if (w - std::max(strut.ab[2], 0.0) > reach || std::min(strut.ab[2], 0.0) - w > reach) continue;
    if (by_copies && copies.set(strut, reach))
      draw_copies(task, strut, copies);
    else
      rows.draw(strut);
    if (left.size() < max_left) continue;
    // Struts that share a surface leave the same samples undecided.
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    max_left = std::max(max_left, 2 * left.size());
  }
  copies.finish();
}

void mark_rows(const RowStruts& struts, const RowTask& task, RowWorkspace& workspace,
               std::vector<LeftSample>& left) {
  with_section_words(task.section_words, [&](auto words) HWY_ATTR {
    mark_sections<decltype(words)::value>(struts, task, workspace, left);
  });
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(mark_rows);

}  // namespace

void RowStruts::mark_inside(const RowTask& task, std::vector<LeftSample>& left) const {
  // The field may be the host's, and its callbacks may slice.
  const Borrowed<RowWorkspace> workspace;
  HWY_DYNAMIC_DISPATCH(mark_rows)(*this, task, *workspace, left);
}

}  // namespace msq
#endif  // HWY_ONCE
