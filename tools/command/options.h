// SPDX-License-Identifier: Apache-2.0
// The table of commands and options. The parser, --help, the man page and the completions of shells
// are all made from it.
#ifndef MSQ_COMMAND_OPTIONS_H
#define MSQ_COMMAND_OPTIONS_H

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace command {

class Arguments;

// What the value of an option or an operand is, as a shell completes it.
enum class Value {
  NONE,   // a flag
  TEXT,   // numbers, expressions: nothing to complete
  WORDS,  // one of a list of words
  FILE,
};

struct Option {
  std::string_view name;   // without dashes
  char letter;             // of the short form; 0: none
  std::string_view value;  // how the help names the value; "" for a flag
  Value kind;
  std::string_view words;  // WORDS: separated by spaces
  std::string_view help;   // begins with a small letter and has no full stop at its end
};

// Options under one heading of the help.
struct Group {
  std::string_view title;
  std::span<const Option> options;
};

struct Operand {
  std::string_view name;
  bool is_required;
  std::string_view help;
};

struct Command {
  std::string_view name;
  std::string_view summary;  // a line
  std::string_view text;     // sentences
  std::vector<Operand> operands;
  std::vector<Group> groups;
  std::vector<std::string_view> examples;  // lines of a shell
  void (*run)(const Arguments& arguments);
};

struct ExitCode {
  std::string_view status;
  std::string_view meaning;
};

std::span<const Command> commands();
std::span<const Option> main_options();
std::span<const ExitCode> exit_codes();

// NULL if there is none of that name.
const Command* find_command(std::string_view name);
const Option* find_option(const Command& command, std::string_view name);

// Texts made from the table.
std::string main_help();
std::string command_help(const Command& command);
std::string manual_page();  // roff, for man
std::string bash_completion();
std::string zsh_completion();

// The sub-commands.
void run_calibrate(const Arguments& arguments);
void run_info(const Arguments& arguments);
void run_mesh(const Arguments& arguments);
void run_model(const Arguments& arguments);
void run_query(const Arguments& arguments);
void run_render(const Arguments& arguments);
void run_slice(const Arguments& arguments);
void run_stats(const Arguments& arguments);
void run_struts(const Arguments& arguments);

}  // namespace command

#endif
