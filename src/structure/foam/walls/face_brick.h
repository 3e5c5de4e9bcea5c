// SPDX-License-Identifier: Apache-2.0
// The Voronoi cells of the seeds of a brick of neighbourhood cells, by their faces.
#pragma once

#include <memory>
#include <vector>

#include "cell/cache.h"
#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seeds.h"
#include "structure/foam/seeds/stretch.h"
#include "structure/foam/walls/wall_face.h"

namespace msq {

/// Foam units; of stretched cells, max_factor() foam units (seeds/stretch.h), so that cells are no
/// longer than in the space of the diagram.
class FaceBrick final : public CellData {
 public:
  /// Cells along each axis, unless seeds are graded; bricks begin `lead` before multiples of that,
  /// as those of edges do (edges/edge_brick.h).
  static constexpr int side = 8, lead = 2;

  struct Face {
    float normal[3];  // outward, of length 1
    float distance;   // of its plane from the seed; below 0 if the seed is beyond it
  };
  struct Cell {
    Vec3 seed;              // from the corner of the brick
    float low[3], high[3];  // about the cell, from the seed
    uint32_t first, count;  // of its faces

    /// `box`: of the vertices.
    void set_box(const Box3& box);
  };
  /// By how much coordinates of the boxes about cells exceed those of their vertices, at least.
  static constexpr double box_slack = 1e-6;

  /// The brick whose first cell is `corner`.
  FaceBrick(const FoamSeeds& seeds, CellIndex corner, bool with_areas);
  /// Of weighted seeds (seeds/seeds.h); without areas. Seeds without a cell are left out.
  struct Weighted {};
  FaceBrick(Weighted, const FoamSeeds& seeds, CellIndex corner);
  /// Of graded seeds (seeds/graded_seeds.h), in the cells of their brick.
  FaceBrick(const std::shared_ptr<const GradedSeeds>& seeds, CellIndex corner, bool with_areas);
  /// Of stretched cells; without areas.
  FaceBrick(const Stretch& stretch, CellIndex corner);

  /// Each is bounded by its faces; there may be planes among them that only touch it.
  const std::vector<Cell>& cells() const { return cells_; }
  const Face* faces(const Cell& cell) const { return faces_.data() + cell.first; }
  /// Areas and centroids, from the seed, of the faces; if they were wanted.
  const WallFace* areas(const Cell& cell) const { return areas_.data() + cell.first; }
  uint64_t bytes() const override {
    return sizeof *this + cells_.capacity() * sizeof(Cell) + faces_.capacity() * sizeof(Face) +
           areas_.capacity() * sizeof(WallFace);
  }

 private:
  /// From a walk over tetrahedra (facet_faces.h); false, and nothing is there, if it gives up.
  bool walk(const FoamSeeds& seeds, CellIndex corner, Vec3 factor);

  std::vector<Cell> cells_;
  std::vector<Face> faces_;
  std::vector<WallFace> areas_;
};

}  // namespace msq
