// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "io/json_text.h"

namespace msq {

uint32_t JsonTree::member(uint32_t object, std::string_view key) const {
  const JsonValue& in = values_[object];
  if (in.kind != JsonValue::Kind::object || in.count == 0) return 0;
  for (uint32_t value = in.first; value; value = values_[value].next)
    if (texts_[values_[value].key] == key) return value;
  return 0;
}

uint32_t JsonTree::element(uint32_t list, uint64_t index) const {
  const JsonValue& in = values_[list];
  if (in.kind != JsonValue::Kind::list || index >= in.count) return 0;
  uint32_t value = in.first;
  while (index-- > 0) value = values_[value].next;
  return value;
}

std::string JsonTree::place(uint32_t value) const {
  return json_place(source_, values_[value].offset);
}

std::string JsonTree::path(uint32_t value) const {
  std::string path;
  for (uint32_t in = 0; in != value;) {
    const bool is_list = values_[in].kind == JsonValue::Kind::list;
    // Values within come before the next value beside: the last one not beyond `value` has it.
    uint64_t index = 0;
    uint32_t part = values_[in].first;
    while (values_[part].next && values_[part].next <= value) {
      part = values_[part].next;
      ++index;
    }
    if (is_list)
      path.append("[").append(std::to_string(index)).append("]");
    else
      path.append(path.empty() ? "" : ".").append(key(part));
    in = part;
  }
  return path;
}

std::string json_place(std::string_view text, uint64_t offset) {
  const std::string_view before = text.substr(0, std::min<uint64_t>(offset, text.size()));
  const size_t last = before.rfind('\n');
  const size_t column = before.size() - (last == std::string_view::npos ? 0 : last + 1);
  return std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ":" +
         std::to_string(column + 1);
}

}  // namespace msq
