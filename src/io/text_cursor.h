// SPDX-License-Identifier: Apache-2.0
// Words and numbers of text files, independent of the process's locale.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "base/status.h"

namespace msq {

/// At most 60 characters of a word, for messages.
struct Quoted {
  explicit Quoted(std::string_view word)
      : length(word.size() < 60 ? static_cast<int>(word.size()) : 60) {
    for (int i = 0; i < length; ++i) text[i] = word[i] >= 32 && word[i] < 127 ? word[i] : '?';
  }
  int length;
  char text[61] = {};
};

/// For a number out of double's range: whether it is too small, not too large.
inline bool is_too_small(std::string_view digits) {
  const size_t e = std::min(digits.find_first_of("eE"), digits.size());
  std::string_view exponent = digits.substr(std::min(e + 1, digits.size()));
  if (exponent.starts_with('+')) exponent.remove_prefix(1);
  int64_t power = 0;
  const auto parsed = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
  if (parsed.ec == std::errc::result_out_of_range) return exponent[0] == '-';
  // A double overflows from 10^309 on, and underflows below 10^-323.
  const std::string_view mantissa = digits.substr(0, e);
  const auto first = static_cast<int64_t>(mantissa.find_first_of("123456789"));
  const auto point = static_cast<int64_t>(std::min(mantissa.find('.'), mantissa.size()));
  return power < first - point;
}

/// Converts a whole word to the nearest double; 0 if it is too small. Accepts "nan" and "inf":
/// vertices are checked when all are read.
inline double parse_real(std::string_view word, const char* what) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_whole = end == digits.data() + digits.size();
  if (error == std::errc::result_out_of_range && is_whole) {
    if (is_too_small(digits)) return digits.starts_with('-') ? -0.0 : 0.0;
    fail(Status::mesh, "%s: \"%s\" is out of the range of a double", what, Quoted(word).text);
  }
  if (error != std::errc() || !is_whole)
    fail(Status::io, "%s: \"%s\" is not a number", what, Quoted(word).text);
  return value;
}

/// The same for a number that must be finite.
inline double parse_finite(std::string_view word, const char* what) {
  const double value = parse_real(word, what);
  if (!std::isfinite(value))
    fail(Status::mesh, "%s: \"%s\" is not finite", what, Quoted(word).text);
  return value;
}

inline int64_t parse_integer(std::string_view word, const char* what) {
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(Status::io, "%s: \"%s\" is not an integer of 64 bits", what, Quoted(word).text);
  return value;
}

inline uint64_t parse_count(std::string_view word, const char* what) {
  const int64_t value = parse_integer(word, what);
  if (value < 0) fail(Status::io, "%s: %lld is negative", what, static_cast<long long>(value));
  return static_cast<uint64_t>(value);
}

/// Walks over text, word by word or line by line.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : rest_(text) {}

  static bool is_space(char c) { return is_line_end(c) || is_blank(c); }
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  uint64_t remaining() const { return rest_.size(); }
  std::string_view rest() const { return rest_; }
  void skip(uint64_t bytes) { rest_.remove_prefix(bytes); }

  /// Next word, on this line or below; empty at the end of the text.
  std::string_view word() {
    while (!rest_.empty() && is_space(rest_[0])) rest_.remove_prefix(1);
    return take_word();
  }
  /// Next word of this line; empty at its end.
  std::string_view word_of_line() {
    while (!rest_.empty() && is_blank(rest_[0])) rest_.remove_prefix(1);
    return take_word();
  }
  /// Everything up to the end of this line.
  std::string_view rest_of_line() {
    size_t n = 0;
    while (n < rest_.size() && !is_line_end(rest_[n])) ++n;
    const std::string_view result = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return result;
  }
  /// The same, and moves past the end.
  std::string_view line() {
    const std::string_view result = rest_of_line();
    if (rest_.size() > 1 && rest_[0] == '\r' && rest_[1] == '\n')
      rest_.remove_prefix(2);
    else if (!rest_.empty())
      rest_.remove_prefix(1);
    return result;
  }

 private:
  std::string_view take_word() {
    size_t n = 0;
    while (n < rest_.size() && !is_space(rest_[n])) ++n;
    const std::string_view result = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return result;
  }

  std::string_view rest_;
};

/// Removes the byte order mark that some writers put before UTF-8.
inline std::string_view without_byte_order_mark(std::string_view text) {
  return text.starts_with("\xef\xbb\xbf") ? text.substr(3) : text;
}

inline char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
}

inline bool equal_ignoring_case(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i)
    if (lower_case(a[i]) != lower_case(b[i])) return false;
  return true;
}

}  // namespace msq
