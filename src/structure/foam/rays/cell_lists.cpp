// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/rays/cell_lists.h"

#include <algorithm>
#include <bit>

namespace msq {

namespace {

/// Reading a vector across two cache lines just after it was written takes several times as long.
size_t whole_vectors(size_t floats) {
  constexpr size_t lanes = 16;
  return (floats + lanes - 1) / lanes * lanes;
}

size_t slot_of(CellIndex c) {
  return static_cast<size_t>((c.x & 3) | (c.y & 3) << 2 | (c.z & 3) << 4);
}

}  // namespace

void CellLists::move_to(const FoamData& foam) {
  forget();
  foam_ = &foam;
  radius_ = foam.max_radius();
  reach_ = RayBrick::reach(foam.seeds(), radius_);
}

void CellLists::forget() {
  ++era_;
  bricks_.clear();
  brick_numbers_.clear();
  list_count_ = 0;
  std::fill(std::begin(recent_), std::end(recent_), Recent{});
  used_chunks_ = 0;
  used_floats_ = chunk_floats;
}

float* CellLists::room(size_t floats) {
  if (used_floats_ + floats > chunk_floats) {
    const size_t size = std::max(floats, chunk_floats);
    if (used_chunks_ == chunks_.size() || floats > chunk_floats)
      chunks_.insert(chunks_.begin() + static_cast<ptrdiff_t>(used_chunks_),
                     allocate_aligned(size));
    ++used_chunks_;
    used_floats_ = 0;
  }
  float* const place = chunks_[used_chunks_ - 1].get() + used_floats_;
  used_floats_ += floats;
  return place;
}

const CellLists::Recent& CellLists::find_brick(CellIndex brick) {
  Recent& recent = recent_[slot_of(brick)];
  if (recent.edges && recent.brick == brick) return recent;
  uint32_t number;
  if (const auto found = brick_numbers_.find(brick); found != brick_numbers_.end()) {
    number = found->second;
  } else {
    const CellIndex corner{brick.x * RayBrick::side - RayBrick::lead,
                           brick.y * RayBrick::side - RayBrick::lead,
                           brick.z * RayBrick::side - RayBrick::lead};
    auto data = foam_->context().cache.fetch(foam_->ray_bricks_id(), corner, [&] {
      return std::make_shared<const RayBrick>(foam_->seeds(), corner, radius_);
    });
    number = static_cast<uint32_t>(bricks_.size());
    bricks_.push_back(std::static_pointer_cast<const RayBrick>(std::move(data)));
    bricks_.back()->prefetch();
    brick_numbers_.emplace(brick, number);
  }
  return recent = {brick, bricks_[number].get(), number};
}

CellLists::List& CellLists::find_list(CellIndex cell) {
  const size_t mask = lists_.size() - 1;
  size_t place = CellHash()(cell) & mask;
  while (lists_[place].era == era_ && !(lists_[place].cell == cell)) place = (place + 1) & mask;
  return lists_[place];
}

CapsuleView CellLists::list(CellIndex cell) {
  if (2 * list_count_ >= lists_.size()) {
    std::vector<List> old(std::max<size_t>(1024, 2 * lists_.size()));
    old.swap(lists_);
    for (const List& list : old)
      if (list.era == era_) find_list(list.cell) = list;
  }
  List& list = find_list(cell);
  if (list.era != era_) {
    list.cell = cell;
    make_list(list);
    list.era = era_;
    ++list_count_;
  }
  const size_t stride = whole_vectors(list.count);
  CapsuleView view;
  for (size_t axis = 0; axis < 3; ++axis) {
    view.a[axis] = list.values + axis * stride;
    view.ab[axis] = list.values + (axis + 3) * stride;
  }
  view.ids = reinterpret_cast<const uint32_t*>(list.values + 6 * stride);
  view.count = list.count;
  return view;
}

/// Finds the bricks whose edges may come near a cell.
void CellLists::find_bricks(CellIndex cell) {
  const int at[3] = {cell.x, cell.y, cell.z};
  int own[3], in_own[3];
  bool is_within_half = true;
  for (size_t axis = 0; axis < 3; ++axis) {
    own[axis] = RayBrick::brick_of(at[axis]);
    in_own[axis] = at[axis] + RayBrick::lead - own[axis] * RayBrick::side;
    is_within_half &= reach_[axis] <= RayBrick::side / 2;
  }
  sources_.clear();
  const auto add = [&](int i, int j, int k) {
    const Recent& brick = find_brick({i, j, k});
    const CellIndex corner = brick.edges->corner();
    const auto edges = brick.edges->list(cell.x - corner.x, cell.y - corner.y, cell.z - corner.z);
    if (!edges.empty()) sources_.push_back({brick.edges, edges, brick.number << 16});
  };
  if (is_within_half) {
    const RayBrick& brick = *find_brick({own[0], own[1], own[2]}).edges;
    // Along each axis, the neighbour that is nearer to the cell.
    int beside[3];
    for (size_t axis = 0; axis < 3; ++axis)
      beside[axis] = own[axis] + (2 * in_own[axis] < RayBrick::side ? -1 : 1);
    for (unsigned rest = brick.owning(foam_->seeds(), radius_, in_own[0], in_own[1], in_own[2]);
         rest; rest &= rest - 1) {
      const auto across = static_cast<unsigned>(std::countr_zero(rest));
      add(across & 1 ? beside[0] : own[0], across & 2 ? beside[1] : own[1],
          across & 4 ? beside[2] : own[2]);
    }
    return;
  }
  int first[3], last[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    first[axis] = RayBrick::brick_of(at[axis] - reach_[axis]);
    last[axis] = RayBrick::brick_of(at[axis] + reach_[axis]);
  }
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) add(i, j, k);
}

void CellLists::make_list(List& list) {
  const CellIndex cell = list.cell;
  check_cancelled();
  find_bricks(cell);
  size_t count = 0;
  for (const Source& source : sources_) count += source.edges.size();
  const size_t stride = whole_vectors(count);
  float* const values = room(7 * stride);
  auto* const ids = reinterpret_cast<uint32_t*>(values + 6 * stride);
  const Vec3 scale = foam_->seeds().scale();
  size_t i = 0;
  for (const Source& source : sources_) {
    const RayBrick& brick = *source.brick;
    const CellIndex middle = brick.middle();
    const float x = static_cast<float>((cell.x - middle.x) * scale.x);
    const float y = static_cast<float>((cell.y - middle.y) * scale.y);
    const float z = static_cast<float>((cell.z - middle.z) * scale.z);
    for (const uint16_t edge : source.edges) {
      const auto &a = brick.end(edge, 0), &b = brick.end(edge, 1);
      float* const value = values + i;
      value[0] = a[0] - x;
      value[stride] = a[1] - y;
      value[2 * stride] = a[2] - z;
      value[3 * stride] = b[0] - a[0];
      value[4 * stride] = b[1] - a[1];
      value[5 * stride] = b[2] - a[2];
      ids[i++] = source.first_id | edge;
    }
  }
  list.count = static_cast<uint32_t>(count);
  list.values = values;
}

}  // namespace msq
