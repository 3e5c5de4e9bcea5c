// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/voronoi_cell.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd.h"
#include "structure/foam/voronoi_cell.h"

#ifndef MSQ_VORONOI_CELL_ONCE
#define MSQ_VORONOI_CELL_ONCE
namespace msq {

/// The first plane met from a point along a direction.
struct PlaneHit {
  double t;
  uint32_t plane;  // most_planes: none
};

/// Half-edge table and vertices of a walk.
struct WalkState {
  const VoronoiCell::Planes* planes;
  size_t count, padded;
  std::vector<VoronoiCell::Vertex>* vertices;
  uint32_t* ends;
  uint32_t epoch;
  double radius_squared;
};

}  // namespace msq
#endif

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Least (offset - n . p) / (n . d) over planes with n . d > 0. Fractions are compared by cross
/// products, which spares a division a plane.
HWY_INLINE PlaneHit first_plane(const VoronoiCell::Planes& planes, size_t padded, Vec3 p, Vec3 d) {
  const hn::ScalableTag<double> tag;
  using V = hn::Vec<decltype(tag)>;
  const size_t lanes = hn::Lanes(tag);
  const V px = hn::Set(tag, p.x), py = hn::Set(tag, p.y), pz = hn::Set(tag, p.z);
  const V dx = hn::Set(tag, d.x), dy = hn::Set(tag, d.y), dz = hn::Set(tag, d.z);
  // Planes along the edge itself have n . d = 0 but for rounding.
  const V parallel = hn::Set(tag, 1e-13);
  V best_num = hn::Set(tag, 1e100), best_den = hn::Set(tag, 1.0);
  V best = hn::Set(tag, static_cast<double>(VoronoiCell::most_planes));
  V index = hn::Iota(tag, 0.0);
  const V step = hn::Set(tag, static_cast<double>(lanes));
  for (size_t i = 0; i < padded; i += lanes) {
    const V nx = hn::Load(tag, planes.x + i), ny = hn::Load(tag, planes.y + i),
            nz = hn::Load(tag, planes.z + i);
    const V num = hn::Sub(
        hn::Load(tag, planes.offset + i),
        hn::Add(hn::Add(hn::Mul(nx, px), hn::Mul(ny, py)), hn::Mul(nz, pz)));
    const V den = hn::Add(hn::Add(hn::Mul(nx, dx), hn::Mul(ny, dy)), hn::Mul(nz, dz));
    const auto nearer = hn::And(hn::Gt(den, parallel),
                                hn::Lt(hn::Mul(num, best_den), hn::Mul(best_num, den)));
    best_num = hn::IfThenElse(nearer, num, best_num);
    best_den = hn::IfThenElse(nearer, den, best_den);
    best = hn::IfThenElse(nearer, index, best);
    index = hn::Add(index, step);
  }
  const V t = hn::Div(best_num, best_den);
  const V least = hn::MinOfLanes(tag, t);
  HWY_ALIGN double indices[most_simd_doubles];
  hn::Store(best, tag, indices);
  const intptr_t lane = hn::FindFirstTrue(tag, hn::Eq(t, least));
  if (lane < 0) return {0, VoronoiCell::most_planes};  // NaN
  return {hn::GetLane(least), static_cast<uint32_t>(indices[lane])};
}

bool walk_cell(WalkState& state) {
  constexpr uint32_t width = VoronoiCell::most_planes, none = VoronoiCell::most_planes;
  const VoronoiCell::Planes& planes = *state.planes;
  std::vector<VoronoiCell::Vertex>& vertices = *state.vertices;
  const auto normal = [&](uint32_t i) { return Vec3{planes.x[i], planes.y[i], planes.z[i]}; };
  const auto known = [&](uint32_t a, uint32_t b) {
    return state.ends[a * width + b] >> 16 == state.epoch;
  };
  const auto add_vertex = [&](uint32_t a, uint32_t b, uint32_t c, Vec3 p) {
    if (vertices.size() == VoronoiCell::most_vertices || known(a, b) || known(b, c) || known(c, a))
      return false;
    const uint32_t value = state.epoch << 16 | static_cast<uint32_t>(vertices.size());
    state.ends[a * width + b] = value;
    state.ends[b * width + c] = value;
    state.ends[c * width + a] = value;
    vertices.push_back({{static_cast<uint16_t>(a), static_cast<uint16_t>(b),
                         static_cast<uint16_t>(c)}, p});
    state.radius_squared = std::max(state.radius_squared, dot(p, p));
    return true;
  };

  uint32_t a = 0;
  for (uint32_t i = 1; i < state.count; ++i)
    if (planes.offset[i] < planes.offset[a]) a = i;
  const Vec3 na = normal(a);
  const Vec3 least_axis = std::abs(na.x) <= std::abs(na.y) && std::abs(na.x) <= std::abs(na.z)
                              ? Vec3{1, 0, 0}
                          : std::abs(na.y) <= std::abs(na.z) ? Vec3{0, 1, 0}
                                                             : Vec3{0, 0, 1};
  Vec3 p = na * 0.5;
  Vec3 d = cross(na, least_axis);
  const PlaneHit edge = first_plane(planes, state.padded, p, d);
  if (edge.plane == none) return false;
  p = p + d * edge.t;
  d = cross(na, normal(edge.plane));
  const PlaneHit start = first_plane(planes, state.padded, p, d);
  if (start.plane == none || start.plane == a || start.plane == edge.plane) return false;
  p = p + d * start.t;
  if (!add_vertex(a, edge.plane, start.plane, p)) return false;

  // Vertices are their own queue: each one's three edges are followed in turn.
  for (size_t v = 0; v < vertices.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      const VoronoiCell::Vertex vertex = vertices[v];
      const uint32_t from = vertex.plane[i], to = vertex.plane[(i + 1) % 3];
      if (known(to, from)) continue;
      const Vec3 along = cross(normal(to), normal(from));
      const PlaneHit hit = first_plane(planes, state.padded, vertex.position, along);
      if (hit.plane == none || hit.plane == from || hit.plane == to) return false;
      if (!add_vertex(to, from, hit.plane, vertex.position + along * hit.t)) return false;
    }

  bool used[VoronoiCell::most_planes] = {};
  size_t faces = 0;
  for (const VoronoiCell::Vertex& vertex : vertices)
    for (uint16_t plane : vertex.plane) {
      faces += !used[plane];
      used[plane] = true;
    }
  return vertices.size() == 2 * faces - 4;
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

HWY_EXPORT(walk_cell);

void VoronoiCell::add(Vec3 neighbour) {
  planes_.x[count_] = neighbour.x;
  planes_.y[count_] = neighbour.y;
  planes_.z[count_] = neighbour.z;
  planes_.offset[count_] = 0.5 * dot(neighbour, neighbour);
  ++count_;
}

bool VoronoiCell::walk() {
  vertices_.clear();
  radius_squared_ = 0;
  if (count_ < 4) return false;
  if (ends_.empty() || ++epoch_ > 0xffff) {
    ends_.assign(most_planes * most_planes, 0);
    epoch_ = 1;
  }
  // Planes that are never met, up to a whole vector.
  static_assert(most_planes % most_simd_doubles == 0);
  size_t padded = count_;
  for (; padded % most_simd_doubles != 0; ++padded)
    planes_.x[padded] = planes_.y[padded] = planes_.z[padded] = planes_.offset[padded] = 0;
  WalkState state{&planes_, count_, padded, &vertices_, ends_.data(), epoch_, 0};
  const bool done = HWY_DYNAMIC_DISPATCH(walk_cell)(state);
  radius_squared_ = state.radius_squared;
  return done;
}

Vec3 VoronoiCell::corner(const Vertex& vertex) const {
  const auto normal = [&](int i) {
    const uint16_t p = vertex.plane[i];
    return Vec3{planes_.x[p], planes_.y[p], planes_.z[p]};
  };
  const Vec3 a = normal(0), b = normal(1), c = normal(2);
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  return (bc * planes_.offset[vertex.plane[0]] + ca * planes_.offset[vertex.plane[1]] +
          ab * planes_.offset[vertex.plane[2]]) *
         (1 / dot(a, bc));
}

}  // namespace msq
#endif  // HWY_ONCE
