// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>

#include "failure.h"
#include "text.h"

namespace command {

namespace {

const std::string NOTHING;

std::string names_of(const Option& option) {
  std::string names = "--" + std::string(option.name);
  if (option.letter) names = std::string("-") + option.letter + "," + names;
  return names;
}

std::string in_quotes(std::string_view value) {
  return "'" + std::string(value) + "'";
}

// "--name=" has no value. The parser would take the next argument for it.
void refuse_missing_values(int argc, const char* const* argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view text = argv[i];
    if (text == "--") return;
    if (text.starts_with("--") && text.ends_with('=')) {
      throw UsageError(std::string(text.substr(0, text.size() - 1)) +
                       ": the value behind = is missing");
    }
  }
}

}  // namespace

Arguments::Arguments(const Command& command, int argc, const char* const* argv)
    : command_(&command), operands_(command.operands.size()) {
  CLI::App app;
  app.set_help_flag("-h,--help");
  for (const Group& group : command.groups) {
    for (const Option& option : group.options) {
      const std::string name(option.name);
      if (name == "help") continue;
      if (option.kind == Value::NONE) {
        app.add_flag_callback(names_of(option), [this, name] { values_[name] = ""; });
      } else {
        app.add_option_function<std::string>(
            names_of(option), [this, name](const std::string& value) { values_[name] = value; });
      }
    }
  }
  std::vector<const CLI::Option*> operands;
  for (size_t i = 0; i < command.operands.size(); ++i) {
    const Operand& operand = command.operands[i];
    operands.push_back(
        app.add_option(std::string(operand.name), operands_[i])->required(operand.is_required));
  }
  refuse_missing_values(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    wants_help_ = true;
    return;
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  for (const auto& [name, value] : values_) {
    const Value kind = find_option(command, name)->kind;
    if (kind == Value::WORDS) word(name);
    if (kind == Value::FILE && value.empty()) refuse(name, "'' is no name of a file");
  }
  for (size_t i = 0; i < operands.size(); ++i) {
    if (operands[i]->count() > 0 && operands_[i].empty()) {
      throw UsageError(std::string(command.operands[i].name) + ": '' is no name of a file");
    }
  }
}

const std::string& Arguments::text(std::string_view option) const {
  const auto found = values_.find(option);
  return found == values_.end() ? NOTHING : found->second;
}

const std::string& Arguments::operand(size_t i) const {
  return i < operands_.size() ? operands_[i] : NOTHING;
}

double Arguments::number(std::string_view option, double otherwise) const {
  if (!has(option)) return otherwise;
  const std::optional<double> value = to_number(text(option));
  if (!value) refuse(option, in_quotes(text(option)) + " is not a number");
  return *value;
}

uint64_t Arguments::count(std::string_view option, uint64_t otherwise, uint64_t max,
                          uint64_t min) const {
  if (!has(option)) return otherwise;
  const std::optional<uint64_t> value = to_count(text(option));
  if (!value || *value < min || *value > max) {
    refuse(option, in_quotes(text(option)) + " is not a whole number from " + std::to_string(min) +
                       " to " + std::to_string(max));
  }
  return *value;
}

std::vector<double> Arguments::numbers(std::string_view option,
                                       std::initializer_list<size_t> sizes) const {
  std::vector<double> found;
  for (const std::string_view part : split(text(option), ',')) {
    const std::optional<double> value = to_number(part);
    if (!value) refuse(option, in_quotes(part) + " is not a number");
    found.push_back(*value);
  }
  if (std::find(sizes.begin(), sizes.end(), found.size()) == sizes.end()) {
    std::string wanted;
    for (const size_t size : sizes) {
      wanted += (wanted.empty() ? "" : " or ") + std::to_string(size);
    }
    refuse(option, in_quotes(text(option)) + " has " + std::to_string(found.size()) +
                       " numbers, and must have " + wanted);
  }
  return found;
}

void Arguments::sizes(std::string_view option, double out[3]) const {
  const std::vector<double> given = numbers(option, {1, 3});
  for (size_t i = 0; i < 3; ++i) out[i] = given.size() == 1 ? given[0] : given[i];
}

uint64_t Arguments::bytes(std::string_view option) const {
  if (!has(option)) return 0;
  std::string_view rest = text(option);
  if (rest.ends_with("iB")) rest.remove_suffix(2);
  if (rest.ends_with("B")) rest.remove_suffix(1);
  int shift = 0;
  constexpr std::string_view UNITS = "KMGT";
  const size_t unit = rest.empty() ? UNITS.npos : UNITS.find(rest.back());
  if (unit != UNITS.npos) {
    shift = 10 * (static_cast<int>(unit) + 1);
    rest.remove_suffix(1);
  }
  const std::optional<double> value = to_number(rest);
  const double bytes = value ? *value * static_cast<double>(uint64_t{1} << shift) : 0;
  if (!value || !(bytes >= 1) || !(bytes < 9e18)) {
    refuse(option, in_quotes(text(option)) + " is not a size such as 512M or 4G");
  }
  return static_cast<uint64_t>(bytes);
}

size_t Arguments::word(std::string_view option) const {
  const std::vector<std::string_view> words = split(find_option(*command_, option)->words, ' ');
  const auto found = std::find(words.begin(), words.end(), text(option));
  if (found == words.end()) {
    std::string list;
    for (const std::string_view word : words)
      list += (list.empty() ? "" : ", ") + std::string(word);
    refuse(option, in_quotes(text(option)) + " is none of " + list);
  }
  return static_cast<size_t>(found - words.begin());
}

void Arguments::require(std::string_view option) const {
  if (!has(option)) {
    throw UsageError("msq " + std::string(command_->name) + " needs --" + std::string(option));
  }
}

void Arguments::refuse(std::string_view option, const std::string& why) const {
  throw UsageError("--" + std::string(option) + ": " + why);
}

}  // namespace command
