// SPDX-License-Identifier: Apache-2.0
// Numbers as text and back. Nothing here depends on a locale.
#ifndef MSQ_COMMAND_TEXT_H
#define MSQ_COMMAND_TEXT_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace command {

// The shortest text that reads back as the same number; "inf" and "nan" for what is not finite.
std::string exact(double value);

// At most `digits` significant digits, for people.
std::string rounded(double value, int digits = 6);

// Appends exact(value) or a whole number.
void append(std::string& text, double value);
void append(std::string& text, uint64_t value);

// The number that all of the text is, spaces around it aside. Nothing if it is none, or not finite.
std::optional<double> to_number(std::string_view text);
std::optional<uint64_t> to_count(std::string_view text);

// The parts between separators.
std::vector<std::string_view> split(std::string_view text, char separator);

// The text without spaces and tabs at its ends.
std::string_view trimmed(std::string_view text);

// The ending of a file's name in lower case, with its dot: ".stl"; "" without one.
std::string ending(std::string_view path);

// The text with control characters replaced, so that it is one line.
std::string one_line(std::string_view text);

// Whether the text is UTF-8.
bool is_utf8(std::string_view text);

// Hexadecimal digits.
std::string to_hex(const uint8_t* bytes, size_t count);

}  // namespace command

#endif
