// SPDX-License-Identifier: Apache-2.0
// What Structure::onset() returns of a value that a search found.
#pragma once

#include "base/infinity.h"
#include "structure/structure.h"

namespace msq {

/// Searches may look no farther than the limit, so what they find beyond it may not be the least.
inline double known_onset(const Structure& structure, double found) {
  return found <= structure.onset_limit() ? found : infinity;
}

}  // namespace msq
