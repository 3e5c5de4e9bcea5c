// SPDX-License-Identifier: Apache-2.0
// How far a ray that starts in a strut stays in it.
#pragma once

#include "base/ray.h"
#include "structure/foam/foam_data.h"

namespace msq {

/// A t, at most `to`, up to which a ray that is inside at `from` stays in a strut that contains its
/// point there, safe against rounding; `from` if none is found.
double strut_exit(const FoamData& foam, const Ray& ray, double from, double to);

}  // namespace msq
