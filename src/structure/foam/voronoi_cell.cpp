// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/voronoi_cell.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/simd.h"
#include "structure/foam/voronoi_cell.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr uint32_t no_plane = VoronoiCell::most_planes;

/// The first plane met from a point along a direction.
struct PlaneHit {
  double t;
  uint32_t plane;
};

template <class T>
struct PlaneArrays {
  const T *x, *y, *z, *offset;
  size_t padded;
};

/// Least (offset - n . p) / (n . d) over planes with n . d > 0, but for three. Fractions are
/// compared by cross products, which spares a division a plane.
template <class T>
HWY_INLINE PlaneHit first_plane(const PlaneArrays<T>& planes, Vec3 p, Vec3 d, uint32_t a,
                                uint32_t b, uint32_t c) {
  const hn::ScalableTag<T> tag;
  const size_t lanes = hn::Lanes(tag);
  const auto set = [&](double v) { return hn::Set(tag, static_cast<T>(v)); };
  const auto px = set(p.x), py = set(p.y), pz = set(p.z);
  const auto dx = set(d.x), dy = set(d.y), dz = set(d.z);
  const auto not_a = set(a), not_b = set(b), not_c = set(c);
  const auto parallel = set(1e-13);
  auto best_num = set(1e18), best_den = set(1);
  auto best = set(no_plane);
  auto index = hn::Iota(tag, T{0});
  const auto step = set(static_cast<double>(lanes));
  for (size_t i = 0; i < planes.padded; i += lanes) {
    const auto nx = hn::Load(tag, planes.x + i), ny = hn::Load(tag, planes.y + i),
               nz = hn::Load(tag, planes.z + i);
    const auto num = hn::Sub(hn::Load(tag, planes.offset + i),
                             hn::Add(hn::Add(hn::Mul(nx, px), hn::Mul(ny, py)), hn::Mul(nz, pz)));
    const auto den = hn::Add(hn::Add(hn::Mul(nx, dx), hn::Mul(ny, dy)), hn::Mul(nz, dz));
    const auto other =
        hn::And(hn::And(hn::Ne(index, not_a), hn::Ne(index, not_b)), hn::Ne(index, not_c));
    const auto nearer = hn::And(hn::And(other, hn::Gt(den, parallel)),
                                hn::Lt(hn::Mul(num, best_den), hn::Mul(best_num, den)));
    best_num = hn::IfThenElse(nearer, num, best_num);
    best_den = hn::IfThenElse(nearer, den, best_den);
    best = hn::IfThenElse(nearer, index, best);
    index = hn::Add(index, step);
  }
  const auto t = hn::Div(best_num, best_den);
  const auto least = hn::MinOfLanes(tag, t);
  HWY_ALIGN T indices[2 * most_simd_doubles];
  hn::Store(best, tag, indices);
  const intptr_t lane = hn::FindFirstTrue(tag, hn::Eq(t, least));
  if (lane < 0) return {0, no_plane};  // NaN
  return {static_cast<double>(hn::GetLane(least)), static_cast<uint32_t>(indices[lane])};
}

template <class T>
bool walk(const PlaneArrays<T>& planes, size_t count, VoronoiCell::Graph& graph) {
  constexpr uint32_t width = VoronoiCell::most_planes;
  std::vector<VoronoiCell::Vertex>& vertices = graph.vertices;
  vertices.clear();
  if (graph.ends.empty() || ++graph.epoch > 0xffff) {
    graph.ends.assign(width * width, 0);
    graph.epoch = 1;
  }
  const auto normal = [&](uint32_t i) { return Vec3{planes.x[i], planes.y[i], planes.z[i]}; };
  const auto known = [&](uint32_t a, uint32_t b) {
    return graph.ends[a * width + b] >> 16 == graph.epoch;
  };
  const auto add_vertex = [&](uint32_t a, uint32_t b, uint32_t c, Vec3 p) {
    if (vertices.size() == VoronoiCell::most_vertices || known(a, b) || known(b, c) || known(c, a))
      return false;
    const uint32_t value = graph.epoch << 16 | static_cast<uint32_t>(vertices.size());
    graph.ends[a * width + b] = value;
    graph.ends[b * width + c] = value;
    graph.ends[c * width + a] = value;
    vertices.push_back(
        {{static_cast<uint16_t>(a), static_cast<uint16_t>(b), static_cast<uint16_t>(c)}, p});
    return true;
  };

  uint32_t a = 0;
  for (uint32_t i = 1; i < count; ++i)
    if (planes.offset[i] < planes.offset[a]) a = i;
  const Vec3 na = normal(a);
  const Vec3 least_axis = std::abs(na.x) <= std::abs(na.y) && std::abs(na.x) <= std::abs(na.z)
                              ? Vec3{1, 0, 0}
                          : std::abs(na.y) <= std::abs(na.z) ? Vec3{0, 1, 0}
                                                             : Vec3{0, 0, 1};
  Vec3 p = na * 0.5;
  Vec3 d = cross(na, least_axis);
  const PlaneHit edge = first_plane(planes, p, d, a, a, a);
  if (edge.plane == no_plane) return false;
  p = p + d * edge.t;
  d = cross(na, normal(edge.plane));
  const PlaneHit start = first_plane(planes, p, d, a, edge.plane, edge.plane);
  if (start.plane == no_plane) return false;
  if (!add_vertex(a, edge.plane, start.plane, p + d * start.t)) return false;

  // Vertices are their own queue: each one's three edges are followed in turn.
  for (size_t v = 0; v < vertices.size(); ++v)
    for (int i = 0; i < 3; ++i) {
      const VoronoiCell::Vertex vertex = vertices[v];
      const uint32_t from = vertex.plane[i], to = vertex.plane[(i + 1) % 3];
      if (known(to, from)) continue;
      const Vec3 along = cross(normal(to), normal(from));
      const PlaneHit hit =
          first_plane(planes, vertex.position, along, from, to, vertex.plane[(i + 2) % 3]);
      if (hit.plane == no_plane) return false;
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

/// Puts each vertex where its planes meet. Returns by how much one lies beyond a plane, or off its
/// own, at most.
double place_vertices(const PlaneArrays<double>& planes, VoronoiCell::Graph& graph) {
  const hn::ScalableTag<double> tag;
  const size_t lanes = hn::Lanes(tag);
  auto beyond = hn::Zero(tag);
  double off = 0;
  for (VoronoiCell::Vertex& vertex : graph.vertices) {
    const uint16_t* plane = vertex.plane;
    const auto normal = [&](uint16_t i) { return Vec3{planes.x[i], planes.y[i], planes.z[i]}; };
    const Vec3 a = normal(plane[0]), b = normal(plane[1]), c = normal(plane[2]);
    const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const Vec3 p = (bc * planes.offset[plane[0]] + ca * planes.offset[plane[1]] +
                    ab * planes.offset[plane[2]]) *
                   (1 / dot(a, bc));
    vertex.position = p;
    for (int i = 0; i < 3; ++i)
      off = std::max(off, std::abs(dot(normal(plane[i]), p) - planes.offset[plane[i]]));
    const auto px = hn::Set(tag, p.x), py = hn::Set(tag, p.y), pz = hn::Set(tag, p.z);
    for (size_t i = 0; i < planes.padded; i += lanes) {
      const auto over = hn::Sub(hn::Add(hn::Add(hn::Mul(hn::Load(tag, planes.x + i), px),
                                                hn::Mul(hn::Load(tag, planes.y + i), py)),
                                        hn::Mul(hn::Load(tag, planes.z + i), pz)),
                                hn::Load(tag, planes.offset + i));
      beyond = hn::Max(beyond, over);
    }
  }
  return std::max(off, hn::GetLane(hn::MaxOfLanes(tag, beyond)));
}

bool build_cell(VoronoiCell::Planes& planes, size_t count, VoronoiCell::Graph& graph) {
  // Planes that are never met, up to a whole vector.
  const size_t lanes = hn::Lanes(hn::ScalableTag<float>());
  const size_t padded = (count + lanes - 1) / lanes * lanes;
  for (size_t i = count; i < padded; ++i) {
    planes.x[i] = planes.y[i] = planes.z[i] = 0;
    planes.fx[i] = planes.fy[i] = planes.fz[i] = 0;
    planes.offset[i] = planes.foffset[i] = 1;
  }
  const PlaneArrays<float> single{planes.fx, planes.fy, planes.fz, planes.foffset, padded};
  const PlaneArrays<double> full{planes.x, planes.y, planes.z, planes.offset, padded};
  // A vertex that is right is on its planes and beyond no other, but for rounding.
  constexpr double most_beyond = 1e-10;
  if (walk(single, count, graph) && place_vertices(full, graph) <= most_beyond) return true;
  return walk(full, count, graph) && place_vertices(full, graph) <= most_beyond;
}

}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

static_assert(VoronoiCell::most_planes % (2 * most_simd_doubles) == 0);

HWY_EXPORT(build_cell);

void VoronoiCell::add(Vec3 neighbour) {
  const double offset = 0.5 * dot(neighbour, neighbour);
  planes_.x[count_] = neighbour.x;
  planes_.y[count_] = neighbour.y;
  planes_.z[count_] = neighbour.z;
  planes_.offset[count_] = offset;
  planes_.fx[count_] = static_cast<float>(neighbour.x);
  planes_.fy[count_] = static_cast<float>(neighbour.y);
  planes_.fz[count_] = static_cast<float>(neighbour.z);
  planes_.foffset[count_] = static_cast<float>(offset);
  ++count_;
}

bool VoronoiCell::walk() {
  graph_.vertices.clear();
  radius_squared_ = 0;
  if (count_ < 4) return false;
  if (!HWY_DYNAMIC_DISPATCH(build_cell)(planes_, count_, graph_)) return false;
  for (const Vertex& vertex : graph_.vertices)
    radius_squared_ = std::max(radius_squared_, dot(vertex.position, vertex.position));
  return true;
}

}  // namespace msq
#endif  // HWY_ONCE
