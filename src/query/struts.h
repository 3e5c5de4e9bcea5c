// SPDX-License-Identifier: Apache-2.0
// The struts of a structure that a box selects, in a fixed order, cut to a shape if there is one.
#pragma once

#include <functional>

#include "base/job.h"
#include "cell/context.h"
#include "shape/shape.h"
#include "structure/common/struts.h"
#include "structure/structure.h"

namespace msq {

struct StrutQuery {
  const Structure& structure;
  StrutSelection selection;
  const Shape* shape = nullptr;  ///< that struts are cut to; may be null
};

/// Calls take(struts, count) on the calling thread, with up to max_struts_at_once struts. Throws
/// Error(unsupported) if the structure has no struts.
constexpr size_t max_struts_at_once = 4096;
void for_each_strut(const Context& context, const StrutQuery& query, Job* job,
                    const std::function<void(const Strut* struts, size_t count)>& take);

}  // namespace msq
