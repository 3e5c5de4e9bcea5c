// SPDX-License-Identifier: Apache-2.0
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/edges/voronoi_cell.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>

#include "base/simd.h"
#include "structure/foam/edges/voronoi_cell.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
namespace {

template <class T>
struct PlaneArrays {
  const T *x, *y, *z, *offset;
  size_t padded;
};

/// The first plane that a ray from a point meets.
template <class T>
struct PlaneHit {
  T t;  // a plane is met if this is below no_hit
  uint32_t plane;
};
template <class T>
constexpr T no_hit = T(1e18);

/// A direction along two planes has a sine below this with both, times lengths near 1. So they do
/// not count as hits, without a comparison of plane numbers. If another plane that is as nearly
/// parallel comes first, the test of vertices shows it.
template <class T>
constexpr T parallel = sizeof(T) == 4 ? T(1e-5) : T(1e-13);

HWY_INLINE hn::Vec<hn::ScalableTag<float>> reciprocal(hn::Vec<hn::ScalableTag<float>> v) {
  const auto r = hn::ApproximateReciprocal(v);
  return hn::Mul(r, hn::NegMulAdd(v, r, hn::Set(hn::ScalableTag<float>(), 2.0f)));
}
HWY_INLINE hn::Vec<hn::ScalableTag<double>> reciprocal(hn::Vec<hn::ScalableTag<double>> v) {
  return hn::Div(hn::Set(hn::ScalableTag<double>(), 1.0), v);
}

/// A ray's first plane so far, lane by lane.
template <class T>
struct RayLanes {
  using D = hn::ScalableTag<T>;
  using DU = hn::RebindToUnsigned<D>;
  using Index = hn::TFromD<DU>;
  hn::Vec<D> px, py, pz, dx, dy, dz, best;
  hn::Vec<DU> best_start;

  HWY_INLINE RayLanes(const T* p, const T* along) {
    const D d;
    px = hn::Set(d, p[0]);
    py = hn::Set(d, p[1]);
    pz = hn::Set(d, p[2]);
    dx = hn::Set(d, along[0]);
    dy = hn::Set(d, along[1]);
    dz = hn::Set(d, along[2]);
    best = hn::Set(d, no_hit<T>);
    best_start = hn::Zero(DU());
  }

  HWY_INLINE void meet(hn::Vec<D> nx, hn::Vec<D> ny, hn::Vec<D> nz, hn::Vec<D> offset, size_t i) {
    const D d;
    const DU du;
    const auto num = hn::NegMulAdd(nx, px, hn::NegMulAdd(ny, py, hn::NegMulAdd(nz, pz, offset)));
    const auto den = hn::MulAdd(nx, dx, hn::MulAdd(ny, dy, hn::Mul(nz, dz)));
    const auto t = hn::Mul(num, reciprocal(den));
    const auto nearer = hn::And(hn::Gt(den, hn::Set(d, parallel<T>)), hn::Lt(t, best));
    best = hn::IfThenElse(nearer, t, best);
    best_start =
        hn::IfThenElse(hn::RebindMask(du, nearer), hn::Set(du, static_cast<Index>(i)), best_start);
  }

  HWY_INLINE PlaneHit<T> hit() const {
    const D d;
    HWY_ALIGN Index starts[2 * max_simd_doubles];
    hn::Store(best_start, DU(), starts);
    const auto least = hn::MinOfLanes(d, best);
    const intptr_t lane = hn::FindFirstTrue(d, hn::Eq(best, least));
    if (lane < 0) return {no_hit<T>, 0};  // NaN
    return {hn::GetLane(least), static_cast<uint32_t>(starts[lane] + static_cast<size_t>(lane))};
  }
};

/// Where two rays from points p along directions meet their first planes: minimum of (offset - n .
/// p) / (n . d) with n . d > 0. Two at once hide each other's latencies. A number of vectors known
/// at compile time, if not 0, avoids a loop.
template <int known_vectors, class T>
HWY_INLINE void first_planes(const PlaneArrays<T>& planes, const T* p0, const T* along0,
                             const T* p1, const T* along1, PlaneHit<T>& hit0, PlaneHit<T>& hit1) {
  const hn::ScalableTag<T> d;
  const size_t lanes = hn::Lanes(d), end = known_vectors ? known_vectors * lanes : planes.padded;
  RayLanes<T> ray0(p0, along0), ray1(p1, along1);
  for (size_t i = 0; i < end; i += lanes) {
    const auto nx = hn::Load(d, planes.x + i), ny = hn::Load(d, planes.y + i),
               nz = hn::Load(d, planes.z + i), offset = hn::Load(d, planes.offset + i);
    ray0.meet(nx, ny, nz, offset, i);
    ray1.meet(nx, ny, nz, offset, i);
  }
  hit0 = ray0.hit();
  hit1 = ray1.hit();
}
template <class T>
HWY_INLINE PlaneHit<T> first_plane(const PlaneArrays<T>& planes, const T* p, const T* along) {
  PlaneHit<T> hit, same;
  first_planes<0>(planes, p, along, p, along, hit, same);
  return hit;
}

/// The graph during its construction.
template <class T>
struct Walk {
  static constexpr uint32_t width = VoronoiCell::max_planes, none = ~uint32_t{0};

  const PlaneArrays<T>& planes;
  VoronoiCell::Vertex* const vertices;
  uint16_t* const ends;
  const uint32_t epoch;
  uint32_t count = 0;            // of vertices
  uint32_t first = 0, last = 0;  // of the queue
  T positions[VoronoiCell::max_vertices + 1][3];
  uint32_t queue[3 * VoronoiCell::max_vertices + 3];  // from << 16 | to << 8 | vertex

  Walk(const PlaneArrays<T>& planes, VoronoiCell::Graph& graph)
      : planes(planes), vertices(graph.vertices), ends(graph.ends.data()), epoch(graph.epoch) {}

  HWY_INLINE bool known(uint32_t a, uint32_t b) const { return ends[a * width + b] >> 8 == epoch; }

  HWY_INLINE void cross(uint32_t a, uint32_t b, T* out) const {
    const T ax = planes.x[a], ay = planes.y[a], az = planes.z[a];
    const T bx = planes.x[b], by = planes.y[b], bz = planes.z[b];
    out[0] = ay * bz - az * by;
    out[1] = az * bx - ax * bz;
    out[2] = ax * by - ay * bx;
  }

  /// Adds a vertex of planes that are in anticlockwise order as seen from outside.
  HWY_INLINE void add_vertex(uint32_t a, uint32_t b, uint32_t c) {
    const uint16_t value = static_cast<uint16_t>(epoch << 8 | count);
    ends[a * width + b] = value;
    ends[b * width + c] = value;
    ends[c * width + a] = value;
    VoronoiCell::Vertex& vertex = vertices[count];
    vertex.plane[0] = static_cast<uint8_t>(a);
    vertex.plane[1] = static_cast<uint8_t>(b);
    vertex.plane[2] = static_cast<uint8_t>(c);
    ++count;
  }

  /// Queues the half-edge that leaves a vertex between two planes, unless its end is known.
  HWY_INLINE void follow(uint32_t from, uint32_t to, uint32_t vertex) {
    queue[last] = from << 16 | to << 8 | vertex;
    last += !known(to, from);
  }
  HWY_INLINE uint32_t next() {
    while (first < last) {
      const uint32_t half_edge = queue[first++];
      if (!known(half_edge >> 8 & 0xff, half_edge >> 16)) return half_edge;
    }
    return none;
  }

  /// Starts from the vertices found before.
  bool resume(size_t known_count) {
    for (size_t v = 0; v < known_count; ++v) {
      const VoronoiCell::Vertex& vertex = vertices[v];
      const uint32_t a = vertex.plane[0], b = vertex.plane[1], c = vertex.plane[2];
      if (known(a, b) || known(b, c) || known(c, a)) return false;
      for (int i = 0; i < 3; ++i) positions[v][i] = static_cast<T>(vertex.position[i]);
      add_vertex(a, b, c);
    }
    for (uint32_t v = 0; v < known_count; ++v) {
      const VoronoiCell::Vertex& vertex = vertices[v];
      follow(vertex.plane[0], vertex.plane[1], v);
      follow(vertex.plane[1], vertex.plane[2], v);
      follow(vertex.plane[2], vertex.plane[0], v);
    }
    return true;
  }

  T squared(uint32_t i) const {
    return planes.x[i] * planes.x[i] + planes.y[i] * planes.y[i] + planes.z[i] * planes.z[i];
  }

  /// Slides from the foot on the nearest plane, which is the midpoint to the nearest neighbour if
  /// there are no lifts, along its face to an edge, and along that to a vertex.
  template <bool has_lifts>
  bool start(size_t plane_count) {
    uint32_t a = 0;
    T foot = T(0.5);
    if constexpr (has_lifts) {
      const auto distance = [&](uint32_t i) {
        return planes.offset[i] * planes.offset[i] / squared(i);
      };
      for (uint32_t i = 1; i < plane_count; ++i)
        if (distance(i) < distance(a)) a = i;
      foot = planes.offset[a] / squared(a);
    } else {
      for (uint32_t i = 1; i < plane_count; ++i)
        if (planes.offset[i] < planes.offset[a]) a = i;
    }
    const T n[3] = {planes.x[a], planes.y[a], planes.z[a]};
    T along[3] = {0, n[2], -n[1]};
    const T x = std::abs(n[0]), y = std::abs(n[1]), z = std::abs(n[2]);
    if (y < x && y <= z) {
      along[0] = -n[2];
      along[1] = 0;
      along[2] = n[0];
    } else if (z < x) {
      along[0] = n[1];
      along[1] = -n[0];
      along[2] = 0;
    }
    T p[3] = {n[0] * foot, n[1] * foot, n[2] * foot};
    const PlaneHit<T> edge = first_plane(planes, p, along);
    if (!(edge.t < no_hit<T>)) return false;
    for (int i = 0; i < 3; ++i) p[i] += along[i] * edge.t;
    cross(a, edge.plane, along);
    const PlaneHit<T> end = first_plane(planes, p, along);
    if (!(end.t < no_hit<T>)) return false;
    for (int i = 0; i < 3; ++i) positions[0][i] = p[i] + along[i] * end.t;
    add_vertex(a, edge.plane, end.plane);
    follow(a, edge.plane, 0);
    follow(edge.plane, end.plane, 0);
    follow(end.plane, a, 0);
    return true;
  }

  /// The vertex at the end of a half-edge.
  HWY_INLINE bool end_at(uint32_t half_edge, const T* along, const PlaneHit<T>& hit) {
    const uint32_t from = half_edge >> 16, to = half_edge >> 8 & 0xff;
    if (!(hit.t < no_hit<T>) || count == VoronoiCell::max_vertices || known(from, hit.plane) ||
        known(hit.plane, to))
      return false;
    const T* const p = positions[half_edge & 0xff];
    T* const q = positions[count];
    for (int i = 0; i < 3; ++i) q[i] = p[i] + along[i] * hit.t;
    const uint32_t vertex = count;
    add_vertex(to, from, hit.plane);
    follow(from, hit.plane, vertex);
    follow(hit.plane, to, vertex);
    return true;
  }

  template <int known_vectors>
  HWY_INLINE bool go_on() {
    for (;;) {
      const uint32_t one = next();
      if (one == none) return true;
      uint32_t other = next();
      if (other == none) other = one;
      T along[3], other_along[3];
      cross(one >> 8 & 0xff, one >> 16, along);
      cross(other >> 8 & 0xff, other >> 16, other_along);
      PlaneHit<T> hit, other_hit;
      first_planes<known_vectors>(planes, positions[one & 0xff], along, positions[other & 0xff],
                                  other_along, hit, other_hit);
      if (!end_at(one, along, hit)) return false;
      // The first may have been the second, or the reverse.
      if (!known(other >> 8 & 0xff, other >> 16) && !end_at(other, other_along, other_hit))
        return false;
    }
  }
};

/// Sets the bits of the planes of vertices from number `first` on.
HWY_INLINE void mark_planes(const VoronoiCell::Graph& graph, size_t first, uint64_t (&bits)[2]) {
  for (size_t v = first; v < graph.count; ++v)
    for (const uint8_t plane : graph.vertices[v].plane)
      bits[plane >> 6] |= uint64_t{1} << (plane & 63);
}

/// Walks from `known` vertices of the graph, or from none.
template <bool has_lifts, int known_vectors, class T>
bool walk(const PlaneArrays<T>& planes, size_t plane_count, size_t known,
          VoronoiCell::Graph& graph) {
  if (graph.ends.empty() || ++graph.epoch > 0xff) {
    graph.ends.assign(size_t{VoronoiCell::max_planes} * VoronoiCell::max_planes, 0);
    graph.epoch = 1;
  }
  Walk<T> walk(planes, graph);
  if (!(known ? walk.resume(known) : walk.template start<has_lifts>(plane_count))) return false;
  if (!walk.template go_on<known_vectors>()) return false;
  graph.count = walk.count;
  uint64_t used[2] = {0, 0};
  mark_planes(graph, 0, used);
  const size_t faces = static_cast<size_t>(std::popcount(used[0]) + std::popcount(used[1]));
  return graph.count == 2 * faces - 4;
}

/// Puts each vertex, except the known ones, where its planes meet. Returns the maximum distance of
/// a vertex from its own planes, and the maximum squared distance of a vertex.
struct Placement {
  double off, radius_squared;
};
Placement place_vertices(const PlaneArrays<double>& planes, size_t known,
                         VoronoiCell::Graph& graph) {
  const hn::ScalableTag<double> d;
  const size_t lanes = hn::Lanes(d);
  using V = hn::Vec<hn::ScalableTag<double>>;
  auto off = hn::Zero(d), most = hn::Zero(d);
  for (size_t v = known; v < graph.count; v += lanes) {
    HWY_ALIGN double n[3][4][max_simd_doubles];  // normal and offset of each vertex's planes
    for (size_t l = 0; l < lanes; ++l) {
      const VoronoiCell::Vertex& vertex = graph.vertices[std::min(v + l, graph.count - 1)];
      for (int i = 0; i < 3; ++i) {
        n[i][0][l] = planes.x[vertex.plane[i]];
        n[i][1][l] = planes.y[vertex.plane[i]];
        n[i][2][l] = planes.z[vertex.plane[i]];
        n[i][3][l] = planes.offset[vertex.plane[i]];
      }
    }
    const auto at = [&](int i, int j) { return hn::Load(d, n[i][j]); };
    const auto minor = [&](int i, int j, int x) {
      const int y = (x + 1) % 3, z = (x + 2) % 3;
      return hn::Sub(hn::Mul(at(i, y), at(j, z)), hn::Mul(at(i, z), at(j, y)));
    };
    const auto dot3 = [&](V ax, V ay, V az, V bx, V by, V bz) {
      return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
    };
    const V bcx = minor(1, 2, 0), bcy = minor(1, 2, 1), bcz = minor(1, 2, 2);
    const V scale = hn::Div(hn::Set(d, 1.0), dot3(at(0, 0), at(0, 1), at(0, 2), bcx, bcy, bcz));
    const auto coordinate = [&](V bc, int x) {
      return hn::Mul(hn::Add(hn::Add(hn::Mul(bc, at(0, 3)), hn::Mul(minor(2, 0, x), at(1, 3))),
                             hn::Mul(minor(0, 1, x), at(2, 3))),
                     scale);
    };
    const V x = coordinate(bcx, 0), y = coordinate(bcy, 1), z = coordinate(bcz, 2);
    for (int i = 0; i < 3; ++i)
      off = hn::Max(off, hn::Abs(hn::Sub(dot3(at(i, 0), at(i, 1), at(i, 2), x, y, z), at(i, 3))));
    most = hn::Max(most, dot3(x, y, z, x, y, z));
    HWY_ALIGN double p[3][max_simd_doubles];
    hn::Store(x, d, p[0]);
    hn::Store(y, d, p[1]);
    hn::Store(z, d, p[2]);
    for (size_t l = 0; l < std::min(lanes, graph.count - v); ++l)
      graph.vertices[v + l].position = {p[0][l], p[1][l], p[2][l]};
  }
  return {hn::GetLane(hn::MaxOfLanes(d, off)), hn::GetLane(hn::MaxOfLanes(d, most))};
}

/// has_lifts: of a power diagram. `lifts` of the seeds, and of the own one.
template <bool has_lifts>
HWY_INLINE bool build(VoronoiCell::Planes& planes, const Vec3* seeds, Vec3 own, const double* lifts,
                      double own_lift, VoronoiCell::Graph& graph, double& radius_squared) {
  const auto offset_of = [&](const Vec3& normal, size_t i) {
    if constexpr (has_lifts)
      return 0.5 * (dot(normal, normal) + (lifts[planes.seed[i]] - own_lift));
    else
      return 0.5 * dot(normal, normal);
  };
  // Fills the last vector with planes that no ray meets.
  const hn::ScalableTag<float> d;
  const size_t lanes = hn::Lanes(d), count = planes.count;
  const size_t padded = (count + lanes - 1) / lanes * lanes;
  for (size_t i = count; i < padded; ++i) {
    planes.x[i] = planes.y[i] = planes.z[i] = 0;
    planes.offset[i] = 1;
  }
  alignas(64) double x[VoronoiCell::max_planes], y[VoronoiCell::max_planes],
      z[VoronoiCell::max_planes], offset[VoronoiCell::max_planes];
  const auto fill = [&](size_t i) {
    const Vec3 normal = seeds[planes.seed[i]] - own;
    x[i] = normal.x;
    y[i] = normal.y;
    z[i] = normal.z;
    offset[i] = offset_of(normal, i);
  };
  const PlaneArrays<float> single{planes.x, planes.y, planes.z, planes.offset, padded};
  const PlaneArrays<double> full{x, y, z, offset, padded};

  // A correct vertex is on its planes and beyond no other, except for rounding.
  constexpr double max_beyond = 1e-10;
  const auto beyond = [&](const Vec3& p) {
    double most = 0;
    for (size_t i = 0; i < count; ++i) {
      const Vec3 normal = seeds[planes.seed[i]] - own;
      most = std::max(most, dot(normal, p) - offset_of(normal, i));
    }
    return most;
  };
  const auto is_right = [&](size_t known) {
    uint64_t used[2] = {0, 0};
    mark_planes(graph, known, used);
    for (size_t half = 0; half < 2; ++half)
      for (uint64_t rest = used[half]; rest; rest &= rest - 1)
        fill(64 * half + static_cast<size_t>(std::countr_zero(rest)));
    const Placement placement = place_vertices(full, known, graph);
    radius_squared = placement.radius_squared;
    if (!(placement.off <= max_beyond)) return false;
    // The error of n . p - offset is below 40 units of 2^-21 in single precision if vertices are
    // within 2 and planes are of sizes up to 4; larger planes do not come as near. So a vertex that
    // is inside all planes except its own three by more than that is correct. Others are tested in
    // double precision.
    // Lifts add up to 1/2 to an offset.
    const bool is_far = !(radius_squared <= 4);
    const auto near = hn::Set(d, has_lifts ? -4e-5f : -2e-5f);
    for (size_t v = known; v < graph.count; ++v) {
      const Vec3& p = graph.vertices[v].position;
      const auto px = hn::Set(d, static_cast<float>(p.x)), py = hn::Set(d, static_cast<float>(p.y)),
                 pz = hn::Set(d, static_cast<float>(p.z));
      size_t found = 0;
      for (size_t i = 0; i < padded; i += lanes) {
        const auto over = hn::MulAdd(
            hn::Load(d, planes.x + i), px,
            hn::MulAdd(hn::Load(d, planes.y + i), py,
                       hn::MulSub(hn::Load(d, planes.z + i), pz, hn::Load(d, planes.offset + i))));
        found += hn::CountTrue(d, hn::Gt(over, near));
      }
      if ((is_far || found != 3) && !(beyond(p) <= max_beyond)) return false;
    }
    return true;
  };
  const size_t known = graph.known, vectors = padded / lanes;
  double known_radius_squared = 0;
  for (size_t v = 0; v < known; ++v)
    known_radius_squared =
        std::max(known_radius_squared, dot(graph.vertices[v].position, graph.vertices[v].position));
  const bool walked = vectors == 3   ? walk<has_lifts, 3>(single, count, known, graph)
                      : vectors == 6 ? walk<has_lifts, 6>(single, count, known, graph)
                                     : walk<has_lifts, 0>(single, count, known, graph);
  if (walked && is_right(known)) {
    radius_squared = std::max(radius_squared, known_radius_squared);
    return true;
  }
  for (size_t i = 0; i < count; ++i) fill(i);
  for (size_t i = count; i < padded; ++i) {
    x[i] = y[i] = z[i] = 0;
    offset[i] = 1;
  }
  if (!walk<has_lifts, 0>(full, count, 0, graph) || !is_right(0)) return false;
  graph.known = 0;
  graph.found_anew = true;
  return true;
}

bool build_cell(VoronoiCell::Planes& planes, const Vec3* seeds, Vec3 own, VoronoiCell::Graph& graph,
                double& radius_squared) {
  return build<false>(planes, seeds, own, nullptr, 0, graph, radius_squared);
}

bool build_power_cell(VoronoiCell::Planes& planes, const Vec3* seeds, Vec3 own, const double* lifts,
                      double own_lift, VoronoiCell::Graph& graph, double& radius_squared) {
  return build<true>(planes, seeds, own, lifts, own_lift, graph, radius_squared);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

static_assert(VoronoiCell::max_planes % (2 * max_simd_doubles) == 0);

HWY_EXPORT(build_cell);
HWY_EXPORT(build_power_cell);

void VoronoiCell::clear() {
  refill(nullptr, {});
  added_.clear();
}

void VoronoiCell::add(Vec3 neighbour) {
  const size_t i = planes_.count++;
  planes_.x[i] = static_cast<float>(neighbour.x);
  planes_.y[i] = static_cast<float>(neighbour.y);
  planes_.z[i] = static_cast<float>(neighbour.z);
  planes_.offset[i] = static_cast<float>(0.5 * dot(neighbour, neighbour));
  planes_.seed[i] = static_cast<uint32_t>(i);
  added_.push_back(neighbour);
  seeds_ = added_.data();
}

VoronoiCell::Planes& VoronoiCell::refill(const Vec3* seeds, Vec3 own) {
  planes_.count = 0;
  graph_.known = 0;
  graph_.found_anew = false;
  seeds_ = seeds;
  own_ = own;
  return planes_;
}

bool VoronoiCell::add_vertex(uint32_t a, uint32_t b, uint32_t c, Vec3 position) {
  if (graph_.known == max_vertices) return false;
  graph_.vertices[graph_.known++] = {
      {static_cast<uint8_t>(a), static_cast<uint8_t>(b), static_cast<uint8_t>(c)}, position};
  return true;
}

bool VoronoiCell::walk() {
  graph_.count = 0;
  radius_squared_ = 0;
  if (planes_.count < 4 || planes_.count > max_planes) return false;
  return HWY_DYNAMIC_DISPATCH(build_cell)(planes_, seeds_, own_, graph_, radius_squared_);
}

bool VoronoiCell::walk_power(const double* lifts, double own_lift) {
  graph_.count = graph_.known = 0;
  radius_squared_ = 0;
  if (planes_.count < 4 || planes_.count > max_planes) return false;
  return HWY_DYNAMIC_DISPATCH(build_power_cell)(planes_, seeds_, own_, lifts, own_lift, graph_,
                                                radius_squared_);
}

}  // namespace msq
#endif  // HWY_ONCE
