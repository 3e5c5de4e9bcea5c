// SPDX-License-Identifier: Apache-2.0
// Source: paper, section "Structured and Unstructured Set Queries": points are grouped by cell, so
// that the data of a cell, here the seeds around it, is computed once for all its points.
#include "structure/foam/sets/point_set.h"

#include <algorithm>
#include <vector>

#include "base/borrowed.h"
#include "structure/foam/sets/locate_points.h"
#include "structure/foam/sets/point_batch.h"

namespace msq {

namespace {

/// For boxes of at most this many cells, points are sorted by counting, cell by cell.
constexpr size_t max_counted_cells = 32768;

struct Workspace {
  LocatedPoints located;
  std::vector<uint32_t> order, start;

  size_t bytes() const { return located.bytes() + order.capacity() * sizeof(uint32_t); }
};

/// Fills workspace.order with the points alive; points of one cell are adjacent.
void order_by_cell(Workspace& w, const uint8_t* alive, size_t count, CellIndex low,
                   const int64_t (&size)[3]) {
  const auto& cell = w.located.cell;
  const double cells =
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(size[2]);
  if (cells > double(max_counted_cells)) {
    for (uint32_t i = 0; i < count; ++i)
      if (alive[i]) w.order.push_back(i);
    std::sort(w.order.begin(), w.order.end(), [&](uint32_t a, uint32_t b) {
      for (int axis : {2, 1, 0})
        if (cell[axis][a] != cell[axis][b]) return cell[axis][a] < cell[axis][b];
      return a < b;
    });
    return;
  }
  const auto number = [&](size_t i) {
    return static_cast<size_t>(
        ((int64_t{cell[2][i]} - low.z) * size[1] + (int64_t{cell[1][i]} - low.y)) * size[0] +
        (int64_t{cell[0][i]} - low.x));
  };
  w.start.assign(static_cast<size_t>(cells) + 1, 0);
  for (size_t i = 0; i < count; ++i)
    if (alive[i]) ++w.start[number(i) + 1];
  for (size_t c = 1; c < w.start.size(); ++c) w.start[c] += w.start[c - 1];
  w.order.resize(w.start.back());
  for (uint32_t i = 0; i < count; ++i)
    if (alive[i]) w.order[w.start[number(i)]++] = i;
}

}  // namespace

void foam_keep_points_by_point(const FoamData& foam, const Vec3* points, uint8_t* alive,
                               size_t count) {
  const Borrowed<Workspace> workspace;
  Workspace& w = *workspace;
  const FoamSeeds& seeds = foam.seeds();
  w.located.locate(foam.neighbourhood(), seeds.scale(), points, count);
  const auto& cell = w.located.cell;
  const auto& place = w.located.place;

  int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
  size_t living = 0;
  for (size_t i = 0; i < count; ++i) {
    if (!alive[i]) continue;
    ++living;
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], cell[axis][i]);
      high[axis] = std::max(high[axis], cell[axis][i]);
    }
  }
  if (living == 0) return;
  const CellIndex corner{low[0], low[1], low[2]};
  int64_t wide[3];
  for (int axis = 0; axis < 3; ++axis) wide[axis] = int64_t{high[axis]} - low[axis] + 1;
  w.order.clear();
  order_by_cell(w, alive, count, corner, wide);

  const double max_radius = foam.max_radius();
  PointBatch batch(seeds, max_radius);
  batch.answer_to(alive);
  int size[3];
  for (int axis = 0; axis < 3; ++axis) size[axis] = static_cast<int>(wide[axis]);
  const bool is_dense =
      batch.seeds_about(size) <= PointBatch::max_seeds_a_point * static_cast<double>(living);
  if (is_dense) batch.move_to(corner, size);
  const bool is_constant = foam.radius().is_constant();
  for (size_t first = 0; first < living;) {
    const uint32_t one = w.order[first];
    const CellIndex home{cell[0][one], cell[1][one], cell[2][one]};
    if (!is_dense) batch.move_to(home, {1, 1, 1}, true);
    for (; first < living; ++first) {
      const uint32_t i = w.order[first];
      if (!(CellIndex{cell[0][i], cell[1][i], cell[2][i]} == home)) break;
      if (batch.is_full()) batch.ask(home);
      const double radius = is_constant ? max_radius : foam.radius().at(points[i]) / foam.unit();
      batch.add({place[0][i], place[1][i], place[2][i]}, radius, i);
    }
    batch.ask(home);
  }
  batch.finish();
}

}  // namespace msq
