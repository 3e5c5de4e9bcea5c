// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/cell_struts.h"

#include <algorithm>

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
  used_bytes_ = chunk_bytes;
}

std::byte* CellStruts::room(size_t bytes) {
  if (used_bytes_ + bytes > chunk_bytes) {
    const size_t size = std::max(bytes, chunk_bytes);
    if (used_chunks_ == chunks_.size() || bytes > chunk_bytes)
      chunks_.insert(chunks_.begin() + static_cast<ptrdiff_t>(used_chunks_),
                     std::make_unique<std::byte[]>(size));
    ++used_chunks_;
    used_bytes_ = 0;
  }
  std::byte* const place = chunks_[used_chunks_ - 1].get() + used_bytes_;
  used_bytes_ += bytes;
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

/// Finds the bricks whose edges may come near a cell.
void CellStruts::find_bricks(CellIndex cell) {
  const int at[3] = {cell.x, cell.y, cell.z};
  int own[3], in_own[3], first[3], last[3];
  bool is_within_half = true;
  for (size_t axis = 0; axis < 3; ++axis) {
    const int place = at[axis] + SeededEdges::lead;
    own[axis] = floor_div(place, SeededEdges::side);
    in_own[axis] = place - own[axis] * SeededEdges::side;
    first[axis] = floor_div(place - reach_[axis], SeededEdges::side);
    last[axis] = floor_div(place + reach_[axis], SeededEdges::side);
    is_within_half &= reach_[axis] <= SeededEdges::side / 2;
  }
  if (is_within_half) {
    const SeededEdges& brick = *find_brick({own[0], own[1], own[2]}).edges;
    for (size_t axis = 0; axis < 3; ++axis)
      if (!brick.looks_beyond(in_own[0], in_own[1], in_own[2], axis))
        first[axis] = last[axis] = own[axis];
  }
  sources_.clear();
  for (int k = first[2]; k <= last[2]; ++k)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int i = first[0]; i <= last[0]; ++i) {
        const Recent& brick = find_brick({i, j, k});
        const CellIndex corner = brick.edges->corner();
        const auto edges =
            brick.edges->list(cell.x - corner.x, cell.y - corner.y, cell.z - corner.z);
        if (!edges.empty()) sources_.push_back({brick.edges, edges, brick.number << 16});
      }
}

CapsuleView CellStruts::make_list(CellIndex cell) {
  find_bricks(cell);
  size_t count = 0;
  for (const Source& source : sources_) count += source.edges.size();
  std::byte* const place = room((7 * count + capsule_padding) * sizeof(float));
  auto* const values = reinterpret_cast<float*>(place);
  auto* const ids = reinterpret_cast<uint32_t*>(place + 6 * count * sizeof(float));
  const Vec3 scale = foam_->seeds().scale();
  size_t i = 0;
  for (const Source& source : sources_) {
    const SeededEdges& brick = *source.brick;
    const CellIndex corner = brick.corner();
    const float x = static_cast<float>((cell.x - corner.x) * scale.x);
    const float y = static_cast<float>((cell.y - corner.y) * scale.y);
    const float z = static_cast<float>((cell.z - corner.z) * scale.z);
    for (const uint16_t edge : source.edges) {
      const auto &a = brick.end(edge, 0), &b = brick.end(edge, 1);
      float* const value = values + i;
      value[0] = a[0] - x;
      value[count] = a[1] - y;
      value[2 * count] = a[2] - z;
      value[3 * count] = b[0] - a[0];
      value[4 * count] = b[1] - a[1];
      value[5 * count] = b[2] - a[2];
      ids[i++] = source.first_id | edge;
    }
  }
  CapsuleView view;
  for (size_t axis = 0; axis < 3; ++axis) {
    view.a[axis] = values + axis * count;
    view.ab[axis] = values + (axis + 3) * count;
  }
  view.ids = ids;
  view.count = count;
  return view;
}

}  // namespace msq
