// SPDX-License-Identifier: Apache-2.0
// The seeds of a foam with more than one in a cell (graded_seeds.h): octrees, which grow as far as
// searches need, or the lists of placed seeds. They are kept for the next search of the thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "structure/foam/seeds/graded_seeds.h"

namespace msq {

/// The seed of a leaf, or a placed one.
struct LeafSeed {
  Vec3 position;   ///< foam units, from the corner of the search's home cell
  int level;       ///< of the leaf
  uint64_t order;  ///< ascends by cell (z, y, x), then by path or number; for seeds within 2^15
                   ///< cells of home
};

class SeedTrees {
 public:
  /// Seeds of one cell that lie side by side, in order: about eight leaves or fewer, or the placed
  /// ones of the cell.
  struct Leaf {
    Vec3 in_cell;
    uint32_t order;  ///< in the cell
    int level;
  };
  struct Twig {
    CellIndex cell;
    const Leaf* leaves;
    size_t count;
  };

  /// Moves to the seeds of a foam. Free if these are the current ones, except that too large a
  /// store is emptied.
  void move_to(const std::shared_ptr<const GradedSeeds>& seeds);
  /// Whether the seeds are the current ones.
  bool has(const std::shared_ptr<const GradedSeeds>& seeds) const {
    // A control block is not reused while owner_ refers to it; the address of the seeds may be.
    return !owner_.owner_before(seeds) && !seeds.owner_before(owner_);
  }

  /// Calls found(seed) for the leaf seeds in cells that meet a box, in the order of seeds. May skip
  /// boxes for which wanted(box) is false. Foam units from the corner of `home`.
  template <class Wanted, class Found>
  void visit(CellIndex home, const Box3& box, Wanted&& wanted, Found&& found);

  /// The same for twigs: found(twig). wanted(box) is not evaluated for the nodes in a twig. Faster
  /// if most seeds in the box are wanted. A twig is valid until the next search.
  template <class Wanted, class Found>
  void visit_twigs(CellIndex home, const Box3& box, Wanted&& wanted, Found&& found);
  /// LeafSeed::order of a leaf.
  static uint64_t order_of(CellIndex home, CellIndex cell, uint32_t order) {
    const auto biased = [](int32_t from_home) {
      return static_cast<uint64_t>(static_cast<uint16_t>(from_home + 0x8000));
    };
    return ((biased(cell.z - home.z) << 16 | biased(cell.y - home.y)) << 16 |
            biased(cell.x - home.x))
               << 15 |
           order;
  }

  /// visit() for all leaves of one cell.
  template <class Found>
  void visit_cell(CellIndex home, CellIndex cell, Found&& found);

  /// The seed of the leaf that contains q, a point of `home`; or a placed one nearby.
  LeafSeed at(CellIndex home, Vec3 q);

  /// Finds the seed nearest to q among those with accept(seed) that are nearer than
  /// sqrt(distance_squared). If there is one, sets both outputs.
  template <class Accept>
  void nearest(CellIndex home, Vec3 q, double& distance_squared, LeafSeed& seed, Accept&& accept);

  size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(Leaf) +
           twigs_.capacity() * sizeof(Range);
  }

 private:
  struct Node {
    Vec3 seed;  // of a leaf, in its cell
    // The first of eight; or a mark. A list of placed seeds has 1 more than their count. The seeds
    // follow it, and have their number and level.
    uint32_t children = 0;
    uint32_t twig = 0;  // number from 1 on; 0: not a twig, or not yet
  };
  struct Range {
    uint32_t first, count;  // of leaves_
  };
  static constexpr uint32_t not_known = 0, is_leaf = 1;
  /// Trees are found by cell modulo this; cells that share a slot replace each other.
  static constexpr int slots_per_axis = 16;
  static constexpr size_t max_nodes = size_t{1} << 17;
  struct Slot {
    CellIndex cell;
    uint32_t root = 0;
  };

  uint32_t root_of(CellIndex cell);
  /// Makes a node a leaf or gives it children.
  uint32_t grow(uint32_t index, const GradedSeeds::Node& node);
  LeafSeed leaf_seed(CellIndex home, uint32_t index, const GradedSeeds::Node& node) const;
  LeafSeed placed_seed(CellIndex home, const PlacedSeed& seed) const;
  /// The node of a cell's list of placed seeds.
  uint32_t list_of(CellIndex cell);
  template <class Wanted, class Found>
  void descend(CellIndex home, uint32_t index, const GradedSeeds::Node& node, Wanted& wanted,
               Found& found);
  template <class Wanted, class Found>
  void visit_list(CellIndex home, CellIndex cell, Wanted& wanted, Found& found);
  template <class Wanted, class Found>
  void descend_to_twigs(CellIndex home, uint32_t index, const GradedSeeds::Node& node,
                        Wanted& wanted, Found& found);
  /// Appends the leaves below a node.
  void append_leaves(uint32_t index, const GradedSeeds::Node& node);
  /// Appends the placed seeds of a list.
  void append_placed(uint32_t list);
  /// Makes a node a twig of the leaves from number `first` on.
  void add_twig(uint32_t index, size_t first);
  Twig twig_of(uint32_t index, CellIndex cell) const {
    const Range& range = twigs_[nodes_[index].twig - 1];
    return {cell, leaves_.data() + range.first, range.count};
  }
  /// The box of a node, rounded as the seeds are, so the seeds are inside.
  Box3 box_of(CellIndex home, const GradedSeeds::Node& node) const {
    const Vec3 scale = seeds_->scale();
    const Vec3 cell{double(node.cell.x - home.x), double(node.cell.y - home.y),
                    double(node.cell.z - home.z)};
    const double size = node.size();
    return {(cell + node.low) * scale, (cell + (node.low + Vec3{size, size, size})) * scale};
  }
  /// Calls visit(cell) for the cells that a box meets.
  template <class Visit>
  void for_each_cell(CellIndex home, const Box3& box, Visit&& visit) const;

  std::weak_ptr<const GradedSeeds> owner_;  // identifies the foam, but does not keep it alive
  const GradedSeeds* seeds_ = nullptr;
  std::vector<Node> nodes_;
  std::vector<Slot> slots_;
  std::vector<PlacedSeed> placed_;  // of one cell
  int twig_level_ = 0;              // nodes of this level are twigs, and leaves above it
  std::vector<Leaf> leaves_;
  std::vector<Range> twigs_;
};

/// The trees of the foams that were searched last, for point queries: the parts of a structure, and
/// the scales of a model, are asked in turn.
class SeedForest {
 public:
  /// Those of a foam. Valid until the next call.
  SeedTrees& of(const std::shared_ptr<const GradedSeeds>& seeds);

  size_t bytes() const;

 private:
  static constexpr size_t foams = 4;
  /// If all trees take more, the others are given up, so that the memory is kept (Borrowed).
  static constexpr size_t max_bytes = size_t{12} << 20;
  SeedTrees trees_[foams];
  uint64_t last_used_[foams] = {};
  uint64_t uses_ = 0;
};

/// Squared distances from q to the nearest and the farthest point of a box.
inline double min_squared(const Box3& box, Vec3 q) {
  const Vec3 d = max(max(box.min - q, q - box.max), Vec3{});
  return dot(d, d);
}
inline double max_squared(const Box3& box, Vec3 q) {
  const Vec3 d = max(box.max - q, q - box.min);
  return dot(d, d);
}

template <class Wanted, class Found>
void SeedTrees::descend(CellIndex home, uint32_t index, const GradedSeeds::Node& node,
                        Wanted& wanted, Found& found) {
  if (!wanted(box_of(home, node))) return;
  uint32_t children = nodes_[index].children;
  if (children == not_known) children = grow(index, node);
  if (children == is_leaf) return found(leaf_seed(home, index, node));
  for (uint32_t octant = 0; octant < 8; ++octant)
    descend(home, children + octant, node.child(octant), wanted, found);
}

template <class Wanted, class Found>
void SeedTrees::visit_list(CellIndex home, CellIndex cell, Wanted& wanted, Found& found) {
  const Vec3 scale = seeds_->scale();
  const Vec3 low{double(cell.x - home.x), double(cell.y - home.y), double(cell.z - home.z)};
  if (!wanted(Box3{low * scale, (low + Vec3{1, 1, 1}) * scale})) return;
  const uint32_t list = list_of(cell), count = nodes_[list].children;
  for (uint32_t i = 1; i < count; ++i) {
    const Node& node = nodes_[list + i];
    const LeafSeed seed = placed_seed(
        home, {cell, node.seed, node.children >> 8, static_cast<int>(node.children & 0xff)});
    if (wanted(Box3{seed.position, seed.position})) found(seed);
  }
}

template <class Wanted, class Found>
void SeedTrees::descend_to_twigs(CellIndex home, uint32_t index, const GradedSeeds::Node& node,
                                 Wanted& wanted, Found& found) {
  if (!wanted(box_of(home, node))) return;
  if (nodes_[index].twig == 0) {
    uint32_t children = nodes_[index].children;
    if (children == not_known) children = grow(index, node);
    if (children != is_leaf && node.level < twig_level_) {
      for (uint32_t octant = 0; octant < 8; ++octant)
        descend_to_twigs(home, children + octant, node.child(octant), wanted, found);
      return;
    }
    const size_t first = leaves_.size();
    append_leaves(index, node);
    add_twig(index, first);
  }
  found(twig_of(index, node.cell));
}

template <class Visit>
void SeedTrees::for_each_cell(CellIndex home, const Box3& box, Visit&& visit) const {
  const Vec3 scale = seeds_->scale();
  int first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = static_cast<int>(std::floor(box.min[axis] / scale[axis]));
    last[axis] = static_cast<int>(std::floor(box.max[axis] / scale[axis]));
  }
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x)
        visit(CellIndex{home.x + x, home.y + y, home.z + z});
}

template <class Wanted, class Found>
void SeedTrees::visit(CellIndex home, const Box3& box, Wanted&& wanted, Found&& found) {
  for_each_cell(home, box, [&](CellIndex cell) {
    if (seeds_->placed())
      visit_list(home, cell, wanted, found);
    else
      descend(home, root_of(cell), {cell}, wanted, found);
  });
}

template <class Wanted, class Found>
void SeedTrees::visit_twigs(CellIndex home, const Box3& box, Wanted&& wanted, Found&& found) {
  for_each_cell(home, box, [&](CellIndex cell) {
    if (!seeds_->placed()) return descend_to_twigs(home, root_of(cell), {cell}, wanted, found);
    if (!wanted(box_of(home, {cell}))) return;
    const uint32_t list = list_of(cell);
    if (nodes_[list].twig == 0) append_placed(list);
    found(twig_of(list, cell));
  });
}

template <class Found>
void SeedTrees::visit_cell(CellIndex home, CellIndex cell, Found&& found) {
  const auto all = [](const Box3&) { return true; };
  if (seeds_->placed()) return visit_list(home, cell, all, found);
  descend(home, root_of(cell), {cell}, all, found);
}

template <class Accept>
void SeedTrees::nearest(CellIndex home, Vec3 q, double& distance_squared, LeafSeed& seed,
                        Accept&& accept) {
  visit(
      home, Box3{q, q}.grown(std::sqrt(distance_squared) + 1e-9),
      [&](const Box3& box) { return min_squared(box, q) < distance_squared; },
      [&](const LeafSeed& found) {
        const Vec3 d = found.position - q;
        if (dot(d, d) < distance_squared && accept(found)) {
          distance_squared = dot(d, d);
          seed = found;
        }
      });
}

}  // namespace msq
