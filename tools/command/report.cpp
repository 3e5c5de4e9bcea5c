// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "output_file.h"
#include "text.h"

namespace command {

using Json = nlohmann::ordered_json;

struct Report::Values {
  Json json = Json::object();
};

namespace {

constexpr size_t NAME_WIDTH = 24;

std::string line_of(const Json& value) {
  if (value.is_null()) return "unknown";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) return rounded(value.get<double>(), 9);
  if (value.is_string()) return one_line(value.get<std::string>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& one : value) text += (text.empty() ? "" : " ") + line_of(one);
  return text;
}

std::string spaced(std::string text) {
  for (char& c : text) {
    if (c == '_') c = ' ';
  }
  return text;
}

// Objects of a list become the rows of a table.
void append_table(std::string& text, const Json& rows, const std::string& indent) {
  const auto add = [&](const std::string& cell, bool is_last) {
    text += cell;
    if (is_last) {
      text += '\n';
    } else {
      text.append(cell.size() < NAME_WIDTH - 2 ? NAME_WIDTH - 2 - cell.size() : 2, ' ');
    }
  };
  text += indent;
  size_t i = 0;
  for (const auto& [name, value] : rows.front().items()) {
    add(spaced(name), ++i == rows.front().size());
  }
  for (const Json& row : rows) {
    text += indent;
    i = 0;
    for (const Json& value : row) add(line_of(value), ++i == row.size());
  }
}

void append_lines(std::string& text, const Json& object, const std::string& indent) {
  for (const auto& [name, value] : object.items()) {
    text += indent + spaced(name);
    if (value.is_object()) {
      text += '\n';
      append_lines(text, value, indent + "  ");
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      text += '\n';
      append_table(text, value, indent + "  ");
    } else {
      const size_t used = indent.size() + name.size();
      text.append(used < NAME_WIDTH ? NAME_WIDTH - used : 1, ' ');
      text += line_of(value) + '\n';
    }
  }
}

}  // namespace

Report::Report() : values_(std::make_unique<Values>()) {}
Report::~Report() = default;
Report::Report(Report&&) noexcept = default;
Report& Report::operator=(Report&&) noexcept = default;

void Report::add(std::string_view name, double value) {
  values_->json[std::string(name)] = std::isfinite(value) ? Json(value) : Json(nullptr);
}
void Report::add(std::string_view name, uint64_t value) {
  values_->json[std::string(name)] = value;
}
void Report::add(std::string_view name, bool value) {
  values_->json[std::string(name)] = value;
}
void Report::add(std::string_view name, std::string_view value) {
  values_->json[std::string(name)] = std::string(value);
}
void Report::add(std::string_view name, const double* values, size_t count) {
  Json& list = values_->json[std::string(name)] = Json::array();
  for (size_t i = 0; i < count; ++i) {
    list.push_back(std::isfinite(values[i]) ? Json(values[i]) : Json(nullptr));
  }
}
void Report::add(std::string_view name, Report&& part) {
  values_->json[std::string(name)] = std::move(part.values_->json);
}
void Report::add(std::string_view name, std::vector<Report>&& parts) {
  Json& list = values_->json[std::string(name)] = Json::array();
  for (Report& part : parts) list.push_back(std::move(part.values_->json));
}

void Report::print(const Arguments& arguments) const {
  std::string text;
  if (arguments.has("json")) {
    text = values_->json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  } else {
    append_lines(text, values_->json, "");
  }
  OutputFile out(arguments.has("output") ? arguments.text("output") : "-");
  out.write(text);
  out.commit();
}

}  // namespace command
