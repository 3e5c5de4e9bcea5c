// SPDX-License-Identifier: Apache-2.0
// Reads the members of a definition from an object of a document.
#pragma once

#include <optional>
#include <vector>

#include "api/definition_walk.h"
#include "document/builder.h"

namespace msq::document {

/// A whole number from 0 to 2^64 - 1, as JSON Schema has it: 1, 1.0 and 1e0 are the same.
std::optional<uint64_t> whole_number(const JsonValue& value);

/// "is 2", or of what kind a value is, for messages.
std::string given(const JsonValue& value);

class Reader final : public api::DefinitionWalk {
 public:
  using DefinitionWalk::whole;

  /// The arena keeps what the definition points to.
  Reader(Builder& builder, uint32_t object, Arena& arena);

  /// A key that is allowed and read elsewhere.
  void allow(const std::string& key) { known_.push_back(key); }
  /// Refuses the first key that nothing requested.
  void finish() const;

  void number(const char* key, double& value) override;
  void numbers(const char* key, std::span<double> values, bool may_be_one) override;
  bool optional_numbers(const char* key, bool is_there, std::span<double> values) override;
  void whole(const char* key, uint64_t& value, uint64_t max) override;
  void wholes(const char* key, std::span<uint64_t> values, uint64_t max) override;
  void truth(const char* key, int32_t& value) override;
  void choice(const char* key, int32_t& value, api::Choices choices) override;
  void flags(const char* key, uint32_t& value, api::Choices choices) override;
  void text(const char* key, const char*& value) override;
  void file(const char* key, const char*& value) override;
  void param(const char* key, msq_param& value) override;
  void image(const char* key, msq_image& image, api::ImageSource& source) override;
  void object(const char* key, const msq_shape*& value) override;
  void object(const char* key, const msq_field*& value) override;
  void object(const char* key, const msq_structure*& value) override;
  void object(const char* key, const msq_material*& value) override;
  void objects(const char* key, const msq_shape* const*& values, uint64_t& count) override;
  void objects(const char* key, const msq_structure* const*& values, uint64_t& count) override;
  void objects(const char* key, const msq_model* const*& values, uint64_t& count) override;
  void tuples(const char* key, const double*& values, uint64_t& count, size_t width) override;
  void tuples(const char* key, const uint32_t*& values, uint64_t& count, size_t width) override;
  void tuples(const char* key, const uint8_t*& values, uint64_t& count, size_t width,
              api::Choices choices) override;
  void named_values(const char* key, const msq_named_value*& values, uint64_t& count) override;
  void equal_counts(const char* key, uint64_t count, const char* other,
                    uint64_t other_count) override;
  void members(const char* key, const Part& part, const Part& defaults) override;
  bool section(const char* key, bool is_there, const Part& part, const Part& defaults) override;

 protected:
  void* room(const void* from, size_t bytes, uint64_t copied) override;
  uint64_t list(const char* key, uint64_t count, const std::function<void(uint64_t)>& prepare,
                const std::function<void(DefinitionWalk&, uint64_t)>& part,
                const Part& defaults) override;

 private:
  /// The value of a key; 0: there is none.
  uint32_t find(const char* key);
  void expect(uint32_t value, JsonValue::Kind kind) const;
  double number_of(uint32_t value) const;
  uint64_t whole_of(uint32_t value, uint64_t max) const;
  int32_t choice_of(uint32_t value, api::Choices choices) const;
  template <class Body>
  void each(uint32_t list, Body&& body) const;
  template <class T, class Read>
  void read_tuples(const char* key, const T*& values, uint64_t& count, size_t width, Read&& read);
  template <class Handle, class Make>
  void read_objects(const char* key, const Handle* const*& values, uint64_t& count, Make&& make);
  std::vector<std::string> image_paths(uint32_t value, api::ImageSource& source);
  void read_file(uint32_t object, uint32_t file, msq_image& image, api::ImageSource& source,
                 bool has_layout);
  void read_values(uint32_t list, msq_image& image);

  Builder& builder_;
  const JsonTree& tree_;
  uint32_t object_;
  Arena& arena_;
  std::vector<std::string> known_;
};

template <class Body>
void Reader::each(uint32_t list, Body&& body) const {
  expect(list, JsonValue::Kind::list);
  if (tree_[list].count == 0) return;
  for (uint32_t value = tree_[list].first; value; value = tree_[value].next) body(value);
}

}  // namespace msq::document
