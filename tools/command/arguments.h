// SPDX-License-Identifier: Apache-2.0
// The command line as it was given, checked against the table of options.
#ifndef MSQ_COMMAND_ARGUMENTS_H
#define MSQ_COMMAND_ARGUMENTS_H

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "options.h"

namespace command {

class Arguments {
 public:
  // Parses what follows the name of the command. Throws UsageError.
  Arguments(const Command& command, int argc, const char* const* argv);

  const Command& command() const { return *command_; }
  // --help was among the options; nothing else is known then.
  bool wants_help() const { return wants_help_; }

  bool has(std::string_view option) const { return values_.contains(option); }
  // "" if it is not there.
  const std::string& text(std::string_view option) const;
  // Operand i of the command; "" if it was left out.
  const std::string& operand(size_t i) const;

  // Each throws UsageError, with the option and its value, if the text is no such number, or
  // one below min or above max.
  double number(std::string_view option, double otherwise) const;
  uint64_t count(std::string_view option, uint64_t otherwise, uint64_t max = UINT64_MAX,
                 uint64_t min = 0) const;
  // Numbers with commas between them. sizes: how many there may be.
  std::vector<double> numbers(std::string_view option, std::initializer_list<size_t> sizes) const;
  // One number for all three axes, or three.
  void sizes(std::string_view option, double out[3]) const;
  // 512, 512K, 512M, 4G, 1T, with or without B or iB behind it. 0 if it is not there.
  uint64_t bytes(std::string_view option) const;
  // Index of the word in the list of the table.
  size_t word(std::string_view option) const;

  // Throws UsageError unless the option is there.
  void require(std::string_view option) const;
  // A UsageError about an option: "--name: why".
  [[noreturn]] void refuse(std::string_view option, const std::string& why) const;

 private:
  const Command* command_;
  bool wants_help_ = false;
  std::map<std::string, std::string, std::less<>> values_;
  std::vector<std::string> operands_;
};

}  // namespace command

#endif
