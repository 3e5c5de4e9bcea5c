// SPDX-License-Identifier: Apache-2.0
// Numbers as text that Assimp 5.2.5 reads right. It counts no number that begins with a point,
// wraps around after 19 digits, and gives powers of ten a rounding of their own.
#pragma once

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "base/status.h"
#include "io/text_cursor.h"

namespace msq {

/// Appends a space and the number that the word stands for, as a float in plain notation.
inline void append_number(std::string& text, std::string_view word, const char* what) {
  const double value = parse_real(word, what);
  if (!std::isfinite(value))
    fail(Status::mesh, "%s: \"%s\" is not finite", what, Quoted(word).text);
  if (std::abs(value) >= 1e18)
    fail(Status::unsupported, "%s: \"%s\"; Assimp reads no coordinate of 1e18 or more", what,
         Quoted(word).text);
  char digits[64];
  const auto end = std::to_chars(digits, digits + sizeof digits, static_cast<float>(value),
                                 std::chars_format::fixed);
  text += ' ';
  if (end.ec == std::errc())
    text.append(digits, end.ptr);
  else
    text += '0';  // not zero, but with 60 zeros behind the point
}

}  // namespace msq
