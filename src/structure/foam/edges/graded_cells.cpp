// SPDX-License-Identifier: Apache-2.0
// Each cell is computed from few seeds and then verified against all.
//
// A convex cell computed from some of the seeds is the true one if no other seed is nearer to a
// vertex than its own seed: a half-space that cuts a convex polytope cuts off a vertex. That is,
// the ball about each vertex v through the own seed must be empty. The seeds within some distance D
// of the own seed are in memory. They include those in the balls with 2 |v| <= D, since a ball lies
// within 2 |v| of the own seed. If a fine leaf has coarse neighbours, vertices are farther away.
// Then the octrees find the seed nearest to v: an empty ball contains no whole leaf or cell, so
// this examines few nodes. Seeds found in a ball are added, and the cell is computed again, until
// none is found.
//
// The cell begins with the nearest seeds of all eight octants about the own seed. With one strictly
// inside each, it is bounded: a direction d has a positive product with the seed of its octant.
// Each octant has such a seed within two cells along each axis, since there it contains a whole
// cell that does not touch the planes between octants from the outside. Of placed seeds
// (seeds/placed_seeds.h) it has one within three diagonals of a box: the ball of one diagonal about
// a point 1.001 of them farther along each axis is inside the octant, ends 1 + 1.001 sqrt 3 of them
// away, and has a seed, as the nearest one of any point is less than a diagonal from it.
//
// Lengths are relative to the own seed and in sizes of its leaf, so that the tolerances of the walk
// (voronoi_cell.h) and of EdgeLine have the same meaning at all levels. If the walk fails (seeds on
// one sphere) or has no room (a coarse leaf among fine ones), the cell is cut plane by plane
// (clipped_cell.h). If rounding defeats that too, every pair of seeds is tried by the definition
// itself (edge_line.h), which needs no graph.
#include "structure/foam/edges/graded_cells.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "structure/foam/point/edge_line.h"

namespace msq {

namespace {

/// D^2, in sizes of the own leaf if that is a cube, or else in the side of a cube of its volume.
/// Among leaves of one level it covers about 43 seeds, enough for most cells. With fewer than
/// `enough` seeds, D grows. With more than `crowd`, as near a coarse leaf among fine ones, it
/// shrinks. Any D is correct, and all vertices are compared with all seeds in memory.
constexpr double first_reach_squared = 4.75;
constexpr size_t enough = 32, crowd = 2048;
/// If more than `max_at_first` seeds are in memory, this number of each octant is used.
constexpr size_t max_at_first = 64, octant_share = 6;
/// Maximum distance of a vertex v beyond a plane, relative to |v|^2 or to 1. Larger than that of
/// ClippedCell.
constexpr double tolerance = 2 * ClippedCell::tolerance;

}  // namespace

void GradedCells::move_to(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex home) {
  trees_.move_to(seeds);
  home_ = home;
  empty_radius_ = seeds->cells().empty_radius();
  is_placed_ = seeds->placed() != nullptr;
  scale_ = seeds->scale();
  const double side = std::cbrt(scale_.x * scale_.y * scale_.z);
  first_reach_squared_ = first_reach_squared * (side * side);
}

void GradedCells::append_seeds(CellIndex cell, std::vector<LeafSeed>& seeds) {
  trees_.visit_cell(home_, cell, [&](const LeafSeed& seed) { seeds.push_back(seed); });
}

void GradedCells::find(const LeafSeed& own) {
  own_ = own;
  unit_ = 1.0 / (1 << own.level);
  gather();
  choose_first();
  if (walk()) {
    way_ = Way::walked;
  } else if (clip()) {
    way_ = Way::clipped;
  } else {
    try_pairs();
    way_ = Way::tried;
  }
}

void GradedCells::find_faces(std::vector<Vec3>& neighbours, Box3& box) {
  neighbours.clear();
  box = {Vec3{1, 1, 1} * 1e300, Vec3{1, 1, 1} * -1e300};
  const auto enclose = [&](Vec3 vertex) {
    box = {min(box.min, vertex * unit_), max(box.max, vertex * unit_)};
  };
  const auto take = [&](const Neighbour& n) { neighbours.push_back(n.at * unit_); };
  if (way_ == Way::walked) {
    is_used_.assign(planes_.size(), false);
    cell_.for_each_edge(
        0, [&](size_t, size_t, uint32_t a, uint32_t b) { is_used_[a] = is_used_[b] = true; });
    for (size_t i = 0; i < planes_.size(); ++i)
      if (is_used_[i]) take(planes_[i]);
    for (const Vec3& vertex : vertices_) enclose(vertex);
  } else if (way_ == Way::clipped) {
    is_used_.assign(by_distance_.size(), false);
    for (const ClippedCell::Vertex& vertex : clipped_.vertices()) {
      if (!vertex.is_there) continue;
      enclose(vertex.position);
      for (const uint32_t plane : vertex.plane)
        if (plane >= ClippedCell::first_neighbour)
          is_used_[plane - ClippedCell::first_neighbour] = true;
    }
    for (size_t i = 0; i < by_distance_.size(); ++i)
      if (is_used_[i]) take(by_distance_[i]);
  } else {
    for (const Neighbour& n : planes_) take(n);
    box = Box3{}.grown(empty_radius_ * (1 + 1e-9));
  }
}

GradedCells::Neighbour GradedCells::neighbour(const LeafSeed& seed) const {
  const Vec3 at = (seed.position - own_.position) * (1 / unit_);
  return {at, 0.5 * dot(at, at), seed.order, seed.level};
}

std::array<GradedCells::Seed, 2> GradedCells::others(const Neighbour& a, const Neighbour& b) {
  return {{{a.order, a.level}, {b.order, b.level}}};
}

void GradedCells::gather() {
  reach_squared_ = first_reach_squared_;
  for (bool is_crowded = false;;) {
    near_.clear();
    const double squared = reach_squared_ * (unit_ * unit_);
    trees_.visit_twigs(
        home_, Box3{own_.position, own_.position}.grown(std::sqrt(squared) + 1e-9),
        [&](const Box3& box) {
          return near_.size() <= crowd && min_squared(box, own_.position) <= squared + 1e-9;
        },
        [&](const SeedTrees::Twig& twig) { add_near(twig); });
    if (near_.size() > crowd) {
      is_crowded = true;
      reach_squared_ *= 0.5;
      continue;
    }
    if (is_crowded || near_.size() >= enough) return;
    reach_squared_ *= 2;
  }
}

void GradedCells::add_near(const SeedTrees::Twig& twig) {
  const CellIndex cell = twig.cell;
  const Vec3 corner{double(cell.x - home_.x), double(cell.y - home_.y), double(cell.z - home_.z)};
  const auto neighbour_at = [&](Vec3 in_cell) {
    return ((corner + in_cell) * scale_ - own_.position) * (1 / unit_);
  };
  // Which seeds are within D is unpredictable: listed without a branch.
  constexpr size_t most = 64;
  for (size_t first = 0; first < twig.count; first += most) {
    const SeedTrees::Leaf* const leaves = twig.leaves + first;
    const size_t count = std::min(most, twig.count - first);
    uint8_t within[most];
    size_t found = 0;
    for (size_t i = 0; i < count; ++i) {
      const Vec3 at = neighbour_at(leaves[i].in_cell);
      within[found] = static_cast<uint8_t>(i);
      found += 2 * (0.5 * dot(at, at)) <= reach_squared_;
    }
    for (size_t i = 0; i < found; ++i) {
      const SeedTrees::Leaf& leaf = leaves[within[i]];
      const Vec3 at = neighbour_at(leaf.in_cell);
      const uint64_t order = SeedTrees::order_of(home_, cell, leaf.order);
      if (order != own_.order) near_.push_back({at, 0.5 * dot(at, at), order, leaf.level});
    }
  }
}

void GradedCells::choose_first() {
  planes_.clear();
  has_all_near_ = near_.size() <= max_at_first;
  if (has_all_near_) {
    planes_ = near_;
  } else {
    // The nearest of each octant, by insertion.
    Neighbour share[8][octant_share];
    size_t held[8] = {};
    for (const Neighbour& n : near_) {
      const uint32_t o = octant(n.at);
      size_t i = held[o];
      if (i == octant_share) {
        if (share[o][i - 1].half_squared <= n.half_squared) continue;
        --i;
      } else {
        ++held[o];
      }
      for (; i > 0 && share[o][i - 1].half_squared > n.half_squared; --i)
        share[o][i] = share[o][i - 1];
      share[o][i] = n;
    }
    for (int o = 0; o < 8; ++o) planes_.insert(planes_.end(), share[o], share[o] + held[o]);
  }
  bool has[8] = {};
  for (const Neighbour& n : planes_)
    if (n.at.x != 0 && n.at.y != 0 && n.at.z != 0) has[octant(n.at)] = true;
  for (uint32_t o = 0; o < 8; ++o)
    if (!has[o]) add_nearest_in_octant(o);
  sort_planes();
}

void GradedCells::add_nearest_in_octant(uint32_t wanted) {
  const double far = (is_placed_ ? 3 : 2) * empty_radius_ * (1 + 1e-9);
  double squared = far * far;
  LeafSeed seed{};
  bool has_seed = false;
  Vec3 low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const bool up = wanted >> axis & 1;
    low[axis] = own_.position[axis] - (up ? 0 : far);
    high[axis] = own_.position[axis] + (up ? far : 0);
  }
  const Box3 box{low, high};
  trees_.visit(
      home_, box,
      [&](const Box3& node) {
        return node.overlaps(box) && min_squared(node, own_.position) < squared;
      },
      [&](const LeafSeed& found) {
        const Vec3 d = found.position - own_.position;
        if (d.x == 0 || d.y == 0 || d.z == 0 || octant(d) != wanted || dot(d, d) >= squared) return;
        squared = dot(d, d);
        seed = found;
        has_seed = true;
      });
  // There is one, as the head of this file proves. Without it the cell would only be unbounded, and
  // the walk would fail.
  if (has_seed) planes_.push_back(neighbour(seed));
}

void GradedCells::sort_planes() {
  std::sort(planes_.begin(), planes_.end(),
            [](const Neighbour& a, const Neighbour& b) { return a.order < b.order; });
}

bool GradedCells::is_plane(uint64_t order) const {
  const auto at =
      std::lower_bound(planes_.begin(), planes_.end(), order,
                       [](const Neighbour& n, uint64_t value) { return n.order < value; });
  return at != planes_.end() && at->order == order;
}

bool GradedCells::walk() {
  do {
    if (!walk_once()) return false;
  } while (add_violators());
  return true;
}

bool GradedCells::walk_once() {
  vertices_.clear();
  edges_.clear();
  if (planes_.size() > VoronoiCell::max_planes) return false;
  cell_.clear();
  uint32_t after = 0;  // planes of seeds after the own one come last
  for (const Neighbour& n : planes_) {
    cell_.add(n.at);
    after += n.order < own_.order;
  }
  if (!cell_.walk()) return false;
  for (size_t i = 0; i < cell_.vertex_count(); ++i) vertices_.push_back(cell_.vertex(i));
  cell_.for_each_edge(after, [&](size_t from, size_t to, uint32_t a, uint32_t b) {
    edges_.push_back({vertices_[from], vertices_[to], others(planes_[a], planes_[b]), true});
  });
  return true;
}

bool GradedCells::clip() {
  // All points of the cell are within the empty radius of the seed: the cube cuts off nothing.
  clipped_.start(1.001 * empty_radius_ / unit_);
  sort_by_distance();
  for (const Neighbour& n : by_distance_) {
    check_cancelled();
    if (!clipped_.cut(n.at)) return false;
  }
  unproven_.clear();
  const auto add_unproven = [&](size_t from) {
    for (size_t i = from; i < clipped_.vertices().size(); ++i)
      unproven_.push_back(static_cast<uint32_t>(i));
  };
  add_unproven(0);
  while (!unproven_.empty()) {
    check_cancelled();
    const ClippedCell::Vertex& vertex = clipped_.vertices()[unproven_.back()];
    unproven_.pop_back();
    if (!vertex.is_there) continue;
    found_.clear();
    check_far(vertex.position, dot(vertex.position, vertex.position));
    if (found_.empty()) continue;
    by_distance_.push_back(found_[0]);
    planes_.push_back(found_[0]);
    sort_planes();
    if (!clipped_.cut(found_[0].at)) return false;
    add_unproven(clipped_.made());
  }
  edges_.clear();
  const auto is_after = [&](uint32_t plane) {
    return plane >= ClippedCell::first_neighbour &&
           by_distance_[plane - ClippedCell::first_neighbour].order > own_.order;
  };
  clipped_.for_each_edge(is_after, [&](Vec3 from, Vec3 to) {
    edges_.push_back({from, to, {}, false});
  });
  return true;
}

void GradedCells::try_pairs() {
  do try_pairs_once();
  while (add_violators());
}

void GradedCells::try_pairs_once() {
  vertices_.clear();
  edges_.clear();
  sort_by_distance();
  const size_t count = by_distance_.size();
  for (size_t i = 0; i < count; ++i)
    for (size_t j = i + 1; j < count; ++j) {
      check_cancelled();
      const EdgeLine line(Vec3{}, by_distance_[i].at, by_distance_[j].at);
      if (!line.exists()) continue;
      LineInterval part{-1e300, 1e300};
      for (size_t k = 0; k < count && line.holds(part); ++k)
        if (k != i && k != j) line.cut(by_distance_[k].at, part);
      if (!line.holds(part) || part.low == -1e300 || part.high == 1e300) continue;
      const Edge edge{line.at(part.low), line.at(part.high), {}, false};
      vertices_.push_back(edge.from);
      vertices_.push_back(edge.to);
      if (by_distance_[i].order > own_.order && by_distance_[j].order > own_.order)
        edges_.push_back(edge);
    }
}

void GradedCells::sort_by_distance() {
  by_distance_ = planes_;
  std::sort(by_distance_.begin(), by_distance_.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.half_squared < b.half_squared ||
           (a.half_squared == b.half_squared && a.order < b.order);
  });
}

bool GradedCells::add_violators() {
  const size_t before = planes_.size();
  found_.clear();
  for (const Vec3& v : vertices_) {
    check_cancelled();
    const double squared = dot(v, v);
    if (!has_all_near_) check_near(v);
    if (4 * squared * (1 + 1e-9) > reach_squared_) check_far(v, squared);
  }
  for (const Neighbour& n : found_) {
    if (is_plane(n.order)) continue;
    planes_.push_back(n);
    sort_planes();
  }
  return planes_.size() != before;
}

void GradedCells::check_near(Vec3 v) {
  double deepest = tolerance;
  const Neighbour* found = nullptr;
  for (const Neighbour& n : near_) {
    const double depth = dot(n.at, v) - n.half_squared;
    if (depth <= deepest || is_plane(n.order)) continue;
    deepest = depth;
    found = &n;
  }
  if (found) found_.push_back(*found);
}

void GradedCells::check_far(Vec3 v, double squared) {
  const double most = 1.001 * empty_radius_ / unit_;
  if (squared > most * most) {
    v = v * (most / std::sqrt(squared));
    squared = dot(v, v);
  }
  // |s - v|^2 = |v|^2 - 2 (s v - |s|^2 / 2)
  const double slack = tolerance * std::max(1.0, squared);
  double nearest_squared = (squared - 2 * slack) * (unit_ * unit_);
  LeafSeed seed{};
  bool found = false;
  trees_.nearest(home_, own_.position + v * unit_, nearest_squared, seed,
                 [&](const LeafSeed& candidate) {
                   if (candidate.order == own_.order || is_plane(candidate.order)) return false;
                   return found = true;
                 });
  if (found) found_.push_back(neighbour(seed));
}

}  // namespace msq
