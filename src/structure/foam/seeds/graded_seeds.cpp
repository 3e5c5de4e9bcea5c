// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeds/graded_seeds.h"

#include <algorithm>
#include <cmath>

namespace msq {

bool GradedSeeds::splits(const Node& node) const {
  if (node.level == max_levels) return false;
  double density;
  if (density_.is_constant()) {
    density = density_.at({});
  } else {
    const double half = 0.5 * node.size();
    const CellIndex cell = node.cell;
    const Vec3 centre =
        Vec3{double(cell.x), double(cell.y), double(cell.z)} + node.low + Vec3{half, half, half};
    density = density_.at(grid_.from_grid(centre * grid_.cell_size));
  }
  const double expected = std::ldexp(density, -3 * node.level);
  if (!(expected > 1)) return false;
  if (expected >= 8) return true;
  // Outputs 2 path and 2 path + 1 of the cell's stream: the first for the seed, the second for this
  // decision.
  const uint64_t bits = splitmix_output(cells_.bits(node.cell), 2 * uint64_t{node.path} + 1);
  return random_fraction(bits) < (expected - 1) / 7;
}

Vec3 GradedSeeds::in_leaf(const Node& leaf) const {
  const uint64_t cell_bits = cells_.bits(leaf.cell);
  const uint64_t bits =
      leaf.level == 0 ? cell_bits : splitmix_output(cell_bits, 2 * uint64_t{leaf.path});
  return leaf.low + cells_.fractions(bits) * leaf.size();
}

int GradedSeeds::twig_level() const {
  const double most = density_.range().high;
  int level = 0;
  while (level < max_levels && std::ldexp(most, -3 * level) > 8) ++level;
  return level;
}

int GradedSeeds::min_level(const Box3& box) const {
  // Nodes around the points of the box lie in the cells that the box meets, and so do their
  // centres. If the density is at least 8^n everywhere there, a node of level l < n expects 8^(n -
  // l) >= 8 seeds.
  const double slack = 1e-9;
  Box3 cells;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = grid_.cell_size[axis];
    cells.min[axis] = std::floor(box.min[axis] / size - slack) * size;
    cells.max[axis] = (std::floor(box.max[axis] / size + slack) + 1) * size;
  }
  const double least = density_.range(grid_.from_grid(cells)).low;
  int level = 0;
  for (double next = 8; level < max_levels && least >= next; next *= 8) ++level;
  return level;
}

double GradedSeeds::max_distance(const Box3& box) const {
  if (placed_) return placed_->max_distance(box);
  return std::ldexp(length(grid_.cell_size) * (1 + 1e-9), -min_level(box));
}

Box3 GradedSeeds::box_of(CellIndex corner) const {
  const Vec3 low = Vec3{double(corner.x), double(corner.y), double(corner.z)} * grid_.cell_size;
  return {low, low + grid_.cell_size * brick_side()};
}

bool GradedSeeds::is_needed(CellIndex corner) const {
  return !placed_ || placed_->is_needed(box_of(corner));
}

bool GradedSeeds::may_own_edges(CellIndex corner, const Box3& box) const {
  // Such an edge has a point v in the box. Its owner is one of the seeds nearest to v, so it is
  // within max_distance of v, and v is within that distance of the brick. The diagonal of a cell
  // bounds which points of the box can be v.
  const Box3 brick = box_of(corner);
  const double diagonal = length(grid_.cell_size) * (1 + 1e-9);
  const Box3 about = brick.grown(diagonal);
  if (!about.overlaps(box)) return false;
  return brick.grown(max_distance({max(about.min, box.min), min(about.max, box.max)}))
      .overlaps(box);
}

double GradedSeeds::mean_density(const Box3& box) const {
  const Interval range = placed_ ? placed_->density(box) : density_.range(grid_.from_grid(box));
  return std::max(1.0, 0.5 * (range.low + range.high));
}

int GradedSeeds::brick_side() const {
  // At most about 512 seeds, unless a single cell has more.
  const double most = placed_ ? placed_->max_density() : density_.range().high;
  return most <= 8 ? 4 : most <= 64 ? 2 : 1;
}

void GradedSeeds::describe(HashInput& input) const {
  if (!placed_) return density_.describe(input);
  input.text("placed");
  placed_->describe(input);
}

}  // namespace msq
