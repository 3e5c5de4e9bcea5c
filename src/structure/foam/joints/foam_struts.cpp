// SPDX-License-Identifier: Apache-2.0
#include "structure/foam/joints/foam_struts.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <utility>

#include "base/borrowed.h"
#include "base/checked.h"
#include "base/id_table.h"
#include "base/job.h"
#include "structure/foam/edges/edge_brick.h"
#include "structure/foam/joints/joint_graph.h"

namespace msq {

namespace {

struct Workspace {
  NamedSeeds seeds;
  JointGraph graph;
  IdTable vertices;

  size_t bytes() const { return seeds.bytes() + graph.bytes() + vertices.bytes(); }
};

class FoamStruts final : public StrutsOfOne {
 public:
  FoamStruts(const FoamData& foam, const StrutSelection& selection)
      : foam_(foam),
        selection_(selection),
        side_(foam.graph().brick_layout().side),
        lead_(foam.graph().brick_layout().lead) {
    const Neighbourhood& grid = foam.neighbourhood();
    // An edge that is selected has a point in this box, within the empty radius of its owner.
    around_ = grid.to_grid(selection.around(foam.radius().range().high))
                  .grown(2 * foam.graph().brick_error() * foam.unit());
    const Box3 owners = around_.grown(foam.owner_distance());
    const Vec3 reach = foam.owner_reach();
    const StrutCells cells(grid, Box3{owners.min - reach, owners.max + reach});
    for (int axis = 0; axis < 3; ++axis) {
      const auto brick = [&](int64_t cell) {
        const int64_t from_lead = cell + lead_;
        return from_lead >= 0 ? from_lead / side_ : -((-from_lead + side_ - 1) / side_);
      };
      first_[axis] = brick(cells.first[axis]);
      bricks_[axis] =
          static_cast<uint64_t>(std::max<int64_t>(0, brick(cells.last[axis]) - first_[axis] + 1));
    }
  }

  uint64_t count() const override {
    return checked_product(checked_product(bricks_[0], bricks_[1], "bricks of cells"), bricks_[2],
                           "bricks of cells");
  }

  void append(uint64_t part, StrutList& list) const override {
    int32_t at[3];
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = static_cast<int32_t>(
          (first_[axis] + static_cast<int64_t>(part % bricks_[axis])) * side_ - lead_);
      part /= bricks_[axis];
    }
    const CellIndex corner{at[0], at[1], at[2]};
    const FoamGraph& graph = foam_.graph();
    if (!graph.may_own_edges(corner, around_)) return;
    const auto data =
        foam_.context().cache.fetch(foam_.id(), corner, [&] { return graph.make_brick(corner); });
    const Borrowed<Workspace> workspace;
    find_joints(static_cast<const EdgeBrick&>(*data), corner, *workspace);
    workspace->graph.find_edges();
    add_struts(workspace->graph, list);
  }

  double radius_at(const Strut&, double, double, Vec3 p) const override {
    return foam_.radius().at(p);
  }

 private:
  void find_joints(const EdgeBrick& brick, CellIndex corner, Workspace& work) const {
    work.seeds.move_to(foam_.diagram_seeds(), foam_.graded(), corner, side_);
    // The positions of a stretched brick are rounded twice.
    const double error = foam_.stretch() ? 2 * edge_error : edge_error;
    const SegmentSet& segments = brick.segments();
    work.graph.start(work.seeds, corner, side_, 4 * segments.count());
    work.vertices.reset(2 * segments.count());
    uint32_t vertices = 0;
    for (size_t i = 0; i < segments.count(); ++i) {
      if (i % 64 == 0) check_cancelled();
      const FloatSegment segment = segments.at(i);
      for (const float(&end)[3] : {std::cref(segment.a), std::cref(segment.b)}) {
        uint32_t bits[3];
        std::memcpy(bits, end, sizeof bits);
        IdHash hash(0);
        hash.add(bits[0] | uint64_t{bits[1]} << 32);
        hash.add(uint64_t{bits[2]});
        if (work.vertices.find_or_add(hash.id(), vertices) != vertices) continue;
        ++vertices;
        const Vec3 p = foam_.to_diagram(brick.origin() + Vec3{end[0], end[1], end[2]});
        work.graph.add_at(p, error);
      }
    }
  }

  Vec3 place(const Joint& joint) const {
    const CellIndex cell = joint.seeds[0].cell;
    const Neighbourhood& grid = foam_.neighbourhood();
    return grid.from_grid(Vec3{double(cell.x), double(cell.y), double(cell.z)} * grid.cell_size +
                          foam_.from_diagram(joint.position) * foam_.unit());
  }

  CellIndex cell_of(const NamedSeed& seed) const {
    return foam_.placed() ? foam_.placed()->cell_of(seed.cell, seed.leaf >> 3) : seed.cell;
  }

  void add_struts(const JointGraph& graph, StrutList& list) const {
    const size_t from = list.struts.size();
    const double max_radius = foam_.radius().range().high;
    for (const JointGraph::Edge& edge : graph.edges()) {
      if (edge.ends[0] == edge.ends[1] || !graph.is_owned(edge)) continue;
      const Joint *a = &graph.joints()[edge.ends[0]], *b = &graph.joints()[edge.ends[1]];
      if (b->id < a->id) std::swap(a, b);
      Strut strut;
      strut.a = place(*a);
      strut.b = place(*b);
      if (!selection_.selects(strut.a, strut.b, max_radius)) continue;
      strut.id = edge.id;
      strut.nodes[0] = a->id;
      strut.nodes[1] = b->id;
      strut.cell = cell_of(graph.owner(edge));
      strut.radii[0] = strut.radii[1] = max_radius;
      list.add(strut, 1);
    }
    std::sort(list.struts.begin() + static_cast<ptrdiff_t>(from), list.struts.end(),
              [](const Strut& a, const Strut& b) {
                if (!(a.cell == b.cell))
                  return a.cell.z != b.cell.z   ? a.cell.z < b.cell.z
                         : a.cell.y != b.cell.y ? a.cell.y < b.cell.y
                                                : a.cell.x < b.cell.x;
                return a.id < b.id;
              });
    if (!foam_.radius().is_constant()) set_radii(foam_.radius(), from, list);
  }

  const FoamData& foam_;
  const StrutSelection selection_;
  const int side_, lead_;
  Box3 around_;
  int64_t first_[3];
  uint64_t bricks_[3];
};

}  // namespace

std::unique_ptr<StrutParts> foam_struts(const FoamData& foam, const StrutSelection& selection) {
  return std::make_unique<FoamStruts>(foam, selection);
}

}  // namespace msq
