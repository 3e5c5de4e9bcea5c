// SPDX-License-Identifier: Apache-2.0
// Parses text into tapes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "expression/tape.h"

namespace msq {

struct NamedValue {
  std::string name;
  double value;
};

constexpr size_t max_expression_bytes = 65536;
constexpr int max_expression_depth = 100;  // maximum nesting of brackets, signs and exponents

/// Accepts numbers, pi, names with a value, x, y, z, + - * / ^ < <= > >= == !=, brackets, and the
/// functions listed in parser.cpp. Throws Error(argument), with the position and the
/// reason, if the text is not an expression or a parameter is not a name. Throws Error(limit) if
/// the text is too long, nests too deep or has too many operations.
Tape parse_expression(std::string_view text, const std::vector<NamedValue>& parameters);

}  // namespace msq
