// SPDX-License-Identifier: Apache-2.0
#include "base/simd.h"

#include <hwy/highway.h>

#include <cstdint>

namespace msq {

const char* simd_target_name() {
  // Targets are bits; the best supported one is the lowest.
  const int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(supported & -supported);
}

}  // namespace msq
