// SPDX-License-Identifier: Apache-2.0
// The common part of readers of text: errors that name the line, and no guesses about text that is
// not UTF-8.
#pragma once

#include <cstdint>
#include <string_view>

#include "base/status.h"

namespace msq {

/// Number, from 1, of the line of the text that contains a pointer.
inline uint64_t line_of(std::string_view text, const char* at) {
  uint64_t line = 1;
  const char* const end = text.data() + text.size();
  for (const char* c = text.data(); c < at; ++c)
    line += *c == '\n' || (*c == '\r' && (c + 1 == end || c[1] != '\n'));
  return line;
}

/// Runs body(). Prefixes its errors with the format and the line that contains `at` then.
template <class Body>
void with_lines(const char* format, std::string_view text, const char* const& at, Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    if (error.status == Status::cancelled) throw;
    fail(error.status, "%s: line %llu: %s", format,
         static_cast<unsigned long long>(line_of(text, at)), error.what());
  }
}

/// Whether bytes that should be text are in UTF-16 or UTF-32: they begin with its byte order mark,
/// or some but not all of the first four are 0.
inline bool is_wide_text(std::string_view file) {
  const std::string_view first = file.substr(0, 4);
  return file.starts_with("\xff\xfe") || file.starts_with("\xfe\xff") ||
         (first.find('\0') != std::string_view::npos &&
          first.find_first_not_of('\0') != std::string_view::npos);
}

/// Throws Error(unsupported) for such text.
inline void refuse_wide_text(std::string_view file, const char* format) {
  if (is_wide_text(file))
    fail(Status::unsupported,
         "%s: the file is text in UTF-16 or UTF-32, or no text; only UTF-8 and ASCII are read",
         format);
}

}  // namespace msq
