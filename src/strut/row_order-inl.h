// SPDX-License-Identifier: Apache-2.0
// The order in which vectors cover the rows of samples that a convex solid may meet. Included once
// for each instruction set.
//
// Rows lie in lines. A line is a layer or, if that needs fewer vectors, the rows of one y. All
// lines of a solid have the same width, and follow each other in the vectors without a gap. A line
// begins where the solid may begin: a slanting strut meets few rows of each line of its box.
#if defined(MSQ_STRUT_ROW_ORDER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUT_ROW_ORDER_INL_H
#undef MSQ_STRUT_ROW_ORDER_INL_H
#else
#define MSQ_STRUT_ROW_ORDER_INL_H
#endif

#include <hwy/highway.h>

#include "strut/raster_target.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FullLanes = hn::ScalableTag<float>;

/// The order of one solid in each lane.
template <class D, class V = hn::Vec<D>>
struct RowOrder {
  /// A line has `width` rows from ceil(first + slope * line) on. Those from 0 to `extent` exist.
  V width, extent, lines, first, slope;
  hn::Mask<D> by_layers;  // lines are layers

  /// The whole of a box of rows and layers.
  HWY_INLINE RowOrder(D d, const RasterTarget& target, V rows, V layers)
      : width(rows), extent(rows), lines(layers), first(hn::Zero(d)), slope(hn::Zero(d)) {
    by_layers = hn::Eq(first, first);
    if (target.dz > 0) return;
    // Layers anywhere: a vector lies in one of them.
    const auto lanes = static_cast<double>(hn::Lanes(FullLanes()));
    width = hn::Mul(hn::Ceil(hn::Mul(rows, hn::Set(d, 1 / lanes))), hn::Set(d, lanes));
  }

  /// Leaves out rows that are farther than `reach` from an axis along (dy, dz), if that needs fewer
  /// vectors. (v, w): the first row, from a point of the axis. In columns.
  HWY_INLINE void follow_axis(D d, const RasterTarget& target, V v, V w, V dy, V dz, V reach) {
    const auto is_one = hn::Le(vectors(d), hn::Set(d, 1.0));
    if (!(target.dz > 0) || hn::AllTrue(d, is_one)) return;
    const double row_step = target.dy * target.inverse_dx,
                 layer_step = target.dz * target.inverse_dx;
    const V half_across = hn::Mul(hn::Mul(reach, hn::Sqrt(hn::MulAdd(dy, dy, hn::Mul(dz, dz)))),
                                  hn::Set(d, 1 / (row_step * layer_step)));
    // Without an inverse, as for an axis along a line, no comparison holds.
    const V in_rows = hn::Mul(dy, hn::Set(d, 1 / row_step)),
            in_layers = hn::Mul(dz, hn::Set(d, 1 / layer_step));
    const V inverse = hn::Div(hn::Set(d, 1.0), hn::Mul(in_rows, in_layers));
    const V rows = extent, layers = lines;
    V least = hn::Mul(rows, layers);
    // `count` lines of `all` rows. `first_row`, `first_line`: of the box, from the axis. `along`:
    // the axis in rows of a line.
    const auto consider = [&](bool are_layers, V all, V count, V first_row, V first_line,
                              V along) HWY_ATTR {
      // Single precision computes where a line begins, with an error below 3 * 2^-24 * most.
      const V slack = hn::Set(d, 0x1p-8), most = hn::Set(d, 8192.0);
      const V inverse_between = hn::Mul(inverse, along);  // of the axis in lines
      const V half = hn::MulAdd(half_across, hn::Abs(inverse_between), slack);
      const V per_line = hn::Mul(along, inverse_between);
      const V begin = hn::Sub(hn::MulSub(per_line, first_line, first_row), half);
      const V needed = hn::Add(hn::Floor(hn::Add(half, half)), hn::Set(d, 1.0));
      const V in_all = hn::Mul(needed, count);
      const auto fewer =
          hn::And(hn::Lt(in_all, least),
                  hn::Lt(hn::MulAdd(hn::Abs(per_line), count, hn::Abs(begin)), most));
      least = hn::IfThenElse(fewer, in_all, least);
      width = hn::IfThenElse(fewer, needed, width);
      extent = hn::IfThenElse(fewer, all, extent);
      lines = hn::IfThenElse(fewer, count, lines);
      first = hn::IfThenElse(fewer, begin, first);
      slope = hn::IfThenElse(fewer, per_line, slope);
      by_layers = are_layers ? hn::Or(by_layers, fewer) : hn::AndNot(fewer, by_layers);
    };
    const V row = hn::Mul(v, hn::Set(d, 1 / row_step)),
            layer = hn::Mul(w, hn::Set(d, 1 / layer_step));
    consider(true, rows, layers, row, layer, in_rows);
    consider(false, layers, rows, layer, row, in_layers);
  }

  /// The first if lines are layers, else the second.
  HWY_INLINE V either(D d, double layered, double other) const {
    return hn::IfThenElse(by_layers, hn::Set(d, layered), hn::Set(d, other));
  }
  HWY_INLINE V vectors(D d) const {
    return hn::Ceil(hn::Mul(hn::Mul(width, lines),
                            hn::Set(d, 1.0 / static_cast<double>(hn::Lanes(FullLanes())))));
  }
  /// Whether single precision numbers the rows; and the words of a target.
  HWY_INLINE hn::Mask<D> fits(D d) const {
    return hn::Lt(hn::Mul(width, lines), hn::Set(d, 0x1p20));
  }
  static bool fits(const RasterTarget& target) {
    return target.layers * target.layer_words < (size_t{1} << 24);
  }
};

/// The same in single precision, of each of a number of solids.
template <size_t room>
struct RowOrders {
  int32_t vectors[room];
  float width[room], inverse_width[room], extent[room], lines[room], first[room], slope[room];
  float inner_words[room], outer_words[room];  // from row to row of a line, from line to line
  int32_t by_layers[room];

  template <class D>
  HWY_INLINE void set(D d, const RasterTarget& target, const RowOrder<D>& order, size_t i) {
    const hn::Rebind<float, D> df;
    const hn::Rebind<int32_t, D> di;
    const auto put = [&](hn::Vec<D> value, float* out)
                         HWY_ATTR { hn::StoreU(hn::DemoteTo(df, value), df, out + i); };
    const auto most = hn::Set(d, 0x1p30), one = hn::Set(d, 1.0);
    hn::StoreU(hn::DemoteTo(di, hn::Min(order.vectors(d), most)), di, vectors + i);
    hn::StoreU(hn::DemoteTo(di, hn::IfThenElseZero(order.by_layers, one)), di, by_layers + i);
    put(order.width, width);
    hn::StoreU(hn::Div(hn::Set(df, 1.0f), hn::DemoteTo(df, order.width)), df, inverse_width + i);
    put(order.extent, extent);
    put(order.lines, lines);
    put(order.first, first);
    put(order.slope, slope);
    const auto row_words = static_cast<double>(target.row_words),
               layer_words = static_cast<double>(target.layer_words);
    put(order.either(d, row_words, layer_words), inner_words);
    put(order.either(d, layer_words, row_words), outer_words);
  }
};

/// The vectors of one solid.
class RowVectors {
 public:
  using V = hn::Vec<FullLanes>;

  template <size_t room>
  HWY_INLINE RowVectors(const RowOrders<room>& orders, size_t i)
      : by_layers_(orders.by_layers[i] != 0) {
    const FullLanes d;
    width_ = hn::Set(d, orders.width[i]);
    inverse_width_ = hn::Set(d, orders.inverse_width[i]);
    half_inverse_ = hn::Mul(inverse_width_, hn::Set(d, 0.5f));
    extent_ = hn::Set(d, orders.extent[i]);
    lines_ = hn::Set(d, orders.lines[i]);
    first_ = hn::Set(d, orders.first[i]);
    slope_ = hn::Set(d, orders.slope[i]);
    inner_words_ = hn::Set(d, orders.inner_words[i]);
    outer_words_ = hn::Set(d, orders.outer_words[i]);
  }

  /// The place in its line and the line of each row of a vector. Returns which of them exist.
  HWY_INLINE hn::Mask<FullLanes> find(size_t vector, V& inner, V& outer) const {
    const FullLanes d;
    const V number = hn::Iota(d, static_cast<float>(vector * hn::Lanes(d)));
    outer = hn::Floor(hn::MulAdd(number, inverse_width_, half_inverse_));
    inner =
        hn::Add(hn::NegMulAdd(outer, width_, number), hn::Ceil(hn::MulAdd(outer, slope_, first_)));
    return hn::And(hn::And(hn::Ge(inner, hn::Zero(d)), hn::Lt(inner, extent_)),
                   hn::Lt(outer, lines_));
  }
  /// In bits, from the solid's first row and layer.
  HWY_INLINE hn::Vec<hn::RebindToSigned<FullLanes>> bits(V inner, V outer) const {
    const V words = hn::MulAdd(inner, inner_words_, hn::Mul(outer, outer_words_));
    return hn::ShiftLeft<6>(hn::ConvertTo(hn::RebindToSigned<FullLanes>(), words));
  }
  V row(V inner, V outer) const { return by_layers_ ? inner : outer; }
  V layer(V inner, V outer) const { return by_layers_ ? outer : inner; }

 private:
  V width_, inverse_width_, half_inverse_, extent_, lines_, first_, slope_;
  V inner_words_, outer_words_;
  const bool by_layers_;
};

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
