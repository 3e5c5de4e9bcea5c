// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam that may own a part of a plane of constant z.
#pragma once

#include <cstddef>
#include <cstdint>

#include "structure/common/line_graph.h"
#include "structure/common/plane_cells.h"
#include "structure/foam/seeds/graded_seeds.h"
#include "structure/foam/seeds/seeds.h"
#include "structure/foam/seeds/stretch.h"

namespace msq {

/// A seed as the plane sees it. A point v of the plane is at the squared distance
/// |v - position|^2 + weight from it.
struct SectionSeed {
  Vec2 position;  ///< of the nearest point of the plane
  double weight;  ///< squared distance from the plane, and the lift of a weighted foam's seed
};

/// In the order of seeds: by cell (z, y, x of the grid), then by path in the tree of the cell. So
/// two seeds have the same order in every window.
struct SectionSeeds {
  double reach = 0;  ///< no point of the plane is farther from its nearest seed
  double height = 0;
  Vec3 origin;  ///< of the grid, in the plane and along its normal
  CountedVector<SectionSeed> seeds;

  /// A seed whose position differs from this one by no more, along each axis, is above or below it
  /// except for rounding. The same in every window.
  double same_place(Vec2 position) const;
};

/// The foam whose seeds are sought, with struts or walls.
struct SectionFoam {
  const Neighbourhood& grid;
  const FoamSeeds& seeds;
  const std::shared_ptr<const GradedSeeds>& graded;  ///< null where there is one seed in each cell
  double unit;                                       ///< length of a foam unit in model units
  const Stretch* stretch = nullptr;  ///< null where the diagram is that of model space
};

/// A plane of constant z in the space of the diagram (seeds/stretch.h), with lengths in model
/// units. It has coordinates v in which distances are those of that space; without a stretch, model
/// x, y.
class SectionPlane {
 public:
  SectionPlane(const SectionFoam& foam, double z);

  /// From grid coordinates to v and the height.
  const GridMap& from_grid() const { return from_grid_; }
  double height() const { return height_; }
  /// No point of space is farther, lifted (seeds/seeds.h), from its nearest seed.
  double reach() const { return reach_; }
  /// Of a cell, in the space of the diagram.
  double cell_volume() const { return cell_volume_; }
  Vec2 to_model(Vec2 v) const {
    return is_stretched_ ? origin_ + Vec2{xx_ * v.x + xy_ * v.y, yy_ * v.y} : v;
  }
  /// Contains the image of a window.
  Box2 image(const Box2& window) const;
  /// Contains the grid coordinates of a box of v and the height.
  Box3 to_grid(const Box3& box) const;

 private:
  const Neighbourhood& grid_;
  bool is_stretched_;
  GridMap from_grid_;
  double height_, reach_, cell_volume_;
  Rotation axes_;  // of the plane and its normal, as rows, in the space of the diagram
  Vec3 factor_{1, 1, 1};
  double xx_ = 1, xy_ = 0, yy_ = 1;
  Vec2 origin_;
};

/// All seeds within 3 reach of a window of the plane that may be nearest to a point of the plane:
/// those whose part of the plane meets the window (within 1 reach), and all that bound those
/// (within 2 more). Throws Error(limit) where there are too many.
SectionSeeds find_section_seeds(const SectionFoam& foam, const SectionPlane& plane,
                                const Box2& window);

}  // namespace msq
