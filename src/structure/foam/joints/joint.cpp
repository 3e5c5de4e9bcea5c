// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/joints/joint.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "structure/foam/edges/edge_brick.h"

namespace msq {

namespace {

/// More seeds than this about a vertex are left out, the last first: no arrangement of seeds on a
/// grid has as many.
constexpr size_t max_near = 24;
/// The volume of the tetrahedron of seeds, times 6, and the area of a triangle, times 2, below
/// which they count as flat: differences of seeds have about 2^-40 of rounding at most.
constexpr double flat = 1e-13;

Id id_of(const std::vector<NamedSeed>& seeds) {
  IdHash hash(2);
  for (const NamedSeed& seed : seeds) seed.add_name(hash);
  return hash.id();
}

/// The position from the first four seeds that are not in a plane, from the corner of the first
/// seed's cell.
bool place(const std::vector<NamedSeed>& seeds, Vec3 scale, Vec3& position) {
  const CellIndex home = seeds[0].cell;
  LiftedSeed at[max_near];
  const size_t count = std::min(seeds.size(), max_near);
  for (size_t i = 0; i < count; ++i) at[i] = {seeds[i].from(home, scale), seeds[i].lift};
  for (size_t d = 3; d < count; ++d)
    for (size_t c = 2; c < d; ++c)
      for (size_t b = 1; b < c; ++b)
        for (size_t a = 0; a < b; ++a)
          if (find_circumcentre({at[a], at[b], at[c], at[d]}, position)) return true;
  return false;
}

}  // namespace

bool find_circumcentre(const LiftedSeed (&seeds)[4], Vec3& centre) {
  const Vec3 u = seeds[1].place - seeds[0].place, v = seeds[2].place - seeds[0].place,
             w = seeds[3].place - seeds[0].place;
  const Vec3 vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double volume = dot(u, vw);
  if (!(std::abs(volume) > flat * length(u) * length(v) * length(w))) return false;
  const double scale = 0.5 / volume;
  const auto solve = [&](double a, double b, double c) {
    return (vw * a + wu * b + uv * c) * scale;
  };
  const auto twice_offset = [&](Vec3 n, const LiftedSeed& seed) {
    return dot(n, n) + (seed.lift - seeds[0].lift);
  };
  const double to_u = twice_offset(u, seeds[1]), to_v = twice_offset(v, seeds[2]),
               to_w = twice_offset(w, seeds[3]);
  Vec3 x = solve(to_u, to_v, to_w);
  // One step of refinement: what is left of the three equations.
  const auto rest = [&](double offset, Vec3 n) { return offset - 2 * dot(n, x); };
  x = x + solve(rest(to_u, u), rest(to_v, v), rest(to_w, w));
  centre = seeds[0].place + x;
  return true;
}

bool are_collinear(const NamedSeed& a, const NamedSeed& b, const NamedSeed& c, Vec3 scale) {
  const Vec3 u = b.from(a.cell, scale) - a.from(a.cell, scale);
  const Vec3 v = c.from(a.cell, scale) - a.from(a.cell, scale);
  return !(length(cross(u, v)) > flat * length(u) * length(v));
}

void JointFinder::gather(NamedSeeds& seeds, Vec3 p, double error) {
  // Twice the spread that the error causes. If more than four seeds are so nearly as far, rounded
  // positions may be less exact: the seeds may be almost in a plane.
  const double within = 4 * error, in_doubt = 64 * error;
  joints_.clear();
  seeds.find(p, within, near_);
  if (near_.size() == 4) try_all(seeds, p, within);
  if (!joints_.empty()) return;
  seeds.find(p, in_doubt, near_);
  if (near_.size() > max_near) near_.resize(max_near);
  if (near_.size() >= 4) try_all(seeds, p, in_doubt);
}

// Let s be the seed nearest to p, and c a vertex within `within` / 2 of p. A seed that is not in
// near_ is farther from p than s by more than `within`, so it is farther from c than s is. So the
// seeds in near_ decide whether the ball about c is empty.
void JointFinder::try_all(const NamedSeeds& seeds, Vec3 p, double within) {
  const Vec3 scale = seeds.scale();
  const CellIndex home = near_[0].cell, corner = seeds.corner();
  const size_t count = near_.size();
  LiftedSeed at[max_near];
  for (size_t i = 0; i < count; ++i) at[i] = {near_[i].from(home, scale), near_[i].lift};
  const Vec3 place_of_p =
      p -
      Vec3{double(home.x - corner.x), double(home.y - corner.y), double(home.z - corner.z)} * scale;
  const auto try_four = [&](size_t a, size_t b, size_t c, size_t d) {
    Vec3 centre;
    if (!find_circumcentre({at[a], at[b], at[c], at[d]}, centre)) return;
    const auto distance = [&](size_t i) { return std::sqrt(squared_from(at[i], centre)); };
    const double radius = distance(a);
    for (size_t i = 0; i < count; ++i)
      if (distance(i) < radius - equally_far) return;
    if (length(centre - place_of_p) > 0.5 * within) return;
    Joint joint;
    joint.seeds.reserve(count);
    for (size_t i = 0; i < count; ++i)
      if (distance(i) <= radius + equally_far) joint.seeds.push_back(near_[i]);
    joint.id = id_of(joint.seeds);
    const auto is_known = [&](const Joint& other) { return other.id == joint.id; };
    if (joint.seeds.size() < 4 || std::any_of(joints_.begin(), joints_.end(), is_known)) return;
    if (place(joint.seeds, scale, joint.position)) joints_.push_back(std::move(joint));
  };
  for (size_t d = 3; d < count; ++d) {
    check_cancelled();
    for (size_t c = 2; c < d; ++c)
      for (size_t b = 1; b < c; ++b)
        for (size_t a = 0; a < b; ++a) try_four(a, b, c, d);
  }
}

}  // namespace msq
