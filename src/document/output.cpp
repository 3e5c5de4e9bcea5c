// SPDX-License-Identifier: Apache-2.0
#include "document/output.h"

#include <charconv>

#include "io/json_text.h"

namespace msq::document {

std::string number_text(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

bool Output::fits(size_t& room) const {
  const auto take = [&](size_t bytes) {
    const bool is_room = bytes <= room;
    room -= is_room ? bytes : 0;
    return is_room;
  };
  if (kind == Kind::raw) return raw.find('\n') == std::string::npos && take(raw.size());
  for (const Output& item : items)
    if (!item.fits(room) || !take(2)) return false;
  for (const auto& [key, value] : members)
    if (!take(key.size() + 6) || !value.fits(room)) return false;
  return take(2);
}

void Output::print_line(std::string& to) const {
  if (kind == Kind::raw) {
    to += raw;
    return;
  }
  to += kind == Kind::list ? "[" : "{";
  bool is_first = true;
  const auto separate = [&] {
    if (!is_first) to += ", ";
    is_first = false;
  };
  for (const Output& item : items) {
    separate();
    item.print_line(to);
  }
  for (const auto& [key, value] : members) {
    separate();
    to += json_quoted(key) + ": ";
    value.print_line(to);
  }
  to += kind == Kind::list ? "]" : "}";
}

void Output::print(std::string& to, size_t indent) const {
  size_t room = indent < 90 ? 100 - indent : 10;
  if (fits(room)) return print_line(to);
  const std::string inner(indent + 2, ' ');
  if (kind == Kind::raw) {
    for (char c : raw) {
      to += c;
      if (c == '\n') to += inner;
    }
    return;
  }
  to += kind == Kind::list ? "[" : "{";
  bool is_first = true;
  const auto begin_line = [&] {
    to += is_first ? "\n" : ",\n";
    to += inner;
    is_first = false;
  };
  for (const Output& item : items) {
    begin_line();
    item.print(to, indent + 2);
  }
  for (const auto& [key, value] : members) {
    begin_line();
    to += json_quoted(key) + ": ";
    value.print(to, indent + 2);
  }
  to += '\n';
  to.append(indent, ' ');
  to += kind == Kind::list ? ']' : '}';
}

std::string Output::print() const {
  std::string text;
  print(text, 0);
  return text + "\n";
}

}  // namespace msq::document
