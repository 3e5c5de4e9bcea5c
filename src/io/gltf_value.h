// SPDX-License-Identifier: Apache-2.0
// Values of the JSON in a glTF file, checked where they are read.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.h"
#include "io/json_text.h"

namespace msq {

/// A value of the file, or none. Functions throw Error(io), with line and column, if it is of
/// another kind.
class GltfValue {
 public:
  GltfValue() = default;
  GltfValue(const JsonTree& tree, uint32_t value) : tree_(&tree), value_(value) {}

  explicit operator bool() const { return tree_ != nullptr; }
  bool is(JsonValue::Kind kind) const { return tree_ && at().kind == kind; }

  /// The member of an object; none if it is absent.
  GltfValue member(const char* name) const {
    if (!is(JsonValue::Kind::object))
      fail(Status::io, "glTF: %s: this is not an object", where().c_str());
    const uint32_t found = tree_->member(value_, name);
    return found ? GltfValue(*tree_, found) : GltfValue();
  }
  /// The elements of an array; none if it is absent.
  std::vector<GltfValue> list(const char* name) const {
    std::vector<GltfValue> elements;
    const GltfValue found = member(name);
    if (!found) return elements;
    if (!found.is(JsonValue::Kind::list))
      fail(Status::io, "glTF: %s: %s is not an array", found.where().c_str(), name);
    elements.reserve(found.at().count);
    for (uint32_t next = found.at().count ? found.at().first : 0; next; next = (*tree_)[next].next)
      elements.emplace_back(*tree_, next);
    return elements;
  }
  uint64_t whole() const {
    if (!is(JsonValue::Kind::whole))
      fail(Status::io, "glTF: %s: this is not a whole number from 0", where().c_str());
    return at().whole;
  }
  uint64_t whole(const char* name, uint64_t none) const {
    const GltfValue found = member(name);
    return found ? found.whole() : none;
  }
  uint64_t required(const char* name) const {
    const GltfValue found = member(name);
    if (!found) fail(Status::io, "glTF: %s: this has no %s", where().c_str(), name);
    return found.whole();
  }
  double number() const {
    if (is(JsonValue::Kind::whole)) return static_cast<double>(at().whole);
    if (!is(JsonValue::Kind::number))
      fail(Status::io, "glTF: %s: this is not a number", where().c_str());
    return at().number;
  }
  /// A string; empty if it is absent.
  std::string_view text(const char* name) const {
    const GltfValue found = member(name);
    return found ? found.text() : std::string_view();
  }
  std::string_view text() const {
    if (!is(JsonValue::Kind::text))
      fail(Status::io, "glTF: %s: this is not a string", where().c_str());
    return tree_->text(at().text);
  }
  bool truth(const char* name) const {
    const GltfValue found = member(name);
    return found.is(JsonValue::Kind::truth) && found.at().whole;
  }
  /// Numbers of an array of that length; false if it is absent.
  template <size_t n>
  bool numbers(const char* name, double (&values)[n]) const {
    if (!member(name)) return false;
    const std::vector<GltfValue> elements = list(name);
    if (elements.size() != n)
      fail(Status::io, "glTF: %s: %s has %zu numbers; it must have %zu", where().c_str(), name,
           elements.size(), n);
    for (size_t i = 0; i < n; ++i) values[i] = elements[i].number();
    return true;
  }

  /// Line and column, for messages.
  std::string where() const { return tree_->place(value_); }

 private:
  const JsonValue& at() const { return (*tree_)[value_]; }

  const JsonTree* tree_ = nullptr;
  uint32_t value_ = 0;
};

}  // namespace msq
