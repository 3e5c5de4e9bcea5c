// SPDX-License-Identifier: Apache-2.0
#include "document/reader.h"

#include <algorithm>
#include <cmath>

namespace msq::document {

namespace {

using Kind = JsonValue::Kind;

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::truth:
      return "true or false";
    case Kind::whole:
      return "a whole number";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "a text";
    case Kind::list:
      return "a list";
    default:
      return "an object";
  }
}

std::string counted(uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::string given(const JsonValue& value) {
  if (value.kind == Kind::whole) return "is " + std::to_string(value.whole);
  if (value.kind != Kind::number) return std::string("is ") + name_of(value.kind);
  char text[40];
  std::snprintf(text, sizeof text, "is %.10g", value.number);
  return text;
}

std::optional<uint64_t> whole_number(const JsonValue& value) {
  if (value.kind == Kind::whole) return value.whole;
  if (value.kind != Kind::number) return std::nullopt;
  constexpr double too_large = 18446744073709551616.0;
  const double number = value.number;
  if (!(number >= 0 && number < too_large) || number != std::floor(number)) return std::nullopt;
  return static_cast<uint64_t>(number);
}

Reader::Reader(Builder& builder, uint32_t object, Arena& arena)
    : builder_(builder), tree_(builder.tree()), object_(object), arena_(arena) {
  expect(object, Kind::object);
}

uint32_t Reader::find(const char* key) {
  known_.emplace_back(key);
  return tree_.member(object_, key);
}

void Reader::finish() const {
  if (tree_[object_].count == 0) return;
  for (uint32_t value = tree_[object_].first; value; value = tree_[value].next) {
    if (std::find(known_.begin(), known_.end(), tree_.key(value)) != known_.end()) continue;
    std::string keys;
    for (const std::string& key : known_) keys.append(keys.empty() ? "" : ", ").append(key);
    builder_.refuse(value, Status::argument,
                    keys.empty() ? "unknown key; there must be none"
                                 : "unknown key; the keys here are " + keys);
  }
}

void Reader::expect(uint32_t value, Kind kind) const {
  if (tree_[value].kind != kind)
    builder_.refuse(
        value, Status::argument,
        std::string("is ") + name_of(tree_[value].kind) + "; it must be " + name_of(kind));
}

double Reader::number_of(uint32_t value) const {
  if (tree_[value].kind == Kind::whole) return static_cast<double>(tree_[value].whole);
  expect(value, Kind::number);
  return tree_[value].number;
}

uint64_t Reader::whole_of(uint32_t value, uint64_t max) const {
  const JsonValue& found = tree_[value];
  const std::optional<uint64_t> whole = whole_number(found);
  if (!whole || *whole > max) {
    builder_.refuse(value, Status::argument,
                    given(found) + "; it must be a whole number from 0 to " + std::to_string(max));
  }
  return *whole;
}

int32_t Reader::choice_of(uint32_t value, api::Choices choices) const {
  expect(value, Kind::text);
  const std::string& text = tree_.text(tree_[value].text);
  std::string names;
  for (const api::Choice& choice : choices) {
    if (text == choice.name) return choice.value;
    names.append(names.empty() ? "" : ", ").append(choice.name);
  }
  builder_.refuse(value, Status::argument,
                  "is " + json_quoted(text.substr(0, 100)) + "; it must be one of " + names);
}

void Reader::number(const char* key, double& value) {
  if (const uint32_t found = find(key)) value = number_of(found);
}

void Reader::numbers(const char* key, std::span<double> values, bool may_be_one) {
  const uint32_t found = find(key);
  if (!found) return;
  if (may_be_one && tree_[found].kind != Kind::list) {
    std::fill(values.begin(), values.end(), number_of(found));
    return;
  }
  expect(found, Kind::list);
  if (tree_[found].count != values.size())
    builder_.refuse(found, Status::argument,
                    "has " + counted(tree_[found].count, "element", "elements") +
                        "; it must have " + std::to_string(values.size()));
  size_t i = 0;
  each(found, [&](uint32_t value) { values[i++] = number_of(value); });
}

bool Reader::optional_numbers(const char* key, bool, std::span<double> values) {
  const bool is_there = tree_.member(object_, key) != 0;
  numbers(key, values, false);
  return is_there;
}

void Reader::whole(const char* key, uint64_t& value, uint64_t max) {
  if (const uint32_t found = find(key)) value = whole_of(found, max);
}

void Reader::wholes(const char* key, std::span<uint64_t> values, uint64_t max) {
  const uint32_t found = find(key);
  if (!found) return;
  expect(found, Kind::list);
  if (tree_[found].count != values.size())
    builder_.refuse(found, Status::argument,
                    "has " + counted(tree_[found].count, "element", "elements") +
                        "; it must have " + std::to_string(values.size()));
  size_t i = 0;
  each(found, [&](uint32_t value) { values[i++] = whole_of(value, max); });
}

void Reader::truth(const char* key, int32_t& value) {
  const uint32_t found = find(key);
  if (!found) return;
  expect(found, Kind::truth);
  value = tree_[found].whole != 0;
}

void Reader::choice(const char* key, int32_t& value, api::Choices choices) {
  if (const uint32_t found = find(key)) value = choice_of(found, choices);
}

void Reader::flags(const char* key, uint32_t& value, api::Choices choices) {
  const uint32_t found = find(key);
  if (!found) return;
  value = 0;
  each(found, [&](uint32_t flag) {
    const auto bit = static_cast<uint32_t>(choice_of(flag, choices));
    if (value & bit) builder_.refuse(flag, Status::argument, "is there twice");
    value |= bit;
  });
}

void Reader::text(const char* key, const char*& value) {
  const uint32_t found = find(key);
  if (!found) return;
  expect(found, Kind::text);
  value = arena_.keep(std::string(tree_.text(tree_[found].text))).c_str();
}

void Reader::file(const char* key, const char*& value) {
  const uint32_t found = find(key);
  if (!found) builder_.refuse(object_, Status::argument, std::string("has no key ") + key);
  value = arena_.keep(builder_.path_of_file(found)).c_str();
}

void Reader::param(const char* key, msq_param& value) {
  const uint32_t found = find(key);
  if (!found) return;
  if (tree_[found].kind == Kind::text || tree_[found].kind == Kind::object)
    value.field = builder_.field(found);
  else
    value.value = number_of(found);
}

void Reader::object(const char* key, const msq_shape*& value) {
  if (const uint32_t found = find(key)) value = builder_.shape(found);
}
void Reader::object(const char* key, const msq_field*& value) {
  if (const uint32_t found = find(key)) value = builder_.field(found);
}
void Reader::object(const char* key, const msq_structure*& value) {
  if (const uint32_t found = find(key)) value = builder_.structure(found);
}
void Reader::object(const char* key, const msq_material*& value) {
  if (const uint32_t found = find(key)) value = builder_.material(found);
}

template <class Handle, class Make>
void Reader::read_objects(const char* key, const Handle* const*& values, uint64_t& count,
                          Make&& make) {
  const uint32_t found = find(key);
  if (!found) return;
  expect(found, Kind::list);
  auto* handles = arena_.take_array<const Handle*>(tree_[found].count);
  count = 0;
  each(found, [&](uint32_t value) { handles[count++] = make(value); });
  values = handles;
}

void Reader::objects(const char* key, const msq_shape* const*& values, uint64_t& count) {
  read_objects(key, values, count, [&](uint32_t value) { return builder_.shape(value); });
}

void Reader::objects(const char* key, const msq_structure* const*& values, uint64_t& count) {
  read_objects(key, values, count, [&](uint32_t value) { return builder_.structure(value); });
}

void Reader::objects(const char* key, const msq_model* const*& values, uint64_t& count) {
  read_objects(key, values, count, [&](uint32_t value) { return builder_.model(value); });
}

template <class T, class Read>
void Reader::read_tuples(const char* key, const T*& values, uint64_t& count, size_t width,
                         Read&& read) {
  const uint32_t found = find(key);
  if (!found) return;
  expect(found, Kind::list);
  auto* all = arena_.take_array<T>(tree_[found].count * width);
  count = 0;
  each(found, [&](uint32_t tuple) {
    T* elements = all + count++ * width;
    if (width == 1) {
      *elements = read(tuple);
      return;
    }
    expect(tuple, Kind::list);
    if (tree_[tuple].count != width)
      builder_.refuse(tuple, Status::argument,
                      "has " + counted(tree_[tuple].count, "element", "elements") +
                          "; it must have " + std::to_string(width));
    each(tuple, [&](uint32_t value) { *elements++ = read(value); });
  });
  values = all;
}

void Reader::tuples(const char* key, const double*& values, uint64_t& count, size_t width) {
  read_tuples(key, values, count, width, [&](uint32_t value) { return number_of(value); });
}

void Reader::tuples(const char* key, const uint32_t*& values, uint64_t& count, size_t width) {
  read_tuples(key, values, count, width,
              [&](uint32_t value) { return static_cast<uint32_t>(whole_of(value, UINT32_MAX)); });
}

void Reader::tuples(const char* key, const uint8_t*& values, uint64_t& count, size_t width,
                    api::Choices choices) {
  read_tuples(key, values, count, width,
              [&](uint32_t value) { return static_cast<uint8_t>(choice_of(value, choices)); });
}

void Reader::named_values(const char* key, const msq_named_value*& values, uint64_t& count) {
  const uint32_t found = find(key);
  if (!found) return;
  expect(found, Kind::object);
  auto* all = arena_.take_array<msq_named_value>(tree_[found].count);
  values = all;
  count = tree_[found].count;
  if (count == 0) return;
  for (uint32_t value = tree_[found].first; value; value = tree_[value].next)
    *all++ = {tree_.key(value).c_str(), number_of(value)};
}

void Reader::equal_counts(const char* key, uint64_t count, const char* other,
                          uint64_t other_count) {
  if (count == other_count) return;
  const uint32_t found = tree_.member(object_, key);
  builder_.refuse(found ? found : object_, Status::argument,
                  "has " + counted(count, "element", "elements") + ", but " + other + " has " +
                      std::to_string(other_count));
}

void Reader::members(const char* key, const Part& part, const Part& defaults) {
  section(key, true, part, defaults);
}

bool Reader::section(const char* key, bool, const Part& part, const Part&) {
  const uint32_t found = find(key);
  if (!found) return false;
  Reader within(builder_, found, arena_);
  part(within);
  within.finish();
  return true;
}

void* Reader::room(const void* from, size_t bytes, uint64_t copied) {
  auto* block = static_cast<unsigned char*>(arena_.take(bytes));
  if (from && copied) std::copy_n(static_cast<const unsigned char*>(from), bytes, block);
  return block;
}

uint64_t Reader::list(const char* key, uint64_t, const std::function<void(uint64_t)>& prepare,
                      const std::function<void(DefinitionWalk&, uint64_t)>& part, const Part&) {
  const uint32_t found = find(key);
  if (!found) return 0;
  expect(found, Kind::list);
  prepare(tree_[found].count);
  uint64_t i = 0;
  each(found, [&](uint32_t value) {
    Reader within(builder_, value, arena_);
    part(within, i++);
    within.finish();
  });
  return i;
}

}  // namespace msq::document
