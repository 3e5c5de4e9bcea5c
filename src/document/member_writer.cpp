// SPDX-License-Identifier: Apache-2.0
#include "document/member_writer.h"

#include <algorithm>
#include <vector>

#include "document/writer.h"

namespace msq::document {

namespace {

using namespace api;

class MemberWriter final : public DefinitionWalk {
 public:
  using DefinitionWalk::whole;

  /// are_defaults: of values that only serve to be compared with, and need not be right.
  MemberWriter(ModelWriter& writer, Output& to, bool are_defaults = false)
      : writer_(writer), to_(to), are_defaults_(are_defaults) {}

  void number(const char* key, double& value) override { raw(key, number_text(value)); }
  void numbers(const char* key, std::span<double> values, bool may_be_one) override {
    const bool is_one = may_be_one && std::all_of(values.begin(), values.end(),
                                                  [&](double v) { return v == values[0]; });
    raw(key, is_one ? number_text(values[0]) : listed(values));
  }
  bool optional_numbers(const char* key, bool is_there, std::span<double> values) override {
    if (is_there) numbers(key, values, false);
    return is_there;
  }
  void whole(const char* key, uint64_t& value, uint64_t) override {
    raw(key, std::to_string(value));
  }
  void wholes(const char* key, std::span<uint64_t> values, uint64_t) override {
    Output list{Output::Kind::list, {}, {}, {}};
    for (uint64_t value : values) list.items.push_back(Output::of_raw(std::to_string(value)));
    to_.add(key, std::move(list));
  }
  void truth(const char* key, int32_t& value) override { raw(key, value ? "true" : "false"); }
  void choice(const char* key, int32_t& value, Choices choices) override {
    if (!are_defaults_ || is_known(value, choices))
      raw(key, json_quoted(name_of(key, value, choices)));
  }
  void flags(const char* key, uint32_t& value, Choices choices) override {
    Output list{Output::Kind::list, {}, {}, {}};
    uint32_t known = 0;
    for (const Choice& choice : choices)
      if (value & static_cast<uint32_t>(choice.value)) {
        known |= static_cast<uint32_t>(choice.value);
        list.items.push_back(Output::of_raw(json_quoted(choice.name)));
      }
    if (known != value)
      fail(Status::argument, "%s is %u, which msq does not know", writer_.place_of(key).c_str(),
           value);
    to_.add(key, std::move(list));
  }
  void text(const char* key, const char*& value) override {
    if (value) raw(key, writer_.text(key, value));
  }
  void file(const char* key, const char*& value) override {
    if (value) raw(key, writer_.text(key, writer_.path(value)));
  }
  void param(const char* key, msq_param& value) override {
    if (value.field)
      object(key, value.field);
    else
      number(key, value.value);
  }
  void image(const char* key, msq_image& image, ImageSource& source) override {
    if (!image.values) return;  // the default
    const ModelWriter::Within within(writer_, key);
    Output of_image;
    MemberWriter in(writer_, of_image);
    in.file("file", source.file);
    if (source.file_count) in.files("files", source.files, source.file_count);
    const bool is_file = source.file || source.file_count;
    if (!is_file || !(source.is_nrrd || source.is_tiff)) {
      int32_t type = image.value_type;
      in.choice("value_type", type, image_types);
      in.wholes("size", image.size, 0);
    }
    if (source.file && source.skip_bytes) in.whole("skip_bytes", source.skip_bytes, 0);
    if (source.file && source.is_big_endian) in.raw("byte_order", "\"big\"");
    if (!is_file) in.raw("values", values_of(image));
    if (!source.is_nrrd || source.has_grid) {
      Output grid = document::written(
          writer_, [&](DefinitionWalk& of) { walk(of, image.grid); },
          [](DefinitionWalk& of) {
            auto defaults = defaults_of<msq_neighbourhood>();
            walk(of, defaults);
          });
      if (!grid.members.empty() || source.has_grid) of_image.add("grid", std::move(grid));
    }
    to_.add(key, std::move(of_image));
  }

  void object(const char* key, const msq_shape*& value) override { put(key, value); }
  void object(const char* key, const msq_field*& value) override { put(key, value); }
  void object(const char* key, const msq_structure*& value) override { put(key, value); }
  void object(const char* key, const msq_material*& value) override { put(key, value); }
  void objects(const char* key, const msq_shape* const*& values, uint64_t& count) override {
    put_all(key, values, count);
  }
  void objects(const char* key, const msq_structure* const*& values, uint64_t& count) override {
    put_all(key, values, count);
  }
  void objects(const char* key, const msq_model* const*& values, uint64_t& count) override {
    put_all(key, values, count);
  }

  void tuples(const char* key, const double*& values, uint64_t& count, size_t width) override {
    put_tuples(key, values, count, width, [](double value) { return number_text(value); });
  }
  void tuples(const char* key, const uint32_t*& values, uint64_t& count, size_t width) override {
    put_tuples(key, values, count, width, [](uint32_t value) { return std::to_string(value); });
  }
  void tuples(const char* key, const uint8_t*& values, uint64_t& count, size_t width,
              Choices choices) override {
    put_tuples(key, values, count, width,
               [&](uint8_t value) { return json_quoted(name_of(key, value, choices)); });
  }
  void named_values(const char* key, const msq_named_value*& values, uint64_t& count) override {
    Output named;
    for (uint64_t i = 0; values && i < count; ++i)
      named.add(values[i].name, Output::of_raw(number_text(values[i].value)));
    if (!named.members.empty()) to_.add(key, std::move(named));
  }
  void equal_counts(const char*, uint64_t, const char*, uint64_t) override {}

  void members(const char* key, const Part& part, const Part& defaults) override {
    const ModelWriter::Within within(writer_, key);
    Output written = document::written(writer_, part, defaults);
    if (!written.members.empty()) to_.add(key, std::move(written));
  }
  bool section(const char* key, bool is_there, const Part& part, const Part& defaults) override {
    const ModelWriter::Within within(writer_, key);
    if (is_there) to_.add(key, document::written(writer_, part, defaults));
    return is_there;
  }

 protected:
  void* room(const void* from, size_t, uint64_t) override { return const_cast<void*>(from); }
  uint64_t list(const char* key, uint64_t count, const std::function<void(uint64_t)>& prepare,
                const std::function<void(DefinitionWalk&, uint64_t)>& part,
                const Part& defaults) override {
    if (count == 0) return 0;
    prepare(count);
    const ModelWriter::Within within(writer_, key);
    Output list{Output::Kind::list, {}, {}, {}};
    for (uint64_t i = 0; i < count; ++i) {
      const ModelWriter::Within item(writer_, i);
      list.items.push_back(document::written(
          writer_, [&](DefinitionWalk& in) { part(in, i); }, defaults));
    }
    to_.add(key, std::move(list));
    return count;
  }

 private:
  void files(const char* key, const char* const* paths, uint64_t count) {
    Output list{Output::Kind::list, {}, {}, {}};
    for (uint64_t i = 0; i < count; ++i)
      list.items.push_back(Output::of_raw(writer_.text(key, writer_.path(paths[i]))));
    to_.add(key, std::move(list));
  }
  static bool is_known(int32_t value, Choices choices) {
    return std::any_of(choices.begin(), choices.end(),
                       [&](const Choice& choice) { return choice.value == value; });
  }
  std::string name_of(const char* key, int32_t value, Choices choices) const {
    for (const Choice& choice : choices)
      if (choice.value == value) return choice.name;
    fail(Status::argument, "%s is %d, which msq does not know", writer_.place_of(key).c_str(),
         value);
  }
  static std::string listed(std::span<const double> values) {
    std::string text = "[";
    for (double value : values) text.append(text.size() > 1 ? ", " : "").append(number_text(value));
    return text + "]";
  }
  void raw(const char* key, std::string text) { to_.add(key, Output::of_raw(std::move(text))); }

  template <class Handle>
  void put(const char* key, const Handle* handle) {
    if (!handle) return;
    const ModelWriter::Within within(writer_, key);
    to_.add(key, writer_.object(api::object(handle, key)));
  }
  template <class Handle>
  void put_all(const char* key, const Handle* const* handles, uint64_t count) {
    if (!handles) return;
    const ModelWriter::Within within(writer_, key);
    Output list{Output::Kind::list, {}, {}, {}};
    for (uint64_t i = 0; i < count; ++i) {
      const ModelWriter::Within item(writer_, i);
      list.items.push_back(writer_.object(api::object(handles[i], key)));
    }
    to_.add(key, std::move(list));
  }

  /// As a text with several tuples per line.
  template <class T, class TextOf>
  void put_tuples(const char* key, const T* values, uint64_t count, size_t width,
                  TextOf&& text_of) {
    if (!values || count == 0) return;
    writer_.check_count(key, checked_product(count, width, key));
    raw(key, lines(values, count, width, text_of));
  }
  template <class T, class TextOf>
  static std::string lines(const T* values, uint64_t count, size_t width, TextOf&& text_of) {
    constexpr size_t max_line = 90;
    std::string text = "[";
    size_t line = 0;
    for (uint64_t i = 0; i < count; ++i) {
      std::string tuple = width > 1 ? "[" : "";
      for (size_t k = 0; k < width; ++k)
        tuple.append(k ? ", " : "").append(text_of(values[i * width + k]));
      if (width > 1) tuple += ']';
      if (i > 0) text += ",";
      if (line + tuple.size() > max_line) {
        text += "\n";
        line = 0;
      } else if (i > 0) {
        text += " ";
      }
      text += tuple;
      line += tuple.size() + 2;
    }
    return text + "]";
  }
  std::string values_of(const msq_image& image) const {
    uint64_t count = 1;
    for (uint64_t size : image.size) count = checked_product(count, size, "an image");
    writer_.check_count("values", count);
    const auto as = [&]<class T>(const T* values) {
      return lines(values, count, 1,
                   [](T value) { return number_text(static_cast<double>(value)); });
    };
    switch (image.value_type) {
      case MSQ_UINT8:
        return as(static_cast<const uint8_t*>(image.values));
      case MSQ_INT16:
        return as(static_cast<const int16_t*>(image.values));
      case MSQ_UINT16:
        return as(static_cast<const uint16_t*>(image.values));
      case MSQ_FLOAT32:
        return as(static_cast<const float*>(image.values));
      default:
        return as(static_cast<const double*>(image.values));
    }
  }

  ModelWriter& writer_;
  Output& to_;
  bool are_defaults_;
};

/// Whether a text has a number that is not finite, which no text in JSON has outside quotes.
bool is_finite(const Output& value) {
  return value.kind != Output::Kind::raw || value.raw.starts_with('"') ||
         (value.raw.find("inf") == std::string::npos && value.raw.find("nan") == std::string::npos);
}

}  // namespace

Output written(ModelWriter& writer, const DefinitionWalk::Part& part,
               const DefinitionWalk::Part& defaults) {
  Output all, without;
  MemberWriter of_defaults(writer, without, true);
  defaults(of_defaults);
  MemberWriter of_part(writer, all);
  part(of_part);
  std::erase_if(all.members, [&](const auto& member) {
    return std::find(without.members.begin(), without.members.end(), member) !=
           without.members.end();
  });
  for (const auto& [key, value] : all.members)
    if (!is_finite(value))
      fail(Status::argument, "%s is %s; a document has finite numbers only",
           writer.place_of(key).c_str(), value.raw.substr(0, 60).c_str());
  return all;
}

}  // namespace msq::document
