// SPDX-License-Identifier: Apache-2.0
// Single tetrahedra of the walk over tetrahedra (facet_walk.h), found and proven in double
// precision. Included once for each instruction set.
#if defined(MSQ_STRUCTURE_FOAM_EDGES_FACET_PROOF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MSQ_STRUCTURE_FOAM_EDGES_FACET_PROOF_INL_H
#undef MSQ_STRUCTURE_FOAM_EDGES_FACET_PROOF_INL_H
#else
#define MSQ_STRUCTURE_FOAM_EDGES_FACET_PROOF_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "structure/foam/edges/facet_batch-inl.h"
#include "structure/foam/edges/facet_state.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

/// A tetrahedron's seeds in any order, and its sphere.
struct Tetrahedron {
  uint32_t seeds[4];
  double det;        // sign: of (b - a) x (c - a) to d
  double centre[3];  // foam units
  double squared;    // radius
};

HWY_INLINE double coordinate(const FacetState& s, uint32_t seed, int axis) {
  return static_cast<double>(s.points[seed][axis]) * s.scale[axis];
}
HWY_INLINE void apart(const FacetState& s, uint32_t from, uint32_t to, double* out) {
  for (int k = 0; k < 3; ++k)
    out[k] = static_cast<double>(s.points[to][k] - s.points[from][k]) * s.scale[k];
}
HWY_INLINE double dot1(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
HWY_INLINE void cross1(const double* a, const double* b, double* to) {
  to[0] = a[1] * b[2] - a[2] * b[1];
  to[1] = a[2] * b[0] - a[0] * b[2];
  to[2] = a[0] * b[1] - a[1] * b[0];
}

/// Cells of the halo; false if a box leaves it.
struct CellRange {
  int low[3], high[3];
};
HWY_INLINE bool cells_of(const FacetState& s, const double* centre, double radius,
                         CellRange& range) {
  bool is_in = true;
  for (int k = 0; k < 3; ++k) {
    const double low = std::floor((centre[k] - radius) / s.scale[k]) + s.half_width,
                 high = std::floor((centre[k] + radius) / s.scale[k]) + s.half_width;
    is_in &= low >= 0 && high < s.width;
    range.low[k] = static_cast<int>(std::min(std::max(low, 0.0), s.width - 1.0));
    range.high[k] = static_cast<int>(std::min(std::max(high, 0.0), s.width - 1.0));
  }
  return is_in;
}
template <class Visit>
HWY_INLINE void for_each_seed(const CellRange& range, Visit&& visit) {
  for (int z = range.low[2]; z <= range.high[2]; ++z)
    for (int y = range.low[1]; y <= range.high[1]; ++y)
      for (int x = range.low[0]; x <= range.high[0]; ++x)
        visit(static_cast<uint32_t>((z * FacetState::stride + y) * FacetState::stride + x));
}

/// Fills det and the sphere.
void make_sphere(const FacetState& s, Tetrahedron& t) {
  double u[3], v[3], w[3];
  apart(s, t.seeds[0], t.seeds[1], u);
  apart(s, t.seeds[0], t.seeds[2], v);
  apart(s, t.seeds[0], t.seeds[3], w);
  const hn::CappedTag<double, 1> one;
  using V = hn::Vec<decltype(one)>;
  V vu[3], vv[3], vw[3], centre[3];
  for (int k = 0; k < 3; ++k) {
    vu[k] = hn::Set(one, u[k]);
    vv[k] = hn::Set(one, v[k]);
    vw[k] = hn::Set(one, w[k]);
  }
  t.det = hn::GetLane(sphere(one, vu, vv, vw, centre));
  t.squared = 0;
  for (int k = 0; k < 3; ++k) {
    const double c = hn::GetLane(centre[k]);
    t.squared += c * c;
    t.centre[k] = coordinate(s, t.seeds[0], k) + c;
  }
}

/// Whether the tetrahedron is one of the diagram.
bool is_proven(const FacetState& s, const Tetrahedron& t) {
  if (!(std::abs(t.det) >= walk_min_volume * t.squared * t.squared)) return false;
  // Keys tell apart seeds up to three cells away.
  for (const uint32_t a : t.seeds)
    for (const uint32_t b : t.seeds)
      for (int k = 0; k < 3; ++k)
        if (std::abs(FacetState::cell(a, k) - FacetState::cell(b, k)) > 3) return false;
  CellRange range;
  if (!(t.squared < 4) || !cells_of(s, t.centre, std::sqrt(t.squared) + 1e-6, range)) return false;
  bool is_empty = true;
  for_each_seed(range, [&](uint32_t i) {
    double d[3];
    for (int k = 0; k < 3; ++k) d[k] = coordinate(s, i, k) - t.centre[k];
    is_empty &= dot1(d, d) > t.squared + walk_tie || i == t.seeds[0] || i == t.seeds[1] ||
                i == t.seeds[2] || i == t.seeds[3];
  });
  return is_empty;
}

/// The seed that the sphere through a facet (the first `known` of the seeds, 2 or 3) meets first if
/// its centre moves from `middle`, equally far from them, along `normal`.
bool meet(const FacetState& s, const CellRange& range, const double* middle, const double* normal,
          Tetrahedron& t, int known, double& distance) {
  distance = 1e300;
  for_each_seed(range, [&](uint32_t i) {
    for (int k = 0; k < known; ++k)
      if (i == t.seeds[k]) return;
    double q[3];
    apart(s, t.seeds[0], i, q);
    const double along = dot1(q, normal);
    if (along <= 1e-12) return;
    const double at = (0.5 * dot1(q, q) - dot1(q, middle)) / along;
    if (at >= distance) return;
    distance = at;
    t.seeds[known] = i;
  });
  return distance < 1e300;
}

/// The tetrahedron beyond a facet of three seeds.
bool resolve(const FacetState& s, double side, Tetrahedron& t) {
  double u[3], v[3], n[3], p[3], q[3], middle[3];
  apart(s, t.seeds[0], t.seeds[1], u);
  apart(s, t.seeds[0], t.seeds[2], v);
  cross1(u, v, n);
  const double nn = dot1(n, n), uu = dot1(u, u), vv = dot1(v, v);
  if (!(nn > 1e-20)) return false;
  cross1(v, n, p);
  cross1(n, u, q);
  double guess[3];
  for (int k = 0; k < 3; ++k) {
    middle[k] = (uu * p[k] + vv * q[k]) / (2 * nn);
    n[k] *= side / std::sqrt(nn);
    guess[k] = coordinate(s, t.seeds[0], k) + middle[k] + ahead * s.unit * n[k];
  }
  // The seed sought is in the ball of any other beyond the facet.
  CellRange range;
  cells_of(s, guess, 0.8 * s.unit, range);
  for (int times = 0; times < 4; ++times) {
    double distance;
    if (!meet(s, range, middle, n, t, 3, distance)) {
      cells_of(s, guess, 1.6 * s.unit, range);
      continue;
    }
    make_sphere(s, t);
    if (is_proven(s, t) && t.det * side > 0) return true;
    if (times == 2 || !(t.squared < 16)) return false;
    cells_of(s, t.centre, std::sqrt(t.squared) + 1e-6, range);
  }
  return false;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#endif
