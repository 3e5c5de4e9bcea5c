// SPDX-License-Identifier: Apache-2.0
// Cells are found as those of edges are (edges/edge_builder.cpp): by a walk among the seeds within
// some distance, proven by the farthest vertex, and where the walk fails, plane by plane. Where
// rounding defeats that too, the planes of all seeds that may matter stand for the faces: planes
// that do not cut a cell are no nearer to its points than those that bound it.
#include "structure/foam/walls/face_brick.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/borrowed.h"
#include "base/job.h"
#include "structure/foam/edges/brick_seeds.h"
#include "structure/foam/edges/clipped_cell.h"
#include "structure/foam/edges/edge_builder.h"
#include "structure/foam/edges/shared_vertices.h"
#include "structure/foam/edges/voronoi_cell.h"

namespace msq {

namespace {

class FaceBuilder {
 public:
  /// `areas`: null where they are not wanted.
  void build(const FoamSeeds& seeds, CellIndex corner, std::vector<FaceBrick::Cell>& cells,
             std::vector<FaceBrick::Face>& faces, std::vector<WallFace>* areas) {
    constexpr int side = FaceBrick::side;
    first_squared_ = EdgeBuilder::first_squared(seeds.scale());
    block_.move_to(seeds, corner, side, first_squared_);
    shared_.reset(block_);
    empty_radius_ = seeds.empty_radius();
    max_squared_ = 4 * empty_radius_ * empty_radius_;
    for (int z = 0; z < side; ++z)
      for (int y = 0; y < side; ++y) {
        check_cancelled();
        for (int x = 0; x < side; ++x) {
          const size_t own = block_.index(x, y, z);
          planes_.clear();
          low_ = Vec3{1, 1, 1} * 1e300;
          high_ = low_ * -1.0;
          if (!find_by_walk(own) && !find_by_cuts(own)) take_all();
          add(block_.position(own), cells, faces);
          if (areas) add_areas(*areas);
        }
      }
  }

  size_t bytes() const { return sizeof *this + block_.bytes() + shared_.bytes(); }

 private:
  struct Neighbour {
    Vec3 position;  // relative to the own seed
    double distance_squared;
  };

  void enclose(Vec3 vertex) {
    low_ = min(low_, vertex);
    high_ = max(high_, vertex);
  }

  bool find_by_walk(size_t own) {
    const double needed = std::max(first_squared_, shared_.needed(own));
    for (double d2 = std::min(needed, max_squared_);;) {
      const uint32_t before = static_cast<uint32_t>(block_.refill(cell_, own, d2));
      if (cell_.count() > VoronoiCell::max_planes) return false;
      shared_.give(block_, own, cell_);
      if (!cell_.walk()) return false;
      // 1e-9: room for the rounding of vertices.
      if (d2 >= max_squared_ || 4 * cell_.radius_squared() * (1 + 1e-9) <= d2) {
        shared_.take(block_, own, before, cell_);
        break;
      }
      d2 = std::min(max_squared_, std::max(4 * cell_.radius_squared() * (1 + 1e-6), 1.25 * d2));
    }
    std::array<bool, VoronoiCell::max_planes> used{};
    cell_.for_each_edge(0,
                        [&](size_t, size_t, uint32_t a, uint32_t b) { used[a] = used[b] = true; });
    const Vec3 seed = block_.position(own);
    for (size_t i = 0; i < cell_.count(); ++i)
      if (used[i]) planes_.push_back(block_.position(cell_.planes().seed[i]) - seed);
    for (size_t v = 0; v < cell_.vertex_count(); ++v) enclose(cell_.vertex(v));
    return true;
  }

  /// From near to far.
  void find_neighbours(size_t own) {
    const Vec3 seed = block_.position(own);
    neighbours_.clear();
    for (size_t i = 0; i < block_.positions().size(); ++i) {
      const Vec3 d = block_.position(i) - seed;
      const double squared = dot(d, d);
      if (i != own && squared <= max_squared_ * (1 + 1e-9)) neighbours_.push_back({d, squared});
    }
    std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& a, const Neighbour& b) {
      return a.distance_squared < b.distance_squared;
    });
  }

  bool find_by_cuts(size_t own) {
    find_neighbours(own);
    // No point of the cell is farther than the empty radius from the seed: the cube takes nothing.
    if (!clipped_.cut_by(neighbours_, 1.001 * empty_radius_, max_squared_)) return false;
    used_.assign(neighbours_.size(), false);
    for (const ClippedCell::Vertex& vertex : clipped_.vertices()) {
      if (!vertex.is_there) continue;
      enclose(vertex.position);
      for (const uint32_t plane : vertex.plane)
        if (plane >= ClippedCell::first_neighbour)
          used_[plane - ClippedCell::first_neighbour] = true;
    }
    for (size_t i = 0; i < used_.size(); ++i)
      if (used_[i]) planes_.push_back(neighbours_[i].position);
    return true;
  }

  void take_all() {
    planes_.clear();
    for (const Neighbour& n : neighbours_) planes_.push_back(n.position);
    high_ = Vec3{1, 1, 1} * empty_radius_;
    low_ = high_ * -1.0;
  }

  void add(Vec3 seed, std::vector<FaceBrick::Cell>& cells, std::vector<FaceBrick::Face>& faces) {
    FaceBrick::Cell cell{seed, {}, {}, static_cast<uint32_t>(faces.size()), 0};
    for (int axis = 0; axis < 3; ++axis) {
      cell.low[axis] = static_cast<float>(low_[axis] - 2 * FaceBrick::box_slack);
      cell.high[axis] = static_cast<float>(high_[axis] + 2 * FaceBrick::box_slack);
    }
    for (const Vec3& apart : planes_) {
      const double distance = length(apart);
      const Vec3 n = apart * (1 / distance);
      faces.push_back({{static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)},
                       static_cast<float>(0.5 * distance)});
    }
    cell.count = static_cast<uint32_t>(faces.size()) - cell.first;
    cells.push_back(cell);
  }

  void add_areas(std::vector<WallFace>& areas) {
    for (const Vec3& face : planes_) {
      polygon_.start({}, face, empty_radius_ * (1 + 1e-9));
      for (const Vec3& other : planes_) {
        if (polygon_.is_empty()) break;
        if (!(other == face)) polygon_.cut(other);
      }
      areas.push_back(polygon_.face());
    }
  }

  BrickSeeds block_;
  SharedVertices shared_;
  VoronoiCell cell_;
  ClippedCell clipped_;
  FacePolygon polygon_;
  std::vector<Neighbour> neighbours_;
  std::vector<bool> used_;
  std::vector<Vec3> planes_;  // of the cell at hand: neighbours, from the own seed
  Vec3 low_, high_;           // of its vertices
  double first_squared_ = 0;
  double empty_radius_ = 0;
  double max_squared_ = 0;  // twice that, squared
};

}  // namespace

FaceBrick::FaceBrick(const FoamSeeds& seeds, CellIndex corner, bool with_areas) {
  const Borrowed<FaceBuilder> builder;
  cells_.reserve(size_t{side} * side * side);
  faces_.reserve(size_t{side} * side * side * 17);
  if (with_areas) areas_.reserve(faces_.capacity());
  builder->build(seeds, corner, cells_, faces_, with_areas ? &areas_ : nullptr);
}

}  // namespace msq
