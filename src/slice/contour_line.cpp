// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slice/contour_line.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "slice/contour_line.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

/// Directions from a point between two, left and right, which are less than half a turn apart.
//
// Each side of the cone moves to the gate's where that lies within the cone, stays where it lies
// within the gate, and else the two have no direction in common. Of two crosses with the factors
// exchanged, one is the other's negative to the last bit.
#if HWY_TARGET == HWY_SCALAR

class Cone {
 public:
  explicit Cone(Vec2 from) : from_(from) {}

  /// False if no direction passes the gate.
  bool begin(const LineGate& gate) {
    left_ = left_of(gate);
    right_ = right_of(gate);
    return cross(right_, left_) > 0;
  }
  bool holds(Vec2 p) const {
    const Vec2 d = p - from_;
    return cross(right_, d) >= 0 && cross(d, left_) >= 0;
  }
  /// False if no direction passes both.
  bool narrow(const LineGate& gate) {
    const Vec2 left = left_of(gate), right = right_of(gate);
    const double right_left = cross(right_, left), left_left = cross(left, left_);
    const double right_right = cross(right_, right), right_behind = cross(right, left_);
    const bool moves_left = right_left >= 0 && left_left >= 0;
    const bool moves_right = right_right >= 0 && right_behind >= 0;
    const bool stays_left = right_behind >= 0 && left_left <= 0;
    const bool stays_right = right_right <= 0 && right_left >= 0;
    if (moves_left) left_ = left;
    if (moves_right) right_ = right;
    return (moves_left || stays_left) && (moves_right || stays_right) && cross(right, left) > 0 &&
           cross(right_, left_) > 0;
  }

 private:
  Vec2 left_of(const LineGate& gate) const { return Vec2{gate.left_x, gate.left_y} - from_; }
  Vec2 right_of(const LineGate& gate) const { return Vec2{gate.right_x, gate.right_y} - from_; }

  Vec2 from_, left_, right_;
};

#else

class Cone {
  // One lane for the left, one for the right.
  using D = hn::FixedTag<double, 2>;
  using V = hn::Vec<D>;

 public:
  HWY_INLINE explicit Cone(Vec2 from)
      : from_x_(hn::Set(D(), from.x)), from_y_(hn::Set(D(), from.y)) {}

  HWY_INLINE bool begin(const LineGate& gate) {
    const D d;
    x_ = hn::Sub(hn::LoadU(d, &gate.left_x), from_x_);
    y_ = hn::Sub(hn::LoadU(d, &gate.left_y), from_y_);
    return hn::GetLane(right_to_left(x_, y_)) > 0;
  }
  HWY_INLINE bool holds(Vec2 p) const {
    const D d;
    const V dx = hn::Sub(hn::Set(d, p.x), from_x_), dy = hn::Sub(hn::Set(d, p.y), from_y_);
    // The left lane is the negative of what it should be.
    const V sides = hn::Sub(hn::Mul(x_, dy), hn::Mul(y_, dx));
    const V signs = hn::ConcatUpperLower(d, hn::Zero(d), hn::Set(d, -0.0));
    return hn::AllTrue(d, hn::Ge(hn::Xor(sides, signs), hn::Zero(d)));
  }
  HWY_INLINE bool narrow(const LineGate& gate) {
    const D d;
    const V zero = hn::Zero(d);
    const V x = hn::Sub(hn::LoadU(d, &gate.left_x), from_x_);
    const V y = hn::Sub(hn::LoadU(d, &gate.left_y), from_y_);
    // From the cone's right to both sides of the gate, and from these to the cone's left.
    const V from_right = hn::Sub(hn::Mul(right_of(x_), y), hn::Mul(right_of(y_), x));
    const V to_left = hn::Sub(hn::Mul(x, left_of(y_)), hn::Mul(y, left_of(x_)));
    const auto moves = hn::And(hn::Ge(from_right, zero), hn::Ge(to_left, zero));
    // In the left lane from the gate's right to the cone's left, and from the gate's left there; in
    // the right lane from the cone's right to the gate's left, and to its right.
    const V behind = hn::Shuffle01(hn::ConcatUpperLower(d, to_left, from_right));
    const V before = hn::ConcatUpperLower(d, from_right, to_left);
    const auto stays = hn::And(hn::Ge(behind, zero), hn::Le(before, zero));
    x_ = hn::IfThenElse(moves, x, x_);
    y_ = hn::IfThenElse(moves, y, y_);
    const V are_open = hn::ConcatUpperLower(d, right_to_left(x, y), right_to_left(x_, y_));
    return hn::AllTrue(d, hn::And(hn::Or(moves, stays), hn::Gt(are_open, zero)));
  }

 private:
  static HWY_INLINE V left_of(V v) { return hn::ConcatLowerLower(D(), v, v); }
  static HWY_INLINE V right_of(V v) { return hn::ConcatUpperUpper(D(), v, v); }
  /// In both lanes.
  static HWY_INLINE V right_to_left(V x, V y) {
    return hn::Sub(hn::Mul(right_of(x), left_of(y)), hn::Mul(right_of(y), left_of(x)));
  }

  V from_x_, from_y_, x_{}, y_{};
};

#endif

size_t simplify_ring(const LineRun* runs, size_t count, const Vec2* at, const LineGate* gates,
                     double units, Vec2* out) {
  /// Points that are looked at beyond the last that fits.
  constexpr size_t max_look_ahead = 64;
  size_t written = 0;
  for (size_t r = 0; r < count; ++r) {
    const Vec2 to = runs[r + 1 < count ? r + 1 : 0].from;
    const size_t end = runs[r].end;  // where `to` is
    Vec2 from = runs[r].from;
    for (size_t next = runs[r].first;;) {
      out[written++] = from * units;
      if (next == end) break;
      size_t last = next, i = next + 1;
      Cone cone(from);
      bool is_open = cone.begin(gates[next]);
      for (; is_open && i < end && i - last <= max_look_ahead; ++i) {
        last = cone.holds(at[i]) ? i : last;
        is_open = cone.narrow(gates[i]);
      }
      if (is_open && i == end && i - last <= max_look_ahead && cone.holds(to)) break;
      from = at[last];
      next = last + 1;
    }
  }
  return written;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

HWY_EXPORT(simplify_ring);

}  // namespace

size_t simplify_ring(const LineRun* runs, size_t count, const Vec2* at, const LineGate* gates,
                     double units, Vec2* out) {
  return HWY_DYNAMIC_DISPATCH(simplify_ring)(runs, count, at, gates, units, out);
}

}  // namespace msq
#endif  // HWY_ONCE
