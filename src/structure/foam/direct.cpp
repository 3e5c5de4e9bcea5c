// SPDX-License-Identifier: Apache-2.0
// The edges come in bricks from the cell cache and go as struts to the span raster; the point query
// decides the few samples in doubt.
#include "structure/foam/direct.h"

#include "structure/foam/edges.h"
#include "structure/foam/graded_edges.h"
#include "structure/foam/point_set.h"
#include "structure/strut_rows.h"

namespace msq {

namespace {

/// Samples for each cell in reach of a block above which building the cells' edges and drawing them
/// beats asking every sample, for a radius in foam units. What a sample costs grows with the square
/// of the radius, from about 0.08 on (docs/benchmarks.md).
double critical_samples(double radius) {
  constexpr double at_tenth = 60;
  const double r = std::max(radius, 0.08);
  return at_tenth * 0.01 / (r * r);
}
/// The same for each leaf of a graded foam: 9 to 17 us for the edges of one, 1 to 2 us a point.
constexpr double critical_samples_of_leaf = 10;

/// Adds a brick's edges where they may touch `reach` (grid coordinates).
void add_brick(const Foam& foam, const EdgeBrick& brick, CellIndex corner, const Box3& reach,
               StrutRows& rows) {
  const Neighbourhood& grid = foam.neighbourhood();
  const double unit = foam.unit();
  const Vec3 origin = Vec3{double(corner.x), double(corner.y), double(corner.z)} * grid.cell_size +
                      brick.origin() * unit;
  const Box3 from_brick{(reach.min - origin) * (1 / unit), (reach.max - origin) * (1 / unit)};
  const Box3 wanted = from_brick.grown(edge_error);
  SegmentFrame frame{grid.from_grid(origin), grid.rotation.m};
  for (double& m : frame.matrix) m *= unit;
  rows.add(brick.segments(), frame, wanted);
}

}  // namespace

void direct_keep_rows(const Foam& foam, const RowBlock& block, const Job* job) {
  const Neighbourhood& grid = foam.neighbourhood();
  const double unit = foam.unit();
  StrutRows rows(block, grid, foam.radius(), edge_error * unit);
  if (rows.empty()) return;
  const Box3 reach = grid.to_grid(rows.reach());
  // An edge that touches the reach has a point in it, and its owner within the empty radius of
  // that.
  const double owner_distance = foam.seeds().empty_radius() * unit * (1 + 1e-9);
  const GradedSeeds* graded = foam.graded().get();
  const double critical =
      graded ? critical_samples_of_leaf * graded->mean_density(reach.grown(owner_distance))
             : critical_samples(foam.most_radius());
  if (!rows.pays(grid, critical))
    return graded ? foam.Structure::keep_rows(block, job)
                  : foam_keep_rows_by_point(foam, block, job);
  const int side = graded ? graded->brick_side() : EdgeBrick::side;
  const int lead = graded ? 0 : EdgeBrick::lead;
  int64_t first[3], last[3];
  for (int axis = 0; axis < 3; ++axis) {
    const auto brick = [&](double g) {
      return static_cast<int64_t>(std::floor((g / grid.cell_size[axis] + lead) / side));
    };
    first[axis] = brick(reach.min[axis] - owner_distance);
    last[axis] = brick(reach.max[axis] + owner_distance);
  }
  for (int64_t k = first[2]; k <= last[2]; ++k)
    for (int64_t j = first[1]; j <= last[1]; ++j)
      for (int64_t i = first[0]; i <= last[0]; ++i) {
        check_cancelled(job);
        const CellIndex corner{static_cast<int32_t>(i * side - lead),
                               static_cast<int32_t>(j * side - lead),
                               static_cast<int32_t>(k * side - lead)};
        if (graded && !graded->may_own_edges(corner, reach)) continue;
        const auto brick = foam.context().cache.fetch(foam.id(), corner, [&] {
          return graded ? graded_edge_brick(foam.graded(), corner)
                        : std::make_shared<const EdgeBrick>(foam.seeds(), corner);
        });
        add_brick(foam, static_cast<const EdgeBrick&>(*brick), corner, reach, rows);
      }
  rows.finish(job, [&](Vec3 p) { return foam.inside(p); });
}

}  // namespace msq
