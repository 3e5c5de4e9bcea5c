// SPDX-License-Identifier: Apache-2.0
// A walk (voronoi_cell.h) finds each seed's Voronoi cell among the seeds within some distance D of
// it. The result is the true cell if its farthest vertex is within D / 2: a seed farther than D is
// farther than twice any vertex, and cuts nothing. If not, D grows, up to twice the empty radius,
// beyond which no seed can matter. The walk may have no room (cells so flat or long that too many
// seeds are within D) or may fail (seeds on one sphere, low jitter). Then the cell is cut plane by
// plane (clipped_cell.h). If rounding defeats that too, every pair of neighbours is tried by the
// definition itself (edge_line.h), which needs no graph.
#include "structure/foam/edges/edge_builder.h"

#include <algorithm>
#include <cmath>

#include "base/job.h"
#include "structure/foam/point/edge_line.h"

namespace msq {

namespace {

/// A list of neighbours with at least this D^2 is enough for most cells of volume 1 (cubes: 97 of
/// 100).
constexpr double first_distance_squared = 4.75;

}  // namespace

double EdgeBuilder::first_squared(Vec3 scale) {
  return first_distance_squared * std::pow(scale.x * scale.y * scale.z, 2.0 / 3);
}

void EdgeBuilder::build(const FoamSeeds& seeds, CellIndex corner, int side, bool wants_seeds) {
  first_squared_ = first_squared(seeds.scale());
  block_.move_to(seeds, corner, side, first_squared_);
  shared_.reset(block_);
  empty_radius_ = seeds.empty_radius();
  max_squared_ = 4 * empty_radius_ * empty_radius_;
  has_jitter_ = seeds.jitter() > 0;
  wants_seeds_ = wants_seeds;
  ends_.clear();
  starts_.clear();
  triples_.clear();
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y) {
      check_cancelled();
      starts_.push_back(static_cast<uint32_t>(ends_.size()));
      for (int x = 0; x < side; ++x) add_owned_edges(block_.index(x, y, z));
    }
}

/// Seeds come in the order of their cells.
void EdgeBuilder::add_owned_edges(size_t own) {
  // Without jitter all vertices have eight seeds. A walk that finds a way through the roundings
  // would name three of them for each edge, and rays would differ by the choice.
  if (has_jitter_ && add_by_walk(own)) return;
  if (!add_by_cuts(own)) add_by_definition(own);
}

bool EdgeBuilder::add_by_walk(size_t own) {
  const double needed = std::max(first_squared_, shared_.needed(own));
  for (double d2 = std::min(needed, max_squared_);;) {
    const uint32_t before = static_cast<uint32_t>(block_.refill(cell_, own, d2));
    if (cell_.count() > VoronoiCell::max_planes) return false;
    shared_.give(block_, own, cell_);
    if (!cell_.walk()) return false;
    // 1e-9: slack for the rounding of vertices.
    if (d2 >= max_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
      shared_.take(block_, own, before, cell_);
      const std::vector<uint32_t>& numbers = shared_.numbers();
      // Planes are in the order of cells: those before the own cell come first.
      const uint32_t* seeds = cell_.planes().seed;
      cell_.for_each_edge(before, [&](size_t from, size_t to, uint32_t a, uint32_t b) {
        ends_.push_back({numbers[from], numbers[to]});
        if (wants_seeds_) triples_.push_back({static_cast<uint32_t>(own), seeds[a], seeds[b]});
      });
      return true;
    }
    d2 = std::min(max_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
  }
}

/// Fills neighbours_ with all seeds that may matter, by distance.
void EdgeBuilder::find_neighbours(size_t own) {
  const Vec3 seed = block_.position(own);
  neighbours_.clear();
  for (size_t i = 0; i < block_.positions().size(); ++i) {
    const Vec3 d = block_.position(i) - seed;
    const double squared = dot(d, d);
    if (i != own && squared <= max_squared_ * (1 + 1e-9))
      neighbours_.push_back({d, squared, i > own});
  }
  std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.distance_squared < b.distance_squared;
  });
}

/// Uses neighbours from near to far, until no vertex is farther than half the distance. If that is
/// impossible, returns false and appends nothing.
bool EdgeBuilder::add_by_cuts(size_t own) {
  find_neighbours(own);
  // All points of the cell are within the empty radius of the seed: the cube cuts off nothing.
  if (!clipped_.cut_by(neighbours_, 1.001 * empty_radius_, max_squared_)) return false;
  const Vec3 seed = block_.position(own);
  const auto is_after = [&](uint32_t plane) {
    return plane >= ClippedCell::first_neighbour &&
           neighbours_[plane - ClippedCell::first_neighbour].after;
  };
  clipped_.for_each_edge(is_after, [&](Vec3 from, Vec3 to) {
    ends_.push_back({shared_.take(seed + from), shared_.take(seed + to)});
    add_unknown(own);
  });
  return true;
}

/// Every pair of later neighbours, cut by all others.
void EdgeBuilder::add_by_definition(size_t own) {
  find_neighbours(own);
  const Vec3 seed = block_.position(own);
  const std::vector<Neighbour>& neighbours = neighbours_;
  const size_t count = neighbours.size();
  for (size_t i = 0; i < count; ++i) {
    if (!neighbours[i].after) continue;
    check_cancelled();
    for (size_t j = i + 1; j < count; ++j) {
      if (!neighbours[j].after) continue;
      const EdgeLine line(Vec3{}, neighbours[i].position, neighbours[j].position);
      if (!line.exists()) continue;
      LineInterval part{-1e300, 1e300};
      for (size_t k = 0; k < count && line.holds(part); ++k)
        if (k != i && k != j) line.cut(neighbours[k].position, part);
      if (!line.holds(part)) continue;
      ends_.push_back(
          {shared_.take(seed + line.at(part.low)), shared_.take(seed + line.at(part.high))});
      add_unknown(own);
    }
  }
}

}  // namespace msq
