// SPDX-License-Identifier: Apache-2.0
// The grid of a structure's definition.
#pragma once

#include "cell/neighbourhood.h"
#include "msq.h"

namespace msq::api {

msq_neighbourhood neighbourhood_defaults();

/// Throws Error(argument) where the grid makes no sense.
Neighbourhood read_neighbourhood(const msq_neighbourhood& grid);

}  // namespace msq::api
