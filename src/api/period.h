// SPDX-License-Identifier: Apache-2.0
// The graded period of a host's definition.
#pragma once

#include <optional>

#include "cell/graded_period.h"
#include "msq.h"

namespace msq::api {

/// None for null. Replaces the definition by the one of this version, `known`. Throws Error where
/// it makes no sense.
std::optional<GradedPeriod> read_period(const msq_period_def*& def, msq_period_def& known);

}  // namespace msq::api
