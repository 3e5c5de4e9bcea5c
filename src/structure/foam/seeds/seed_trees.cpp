// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/seeds/seed_trees.h"

#include <algorithm>

#include "base/job.h"

namespace msq {

void SeedTrees::move_to(const std::shared_ptr<const GradedSeeds>& seeds) {
  if (has(seeds) && nodes_.size() < max_nodes) return;
  owner_.reset();  // until everything is set
  // Nodes 0 and 1 are not used: they would look like the marks of Node::children.
  nodes_.assign(2, {});
  slots_.assign(slots_per_axis * slots_per_axis * slots_per_axis, {});
  leaves_.clear();
  twigs_.clear();
  twig_level_ = seeds->placed() ? 0 : seeds->twig_level();
  owner_ = seeds;
  seeds_ = seeds.get();
}

uint32_t SeedTrees::root_of(CellIndex cell) {
  constexpr uint32_t mask = slots_per_axis - 1;
  const auto part = [](int32_t i) { return static_cast<uint32_t>(i) & mask; };
  Slot& slot =
      slots_[(part(cell.z) * slots_per_axis + part(cell.y)) * slots_per_axis + part(cell.x)];
  if (slot.root == 0 || !(slot.cell == cell)) {
    slot = {cell, static_cast<uint32_t>(nodes_.size())};
    nodes_.emplace_back();
  }
  return slot.root;
}

uint32_t SeedTrees::grow(uint32_t index, const GradedSeeds::Node& node) {
  uint32_t children = is_leaf;
  check_cancelled();
  if (seeds_->splits(node)) {
    children = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 8);
  } else {
    nodes_[index].seed = seeds_->in_leaf(node);
  }
  nodes_[index].children = children;
  return children;
}

void SeedTrees::append_leaves(uint32_t index, const GradedSeeds::Node& node) {
  uint32_t children = nodes_[index].children;
  if (children == not_known) children = grow(index, node);
  if (children == is_leaf) return leaves_.push_back({nodes_[index].seed, node.order(), node.level});
  for (uint32_t octant = 0; octant < 8; ++octant)
    append_leaves(children + octant, node.child(octant));
}

void SeedTrees::append_placed(uint32_t list) {
  const size_t first = leaves_.size();
  for (uint32_t i = 1; i < nodes_[list].children; ++i) {
    const Node& node = nodes_[list + i];
    leaves_.push_back({node.seed, node.children >> 8, static_cast<int>(node.children & 0xff)});
  }
  add_twig(list, first);
}

void SeedTrees::add_twig(uint32_t index, size_t first) {
  twigs_.push_back({static_cast<uint32_t>(first), static_cast<uint32_t>(leaves_.size() - first)});
  nodes_[index].twig = static_cast<uint32_t>(twigs_.size());
}

namespace {

/// `order`: within the cell.
LeafSeed seed_in_cell(CellIndex home, CellIndex cell, Vec3 in_cell, Vec3 scale, int level,
                      uint32_t order) {
  const int32_t x = cell.x - home.x, y = cell.y - home.y, z = cell.z - home.z;
  return {Vec3{x + in_cell.x, y + in_cell.y, z + in_cell.z} * scale, level,
          SeedTrees::order_of(home, cell, order)};
}

}  // namespace

LeafSeed SeedTrees::leaf_seed(CellIndex home, uint32_t index, const GradedSeeds::Node& node) const {
  return seed_in_cell(home, node.cell, nodes_[index].seed, seeds_->scale(), node.level,
                      node.order());
}

LeafSeed SeedTrees::placed_seed(CellIndex home, const PlacedSeed& seed) const {
  return seed_in_cell(home, seed.box, seed.in_box, seeds_->scale(), seed.level, seed.number);
}

uint32_t SeedTrees::list_of(CellIndex cell) {
  const uint32_t list = root_of(cell);
  if (nodes_[list].children != not_known) return list;
  check_cancelled();
  placed_.clear();
  seeds_->placed()->find(cell, placed_);
  nodes_.resize(nodes_.size() + placed_.size());
  for (size_t i = 0; i < placed_.size(); ++i)
    nodes_[list + 1 + i] = {placed_[i].in_box,
                            placed_[i].number << 8 | static_cast<uint32_t>(placed_[i].level), 0};
  nodes_[list].children = static_cast<uint32_t>(placed_.size()) + 1;
  return list;
}

LeafSeed SeedTrees::at(CellIndex home, Vec3 q) {
  const Vec3 scale = seeds_->scale();
  if (const PlacedSeeds* const placed = seeds_->placed()) {
    const Vec3 boxes{home.x + q.x / scale.x, home.y + q.y / scale.y, home.z + q.z / scale.z};
    return placed_seed(home, placed->near(boxes * placed->grid().cell_size));
  }
  uint32_t index = root_of(home);
  GradedSeeds::Node node{home};
  for (;;) {
    uint32_t children = nodes_[index].children;
    if (children == not_known) children = grow(index, node);
    if (children == is_leaf) return leaf_seed(home, index, node);
    const double half = 0.5 * node.size();
    uint32_t octant = 0;
    for (int axis = 0; axis < 3; ++axis)
      if (q[axis] >= (node.low[axis] + half) * scale[axis]) octant |= 1u << axis;
    index = children + octant;
    node = node.child(octant);
  }
}

SeedTrees& SeedForest::of(const std::shared_ptr<const GradedSeeds>& seeds) {
  size_t n = 0;
  while (n < foams && !trees_[n].has(seeds)) ++n;
  if (n == foams) {
    n = static_cast<size_t>(std::min_element(last_used_, last_used_ + foams) - last_used_);
    if (bytes() > max_bytes)
      for (SeedTrees& trees : trees_) trees = {};
  }
  last_used_[n] = ++uses_;
  trees_[n].move_to(seeds);
  return trees_[n];
}

size_t SeedForest::bytes() const {
  size_t sum = 0;
  for (const SeedTrees& trees : trees_) sum += trees.bytes();
  return sum;
}

}  // namespace msq
