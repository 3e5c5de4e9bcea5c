// SPDX-License-Identifier: Apache-2.0
// The text of an expression, with its parameters.
#pragma once

#include "expression/parser.h"
#include "msq.h"

namespace msq::api {

/// Throws Error(argument) or Error(limit) for what is no expression.
Tape read_expression(const char* text, const msq_named_value* parameters, uint64_t parameter_count);

}  // namespace msq::api
