// SPDX-License-Identifier: Apache-2.0
// Warped cells of a structure's definition.
#pragma once

#include <optional>

#include "cell/warp.h"
#include "msq.h"

namespace msq::api {

/// Reads def.warp and replaces it by `known`, the definition of this version. No warp if it is
/// NULL. Throws Error(argument), which names the value and its limit.
std::optional<Warp> read_warp(const msq_warp_def*& def, msq_warp_def& known,
                              const Neighbourhood& grid);

}  // namespace msq::api
