// SPDX-License-Identifier: Apache-2.0
// A row meets a plate, which is convex, in one interval of x. The plate is the union of a prism,
// the points over the triangle that are within r of its plane; of the cylinders of radius r about
// its edges, between their ends; and of the balls about its corners. The row cuts each of these in
// one interval, and the plate from the least to the greatest of their ends.
//
// Bounds. S, m and the errors are those of rows/row_kernel.cpp; m also exceeds the error of the
// triangle's normal, which is that of a height, or of a place in its plane, at any point of the
// cell. Whether a point at an edge belongs to the prism or a cylinder, and at the end of an edge to
// a cylinder or a ball, is decided within a few 2^-53 S. That moves no end by more than m: for r +
// m each of the two contains what the other loses so, and for r - m what one gains so is in the
// plate of radius r. If a slope of the prism's bounds along x is less than 2^-60 of what a bound
// may reach, the bound is taken where the plate is.
//
// The samples of whole buckets within the inner interval are inside. The other samples of the outer
// interval, in whole buckets, are left to the predicate.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/lattice/plates/plate_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/borrowed.h"
#include "base/mask_bits-inl.h"
#include "base/sample_grid.h"
#include "base/simd.h"
#include "structure/lattice/plates/row_plates.h"
#include "structure/lattice/rows/mark_section-inl.h"
#include "structure/lattice/rows/row_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using Doubles = hn::ScalableTag<double>;
using V = hn::Vec<Doubles>;
using M = hn::Mask<Doubles>;

/// Intervals of x, one per row; empty where low > high.
struct Intervals {
  V low, high;
};

HWY_INLINE void unite(Intervals& all, M is_met, V low, V high) {
  all.low = hn::IfThenElse(is_met, hn::Min(all.low, low), all.low);
  all.high = hn::IfThenElse(is_met, hn::Max(all.high, high), all.high);
}

/// A linear function of x: value + slope x.
struct Bound {
  double slope;
  V value;
};

/// Keeps the x at which the bound is at least `least`. `middle`: an x of the plate; `reach`: more
/// than any other differs from it.
HWY_INLINE void clip(const Doubles d, const Bound& bound, V least, double middle, double reach,
                     double scale, Intervals& kept, M& is_met) {
  const V gap = hn::Sub(least, bound.value);
  if (std::abs(bound.slope) * reach < 0x1p-60 * scale) {
    is_met = hn::And(is_met, hn::Le(gap, hn::Set(d, bound.slope * middle)));
    return;
  }
  const V at = hn::Mul(gap, hn::Set(d, 1 / bound.slope));
  if (bound.slope > 0)
    kept.low = hn::Max(kept.low, at);
  else
    kept.high = hn::Min(kept.high, at);
}

/// A plate and a layer.
class PlateRow {
 public:
  PlateRow(const RowPlate& plate, double z, double extent)
      : triangle_(plate.triangle), bounds_(plate.bounds), z_(z), extent_(extent) {}

  HWY_INLINE Intervals cut(V y, V r) const;

 private:
  HWY_INLINE void add_prism(V y, V r, Intervals& all) const;
  HWY_INLINE void add_ball(Vec3 centre, V y, V r2, Intervals& all) const;
  HWY_INLINE void add_cylinder(const Segment& edge, V y, V r2, Intervals& all) const;

  const PlateTriangle& triangle_;
  const Box3& bounds_;
  const double z_, extent_;
};

HWY_INLINE Intervals PlateRow::cut(V y, V r) const {
  const Doubles d;
  Intervals all{hn::Set(d, 1e300), hn::Set(d, -1e300)};
  const V r2 = hn::Mul(r, r);
  add_prism(y, r, all);
  for (const Segment& edge : triangle_.edges) {
    add_ball(edge.a, y, r2, all);
    add_cylinder(edge, y, r2, all);
  }
  return all;
}

HWY_INLINE void PlateRow::add_prism(V y, V r, Intervals& all) const {
  const Doubles d;
  const Vec3 a = triangle_.a(), n = triangle_.normal, s = triangle_.to_s, t = triangle_.to_t;
  const auto along = [&](Vec3 v) HWY_ATTR {
    const double fixed = v.z * (z_ - a.z) - v.x * a.x;
    return Bound{v.x, hn::MulAdd(hn::Sub(y, hn::Set(d, a.y)), hn::Set(d, v.y), hn::Set(d, fixed))};
  };
  const Bound height = along(n), first = along(s), second = along(t);
  const Bound below{-height.slope, hn::Neg(height.value)};
  const V one = hn::Set(d, 1.0), zero = hn::Zero(d);
  const Bound third{-first.slope - second.slope, hn::Sub(one, hn::Add(first.value, second.value))};
  const double middle = 0.5 * (bounds_.min.x + bounds_.max.x), reach = 2 * extent_;
  // Nothing of the prism is further than r from the box of the triangle.
  Intervals kept{hn::Sub(hn::Set(d, bounds_.min.x), r), hn::Add(hn::Set(d, bounds_.max.x), r)};
  M is_met = hn::Gt(r, zero);
  const V deep = hn::Neg(r);
  clip(d, height, deep, middle, reach, extent_, kept, is_met);
  clip(d, below, deep, middle, reach, extent_, kept, is_met);
  clip(d, first, zero, middle, reach, 1, kept, is_met);
  clip(d, second, zero, middle, reach, 1, kept, is_met);
  clip(d, third, zero, middle, reach, 1, kept, is_met);
  unite(all, hn::And(is_met, hn::Le(kept.low, kept.high)), kept.low, kept.high);
}

HWY_INLINE void PlateRow::add_ball(Vec3 centre, V y, V r2, Intervals& all) const {
  const Doubles d;
  const V v = hn::Sub(y, hn::Set(d, centre.y)), w = hn::Set(d, z_ - centre.z);
  const V left = hn::Sub(r2, hn::MulAdd(v, v, hn::Mul(w, w)));
  const V root = hn::Sqrt(hn::Max(left, hn::Zero(d))), x = hn::Set(d, centre.x);
  unite(all, hn::Ge(left, hn::Zero(d)), hn::Sub(x, root), hn::Add(x, root));
}

/// Along the rows, the balls at its ends have the ends of the interval.
HWY_INLINE void PlateRow::add_cylinder(const Segment& edge, V y, V r2, Intervals& all) const {
  const Doubles d;
  const Vec3 ab = edge.ab;
  const double across = ab.y * ab.y + ab.z * ab.z, squared = ab.x * ab.x + across;
  if (!(across > 1e-28 * squared)) return;
  const double inverse = 1 / across, w = z_ - edge.a.z;
  const V zero = hn::Zero(d), dy = hn::Set(d, ab.y), v = hn::Sub(y, hn::Set(d, edge.a.y));
  const V cross = hn::MulSub(v, hn::Set(d, ab.z), hn::Mul(hn::Set(d, w), dy));
  const V left = hn::NegMulAdd(hn::Mul(cross, cross), hn::Set(d, inverse), r2);
  const V root = hn::Sqrt(hn::Mul(hn::Max(left, zero), hn::Set(d, squared * inverse)));
  const V e = hn::MulAdd(v, dy, hn::Set(d, w * ab.z));
  const V centre = hn::Mul(e, hn::Set(d, ab.x * inverse));
  Intervals kept{hn::Sub(centre, root), hn::Add(centre, root)};
  M is_met = hn::Ge(left, zero);
  // Between the ends: 0 <= e + x dx <= squared.
  const double reach = 2 * extent_;
  clip(d, {ab.x, e}, zero, 0, reach, squared, kept, is_met);
  clip(d, {-ab.x, hn::Neg(e)}, hn::Set(d, -squared), 0, reach, squared, kept, is_met);
  const V ax = hn::Set(d, edge.a.x);
  unite(all, hn::And(is_met, hn::Le(kept.low, kept.high)), hn::Add(kept.low, ax),
        hn::Add(kept.high, ax));
}

template <size_t section_words>
void draw_plate(const RowPlates& plates, const RowPlate& plate, const RowTask& task,
                RowWorkspace& workspace, std::vector<LeftSample>& left) {
  const Doubles d;
  const hn::Rebind<int32_t, Doubles> di;
  const size_t lanes = hn::Lanes(d);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0), factor = hn::Set(d, plate.factor);
  const V scale = hn::Set(d, ColumnSets::buckets / plates.cell_size[0]);
  const V y_min = hn::Set(d, plate.bounds.min.y), y_max = hn::Set(d, plate.bounds.max.y);
  const PlateRow shape(plate, task.z, plates.extent);
  const bool is_even = task.is_even();
  for (size_t j = 0; j < task.rows; j += lanes) {
    const V y = hn::LoadU(d, task.y + j);
    const V of_row = task.of_row ? hn::LoadU(d, task.of_row + j) : zero;
    const auto radius_of = [&](const RowLevel& level) HWY_ATTR {
      const V r =
          hn::MulAdd(hn::Add(of_row, hn::Set(d, level.radius)), factor, hn::Set(d, level.margin));
      return hn::Max(r, zero);
    };
    const V reach = radius_of(task.levels[task.widest]);
    const auto is_near =
        hn::And(hn::Ge(hn::Add(y, reach), y_min), hn::Le(hn::Sub(y, reach), y_max));
    uint64_t met = bits_of(d, is_near);
    if (task.rows - j < lanes) met &= (uint64_t{1} << (task.rows - j)) - 1;
    if (!met) continue;
    for (size_t l = 0; l < task.levels.size(); ++l) {
      const V r = radius_of(task.levels[l]);
      const Intervals cut = shape.cut(y, r);
      const auto is_met = hn::And(hn::Le(cut.low, cut.high), hn::Gt(r, zero));
      if (l == task.widest) met &= bits_of(d, is_met);
      const V low = hn::IfThenElseZero(is_met, hn::Floor(hn::Mul(cut.low, scale)));
      const V high = hn::IfThenElse(is_met, hn::Floor(hn::Mul(cut.high, scale)), hn::Neg(one));
      hn::Store(hn::DemoteTo(di, low), di, workspace.low[l]);
      hn::Store(hn::DemoteTo(di, high), di, workspace.high[l]);
    }
    for (; met; met &= met - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(met));
      const size_t row = j + lane;
      if (!task.alive[row]) continue;
      mark_row<section_words>(
          task, workspace, is_even, lane, row, [&](size_t word, uint64_t rest) HWY_ATTR {
            for (; rest; rest &= rest - 1)
              left.push_back(
                  {static_cast<uint32_t>(row), static_cast<uint32_t>(word * bits_per_word) +
                                                   static_cast<uint32_t>(std::countr_zero(rest))});
          });
    }
  }
}

void mark_plates(const RowPlates& plates, const RowTask& task, RowWorkspace& workspace,
                 std::vector<LeftSample>& left) {
  size_t max_left = size_t{1} << 16;
  const RowLevel widest = task.levels[task.widest];
  const double max_of_row =
      task.of_row ? *std::max_element(task.of_row, task.of_row + task.rows) : 0;
  for (const RowPlate& plate : plates.plates) {
    const double reach = plate.factor * (widest.radius + max_of_row) + widest.margin;
    if (task.z + reach < plate.bounds.min.z || task.z - reach > plate.bounds.max.z) continue;
    with_section_words(task.section_words, [&](auto words) HWY_ATTR {
      draw_plate<decltype(words)::value>(plates, plate, task, workspace, left);
    });
    if (left.size() < max_left) continue;
    // Plates that share a surface leave the same samples undecided.
    std::sort(left.begin(), left.end());
    left.erase(std::unique(left.begin(), left.end()), left.end());
    max_left = std::max(max_left, 2 * left.size());
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(mark_plates);

}  // namespace

void RowPlates::mark_inside(const RowTask& task, std::vector<LeftSample>& left) const {
  // The field may be the host's, and its callbacks may slice.
  const Borrowed<RowWorkspace> workspace;
  HWY_DYNAMIC_DISPATCH(mark_plates)(*this, task, *workspace, left);
}

}  // namespace msq
#endif  // HWY_ONCE
