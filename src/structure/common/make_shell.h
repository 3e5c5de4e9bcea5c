// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "structure/common/box_shell.h"
#include "structure/common/warp_shell.h"

namespace msq {

/// What the cells of a warp or of a sampled map fill; null without either.
inline std::unique_ptr<const CellShell> make_shell(const std::optional<Warp>& warp,
                                                   std::shared_ptr<const SampledMap> map) {
  if (warp) return std::make_unique<const WarpShell>(*warp);
  if (map) return std::make_unique<const BoxShell>(std::move(map));
  return nullptr;
}

}  // namespace msq
