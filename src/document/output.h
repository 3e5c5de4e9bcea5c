// SPDX-License-Identifier: Apache-2.0
// A document that is being written, as a tree.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace msq::document {

struct Output {
  enum class Kind { raw, list, object };

  Kind kind = Kind::object;
  /// Text in JSON. Lines within it are indented where it is printed.
  std::string raw;
  std::vector<Output> items;
  std::vector<std::pair<std::string, Output>> members;

  static Output of_raw(std::string text) { return {Kind::raw, std::move(text), {}, {}}; }
  void add(std::string key, Output value) {
    members.emplace_back(std::move(key), std::move(value));
  }
  bool operator==(const Output&) const = default;

  /// The text, with what fits on one line of 100 bytes on one.
  std::string print() const;

 private:
  bool fits(size_t& room) const;
  void print_line(std::string& to) const;
  void print(std::string& to, size_t indent) const;
};

/// A number as the shortest text that reads back as it. Of one that is not finite "inf", "-inf" or
/// "nan", which are not JSON.
std::string number_text(double value);

}  // namespace msq::document
