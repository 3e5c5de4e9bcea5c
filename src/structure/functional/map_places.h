// SPDX-License-Identifier: Apache-2.0
// Angles of many points in cells by a map that the host samples, in vectors, with the bits of the
// scalar map.
#pragma once

#include "cell/sampled_map.h"
#include "expression/batch.h"

namespace msq {

/// SampledMap::place() and angle_of(), to the last bit. x, y, z and the angles are `count` values,
/// readable and writable up to batch_padding beyond; uniform coordinates are allowed. Bit i of `in`
/// (word i / 64; not if null): whether point i is in the box of the samples. All words up to the
/// last are overwritten.
void find_map_places(const SampledMap& map, Values x, Values y, Values z, size_t count,
                     double* const (&angles)[3], uint64_t* in);

}  // namespace msq
