// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace msq {

/// The numbers from low to high.
struct Interval {
  double low = 0, high = 0;
};

}  // namespace msq
