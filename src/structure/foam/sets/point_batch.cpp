// SPDX-License-Identifier: Apache-2.0
// A point needs the seeds within needed = d0 + 2 r + near_slack of it, d0 being the distance to the
// nearest (point.cpp). They are first searched in single precision, in a block of cells around the
// point's, with a slack for the error: too many seeds may be found, none is missed. If fewer than
// three are found, the point is outside. The definition decides the others, in double precision:
// points with few seeds in vectors of points, the rest one by one. A point that needs seeds beyond
// the block uses a second, larger block, and then foam_point_inside().
//
// The error in single precision, u = 2^-24 per rounding, all coordinates at most B. A seed has
// three roundings (its sum with its cell's number, the cell's size, their product), the point one,
// their difference one of at most 2 B: 6 u B along each axis, 10.4 u B in distance. The squares and
// their sum round by 4 u of the squared distance, thus 2 u of a distance of at most 3.5 B: 7 u B.
// Together the error of a distance is below 18 u B; `slack` is 32 u B. needed is a distance plus 2
// r, and is compared with a distance. That gives two errors, and the few roundings of the sum and
// its square, each below u of 3.5 B + 2 r. Three times the slack covers them, r being at most a
// cell.
#include "structure/foam/sets/point_batch.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "structure/foam/point/point.h"

namespace msq {

namespace {

/// Determines the blocks' size: a point with this distance to the nearest seed, at the border of
/// the cell, finds its seeds in the first block.
constexpr double usual_distance = 0.6;

}  // namespace

PointBatch::PointBatch(const FoamSeeds& seeds, double max_radius) : seeds_(seeds) {
  const int step = std::max(0, static_cast<int>(std::ceil(usual_distance + 2 * max_radius)) - 1);
  plan(first_, step);
  plan(second_, step + 1);
  has_first_ = first_.seeds <= max_block_seeds;
  has_second_ = second_.seeds <= max_block_seeds;
  masks_.resize(capacity * (has_second_ ? second_ : first_).mask_words);
}

void PointBatch::plan(Block& block, int step) const {
  const Vec3 scale = seeds_.scale();
  double most = 0;
  block.seeds = 1;
  for (int axis = 0; axis < 3; ++axis) {
    block.half[axis] = static_cast<int>(std::ceil((step + 1) / scale[axis]));
    block.seeds *= static_cast<size_t>(2 * block.half[axis] + 1);
    most = std::max(most, (block.half[axis] + 1) * scale[axis]);
  }
  block.slack = static_cast<float>(0x1p-19 * most);
  block.mask_words = (block.seeds + 63) / 64;
  if (block.seeds > max_block_seeds) return;
  for (int dz = -block.half[2]; dz <= block.half[2]; ++dz)
    for (int dy = -block.half[1]; dy <= block.half[1]; ++dy)
      for (int dx = -block.half[0]; dx <= block.half[0]; ++dx)
        block.cell.push_back({double(dx), double(dy), double(dz)});
  block.offset.resize(block.seeds);
  for (std::vector<float>* v : {&block.x, &block.y, &block.z})
    v->resize(block.seeds + block_padding);
}

void PointBatch::move_to(CellIndex low, const int (&size)[3], bool is_sparse) {
  if (!has_first_) return;
  const bool is_wide = has_second_ && !is_sparse;
  tile_.build(seeds_, low, size, (is_wide ? second_ : first_).half);
  for (Block* block : {&first_, &second_}) {
    const bool is_used = block == &first_ || is_wide;
    if (!is_used) continue;
    for (size_t s = 0; s < block->seeds; ++s) {
      const Vec3 cell = block->cell[s];
      block->offset[s] = tile_.offset(int(cell.x), int(cell.y), int(cell.z));
    }
  }
  is_wide_ = is_wide;
}

void PointBatch::ask(CellIndex cell) {
  if (count_ == 0) return;
  for (size_t i = 0; i < count_; ++i) inside_[index_[i]] = 0;
  size_t left = count_;
  if (has_first_) left = ask(first_, cell, left);
  if (left > 0 && is_wide_) left = ask(second_, cell, left);
  for (size_t i = 0; i < left; ++i)
    inside_[index_[i]] = foam_point_inside(seeds_, cell, {x_[i], y_[i], z_[i]}, radius_[i]);
  count_ = 0;
}

size_t PointBatch::ask(Block& block, CellIndex cell, size_t count) {
  const Vec3 scale = seeds_.scale();
  const size_t home = tile_.index(cell), words = block.mask_words;
  fill_block(tile_, home, block.half, scale, block.x.data(), block.y.data(), block.z.data());
  const Vec3 half{double(block.half[0]), double(block.half[1]), double(block.half[2])};
  uint16_t near[capacity];
  find_near_seeds({block.x.data(), block.y.data(), block.z.data(), block.seeds, words, half * scale,
                   block.slack},
                  scale, {x_, y_, z_, radius_, count}, near, masks_.data());

  // Which points have three seeds is unpredictable: listed without a branch.
  uint8_t chosen[capacity], beyond[capacity];
  size_t chosen_count = 0, beyond_count = 0;
  for (size_t i = 0; i < count; ++i) {
    chosen[chosen_count] = beyond[beyond_count] = static_cast<uint8_t>(i);
    chosen_count += near[i] >= 3 && near[i] != beyond_block;
    beyond_count += near[i] == beyond_block;
  }
  for (size_t n = 0; n < chosen_count; ++n) {
    const size_t i = chosen[n];
    push(block, home, i, masks_.data() + i * words, near[i]);
  }
  for (size_t n = 0; n < beyond_count; ++n) {
    const size_t i = beyond[n];
    x_[n] = x_[i];
    y_[n] = y_[i];
    z_[n] = z_[i];
    radius_[n] = radius_[i];
    index_[n] = index_[i];
  }
  return beyond_count;
}

void PointBatch::push(const Block& block, size_t home, size_t point, const uint64_t* mask,
                      size_t count) {
  const Vec3 scale = seeds_.scale();
  const float *fx = tile_.fraction(0) + home, *fy = tile_.fraction(1) + home,
              *fz = tile_.fraction(2) + home;
  // FoamSeeds::in_row, to the last bit.
  const auto position = [&](size_t s) {
    const ptrdiff_t at = block.offset[s];
    return (block.cell[s] + Vec3{fx[at], fy[at], fz[at]}) * scale;
  };
  const auto for_each_seed = [&](auto&& visit) {
    for (size_t w = 0; w < block.mask_words; ++w)
      for (uint64_t rest = mask[w]; rest; rest &= rest - 1)
        visit(position(w * 64 + static_cast<size_t>(std::countr_zero(rest))));
  };
  const Vec3 q{x_[point], y_[point], z_[point]};
  const double radius = radius_[point];
  if (count <= TripleBatch::max_seeds) {
    TripleBatch& batch = triples_[count - 3];
    const size_t slot = batch.count++;
    size_t i = 0;
    for_each_seed([&](Vec3 seed) {
      for (int axis = 0; axis < 3; ++axis) batch.seed[i][axis][slot] = seed[axis];
      ++i;
    });
    for (int axis = 0; axis < 3; ++axis) batch.point[axis][slot] = q[axis];
    batch.radius[slot] = radius;
    batch.index[slot] = index_[point];
    if (batch.count == TripleBatch::capacity) decide(count);
    return;
  }
  candidates_.clear();
  distance_squared_.clear();
  double least = 1e300;
  for_each_seed([&](Vec3 seed) {
    const Vec3 d = seed - q;
    candidates_.push_back(seed);
    distance_squared_.push_back(dot(d, d));
    least = std::min(least, distance_squared_.back());
  });
  const double needed = std::sqrt(least) + 2 * radius + near_slack;
  near_.clear();
  for (size_t i = 0; i < candidates_.size(); ++i)
    if (distance_squared_[i] <= needed * needed) near_.push_back(candidates_[i]);
  inside_[index_[point]] = foam_point_inside(near_, q, radius);
}

void PointBatch::decide(size_t seeds) {
  TripleBatch& batch = triples_[seeds - 3];
  uint8_t held[TripleBatch::capacity];
  decide_triples(batch, seeds, held);
  for (size_t i = 0; i < batch.count; ++i) inside_[batch.index[i]] = held[i];
  batch.count = 0;
}

void PointBatch::finish() {
  for (size_t seeds = 3; seeds <= TripleBatch::max_seeds; ++seeds)
    if (triples_[seeds - 3].count > 0) decide(seeds);
}

}  // namespace msq
