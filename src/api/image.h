// SPDX-License-Identifier: Apache-2.0
// The image of a definition.
#pragma once

#include <memory>

#include "base/memory.h"
#include "msq.h"
#include "shape/image.h"

namespace msq::api {

msq_image image_defaults();

/// Copies a host's image. Throws Error(argument) where it makes no sense, Error(limit) where the
/// budget has no room. `min_size`: values along each axis, at least.
Image read_image(const msq_image& image, uint64_t min_size,
                 const std::shared_ptr<MemoryBudget>& budget);

}  // namespace msq::api
