// SPDX-License-Identifier: Apache-2.0
// Text in JSON as a tree of values that know where they are in the text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/job.h"

namespace msq {

struct JsonLimits {
  uint64_t max_values;
  uint32_t max_depth;
};

struct JsonValue {
  enum class Kind : uint8_t { null, truth, whole, number, text, list, object };

  Kind kind;
  uint32_t key;        ///< number of a text: the name of a member of an object
  uint32_t first = 0;  ///< of a list or object: the first value in it, if count > 0
  uint32_t next = 0;   ///< the next value of the same list or object; 0: none
  uint64_t offset;     ///< of the first byte, or of the key
  union {
    double number;   ///< of `number`
    uint64_t whole;  ///< of `whole`, not negative; of `truth`, 0 or 1
    uint64_t text;   ///< of `text`: its number
    uint64_t count;  ///< of a list or object
  };
};

/// Values in the order of the text: value 0 is the root, and values within others follow these.
class JsonTree {
 public:
  /// Throws Error(argument) for what is not JSON, keys that occur twice and texts with a zero byte,
  /// Error(limit) where limits are exceeded; messages begin with line and column. Throws
  /// Error(unsupported) in a build without a parser. The text must outlive the tree.
  JsonTree(std::string_view text, const JsonLimits& limits, const Job* job);

  const JsonValue& operator[](uint32_t value) const { return values_[value]; }
  const std::string& text(uint64_t number) const { return texts_[number]; }
  const std::string& key(uint32_t value) const { return texts_[values_[value].key]; }
  /// The member of an object of that name; 0: none.
  uint32_t member(uint32_t object, std::string_view key) const;
  /// The element of a list, by its index; 0: none.
  uint32_t element(uint32_t list, uint64_t index) const;
  /// "12:17" of a value, and its path from the root, such as "scales[1].structure.foam".
  std::string place(uint32_t value) const;
  std::string path(uint32_t value) const;

 private:
  friend class JsonBuilder;
  std::string_view source_;
  std::vector<JsonValue> values_;
  std::vector<std::string> texts_;
};

/// Line and column of a byte, both from 1.
std::string json_place(std::string_view text, uint64_t offset);

/// Whether this build reads and writes JSON.
bool can_read_json();

/// The text as JSON, in quotation marks. Throws Error(unsupported) if it is not UTF-8, or in a
/// build without a parser.
std::string json_quoted(std::string_view text);

}  // namespace msq
