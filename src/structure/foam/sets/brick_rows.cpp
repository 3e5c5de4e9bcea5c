// SPDX-License-Identifier: Apache-2.0
// The edges come in bricks from the cell cache and go as struts to the span raster. The point query
// decides the few samples in doubt.
#include "structure/foam/sets/brick_rows.h"

#include "structure/common/strut_rows.h"
#include "structure/foam/sets/bricks.h"

namespace msq {

bool keep_brick_rows(const FoamData& foam, const RowBlock& block, AliveRows alive, const Job* job) {
  const Neighbourhood& grid = foam.neighbourhood();
  StrutRows rows(block, grid, foam.radius(), foam.graph().brick_error() * foam.unit(), 1, alive);
  if (rows.empty()) return true;
  const double critical = foam.graph().critical_samples(
      grid.to_grid(rows.reach()).grown(foam.owner_distance()), foam.max_radius());
  if (!rows.pays(grid, critical)) {
    // A look at each brick, only where that may matter.
    const double share = foam.graph().drawing_share();
    if (!rows.pays(grid, share * critical)) return false;
    const double built = (1 - share) * (1 - kept_share_of_bricks(foam, rows.reach()));
    if (!rows.pays(grid, (share + built) * critical)) return false;
  }
  for_each_brick(foam, rows.reach(), block.layers() == 1, job, [&](const BrickPart& part) {
    rows.add(part.brick.segments(), part.frame, part.wanted);
  });
  rows.finish(job, [&](Vec3 p) { return foam.inside(p); });
  return true;
}

}  // namespace msq
