// SPDX-License-Identifier: Apache-2.0
// A batch of facets, drawn at random from the queue (neighbours would often lead to the same
// tetrahedron), takes four steps. In SIMD over facets: the lines on which centres of spheres lie.
// For each facet, in SIMD over the seeds of 4 x 4 x 4 cells: the seed that the sphere meets first.
// In SIMD over tetrahedra: the centres of their spheres, in double precision. For each tetrahedron,
// in SIMD over the same 64 seeds: the proof.
//
// The proof does not depend on how a tetrahedron was found: its sphere, grown by `walk_margin`,
// stays within the 64 cells and contains no more than four seeds. Tetrahedra that fail it are found
// and proven in double precision (resolve()). If a fifth seed is as near as double precision can
// tell, or if the sphere leaves the halo, the walk gives up. Then every tetrahedron is a true one,
// with a sphere strictly empty. The walk follows every facet with a seed in the brick and begins
// anew at seeds not reached. The tetrahedra at a seed hang together by the facets at it. So all
// tetrahedra with a seed in the brick are found, and with them both ends of every edge that the
// brick owns.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "structure/foam/edges/facet_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/job.h"
#include "structure/foam/edges/facet_batch-inl.h"
#include "structure/foam/edges/facet_proof-inl.h"
#include "structure/foam/edges/facet_table-inl.h"
#include "structure/foam/edges/facet_walk.h"

HWY_BEFORE_NAMESPACE();
namespace msq {
namespace HWY_NAMESPACE {
namespace {

/// Adds the tetrahedra of a batch, and their facets.
HWY_INLINE void add(FacetState& s, const Batch& batch) {
  const uint32_t kept = without_copies(s, batch);
  const DU d;
  Facets facets[3];
  for (Facets& f : facets) f.count = 0;
  uint32_t number = s.tetrahedra;
  alignas(64) uint32_t numbers[B];
  for (uint32_t i = 0; i < B; ++i) {
    numbers[i] = number;
    number += kept >> i & 1;
  }
  for (size_t i = 0; i < B; i += hn::Lanes(d)) {
    const VU a = with_number(s, hn::Load(d, batch.a + i)),
             b = with_number(s, hn::Load(d, batch.b + i)),
             c = with_number(s, hn::Load(d, batch.c + i)),
             e = with_number(s, hn::Load(d, batch.found + i));
    const VU tetrahedron = hn::Load(d, numbers + i);
    const auto which = hn::RebindMask(d, lanes_of(d, kept >> i));
    const auto negative = hn::RebindMask(d, hn::Lt(hn::Load(D(), batch.side + i), hn::Zero(D())));
    const auto facet = [&](VU p, VU q, hn::Mask<DU> away, Facets& to) {
      // p < q. Where the new seed is between them, the order turns.
      const VU low = hn::Min(p, e), high = hn::Max(q, e), middle = hn::Max(p, hn::Min(q, e));
      const auto odd = hn::And(hn::Gt(e, p), hn::Lt(e, q));
      name(low, middle, high, hn::Xor(away, odd), which, tetrahedron, to);
    };
    facet(a, b, negative, facets[0]);
    facet(a, c, hn::Not(negative), facets[1]);
    facet(b, c, negative, facets[2]);
  }
  uint32_t tetrahedron = s.tetrahedra;
  for (uint32_t rest = kept; rest; rest &= rest - 1, ++tetrahedron) {
    const int i = std::countr_zero(rest);
    float* centre = s.centres[tetrahedron];
    for (int k = 0; k < 3; ++k) centre[k] = batch.centre[k][i];
    s.reached[batch.found[i]] = 1;
    s.ends[batch.bucket[i]][batch.slot[i]][1] = static_cast<uint16_t>(tetrahedron);
    s.done[batch.bucket[i]] |= uint64_t{1} << batch.slot[i];
  }
  s.tetrahedra = tetrahedron;
  for (const Facets& f : facets) take(s, f);
}

/// One batch. Returns whether the walk can go on: 0 if not, 1 if so, 2 if nothing is left.
int step(FacetState& s) {
  Batch batch;
  draw(s, batch);
  if (batch.count == 0) return 2;
  if (s.tetrahedra + B > FacetState::max_tetrahedra) return 0;
  for (size_t i = batch.count; i < B; ++i) batch.found[i] = 0;
  find_lines(s, batch);
  search(s, batch);
  const uint32_t proven = prove(s, batch, find_centres(s, batch));
  const uint32_t all = (uint32_t{2} << (batch.count - 1)) - 1;
  for (uint32_t rest = all & ~proven; HWY_UNLIKELY(rest); rest &= rest - 1) {
    const int i = std::countr_zero(rest);
    if (++s.resolved > walk_max_resolved) return 0;
    Tetrahedron t{{batch.a[i], batch.b[i], batch.c[i], 0}, 0, {}, 0};
    if (!resolve(s, batch.side[i], t)) return 0;
    batch.found[i] = t.seeds[3];
    for (int k = 0; k < 3; ++k) batch.centre[k][i] = static_cast<float>(t.centre[k]);
  }
  add(s, batch);
  return 1;
}

int steps(FacetState& s, int count) {
  int state = 1;
  while (count-- > 0 && state == 1) state = step(s);
  return state;
}

/// Adds a tetrahedron of a seed: that of its nearest neighbour, and so on.
bool begin(FacetState& s, uint32_t seed) {
  if (s.tetrahedra + B > FacetState::max_tetrahedra) return false;
  Tetrahedron t{{seed, 0, 0, 0}, 0, {}, 0};
  CellRange range;
  for (int k = 0; k < 3; ++k) {
    range.low[k] = FacetState::cell(seed, k) - FacetState::halo;
    range.high[k] = FacetState::cell(seed, k) + FacetState::halo;
  }
  double least = 1e300, middle[3] = {0, 0, 0};
  for_each_seed(range, [&](uint32_t i) {
    double q[3];
    apart(s, seed, i, q);
    if (i == seed || dot1(q, q) >= least) return;
    least = dot1(q, q);
    t.seeds[1] = i;
    for (int k = 0; k < 3; ++k) middle[k] = 0.5 * q[k];
  });
  double u[3] = {2 * middle[0], 2 * middle[1], 2 * middle[2]}, v[3], along[3], distance;
  // Not along u.
  const double axis[3] = {double(std::abs(u[0]) <= std::abs(u[2])), 0,
                          double(std::abs(u[0]) > std::abs(u[2]))};
  cross1(u, axis, along);
  if (!meet(s, range, middle, along, t, 2, distance)) return false;
  for (int k = 0; k < 3; ++k) middle[k] += distance * along[k];
  apart(s, seed, t.seeds[2], v);
  cross1(u, v, along);
  if (!meet(s, range, middle, along, t, 3, distance)) return false;
  std::sort(t.seeds, t.seeds + 4);
  make_sphere(s, t);
  if (!is_proven(s, t)) return false;
  const uint32_t number = s.tetrahedra++;
  for (int k = 0; k < 3; ++k) s.centres[number][k] = static_cast<float>(t.centre[k]);
  for (const uint32_t i : t.seeds) s.reached[i] = 1;
  const DU d;
  const auto facet = [&](int i, int j, int k, bool is_away) {
    Facets f;
    f.count = 0;
    const auto one = [&](int n) { return with_number(s, hn::Set(d, t.seeds[n])); };
    name(one(i), one(j), one(k), lanes_of(d, is_away ? 1 : 0), lanes_of(d, 1), hn::Set(d, number),
         f);
    take(s, f);
  };
  const bool is_negative = t.det < 0;
  facet(0, 1, 2, !is_negative);
  facet(0, 1, 3, is_negative);
  facet(0, 2, 3, !is_negative);
  facet(1, 2, 3, is_negative);
  return true;
}

/// Edges in the order of their owners, and bounds of rows. Returns false if one lacks an end.
bool collect(FacetState& s) {
  constexpr float far = 1e30f;
  // A full bucket has lost facets.
  for (const uint8_t count : s.count)
    if (count >= FacetState::bucket_room - 1) return false;
  uint32_t edges = 0;
  for (uint32_t row = 0; row < FacetState::max_side * FacetState::max_side; ++row) {
    s.starts[row] = edges;
#if HWY_TARGET == HWY_SCALAR
    float low[3] = {far, far, far}, high[3] = {-far, -far, -far};
#else
    const hn::FixedTag<float, 4> d;
    auto low0 = hn::Set(d, far), high0 = hn::Set(d, -far), low1 = low0, high1 = high0;
#endif
    for (uint32_t bucket = row * FacetState::max_side; bucket < (row + 1) * FacetState::max_side;
         ++bucket) {
      const uint32_t count = s.count[bucket];
      if (s.done[bucket] != (uint64_t{1} << count) - 1) return false;
      const auto& ends = s.ends[bucket];
      const hn::CappedTag<uint16_t, FacetState::bucket_room / 2> d16;
      for (size_t i = 0; i < count; i += hn::Lanes(d16)) {
        hn::Vec<decltype(d16)> first, second;
        hn::LoadInterleaved2(d16, ends[i], first, second);
        hn::StoreU(first, d16, s.firsts + edges + i);
        hn::StoreU(second, d16, s.seconds + edges + i);
      }
      edges += count;
      for (uint32_t i = 0; i < count; ++i) {
        const float *p = s.centres[ends[i][0]], *q = s.centres[ends[i][1]];
#if HWY_TARGET == HWY_SCALAR
        for (int k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], std::min(p[k], q[k]));
          high[k] = std::max(high[k], std::max(p[k], q[k]));
        }
#else
        const auto a = hn::Load(d, p), b = hn::Load(d, q);
        low0 = hn::Min(low0, a);
        high0 = hn::Max(high0, a);
        low1 = hn::Min(low1, b);
        high1 = hn::Max(high1, b);
#endif
      }
    }
#if HWY_TARGET != HWY_SCALAR
    HWY_ALIGN float low[4], high[4];
    hn::Store(hn::Min(low0, low1), d, low);
    hn::Store(hn::Max(high0, high1), d, high);
#endif
    for (int k = 0; k < 3; ++k) {
      s.bounds[k][row] = low[k];
      s.bounds[k + 3][row] = high[k];
    }
  }
  s.starts[FacetState::max_side * FacetState::max_side] = edges;
  return true;
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace msq
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msq {

namespace {

constexpr int halo = FacetState::halo, max_width = FacetState::max_width,
              stride = FacetState::stride, patch = FacetState::patch,
              patches_in_row = FacetState::patches_in_row;

}  // namespace

HWY_EXPORT(begin);
HWY_EXPORT(steps);
HWY_EXPORT(collect);

bool FacetWalk::suits(const FoamSeeds& seeds) {
  // In flatter or longer cells, relative to a cube of the same volume, too many spheres leave the 4
  // cells of a patch. Seeds nearly in the middle of their cells are nearly on common spheres.
  constexpr double min_side = 0.75;
  constexpr auto min_jitter = int64_t{1} << 24;  // of 2^31
  const Vec3 scale = seeds.scale();
  const double unit = std::cbrt(scale.x * scale.y * scale.z);
  return std::min({scale.x, scale.y, scale.z}) >= min_side * unit && seeds.jitter() >= min_jitter;
}

void FacetWalk::place(const FoamSeeds& seeds, CellIndex corner, int cells) {
  const int size[3] = {cells, cells, cells}, around[3] = {halo, halo, halo};
  tile_.build(seeds, corner, size, around);
  const int width = cells + 2 * halo;
  s_.width = width;
  s_.half_width = width / 2;
  const Vec3 scale = seeds.scale();
  for (int k = 0; k < 3; ++k) s_.scale[k] = scale[k];
  s_.unit = static_cast<float>(std::cbrt(scale.x * scale.y * scale.z));
  const float *fx = tile_.fraction(0), *fy = tile_.fraction(1), *fz = tile_.fraction(2);
  const auto sx = static_cast<float>(scale.x), sy = static_cast<float>(scale.y),
             sz = static_cast<float>(scale.z);
  // Positions in foam units, in rows of `stride`.
  const int patches = width - patch + 1;
  const auto middle = static_cast<float>(s_.half_width);
  float x[max_width][stride], y[max_width][stride], z[max_width][stride];
  for (int cz = 0; cz < width; ++cz) {
    for (int cy = 0; cy < width; ++cy) {
      float(*point)[4] = s_.points + (cz * stride + cy) * stride;
      for (int cx = 0; cx < width; ++cx) {
        const float px = static_cast<float>(cx) - middle + *fx++,
                    py = static_cast<float>(cy) - middle + *fy++,
                    pz = static_cast<float>(cz) - middle + *fz++;
        point[cx][0] = px;
        point[cx][1] = py;
        point[cx][2] = pz;
        point[cx][3] = 0;
        x[cy][cx] = px * sx;
        y[cy][cx] = py * sy;
        z[cy][cx] = pz * sz;
      }
    }
    for (int py = 0; py < patches; ++py)
      for (int px = 0; px < patches; ++px) {
        float* layer = s_.layers[(py * patches_in_row + px) * max_width + cz];
        for (int row = 0; row < patch; ++row) {
          std::memcpy(layer + patch * row, &x[py + row][px], patch * sizeof(float));
          std::memcpy(layer + 16 + patch * row, &y[py + row][px], patch * sizeof(float));
          std::memcpy(layer + 32 + patch * row, &z[py + row][px], patch * sizeof(float));
        }
      }
  }
}

bool FacetWalk::build(const FoamSeeds& seeds, CellIndex corner, int cells, const Owners& owners) {
  place(seeds, corner, cells);
  s_.owners = owners;
  std::memset(s_.count, 0, sizeof s_.count);
  std::memset(s_.done, 0, sizeof s_.done);
  std::memset(s_.reached, 0, sizeof s_.reached);
  std::memset(s_.bucket_used, 0, sizeof s_.bucket_used);
  std::memset(s_.hash_used, 0, sizeof s_.hash_used);
  s_.head = s_.last = s_.tetrahedra = s_.stamp = s_.resolved = 0;
  s_.random = 1;
  const auto walk_from = [&](uint32_t seed) {
    if (!HWY_DYNAMIC_DISPATCH(begin)(s_, seed)) return false;
    for (int state = 1; state != 2;) {
      check_cancelled();
      state = HWY_DYNAMIC_DISPATCH(steps)(s_, 32);
      if (state == 0) return false;
    }
    return true;
  };
  const auto seed_at = [](int x, int y, int z) {
    return static_cast<uint32_t>(((halo + z) * stride + halo + y) * stride + halo + x);
  };
  const auto &low = owners.low, &high = owners.high;
  const auto middle = [&](int axis) { return (low[axis] + high[axis]) / 2; };
  if (!walk_from(seed_at(middle(0), middle(1), middle(2)))) return false;
  for (int z = low[2]; z < high[2]; ++z)
    for (int y = low[1]; y < high[1]; ++y)
      for (int x = low[0]; x < high[0]; ++x) {
        const uint32_t seed = seed_at(x, y, z);
        if (!s_.reached[seed] && !walk_from(seed)) return false;
      }
  return HWY_DYNAMIC_DISPATCH(collect)(s_);
}

SegmentSet FacetWalk::segments() const {
  SegmentSet::Arrays arrays;
  const size_t nodes = s_.tetrahedra, edges = s_.starts[side * side];
  arrays.nodes.resize(3 * nodes + SegmentSet::node_padding);
  for (size_t i = 0; i < nodes; ++i)
    for (size_t k = 0; k < 3; ++k) arrays.nodes[3 * i + k] = s_.centres[i][k];
  arrays.ends.resize(2 * edges + SegmentSet::padding);
  std::copy_n(s_.firsts, edges, arrays.ends.data());
  std::copy_n(s_.seconds, edges, arrays.ends.data() + edges);
  arrays.bounds.resize(6 * side * side);
  for (size_t b = 0; b < 6; ++b)
    std::copy_n(s_.bounds[b], side * side, arrays.bounds.data() + b * side * side);
  arrays.starts.assign(s_.starts, s_.starts + side * side + 1);
  return SegmentSet(std::move(arrays));
}

}  // namespace msq
#endif  // HWY_ONCE
