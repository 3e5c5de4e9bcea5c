// SPDX-License-Identifier: Apache-2.0
// The level of functional structures, named ones, expressions and the host's.
#pragma once

#include "api/guard.h"

namespace msq::api {

inline Parameter read_parameter(const msq_param& parameter, const char* name) {
  if (parameter.field) return Parameter(Ref<const Field>(&object(parameter.field, name)));
  return Parameter(require_finite(parameter.value, name));
}

/// `kind`: MSQ_FUNCTIONAL_*. Throws Error(argument) where the level makes no sense for it.
inline Parameter read_level(const msq_param& level, int32_t kind) {
  Parameter read = read_parameter(level, "level");
  const Interval range = read.range();
  if (kind == MSQ_FUNCTIONAL_SHEET && !(range.low >= 0 && range.high > 0))
    fail(Status::argument,
         "level runs from %g to %g; that of a sheet without thickness must not be negative, nor 0 "
         "everywhere",
         range.low, range.high);
  return read;
}

}  // namespace msq::api
