// SPDX-License-Identifier: Apache-2.0
// Lattices among the structures of structures.h.
#pragma once

#include <memory>

#include "cell/graded_period.h"
#include "cell/sampled_map.h"
#include "cell/warp.h"
#include "structures.h"

namespace msq::test {

/// Cells from half of the grid's size to one and a half.
GradedPeriod graded_period(const Neighbourhood& grid, int axis);

Factory graded_lattice_factory(UnitCell cell, int axis);

/// The axis, or the centre, is outside of the box that the suites sample, or in it.
Factory round_lattice_factory(UnitCell cell, Warp::Kind kind, Vec3 centre, Warp::Shell shell);

/// A map with samples on a box about the grid's origin, in the grid's frame: sheared and bent
/// cells.
std::shared_ptr<const SampledMap> sampled_map(const Neighbourhood& grid);
Factory sampled_lattice_factory(UnitCell cell);

/// The parameter is the thickness of the plates and the radius of the struts.
Factory plated_factory(UnitCell struts, PlateCell plates);

}  // namespace msq::test
