// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/joints/joint.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/job.h"

namespace msq {

namespace {

/// Four seeds of a smaller relative volume count as flat.
constexpr double flat = 1e-13;
/// The circumcentre of four seeds of a smaller relative volume is computed exactly.
constexpr double narrow = 1e-6;
/// In foam units. A brick's tolerances may miss vertices that are closer together.
constexpr double close = 1e-9;
/// The maximum number of sets of four seeds that are tried about a place. Around an axis, dozens of
/// seeds may be almost on one sphere. JointFinder::follow() finds the vertices that are left out.
constexpr size_t max_tried = 1024;

Id id_of(const std::vector<NamedSeed>& seeds) {
  IdHash hash(2);
  for (const NamedSeed& seed : seeds) seed.add_name(hash);
  return hash.id();
}

constexpr JointFace bit(size_t i) {
  return JointFace{1} << i;
}

/// Calls visit(a, b, c, d) for all a < b < c < d below `count`, until it returns true.
template <class Visit>
bool any_four(size_t count, Visit&& visit) {
  for (size_t d = 3; d < count; ++d)
    for (size_t c = 2; c < d; ++c)
      for (size_t b = 1; b < c; ++b)
        for (size_t a = 0; a < b; ++a)
          if (visit(a, b, c, d)) return true;
  return false;
}

}  // namespace

double find_circumcentre(const LiftedSeed (&seeds)[4], Vec3& centre) {
  const Vec3 u = seeds[1].place - seeds[0].place, v = seeds[2].place - seeds[0].place,
             w = seeds[3].place - seeds[0].place;
  const Vec3 vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double volume = dot(u, vw), edges = length(u) * length(v) * length(w);
  if (!(std::abs(volume) > flat * edges)) return 0;
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
  return std::abs(volume) / edges;
}

Vec3 JointFinder::from_corner(CellIndex cell, Vec3 p) const {
  const CellIndex corner = seeds_->corner();
  return p + Vec3{double(cell.x - corner.x), double(cell.y - corner.y), double(cell.z - corner.z)} *
                 seeds_->scale();
}

/// From the first four seeds that are not in a plane, if double precision is good for them; else
/// exactly, where any four lead to the same point.
bool JointFinder::place(Joint& joint) const {
  const std::vector<NamedSeed>& seeds = joint.seeds;
  const CellIndex home = seeds[0].cell;
  const Vec3 scale = seeds_->scale();
  LiftedSeed at[max_near];
  for (size_t i = 0; i < seeds.size(); ++i) at[i] = {seeds[i].from(home, scale), seeds[i].lift};
  double volume = 0;
  any_four(seeds.size(), [&](size_t a, size_t b, size_t c, size_t d) {
    volume = find_circumcentre({at[a], at[b], at[c], at[d]}, joint.position);
    return volume > 0;
  });
  if (volume > narrow) return true;
  ExactSeeds::Seed exact[max_near];
  for (size_t i = 0; i < seeds.size(); ++i) exact[i] = ExactSeeds::from(home, seeds[i]);
  return any_four(seeds.size(), [&](size_t a, size_t b, size_t c, size_t d) {
    if (exact_.side(exact[a], exact[b], exact[c], exact[d]) == 0) return false;
    joint.position = at[a].place + exact_.centre(exact[a], exact[b], exact[c], exact[d]);
    return true;
  });
}

bool JointFinder::gather(Vec3 p, double error) {
  // Twice the spread that the error causes. If more than four seeds are so nearly as far, rounded
  // positions may be less exact: the seeds may be almost in a plane.
  const double within = 4 * error, in_doubt = 64 * error;
  joints_.clear();
  seeds_->find(p, within, near_);
  if (near_.size() == 4 && take_four(p, within)) return true;
  seeds_->find(p, in_doubt, near_);
  return near_.size() >= 4 && near_.size() <= max_near && try_all(p, in_doubt);
}

// Let s be the seed nearest to p, and c a vertex within `within` / 2 of p. A seed that is not in
// near_ is farther from p than s by more than `within`, so it is farther from c than s is. So the
// seeds in near_ decide whether the ball about c is empty.
bool JointFinder::take_four(Vec3 p, double within) {
  Joint joint;
  joint.seeds = near_;
  if (!place(joint)) return false;
  if (length(from_corner(near_[0].cell, joint.position) - p) > 0.5 * within) return false;
  joint.id = id_of(joint.seeds);
  joints_.push_back(std::move(joint));
  return true;
}

bool JointFinder::try_all(Vec3 p, double within) {
  const Vec3 scale = seeds_->scale();
  const CellIndex home = near_[0].cell;
  const size_t count = near_.size();
  LiftedSeed at[max_near];
  ExactSeeds::Seed exact[max_near];
  for (size_t i = 0; i < count; ++i) {
    at[i] = {near_[i].from(home, scale), near_[i].lift};
    exact[i] = ExactSeeds::from(home, near_[i]);
  }
  const Vec3 place_of_p = p - from_corner(home, {});
  std::vector<JointFace> known;  // of joints_
  bool is_certain = true;
  size_t tried = 0;
  any_four(count, [&](size_t a, size_t b, size_t c, size_t d) {
    const JointFace four = bit(a) | bit(b) | bit(c) | bit(d);
    for (const JointFace seeds : known)
      if ((four & ~seeds) == 0) return false;
    if (++tried > max_tried) {
      is_certain = false;
      return true;
    }
    check_cancelled();
    Vec3 centre;
    const double volume = find_circumcentre({at[a], at[b], at[c], at[d]}, centre);
    if (!(volume > narrow)) {
      if (exact_.side(exact[a], exact[b], exact[c], exact[d]) == 0) return false;
      centre = at[a].place + exact_.centre(exact[a], exact[b], exact[c], exact[d]);
    }
    if (!(length(centre - place_of_p) <= 0.5 * within)) return false;
    JointFace seeds = four;
    for (size_t i = 0; i < count; ++i) {
      if (four & bit(i)) continue;
      const int nearer = exact_.nearer(exact[a], exact[b], exact[c], exact[d], exact[i]);
      if (nearer > 0) return false;
      if (nearer == 0) seeds |= bit(i);
    }
    known.push_back(seeds);
    const double radius = std::sqrt(squared_from(at[a], centre));
    Joint joint;
    for (size_t i = 0; i < count; ++i) {
      if (seeds & bit(i))
        joint.seeds.push_back(near_[i]);
      else if (std::sqrt(squared_from(at[i], centre)) < radius + close)
        is_certain = false;
    }
    is_certain = is_certain && (volume > close || std::popcount(seeds) > 4);
    joint.id = id_of(joint.seeds);
    if (place(joint)) joints_.push_back(std::move(joint));
    return false;
  });
  return is_certain && !joints_.empty();
}

void JointFinder::find_faces(const Joint& joint) {
  const CellIndex home = joint.seeds[0].cell;
  const size_t count = joint.seeds.size();
  ExactSeeds::Seed at[max_near];
  for (size_t i = 0; i < count; ++i) at[i] = ExactSeeds::from(home, joint.seeds[i]);
  faces_.clear();
  planes_.clear();
  for (size_t c = 2; c < count; ++c)
    for (size_t b = 1; b < c; ++b)
      for (size_t a = 0; a < b; ++a) {
        const JointFace three = bit(a) | bit(b) | bit(c);
        const auto has_all = [&](JointFace plane) { return (three & ~plane) == 0; };
        if (std::any_of(planes_.begin(), planes_.end(), has_all)) continue;
        JointFace plane = three;
        bool is_on[3] = {false, false, false};  // below, in, above
        for (size_t i = 0; i < count && !(is_on[0] && is_on[2] && plane == three); ++i) {
          if (three & bit(i)) continue;
          const int side = exact_.side(at[a], at[b], at[c], at[i]);
          is_on[side + 1] = true;
          if (side == 0) plane |= bit(i);
        }
        if (is_on[0] && is_on[2]) {
          if (plane != three) planes_.push_back(plane);
          continue;
        }
        // Seeds on a sphere are not three on a line, unless weights lift them.
        if (!is_on[0] && !is_on[2]) continue;
        planes_.push_back(plane);
        faces_.push_back(plane);
      }
}

bool JointFinder::choose(const Joint& joint, JointFace face, Three& three) const {
  const CellIndex home = joint.seeds[0].cell;
  size_t count = 0, numbers[max_near];
  ExactSeeds::Seed on_face[max_near], other{};
  for (size_t i = 0; i < joint.seeds.size(); ++i) {
    const ExactSeeds::Seed seed = ExactSeeds::from(home, joint.seeds[i]);
    if (face & bit(i)) {
      on_face[count] = seed;
      numbers[count++] = i;
    } else {
      other = seed;
    }
  }
  double most = 0;
  for (size_t k = 2; k < count; ++k)
    for (size_t j = 1; j < k; ++j)
      for (size_t i = 0; i < j; ++i) {
        const Vec3 n =
            cross(exact_.apart(on_face[i], on_face[j]), exact_.apart(on_face[i], on_face[k]));
        if (!(dot(n, n) > most)) continue;
        most = dot(n, n);
        three.normal = n;
        const size_t chosen[3] = {i, j, k};
        for (int m = 0; m < 3; ++m) {
          three.at[m] = on_face[chosen[m]];
          three.seed[m] = &joint.seeds[numbers[chosen[m]]];
        }
      }
  if (!(most > 0)) return false;
  three.outward = -exact_.side(three.at[0], three.at[1], three.at[2], other);
  three.normal = three.normal * (three.outward / std::sqrt(most));
  return three.outward != 0;
}

// The other end is where a ball meets the next seed as it moves away from the joint's other seeds,
// with the face's seeds on its sphere. Each step has a ball that is too large and takes a seed in
// it: the ball of that seed is smaller.
bool JointFinder::follow(const Joint& joint, JointFace face, Joint& other) {
  // The rounding of a ball's centre is far smaller. NamedSeeds::find() allows the excess.
  constexpr double margin = 1e-6, excess = 1e-3;
  Three three;
  if (!choose(joint, face, three)) return false;
  const auto& [a, b, c] = three.at;
  const CellIndex home = joint.seeds[0].cell;
  const Vec3 place_of_a = three.seed[0]->from(home, seeds_->scale());
  const Vec3 from_a = joint.position - place_of_a;
  const double along = dot(from_a, three.normal), squared = dot(from_a, from_a) + a.lift,
               radius = seeds_->empty_radius() * (1 + excess);
  const double way = std::sqrt(std::max(0.0, along * along + radius * radius - squared)) - along;
  Vec3 centre = joint.position + three.normal * way;
  NamedSeed met{};  // the last seed taken
  ExactSeeds::Seed d{};
  const auto is_on_ball = [&](const NamedSeed& seed) {
    return seed == *three.seed[0] || seed == *three.seed[1] || seed == *three.seed[2] ||
           seed == met;
  };
  for (bool has_met = false, is_new = true; is_new;) {
    check_cancelled();
    seeds_->find(from_corner(home, centre), margin, near_);
    is_new = false;
    for (const NamedSeed& seed : near_) {
      if (has_met && is_on_ball(seed)) continue;
      const ExactSeeds::Seed e = ExactSeeds::from(home, seed);
      if (exact_.side(a, b, c, e) != three.outward) continue;
      if (has_met && exact_.nearer(a, b, c, d, e) <= 0) continue;
      d = e;
      met = seed;
      has_met = is_new = true;
    }
    if (!has_met) return false;
    centre = place_of_a + exact_.centre(a, b, c, d);
  }
  other.seeds.clear();
  for (const NamedSeed& seed : near_)
    if (is_on_ball(seed) || exact_.nearer(a, b, c, d, ExactSeeds::from(home, seed)) == 0)
      other.seeds.push_back(seed);
  if (other.seeds.size() < 4 || other.seeds.size() > max_near) return false;
  other.id = id_of(other.seeds);
  return place(other);
}

}  // namespace msq
