// SPDX-License-Identifier: Apache-2.0
// Warped cells of a structure's definition.
#pragma once

#include <memory>
#include <optional>

#include "cell/sampled_map.h"
#include "cell/warp.h"
#include "msq.h"

namespace msq::api {

/// One of these, or neither.
struct CellMap {
  std::optional<Warp> round;
  std::shared_ptr<const SampledMap> sampled;

  explicit operator bool() const { return round || sampled; }
};

/// Reads def.warp and replaces it by `known`, the definition of this version. No warp if it is
/// NULL. Throws Error(argument), which names the value and its limit.
CellMap read_warp(const msq_warp_def*& def, msq_warp_def& known, const Neighbourhood& grid);

}  // namespace msq::api
