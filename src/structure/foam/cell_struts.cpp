// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/cell_struts.h"

#include <algorithm>
#include <cstring>

namespace msq {

namespace {

int floor_div(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

size_t slot_of(CellIndex c) {
  return static_cast<size_t>((c.x & 3) | (c.y & 3) << 2 | (c.z & 3) << 4);
}

}  // namespace

void CellStruts::move_to(const Foam& foam) {
  forget();
  foam_ = &foam;
  radius_ = foam.most_radius();
  reach_ = SeededEdges::reach(foam.seeds(), radius_);
}

void CellStruts::forget() {
  ++era_;
  bricks_.clear();
  brick_numbers_.clear();
  lists_.clear();
  std::fill(std::begin(recent_), std::end(recent_), Recent{});
  std::fill(std::begin(recent_lists_), std::end(recent_lists_), RecentList{});
  used_chunks_ = 0;
  used_floats_ = chunk_floats;
}

float* CellStruts::room(size_t floats) {
  if (used_floats_ + floats > chunk_floats) {
    const size_t size = std::max(floats, chunk_floats);
    if (used_chunks_ == chunks_.size() || floats > chunk_floats)
      chunks_.insert(chunks_.begin() + static_cast<ptrdiff_t>(used_chunks_),
                     std::make_unique<float[]>(size));
    ++used_chunks_;
    used_floats_ = 0;
  }
  float* const place = chunks_[used_chunks_ - 1].get() + used_floats_;
  used_floats_ += floats;
  return place;
}

const CellStruts::Recent& CellStruts::find_brick(CellIndex brick) {
  Recent& recent = recent_[slot_of(brick)];
  if (recent.edges && recent.brick == brick) return recent;
  uint32_t number;
  if (const auto found = brick_numbers_.find(brick); found != brick_numbers_.end()) {
    number = found->second;
  } else {
    const CellIndex corner{brick.x * SeededEdges::side - SeededEdges::lead,
                           brick.y * SeededEdges::side - SeededEdges::lead,
                           brick.z * SeededEdges::side - SeededEdges::lead};
    auto data = foam_->context().cache.fetch(foam_->seeded_edges_id(), corner, [&] {
      return std::make_shared<const SeededEdges>(foam_->seeds(), corner, radius_);
    });
    number = static_cast<uint32_t>(bricks_.size());
    bricks_.push_back(std::static_pointer_cast<const SeededEdges>(std::move(data)));
    brick_numbers_.emplace(brick, number);
  }
  return recent = {brick, bricks_[number].get(), number};
}

const CapsuleView& CellStruts::list(CellIndex cell) {
  RecentList& recent = recent_lists_[slot_of(cell)];
  if (recent.list && recent.cell == cell) return *recent.list;
  auto found = lists_.find(cell);
  if (found == lists_.end()) found = lists_.emplace(cell, make_list(cell)).first;
  recent = {cell, &found->second};  // elements of the map stay in place
  return found->second;
}

CapsuleView CellStruts::make_list(CellIndex cell) {
  const int at[3] = {cell.x, cell.y, cell.z};
  int first[3], last[3];
  for (size_t axis = 0; axis < 3; ++axis) {
    const int place = at[axis] + SeededEdges::lead;
    first[axis] = floor_div(place - reach_[axis], SeededEdges::side);
    last[axis] = floor_div(place + reach_[axis], SeededEdges::side);
  }
  ids_.clear();
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const Recent& brick = find_brick({i, j, k});
        const CellIndex corner = brick.edges->corner();
        for (const uint16_t edge :
             brick.edges->list(cell.x - corner.x, cell.y - corner.y, cell.z - corner.z))
          ids_.push_back(brick.number << 16 | edge);
      }
  const size_t count = ids_.size();
  float* const values = room(7 * count + capsule_padding);
  const Vec3 scale = foam_->seeds().scale();
  uint32_t number = UINT32_MAX;
  const SeededEdges* brick = nullptr;
  float shift[3] = {};
  for (size_t i = 0; i < count; ++i) {
    if (ids_[i] >> 16 != number) {
      number = ids_[i] >> 16;
      brick = bricks_[number].get();
      const CellIndex corner = brick->corner();
      shift[0] = static_cast<float>((cell.x - corner.x) * scale.x);
      shift[1] = static_cast<float>((cell.y - corner.y) * scale.y);
      shift[2] = static_cast<float>((cell.z - corner.z) * scale.z);
    }
    const auto &a = brick->end(ids_[i] & 0xffff, 0), &b = brick->end(ids_[i] & 0xffff, 1);
    for (size_t axis = 0; axis < 3; ++axis) {
      values[axis * count + i] = a[axis] - shift[axis];
      values[(axis + 3) * count + i] = b[axis] - a[axis];
    }
  }
  CapsuleView view;
  for (size_t axis = 0; axis < 3; ++axis) {
    view.a[axis] = values + axis * count;
    view.ab[axis] = values + (axis + 3) * count;
  }
  std::memcpy(values + 6 * count, ids_.data(), count * sizeof(uint32_t));
  view.ids = reinterpret_cast<const uint32_t*>(values + 6 * count);
  view.count = count;
  return view;
}

}  // namespace msq
