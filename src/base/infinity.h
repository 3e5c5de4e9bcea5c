// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace msq {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace msq
