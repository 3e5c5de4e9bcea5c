// SPDX-License-Identifier: Apache-2.0
// Maps from lists of samples.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cell/sampled_map.h"

namespace msq::test {

/// `values`: the coordinates u, v and w at the samples, x fastest.
inline std::shared_ptr<const SampledMap> make_map(const ImageFrame& frame,
                                                  const std::array<uint64_t, 3>& size,
                                                  const std::vector<double> (&values)[3]) {
  const auto field = [&](int axis) {
    const Image::Source source{values[axis].data(),
                               Image::Type::float64,
                               {size[0], size[1], size[2]},
                               size[0] * 8,
                               size[0] * size[1] * 8};
    return Ref<const GridField>(
        make_ref<GridField>(Image(source, frame, std::make_shared<MemoryBudget>(0))));
  };
  return std::make_shared<const SampledMap>(SampledMap::Fields{field(0), field(1), field(2)});
}

}  // namespace msq::test
