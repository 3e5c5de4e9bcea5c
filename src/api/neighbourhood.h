// SPDX-License-Identifier: Apache-2.0
// The grid of a structure's definition.
#pragma once

#include "cell/neighbourhood.h"
#include "msq.h"

namespace msq::api {

msq_neighbourhood neighbourhood_defaults();

/// Throws Error(argument), which names the matrix, unless it is a rotation.
Rotation read_rotation(const double (&matrix)[9], const char* name);

/// Throws Error(argument) where the grid makes no sense.
Neighbourhood read_neighbourhood(const msq_neighbourhood& grid);

/// Throws Error(limit) where the cells of a lattice are so flat or so long that the rounding of its
/// longest side, in a turned grid, is a part of the shortest.
void require_proportions(const Neighbourhood& grid);

}  // namespace msq::api
