// SPDX-License-Identifier: Apache-2.0
// What a row of samples has in common with a strut and its copies if the radius is linear along the
// row: a span for each copy, in closed form, a vector of copies at a time. Included once for each
// instruction set.
//
// Let x be the position along the row from the end a of a copy, and G the slope of the radius R(x)
// = R(0) + G x. The distance from the axis is convex in x and R is linear, so each copy has one
// span. A, d, k and e are those of row_kernel.cpp, and q = A / |d|^2. The body holds the x with
// k^2 + q (x - c)^2 <= R(x)^2, where c is the point of the row nearest to the axis's line. If W =
// 1 / (q - G^2), its ends are
//   x = c + W G R(c) -+ sqrt(q W^2 R(c)^2 - W k^2).
// The ends of the sphere about a are those for q = 1, c = 0 and the distance of a from the row in
// place of k; b likewise. Let s = x dx + e, which is 0 beside a and |d|^2 beside b. As for a
// constant radius, an end of the body with s < 0 is replaced by that of a, and one with s > |d|^2
// by that of b. Since q > G^2, the inequality holds in one interval, where R has one sign.
// Intervals with R < 0 are left out.
//
// Bounds. Struts with q < 1/16 or G^2 > q / 4 are drawn by sections, and so are points. So W, q W^2
// and what takes their place about the ends are at most 2 / q, and |G| W <= 2 / q. `margin` bounds
// the error of a radius, and the distance of a column from the line of columns, which changes the
// distance from the axis by as much at most. `reach` is the maximum radius in the columns. Where an
// end is in the columns, |R(c)| <= 1.5 reach. Squared distances have errors of at most 2^-46 S^2.
// So the error of k^2 - R^2 is at most F = 2^-46 S^2 + 4 margin (reach + margin), and that of a
// discriminant at most 2 F / q. Then a root is wrong by at most the root of 4 F / q. If s is that
// near to 0, in units of length, the wrong one of body and end may be chosen. There the squared
// distances from the line and from the end differ by at most 4 F / q, four times that if both ends
// are chosen wrongly. So the discriminants are those of the strut within E = 128 F / q^2. A root is
// then wrong by at most E / (0.7 root) if it is greater than sqrt(E), and by sqrt(E) / 0.7
// otherwise. The centre of a span adds |G| W margin, rounding adds 2^-46 S / q, and the line of
// columns adds `margin`: together at most 4 (margin + 2^-46 S) / q. The radius at an end is wrong
// by `margin` and by |G| times the error of the end.
#if defined(MSQ_COPY_SPANS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_COPY_SPANS_INL_H
#undef MSQ_COPY_SPANS_INL_H
#else
#define MSQ_COPY_SPANS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "base/mask_bits-inl.h"
#include "structure/lattice/rows/row_kernel.h"
#include "structure/lattice/rows/row_struts.h"
#include "strut/span_buffer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

class CopySpans {
  using Doubles = hn::ScalableTag<double>;

 public:
  CopySpans(const RowStruts& struts, const RowTask& task, RowWorkspace& workspace,
            std::vector<LeftSample>& left)
      : task_(task),
        workspace_(workspace),
        left_(left),
        buffer_(task.inside),
        size_(struts.cell_size[0]),
        extent_(struts.extent) {}

  /// Whether copies take less time than sections. A copy takes about as long as `samples` samples
  /// of a section.
  static bool pays(const RowTask& task, double cell_size) {
    const double samples = hn::Lanes(Doubles()) < 4 ? 80 : 40;
    return task.unrolled && cell_size >= samples * std::abs(task.unrolled->width);
  }

  /// Finds the copies that reach the columns, which are the same for all rows. False: the strut is
  /// to be drawn by sections. `reach`: its maximum radius.
  HWY_INLINE bool set(const RowStrut& strut, double reach);
  /// Rows farther from the strut meet no copy.
  double reach() const { return reach_; }
  /// Draws a row that is within reach() of the strut. (v, w): from the end a to the row.
  HWY_INLINE void draw_row(size_t row, double v, double w);
  /// Draws what was gathered.
  HWY_INLINE void finish() { buffer_.draw(); }

 private:
  using V = hn::Vec<Doubles>;

  struct Row {
    double of_row, along, centre;  // its own part of the radius; s at x = 0; c
    double k2, rho2_a, rho2_b;     // scaled as discriminants are
    uint32_t number, bit;
  };
  /// on_body: all ends of spans lie on the body.
  template <bool on_body>
  HWY_INLINE void draw_copies(const Row& row);
  /// Leaves columns [begin, end) to the predicate.
  void leave(uint32_t row, double begin, double end) {
    for (auto column = static_cast<uint32_t>(begin); column < static_cast<uint32_t>(end); ++column)
      left_.push_back({row, column});
  }

  const RowTask& task_;
  RowWorkspace& workspace_;
  std::vector<LeftSample>& left_;
  SpanBuffer buffer_;
  const double size_, extent_;

  // Of the current strut.
  size_t slots_ = 0;  // copies, and those that fill the last vectors
  double dx_ = 0, dy_ = 0, dz_ = 0, factor_ = 0, squared_ = 0;
  double inverse_across_ = 0;  // 1 / A
  double slope_ = 0;           // G
  double body_ = 0, end_ = 0;  // W, and in its place about the ends
  double body_root_ = 0;       // sqrt(q) W
  double max_radius_ = 0;      // of copies, without the row's own part
  double margin_ = 0, reach_ = 0;
  double error_ = 0, end_error_ = 0, radius_error_ = 0;
  // Errors of ends, in columns, where the root is greater than far_root_ and elsewhere.
  double far_root_ = 0, far_by_ = 0, near_by_ = 0;
};

HWY_INLINE bool CopySpans::set(const RowStrut& strut, double reach) {
  const UnrolledColumns& columns = *task_.unrolled;
  margin_ = task_.margin + columns.off;
  reach_ = reach + margin_;
  factor_ = strut.factor;
  dx_ = strut.ab[0];
  dy_ = strut.ab[1];
  dz_ = strut.ab[2];
  const double across = dy_ * dy_ + dz_ * dz_;
  squared_ = dx_ * dx_ + across;
  slope_ = factor_ * task_.slope / columns.width;
  if (!(across >= std::max(0x1p-4 * squared_, RowStrut::least_square)) ||
      !(4 * slope_ * slope_ * squared_ <= across))
    return false;
  const double q = across / squared_;
  inverse_across_ = 1 / across;
  body_ = 1 / (q - slope_ * slope_);
  body_root_ = std::sqrt(q) * body_;
  end_ = 1 / (1 - slope_ * slope_);

  const double first = columns.position(columns.first), last = columns.position(columns.last);
  const double begin = strut.a[0] + std::min(dx_, 0.0) - reach_,
               end = strut.a[0] + std::max(dx_, 0.0) + reach_;
  constexpr double slack = 1e-6;  // of a cell
  const double low = std::ceil((std::min(first, last) - end) / size_ - slack),
               high = std::floor((std::max(first, last) - begin) / size_ + slack);
  if (!(high - low < static_cast<double>(RowWorkspace::max_copies))) return false;
  const auto copies = static_cast<size_t>(std::max(high - low + 1, 0.0));
  const size_t lanes = hn::Lanes(Doubles()), vectors = (copies + lanes - 1) / lanes;
  slots_ = vectors * lanes;
  max_radius_ = 0;
  const double column = columns.column(strut.a[0] + low * size_),
               columns_apart = size_ / columns.width;
  for (size_t n = 0; n < slots_; ++n) {
    // Spans that are drawn one after the other are then in different words.
    const size_t copy = n % lanes * vectors + n / lanes;
    const bool is_there = copy < copies;
    const double at = column + static_cast<double>(copy) * columns_apart;
    const double radius = factor_ * (task_.radius + task_.slope * at);
    workspace_.copy_column[n] = at;
    // Without a copy: less than 0 wherever a row is within reach.
    workspace_.copy_radius[n] = is_there ? radius : -4 * extent_;
    max_radius_ = std::max(max_radius_, workspace_.copy_radius[n]);
  }

  const double from_line = 0x1p-46 * extent_ * extent_ + 4 * margin_ * reach_;
  error_ = 128 * from_line / (q * q);
  end_error_ = 4 * (margin_ + 0x1p-46 * extent_) / q;
  const double root_error = std::sqrt(error_), near_error = root_error / 0.7 + end_error_;
  radius_error_ = margin_ + std::abs(slope_) * near_error;
  far_root_ = std::max(0x1p-10 * extent_, root_error);
  const auto in_columns = [&](double error) {
    return error / std::abs(columns.width) + UnrolledColumns::slack;
  };
  far_by_ = in_columns(error_ / (0.7 * far_root_) + end_error_);
  near_by_ = in_columns(near_error);
  return true;
}

HWY_INLINE void CopySpans::draw_row(size_t row, double v, double w) {
  const double e = v * dy_ + w * dz_, cross = v * dz_ - w * dy_, vb = v - dy_, wb = w - dz_;
  Row at;
  at.of_row = factor_ * task_.of_row[row];
  at.along = e;
  at.centre = dx_ * e * inverse_across_;
  at.k2 = cross * cross * inverse_across_ * body_;
  at.rho2_a = (v * v + w * w) * end_;
  at.rho2_b = (vb * vb + wb * wb) * end_;
  at.bit = static_cast<uint32_t>(row * task_.row_words() * bits_per_word);
  at.number = static_cast<uint32_t>(row);
  // The longest span about the centre, and its part of the axis.
  const double r = max_radius_ + at.of_row + std::abs(slope_ * at.centre) + margin_;
  const double root = std::sqrt(std::max(r * r * body_root_ * body_root_ - at.k2, 0.0) + error_);
  const double half = std::abs(dx_) * (std::abs(slope_) * body_ * r + root + end_error_);
  const double middle = at.centre * dx_ + e;
  if (middle > half && squared_ - middle > half)
    draw_copies<true>(at);
  else
    draw_copies<false>(at);
}

template <bool on_body>
HWY_INLINE void CopySpans::draw_copies(const Row& row) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> di;
  const UnrolledColumns& columns = *task_.unrolled;
  const auto number = [&](double value) HWY_ATTR { return hn::Set(d, value); };
  const V of_row = number(row.of_row), slope = number(slope_), k2 = number(row.k2);
  const V to_centre = number(slope_ * row.centre), c = number(row.centre);
  const V body_root = number(body_root_), body_shift = number(slope_ * body_);
  const V zero = hn::Zero(d), error = number(error_), none = number(-error_);
  const V thin = number(radius_error_), gone = number(-radius_error_);
  const V per_column = number(1 / columns.width);
  const V first = number(columns.first), last = number(columns.last);
  const V far_root = number(far_root_), far_by = number(far_by_), near_by = number(near_by_);
  const auto bit = hn::Set(di, static_cast<int32_t>(row.bit));

  for (size_t n = 0; n < slots_; n += hn::Lanes(d)) {
    const V r = hn::Add(hn::Load(d, workspace_.copy_radius + n), of_row);
    const auto root_of = [&](V of_radius, V factor, V distance2) HWY_ATTR {
      const V scaled = hn::Mul(of_radius, factor);
      return hn::MulSub(scaled, scaled, distance2);
    };
    const V middle = hn::Add(r, to_centre);
    const V body_d = root_of(middle, body_root, k2);
    const V body_centre = hn::MulAdd(middle, body_shift, c);
    V least = body_d, root = hn::Sqrt(hn::Max(body_d, zero));
    V low = hn::Sub(body_centre, root), high = hn::Add(body_centre, root);
    if constexpr (!on_body) {
      const V dx = number(dx_), along = number(row.along), length2 = number(squared_);
      const V end = number(end_), end_shift = number(slope_ * end_);
      const V r_b = hn::MulAdd(dx, slope, r);
      const V d_a = root_of(r, end, number(row.rho2_a)),
              d_b = root_of(r_b, end, number(row.rho2_b));
      const V centre_a = hn::Mul(r, end_shift), centre_b = hn::MulAdd(r_b, end_shift, dx);
      const V s_low = hn::MulAdd(low, dx, along), s_high = hn::MulAdd(high, dx, along);
      const auto choose = [&](V s, V of_a, V of_b, V of_body) HWY_ATTR {
        return hn::IfThenElse(hn::Gt(s, length2), of_b,
                              hn::IfThenElse(hn::Lt(s, zero), of_a, of_body));
      };
      const V low_d = choose(s_low, d_a, d_b, body_d), high_d = choose(s_high, d_a, d_b, body_d);
      const V low_root = hn::Sqrt(hn::Max(low_d, zero)),
              high_root = hn::Sqrt(hn::Max(high_d, zero));
      low = hn::Sub(choose(s_low, centre_a, centre_b, body_centre), low_root);
      high = hn::Add(choose(s_high, centre_a, centre_b, body_centre), high_root);
      least = hn::Min(least, hn::Min(low_d, high_d));
      root = hn::Min(low_root, high_root);
    }
    const V least_radius = hn::Min(hn::MulAdd(low, slope, r), hn::MulAdd(high, slope, r));
    const auto met = hn::And(hn::Gt(least, none), hn::Gt(least_radius, gone));
    if (hn::AllFalse(d, met)) continue;

    const V by = hn::IfThenElse(hn::Gt(root, far_root), far_by, near_by);
    const V at = hn::Load(d, workspace_.copy_column + n);
    const V one_end = hn::MulAdd(low, per_column, at), other = hn::MulAdd(high, per_column, at);
    const V from = hn::Min(one_end, other), to = hn::Max(one_end, other);
    // Columns [x0, x1] may be inside; columns [i0, i1] are certainly inside.
    const V x0 = hn::Max(hn::Ceil(hn::Sub(from, by)), first);
    const V x1 = hn::Min(hn::Floor(hn::Add(to, by)), last);
    const V i0 = hn::Max(hn::Ceil(hn::Add(from, by)), first);
    const V i1 = hn::Min(hn::Floor(hn::Sub(to, by)), last);
    const auto some = hn::And(met, hn::Le(x0, x1));
    const auto sure = hn::And(hn::And(some, hn::Le(i0, i1)),
                              hn::And(hn::Gt(least, error), hn::Gt(least_radius, thin)));
    buffer_.add(di, hn::Add(hn::DemoteTo(di, i0), bit), hn::DemoteTo(di, hn::Sub(i1, i0)),
                lanes_of(di, bits_of(d, sure)));

    const auto decided = hn::And(sure, hn::And(hn::Eq(x0, i0), hn::Eq(x1, i1)));
    const uint64_t doubtful = bits_of(d, hn::AndNot(decided, some));
    if (HWY_LIKELY(!doubtful)) continue;
    const V one = hn::Set(d, 1.0), past = hn::Add(x1, one);
    HWY_ALIGN double ends[4][max_simd_doubles];
    hn::Store(x0, d, ends[0]);
    hn::Store(hn::IfThenElse(sure, i0, past), d, ends[1]);
    hn::Store(hn::IfThenElse(sure, hn::Add(i1, one), past), d, ends[2]);
    hn::Store(past, d, ends[3]);
    for (uint64_t rest = doubtful; rest; rest &= rest - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(rest));
      leave(row.number, ends[0][lane], ends[1][lane]);
      leave(row.number, ends[2][lane], ends[3][lane]);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif  // MSQ_COPY_SPANS_INL_H
