// SPDX-License-Identifier: Apache-2.0
// Sides of a cell of marching squares, counter-clockwise.
#pragma once

#include <cstdint>

namespace msq::cell_sides {

inline constexpr uint32_t bottom = 0, right = 1, top = 2, left = 3;

}  // namespace msq::cell_sides
