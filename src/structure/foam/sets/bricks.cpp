// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/sets/bricks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/borrowed.h"
#include "structure/common/grid_boxes.h"

namespace msq {

namespace {

/// Calls visit(corner, part) for each brick that may have edges that touch a box where the foam is
/// needed. part: the part of the box that they may touch, in grid coordinates.
template <class Visit>
void for_each_corner(const FoamData& foam, const Box3& box, Visit&& visit) {
  const FoamGraph& graph = foam.graph();
  const FoamGraph::BrickLayout layout = graph.brick_layout();
  for_each_brick_near(foam.neighbourhood(), box, foam.owner_distance(), foam.owner_reach(),
                      layout.side, layout.lead, [&](CellIndex corner, const Box3& part) {
                        if (foam.graded() && !foam.graded()->is_needed(corner)) return;
                        if (graph.may_own_edges(corner, part)) visit(corner, part);
                      });
}

/// Without jitter, all seeds are at the centres of their cells, so one brick serves for all. It
/// takes many times as long to build as others, since its seeds are on common spheres.
bool has_equal_bricks(const FoamData& foam) {
  return !foam.graded() && !foam.is_weighted() && foam.seeds().jitter() == 0;
}

/// The cell of the cache that holds a brick.
CellIndex cell_of_brick(const FoamData& foam, CellIndex corner) {
  return has_equal_bricks(foam) ? CellIndex{} : corner;
}

/// The seeds of a brick that may own edges that touch a box (grid coordinates), as far as the
/// grid's axis `axis` tells.
Owners owners_near(const FoamData& foam, CellIndex corner, const Box3& box, int axis) {
  const double size = foam.neighbourhood().cell_size[axis];
  const double first = axis == 0 ? corner.x : axis == 1 ? corner.y : corner.z;
  const double around = foam.owner_distance() + foam.owner_reach()[axis];
  const auto cell = [&](double g) {
    return static_cast<int>(std::clamp(std::floor(g / size) - first, 0.0, EdgeBrick::side - 1.0));
  };
  Owners owners = Owners::all(EdgeBrick::side);
  owners.low[axis] = cell(box.min[axis] - around);
  owners.high[axis] = cell(box.max[axis] + around) + 1;
  return owners;
}

CellCache::Data fetch_brick(const FoamData& foam, CellIndex corner) {
  return foam.context().cache.fetch(foam.id(), cell_of_brick(foam, corner),
                                    [&] { return foam.graph().make_brick(corner); });
}

/// The brick, or a part of it that has the edges that touch the box. Tiles of a layer share parts.
CellCache::Data fetch_brick_of_layer(const FoamData& foam, CellIndex corner, const Box3& box,
                                     int across) {
  // Deeper parts take about as long as the brick.
  constexpr int max_depth = EdgeBrick::side - 2;
  CellCache& cache = foam.context().cache;
  const Owners owners = owners_near(foam, corner, box, across);
  if (owners.high[across] - owners.low[across] > max_depth || cache.keeps(foam.id(), corner))
    return fetch_brick(foam, corner);
  CellCache::Data part = cache.fetch(foam.brick_parts_id(), corner,
                                     [&] { return foam.graph().make_part(corner, owners); });
  return static_cast<const EdgeBrick&>(*part).holds(owners) ? part : fetch_brick(foam, corner);
}

}  // namespace

void for_each_brick(const FoamData& foam, const Box3& box, bool is_layer, const Job* job,
                    const std::function<void(const BrickPart&)>& visit) {
  const Neighbourhood& grid = foam.neighbourhood();
  const FoamGraph& graph = foam.graph();
  const double unit = foam.unit();
  const bool are_equal = has_equal_bricks(foam);
  int across = -1;  // the axis of the grid across the layer; -1: all of each brick
  if (is_layer && graph.has_parts()) {
    const std::array<int, 3> axes = grid.sample_axes();
    for (int axis = 0; axis < 3; ++axis)
      if (axes[static_cast<size_t>(axis)] == 2) across = axis;
  }
  CellCache::Data data;
  for_each_corner(foam, box, [&](CellIndex corner, const Box3& near) {
    check_cancelled(job);
    if (!are_equal) data.reset();
    const bool is_new = !data;
    if (is_new)
      data =
          across < 0 ? fetch_brick(foam, corner) : fetch_brick_of_layer(foam, corner, near, across);
    const auto& brick = static_cast<const EdgeBrick&>(*data);
    if (is_new) brick.segments().prefetch();
    const Vec3 origin =
        Vec3{double(corner.x), double(corner.y), double(corner.z)} * grid.cell_size +
        brick.origin() * unit;
    const Box3 from_brick{(near.min - origin) * (1 / unit), (near.max - origin) * (1 / unit)};
    SegmentFrame frame{grid.from_grid(origin), grid.rotation.m};
    for (double& m : frame.matrix) m *= unit;
    visit(BrickPart{brick, frame, from_brick.grown(graph.brick_error())});
  });
}

double kept_share_of_bricks(const FoamData& foam, const Box3& box) {
  const CellCache& cache = foam.context().cache;
  uint64_t bricks = 0, kept = 0;
  for_each_corner(foam, box, [&](CellIndex corner, const Box3&) {
    ++bricks;
    kept += cache.keeps(foam.id(), cell_of_brick(foam, corner));
  });
  return bricks == 0 ? 1 : static_cast<double>(kept) / static_cast<double>(bricks);
}

void for_each_foam_strut(const FoamData& foam, const Box3& box, const Structure::TakeStrut& take,
                         const Job* job) {
  const double radius = foam.radius().range().high;
  const Box3 reach = box.grown(radius + foam.graph().brick_error() * foam.unit());
  SegmentSelection selection;
  const Borrowed<StrutBatch> batch;
  for_each_brick(foam, reach, false, job, [&](const BrickPart& part) {
    selection.select(part.brick.segments(), part.wanted);
    for (size_t first = 0; first < selection.count(); first += StrutBatch::capacity) {
      selection.place(part.frame, first, *batch);
      for (size_t i = 0; i < batch->count; ++i) take(batch->from(i), batch->to(i), radius);
    }
  });
}

}  // namespace msq
