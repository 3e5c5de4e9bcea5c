// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace msq {

/// Along an axis of a unit cell, of any kind of structure.
constexpr int max_clusters = 64;

}  // namespace msq
