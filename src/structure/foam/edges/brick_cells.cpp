// SPDX-License-Identifier: Apache-2.0
// A walk (voronoi_cell.h) finds each seed's Voronoi cell among the seeds within some distance D of
// it. The result is the true cell if its farthest vertex is within D / 2: a seed farther than D is
// farther than twice any vertex, and cuts nothing. If not, D grows, up to twice the empty radius,
// beyond which no seed can matter. The walk may have no room (cells so flat or long that too many
// seeds are within D) or may fail (seeds on one sphere, low jitter). Then the cell is cut plane by
// plane (clipped_cell.h).
#include "structure/foam/edges/brick_cells.h"

#include <algorithm>
#include <cmath>

namespace msq {

namespace {

/// A list of neighbours with at least this D^2 is enough for most cells of volume 1 (cubes: 97 of
/// 100). It goes with the volume of the grid's cells, so that flat and long cells have as many
/// seeds within D as cubes have.
constexpr double first_distance_squared = 4.75;

}  // namespace

void BrickCells::move_to(const FoamSeeds& seeds, CellIndex corner, int side) {
  const Vec3 scale = seeds.scale();
  first_squared_ = first_distance_squared * std::pow(scale.x * scale.y * scale.z, 2.0 / 3);
  block_.move_to(seeds, corner, side, first_squared_);
  shared_.reset(block_);
  empty_radius_ = seeds.empty_radius();
  max_squared_ = 4 * empty_radius_ * empty_radius_;
}

int64_t BrickCells::walk(size_t own) {
  const double needed = std::max(first_squared_, shared_.needed(own));
  for (double d2 = std::min(needed, max_squared_);;) {
    const uint32_t before = static_cast<uint32_t>(block_.refill(cell_, own, d2));
    if (cell_.count() > VoronoiCell::max_planes) return -1;
    shared_.give(block_, own, cell_);
    if (!cell_.walk()) return -1;
    // 1e-9: slack for the rounding of vertices.
    if (d2 >= max_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
      shared_.take(block_, own, before, cell_);
      return before;
    }
    d2 = std::min(max_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
  }
}

void BrickCells::find_neighbours(size_t own) {
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

/// Uses neighbours from near to far, until no vertex is farther than half the distance.
bool BrickCells::cut(size_t own) {
  find_neighbours(own);
  // All points of the cell are within the empty radius of the seed: the cube cuts off nothing.
  return clipped_.cut_by(neighbours_, 1.001 * empty_radius_, max_squared_);
}

}  // namespace msq
