// SPDX-License-Identifier: Apache-2.0
// Crossings have the same bits for all targets, and distances of triangles those of
// TreeTriangle::distance_squared(). Bounds may use fused operations: the slack of the tree covers
// their rounding.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shape/triangle_search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>

#include "base/lanes3-inl.h"
#include "base/mask_bits-inl.h"
#include "base/simd.h"
#include "shape/triangle_search.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

using D = hn::CappedTag<double, tree_width>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Vector = Lanes3<D>;

HWY_INLINE V edge_squared(D d, const Vector& w, const Vector& ab, const double* inverse) {
  const V t = clamp01(d, hn::Mul(dot<D>(w, ab), hn::Load(d, inverse)));
  const Vector away = subtract<D>(w, scale<D>(ab, t));
  return dot<D>(away, away);
}

/// TreeTriangle::distance_squared() of the triangles of a block from i on.
HWY_INLINE V distances_squared(D d, const TriangleBlock& block, const Vector& p, size_t i) {
  const V zero = hn::Zero(d), far = hn::Set(d, std::numeric_limits<double>::infinity());
  const Vector a = load_lanes(d, block.a, i), u = load_lanes(d, block.u, i),
               v = load_lanes(d, block.v, i);
  const V inverse = hn::Load(d, block.inverse_normal_squared + i);
  const Vector w = subtract<D>(p, a), normal = cross<D>(u, v);
  const V of_u = hn::Mul(dot<D>(cross<D>(w, v), normal), inverse);
  const V of_v = hn::Mul(dot<D>(cross<D>(u, w), normal), inverse);
  const M is_flat = hn::Eq(inverse, zero);
  const M beyond_u = hn::Or(hn::Lt(of_v, zero), is_flat);
  const M beyond_v = hn::Or(hn::Lt(of_u, zero), is_flat);
  const M beyond_w = hn::Or(hn::Gt(hn::Add(of_u, of_v), hn::Set(d, 1)), is_flat);
  const Vector within = subtract<D>(subtract<D>(w, scale<D>(u, of_u)), scale<D>(v, of_v));
  const V inner = dot<D>(within, within);
  const M is_beyond = hn::Or(hn::Or(beyond_u, beyond_v), beyond_w);
  if (hn::AllFalse(d, is_beyond)) return inner;
  const Vector b = {hn::Add(a.x, u.x), hn::Add(a.y, u.y), hn::Add(a.z, u.z)};
  const Vector c = {hn::Add(a.x, v.x), hn::Add(a.y, v.y), hn::Add(a.z, v.z)};
  const V of_edge_u = edge_squared(d, w, subtract<D>(b, a), block.inverse_edge_squared[0] + i);
  const V of_edge_v = edge_squared(d, w, subtract<D>(c, a), block.inverse_edge_squared[1] + i);
  const V of_edge_w =
      edge_squared(d, subtract<D>(p, b), subtract<D>(c, b), block.inverse_edge_squared[2] + i);
  const V outer = hn::Min(
      hn::Min(hn::IfThenElse(beyond_u, of_edge_u, far), hn::IfThenElse(beyond_v, of_edge_v, far)),
      hn::IfThenElse(beyond_w, of_edge_w, far));
  return hn::IfThenElse(is_beyond, outer, inner);
}

HWY_INLINE V over(D d, V value, V than) {
  return hn::Max(hn::Sub(value, than), hn::Zero(d));
}

/// Bounds of the squared distances to the children of a node from i on; if a bound is at least the
/// limit, it may be any bound that is.
HWY_INLINE V bounds_squared(D d, const BoundNode& node, const Vector& p, V limit, size_t i) {
  const V zero = hn::Zero(d);
  const Vector low = subtract<D>(load_lanes(d, node.min, i), p);
  const Vector high = subtract<D>(p, load_lanes(d, node.max, i));
  const Vector gap = {hn::Max(hn::Max(low.x, high.x), zero), hn::Max(hn::Max(low.y, high.y), zero),
                      hn::Max(hn::Max(low.z, high.z), zero)};
  const V of_box = fast_dot<D>(gap, gap);
  if (hn::AllFalse(d, hn::Lt(of_box, limit))) return of_box;
  const Vector w = subtract<D>(p, load_lanes(d, node.centre, i)),
               normal = load_lanes(d, node.normal, i);
  const V along = fast_dot<D>(normal, w);
  const V above = over(d, hn::Abs(along), hn::Load(d, node.half_height + i));
  const Vector across = fast_add_scaled<D>(w, normal, hn::Neg(along));
  const V beyond = over(d, hn::Sqrt(fast_dot<D>(across, across)), hn::Load(d, node.radius + i));
  return hn::Max(of_box, hn::MulAdd(above, above, hn::Mul(beyond, beyond)));
}

/// goal.best(): the square of the limit. goal.take(triangle, squared), for those up to it, returns
/// false to stop.
template <class Goal>
HWY_INLINE void search(const TriangleTreeView& tree, Vec3 at, Goal& goal) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const Vector p = set_lanes(d, at);
  const auto limit_of = [&](double best) { return best * (1 + 0x1p-20) + tree.slack; };
  double limit = limit_of(goal.best());
  Waiting waiting[max_waiting];
  size_t count = 0;
  waiting[count++] = {0, 0};
  HWY_ALIGN double squared[tree_width];
  while (count > 0) {
    const Waiting next = waiting[--count];
    if (!(next.bound < limit)) continue;
    uint32_t bits = 0;
    if (next.child & BoundNode::block_bit) {
      const uint32_t block = next.child & ~BoundNode::block_bit;
      const V best = hn::Set(d, goal.best());
      for (size_t i = 0; i < tree_width; i += lanes) {
        const V value = distances_squared(d, tree.blocks[block], p, i);
        hn::Store(value, d, squared + i);
        bits |= static_cast<uint32_t>(bits_of(d, hn::Le(value, best))) << i;
      }
      for (; bits; bits &= bits - 1) {
        const uint32_t i = static_cast<uint32_t>(std::countr_zero(bits));
        if (!goal.take(block * tree_width + i, squared[i])) return;
      }
      limit = limit_of(goal.best());
      continue;
    }
    const BoundNode& node = tree.nodes[next.child];
    const V most = hn::Set(d, limit);
    for (size_t i = 0; i < tree_width; i += lanes) {
      const V bound = bounds_squared(d, node, p, most, i);
      hn::Store(bound, d, squared + i);
      bits |= static_cast<uint32_t>(bits_of(d, hn::Lt(bound, most))) << i;
    }
    bits &= (uint32_t{1} << node.count) - 1;
    count = add_waiting(waiting, count, node, bits, squared);
  }
}

struct NearestGoal {
  NearestTriangle& nearest;

  double best() const { return nearest.squared; }
  bool take(uint32_t triangle, double squared) {
    const bool is_tie = squared == nearest.squared && triangle < nearest.triangle;
    if (squared < nearest.squared || is_tie) nearest = {squared, triangle};
    return true;
  }
};

struct BelowGoal {
  TriangleBelow& found;

  double best() const { return found.is_below_high ? found.low_squared : found.high_squared; }
  bool take(uint32_t triangle, double squared) {
    if (!(squared < best())) return true;
    found.triangle = triangle;
    found.is_below_high = true;
    found.is_below_low = squared < found.low_squared;
    return !found.is_below_low && found.low_squared > 0;
  }
};

void search_nearest(const TriangleTreeView& tree, Vec3 p, NearestTriangle& nearest) {
  NearestGoal goal{nearest};
  search(tree, p, goal);
}

void search_below(const TriangleTreeView& tree, Vec3 p, TriangleBelow& found) {
  BelowGoal goal{found};
  search(tree, p, goal);
}

/// As clip_to_box() of each box.
uint32_t clip_boxes(const BoundNode& node, const Ray& ray, double from, double to, double margin,
                    double* entry) {
  const D d;
  uint32_t bits = 0;
  const V zero = hn::Zero(d), less = hn::Set(d, 1 - 0x1p-50), more = hn::Set(d, 1 + 0x1p-50);
  const V room = hn::Set(d, margin);
  for (size_t i = 0; i < tree_width; i += hn::Lanes(d)) {
    V low = hn::Set(d, from), high = hn::Set(d, to);
    M meets = hn::Lt(low, hn::Set(d, std::numeric_limits<double>::infinity()));
    for (int axis = 0; axis < 3; ++axis) {
      const V o = hn::Set(d, ray.origin[axis]), along = hn::Set(d, ray.direction[axis]);
      const V min = hn::Sub(hn::Load(d, node.min[axis] + i), room);
      const V max = hn::Add(hn::Load(d, node.max[axis] + i), room);
      if (ray.direction[axis] == 0) {
        meets = hn::And(meets, hn::And(hn::Ge(o, min), hn::Le(o, max)));
        continue;
      }
      const V one = hn::Div(hn::Sub(min, o), along), other = hn::Div(hn::Sub(max, o), along);
      const V near = hn::Min(one, other), far = hn::Max(one, other);
      low = hn::Max(low, hn::Mul(near, hn::IfThenElse(hn::Gt(near, zero), less, more)));
      high = hn::Min(high, hn::Mul(far, hn::IfThenElse(hn::Gt(far, zero), more, less)));
    }
    hn::Store(low, d, entry + i);
    bits |= static_cast<uint32_t>(bits_of(d, hn::And(meets, hn::Le(low, high)))) << i;
  }
  return bits & ((uint32_t{1} << node.count) - 1);
}

uint32_t cross_triangles(const TriangleBlock& block, const Ray& ray, double from, double to,
                         double margin, double* at) {
  const D d;
  uint32_t bits = 0;
  const V zero = hn::Zero(d), one = hn::Set(d, 1);
  const Vector origin = set_lanes(d, ray.origin), direction = set_lanes(d, ray.direction);
  for (size_t i = 0; i < tree_width; i += hn::Lanes(d)) {
    const Vector a = load_lanes(d, block.a, i), u = load_lanes(d, block.u, i),
                 v = load_lanes(d, block.v, i);
    const Vector away = cross<D>(direction, v), normal = cross<D>(u, v);
    const V across = dot<D>(away, u), size = hn::Sqrt(dot<D>(normal, normal));
    // Nearly along the plane, the error of t is margin over the slope.
    M meets = hn::Gt(hn::Abs(across), hn::Mul(hn::Set(d, 0x1p-40), size));
    const V inverse = hn::Div(one, across);
    const Vector w = subtract<D>(origin, a), q = cross<D>(w, u);
    const V of_u = hn::Mul(dot<D>(w, away), inverse), of_v = hn::Mul(dot<D>(direction, q), inverse);
    const Vector third = subtract<D>(v, u);
    const V longest = hn::Max(hn::Max(dot<D>(u, u), dot<D>(v, v)), dot<D>(third, third));
    // The margin over the triangle's height.
    const V room = hn::Mul(hn::Mul(hn::Set(d, margin), hn::Sqrt(longest)), hn::Abs(inverse));
    const V t = hn::Mul(dot<D>(v, q), inverse);
    meets = hn::And(meets, hn::And(hn::Ge(of_u, hn::Neg(room)), hn::Ge(of_v, hn::Neg(room))));
    meets = hn::And(meets, hn::Le(hn::Add(of_u, of_v), hn::Add(one, room)));
    meets = hn::And(meets, hn::And(hn::Ge(t, hn::Set(d, from)), hn::Le(t, hn::Set(d, to))));
    hn::Store(hn::IfThenElse(meets, t, zero), d, at + i);
    bits |= static_cast<uint32_t>(bits_of(d, meets)) << i;
  }
  return bits;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(search_nearest);
HWY_EXPORT(search_below);
HWY_EXPORT(clip_boxes);
HWY_EXPORT(cross_triangles);

void find_nearest(const TriangleTreeView& tree, Vec3 p, NearestTriangle& nearest) {
  HWY_DYNAMIC_DISPATCH(search_nearest)(tree, p, nearest);
}

void find_below(const TriangleTreeView& tree, Vec3 p, TriangleBelow& found) {
  HWY_DYNAMIC_DISPATCH(search_below)(tree, p, found);
}

uint32_t meet_boxes(const BoundNode& node, const Ray& ray, double from, double to, double margin,
                    double (&entry)[tree_width]) {
  return HWY_DYNAMIC_DISPATCH(clip_boxes)(node, ray, from, to, margin, entry);
}

uint32_t meet_triangles(const TriangleBlock& block, const Ray& ray, double from, double to,
                        double margin, double (&at)[tree_width]) {
  return HWY_DYNAMIC_DISPATCH(cross_triangles)(block, ray, from, to, margin, at);
}

void TriangleBlock::set(uint32_t i, const TreeTriangle& t) {
  for (int axis = 0; axis < 3; ++axis) {
    a[axis][i] = t.a[axis];
    u[axis][i] = t.u[axis];
    v[axis][i] = t.v[axis];
  }
  inverse_normal_squared[i] = t.inverse_normal_squared();
  inverse_edge_squared[0][i] = t.edge_u().inverse_length_squared;
  inverse_edge_squared[1][i] = t.edge_v().inverse_length_squared;
  inverse_edge_squared[2][i] = t.edge_w().inverse_length_squared;
}

TreeTriangle TriangleBlock::at(uint32_t i) const {
  TreeTriangle t;
  for (int axis = 0; axis < 3; ++axis) {
    t.a[axis] = a[axis][i];
    t.u[axis] = u[axis][i];
    t.v[axis] = v[axis][i];
  }
  return t;
}

}  // namespace msq
#endif  // HWY_ONCE
