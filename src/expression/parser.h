// SPDX-License-Identifier: Apache-2.0
// Tapes from text.
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

constexpr size_t most_expression_bytes = 4096;
constexpr int most_expression_depth = 100;  // of brackets, signs and exponents within each other

/// Numbers, pi, names with a value, x, y, z, + - * / ^, brackets, and the functions pow, min, max,
/// abs, sqrt, sin, cos, exp and log. Throws Error(argument), with the position and the reason, for
/// text that is no expression or for parameters that are no names, and Error(limit) for one that is
/// too long, nests too deep or has too many operations.
Tape parse_expression(std::string_view text, const std::vector<NamedValue>& parameters);

}  // namespace msq
