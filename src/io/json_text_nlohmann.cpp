// SPDX-License-Identifier: Apache-2.0
// JSON by nlohmann-json. Its parser keeps no stack but one bit per open list or object, and reports
// values one by one. They become a tree here, whose size and depth are bounded while it grows.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/status.h"
#include "io/json_text.h"

namespace msq {

namespace {

using nlohmann::json;

/// Bytes of a text, which tell how far they were read.
class CountedBytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountedBytes(const char* at, const char** read) : at_(at), read_(read) {}
  const char& operator*() const { return *at_; }
  CountedBytes& operator++() {
    *read_ = ++at_;
    return *this;
  }
  CountedBytes operator++(int) {
    CountedBytes before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountedBytes& other) const { return at_ == other.at_; }
  bool operator!=(const CountedBytes& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** read_;
};

/// What the parser says, without the name of its exception and its own line and column.
std::string reason(const std::string& message) {
  size_t from = message.find(", column ");
  from =
      message.find(from == std::string::npos ? "] " : ": ", from == std::string::npos ? 0 : from);
  return from == std::string::npos ? message : message.substr(from + 2);
}

}  // namespace

/// Receives the events of the parser.
class JsonBuilder : public nlohmann::json_sax<json> {
 public:
  JsonBuilder(JsonTree& tree, std::string_view text, const JsonLimits& limits, const Job* job)
      : tree_(tree), text_(text), limits_(limits), read_(text.data()), poll_(job) {}

  void parse() {
    // The parser takes it for the end of the text.
    if (const size_t zero = text_.find('\0'); zero != std::string_view::npos)
      fail_at(Status::argument, zero, "the text has the character 0, which JSON does not have");
    // Events come after the last byte of what they report, and perhaps the one behind it.
    const CountedBytes begin(text_.data(), &read_), end(text_.data() + text_.size(), &read_);
    json::sax_parse(begin, end, this, json::input_format_t::json, true);
  }

  bool null() override {
    add(JsonValue::Kind::null);
    return true;
  }
  bool boolean(bool value) override {
    add(JsonValue::Kind::truth).whole = value;
    return true;
  }
  bool number_integer(number_integer_t value) override {  // negative, or -0
    add(JsonValue::Kind::number).number = value == 0 ? -0.0 : static_cast<double>(value);
    return true;
  }
  bool number_unsigned(number_unsigned_t value) override {
    add(JsonValue::Kind::whole).whole = value;
    return true;
  }
  bool number_float(number_float_t value, const string_t&) override {
    add(JsonValue::Kind::number).number = value;
    return true;
  }
  bool string(string_t& value) override {
    const uint64_t text = tree_.texts_.size();
    keep(value);
    add(JsonValue::Kind::text).text = text;
    return true;
  }
  bool binary(binary_t&) override { return false; }  // not in text
  bool start_object(std::size_t) override { return open(JsonValue::Kind::object); }
  bool end_object() override {
    check_keys(open_.back().value);
    open_.pop_back();
    begin_next();
    return true;
  }
  bool start_array(std::size_t) override { return open(JsonValue::Kind::list); }
  bool end_array() override {
    open_.pop_back();
    begin_next();
    return true;
  }
  bool key(string_t& value) override {
    key_offset_ = start();
    key_ = static_cast<uint32_t>(tree_.texts_.size());
    keep(value);
    begin_next();
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const json::exception& error) override {
    fail_at(Status::argument, position > 0 ? position - 1 : 0, reason(error.what()));
  }

 private:
  struct Open {
    uint32_t value, last;  ///< the list or object, and the last value in it
  };

  [[noreturn]] void fail_at(Status status, uint64_t offset, const std::string& message) const {
    throw Error(status, json_place(text_, offset) + ": " + message);
  }

  /// Where the value or key begins that the parser has just read: behind what was read before it
  /// and the space, commas and colons that follow.
  uint64_t start() const {
    size_t at = behind_;
    if (at == 0 && text_.substr(0, 3) == "\xef\xbb\xbf") at = 3;
    at = text_.find_first_not_of(" \t\r\n,:", at);
    return at == std::string_view::npos ? text_.size() : at;
  }
  void begin_next() { behind_ = static_cast<size_t>(read_ - text_.data()); }

  JsonValue& add(JsonValue::Kind kind) {
    poll_();
    const uint64_t number = tree_.values_.size();
    const bool is_member =
        !open_.empty() && tree_.values_[open_.back().value].kind == JsonValue::Kind::object;
    const uint64_t offset = is_member ? key_offset_ : start();
    begin_next();
    if (number >= std::min<uint64_t>(limits_.max_values, UINT32_MAX - 1))
      fail_at(Status::limit, offset,
              "the document has more than " + std::to_string(limits_.max_values) +
                  " values; max_values is as many");
    JsonValue value{kind, is_member ? key_ : 0, 0, 0, offset, {0}};
    value.count = 0;
    tree_.values_.push_back(value);
    if (!open_.empty()) {
      Open& in = open_.back();
      if (tree_.values_[in.value].count++ == 0)
        tree_.values_[in.value].first = static_cast<uint32_t>(number);
      else
        tree_.values_[in.last].next = static_cast<uint32_t>(number);
      in.last = static_cast<uint32_t>(number);
    }
    return tree_.values_.back();
  }

  bool open(JsonValue::Kind kind) {
    const JsonValue& value = add(kind);
    if (open_.size() >= limits_.max_depth)
      fail_at(Status::limit, value.offset,
              "lists and objects are deeper within each other than max_depth, " +
                  std::to_string(limits_.max_depth));
    const auto number = static_cast<uint32_t>(tree_.values_.size() - 1);
    open_.push_back({number, number});
    return true;
  }

  void keep(std::string& text) {
    if (text.find('\0') != std::string::npos)
      fail_at(Status::argument, start(), "a text has the character 0, which no text may have");
    tree_.texts_.push_back(std::move(text));
  }

  void check_keys(uint32_t object) const {
    std::vector<uint32_t> members;
    if (tree_[object].count > 0)
      for (uint32_t value = tree_[object].first; value; value = tree_[value].next)
        members.push_back(value);
    std::stable_sort(members.begin(), members.end(),
                     [&](uint32_t a, uint32_t b) { return tree_.key(a) < tree_.key(b); });
    for (size_t i = 1; i < members.size(); ++i)
      if (tree_.key(members[i]) == tree_.key(members[i - 1]))
        fail_at(Status::argument, tree_[members[i]].offset,
                "the key " + json_quoted(tree_.key(members[i])) +
                    " is there twice; it is also in line and column " +
                    json_place(text_, tree_[members[i - 1]].offset));
  }

  JsonTree& tree_;
  std::string_view text_;
  const JsonLimits& limits_;
  const char* read_;
  size_t behind_ = 0;  ///< the end of the last value or key
  uint64_t key_offset_ = 0;
  uint32_t key_ = 0;
  std::vector<Open> open_;
  PollEvery<1024> poll_;
};

bool can_read_json() {
  return true;
}

JsonTree::JsonTree(std::string_view text, const JsonLimits& limits, const Job* job)
    : source_(text), texts_(1) {
  JsonBuilder(*this, text, limits, job).parse();
}

std::string json_quoted(std::string_view text) {
  try {
    return json(text).dump();
  } catch (const json::exception&) {
    fail(Status::unsupported, "a text that is to be written is not UTF-8");
  }
}

}  // namespace msq
