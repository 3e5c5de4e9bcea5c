// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "base/borrowed.h"
#include "structure/foam/foam_data.h"
#include "structure/foam/point/edges_near.h"
#include "structure/foam/point/stretched_point.h"
#include "structure/foam/point/weighted_point.h"

namespace msq {

/// The struts within a radius (foam units) of a point, and the point in their frame.
class NearEdges {
 public:
  NearEdges(const FoamData& foam, Vec3 p, double radius) {
    const Neighbourhood::Located located = foam.neighbourhood().locate(p);
    q = located.fraction * foam.seeds().scale();
    if (foam.stretch())
      find_stretched_edges_near(*foam.stretch(), located.cell, q, radius, *struts_);
    else if (foam.is_weighted())
      find_weighted_edges_near(foam.seeds(), located.cell, q, radius, *struts_);
    else
      find_edges_near(foam.seeds(), located.cell, q, radius, *struts_);
  }
  auto begin() const { return struts_->cbegin(); }
  auto end() const { return struts_->cend(); }

  Vec3 q;

 private:
  const Borrowed<std::vector<NearEdge>> struts_;
};

}  // namespace msq
