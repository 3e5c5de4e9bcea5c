// SPDX-License-Identifier: Apache-2.0
// Periodic strut lattice. Onset of a point: its distance to the infinite tiling of the unit cell's
// struts.
#pragma once

#include <vector>

#include "base/lazy.h"
#include "field/field.h"
#include "structure/lattice/nearest_struts.h"
#include "structure/lattice/unit_cell.h"
#include "structure/structure.h"
#include "strut/segment.h"

namespace msq {

class Lattice final : public Structure {
 public:
  Lattice(const Neighbourhood& neighbourhood, const UnitCell& cell, Parameter radius);

  bool inside(Vec3 p) const override;
  void keep_rows(const RowBlock& block, const Job* job) const override;
  /// Exact outside where the radius is constant and the cell sizes differ by no more than 8 times.
  double clearance(Vec3 p) const override;

 private:
  Parameter radius_;
  std::vector<PeriodicStrut> struts_;  // in cell units
  Box3 reach_;                         // of all of them
  std::vector<Segment> near_;          // struts of the tiling within the greatest radius of a cell,
                                       // in model units from its corner
  Lazy<NearestStruts> nearest_;
};

}  // namespace msq
