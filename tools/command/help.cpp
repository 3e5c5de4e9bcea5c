// SPDX-License-Identifier: Apache-2.0
// Help, the manual page and completions, made from the table of options.
#include <msq.h>

#include <set>

#include "options.h"
#include "text.h"

namespace command {

namespace {

constexpr size_t WIDTH = 80, COLUMN = 26;
constexpr char ABOUT[] =
    "fills parts with lattices, foams and periodic surfaces without meshing them";
constexpr char DESCRIPTION[] =
    "msq fills a coarse part with one or more fine structures and slices, draws, measures and "
    "samples the result, without a mesh. Memory does not grow with the part. Lengths are in "
    "millimetres unless a model file says otherwise.";
constexpr char CONDUCT[] =
    "Results go to files or to standard output, everything else to standard error. A file gets its "
    "name when it is complete. After a failure there is no new file, and an existing one is "
    "unchanged. On a terminal, long work shows its progress, its rate and the time left. "
    "Ctrl-C ends the work in good order; a second one ends it at once. Numbers have a decimal "
    "point in all locales.";

// Words with at most `width` characters a line. The first line begins at column `at`.
std::string wrapped(std::string_view text, size_t indent, size_t at, size_t width = WIDTH) {
  std::string out;
  bool is_first = true;
  for (const std::string_view word : split(text, ' ')) {
    if (!is_first && at + 1 + word.size() > width) {
      out += '\n';
      out.append(indent, ' ');
      at = indent;
    } else if (!is_first) {
      out += ' ';
      ++at;
    }
    out += word;
    at += word.size();
    is_first = false;
  }
  return out + "\n";
}

std::string choices(const Option& option) {
  if (option.kind != Value::WORDS) return "";
  std::string text;
  for (const std::string_view word : split(option.words, ' ')) {
    text += (text.empty() ? ": " : ", ") + std::string(word);
  }
  return text;
}

std::string option_lines(const Option& option) {
  std::string text = option.letter ? std::string("  -") + option.letter + ", " : "      ";
  text += "--" + std::string(option.name);
  if (!option.value.empty()) text += " " + std::string(option.value);
  if (text.size() + 2 > COLUMN) {
    text += '\n';
    text.append(COLUMN, ' ');
  } else {
    text.append(COLUMN - text.size(), ' ');
  }
  return text + wrapped(std::string(option.help) + choices(option), COLUMN, COLUMN);
}

std::string usage_of(const Command& command) {
  std::string text = "msq " + std::string(command.name);
  for (const Operand& operand : command.operands) {
    text += operand.is_required ? " " + std::string(operand.name)
                                : " [" + std::string(operand.name) + "]";
  }
  return text + " [options]";
}

// Text of roff: no command at the start of a line, dashes that can be copied.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) {
      out += "\\&";
      out += c;
    } else {
      out += c;
    }
  }
  return out;
}

// Sentences, one to a line, as man wants them.
std::string roff_sentences(std::string_view text) {
  std::string lines;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool ends = text[i] == ' ' && i > 0 && text[i - 1] == '.';
    lines += ends ? '\n' : text[i];
  }
  return roff(lines) + "\n";
}

std::string roff_option(const Option& option) {
  std::string text = ".TP\n";
  if (option.letter) text += "\\fB\\-" + std::string(1, option.letter) + "\\fR, ";
  text += "\\fB" + roff("--" + std::string(option.name)) + "\\fR";
  if (!option.value.empty()) text += " \\fI" + roff(option.value) + "\\fR";
  return text + "\n" + roff(std::string(option.help) + choices(option)) + "\n";
}

std::string roff_command(const Command& command, std::set<std::string_view>& described) {
  std::string text = ".SS " + roff("msq " + std::string(command.name)) + "\n";
  text += "\\fB" + roff("msq " + std::string(command.name)) + "\\fR";
  for (const Operand& operand : command.operands) {
    text += operand.is_required ? " \\fI" + std::string(operand.name) + "\\fR"
                                : " [\\fI" + std::string(operand.name) + "\\fR]";
  }
  text += " [\\fIoptions\\fR]\n.PP\n" + roff_sentences(command.text);
  std::string shared;
  for (const Group& group : command.groups) {
    if (described.contains(group.title)) {
      shared +=
          (shared.empty() ? "" : ", ") + std::string(group.title.substr(0, group.title.find(" (")));
      continue;
    }
    for (const Option& option : group.options) text += roff_option(option);
  }
  if (!shared.empty()) text += ".PP\nOptions in sections below: " + roff(shared) + ".\n";
  return text;
}

// Groups that more than one command has, in the order in which they occur.
std::vector<Group> shared_groups() {
  std::vector<Group> found;
  std::set<std::string_view> once, twice;
  for (const Command& command : commands()) {
    for (const Group& group : command.groups) {
      if (!once.insert(group.title).second && twice.insert(group.title).second) {
        found.push_back(group);
      }
    }
  }
  return found;
}

// Text between single quotes of a shell.
std::string shell(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

std::string main_help() {
  std::string text = "usage: msq COMMAND [options]\nmsq " + wrapped(ABOUT, 0, 4) + "\nCommands\n";
  for (const Command& command : commands()) {
    std::string line = "  " + std::string(command.name);
    line.append(COLUMN - 12 - line.size(), ' ');
    text += line + wrapped(command.summary, COLUMN - 12, COLUMN - 12);
  }
  text += "\nOptions\n";
  for (const Option& option : main_options()) text += option_lines(option);
  text += "\nExit status\n";
  for (const ExitCode& code : exit_codes()) {
    std::string line = "  " + std::string(code.status);
    line.append(COLUMN - line.size(), ' ');
    text += line + wrapped(code.meaning, COLUMN, COLUMN);
  }
  return text + "\nmsq COMMAND --help lists the options of a command.\n";
}

std::string command_help(const Command& command) {
  std::string text = "usage: " + usage_of(command) + "\n" + wrapped(command.text, 0, 0);
  if (!command.operands.empty()) text += '\n';
  for (const Operand& operand : command.operands) {
    std::string line = "  " + std::string(operand.name);
    line.append(COLUMN - line.size(), ' ');
    text += line + wrapped(operand.help, COLUMN, COLUMN);
  }
  for (const Group& group : command.groups) {
    text += "\n" + wrapped(group.title, 0, 0);
    for (const Option& option : group.options) text += option_lines(option);
  }
  text += command.examples.size() == 1 ? "\nExample\n" : "\nExamples\n";
  for (const std::string_view example : command.examples)
    text += "  " + std::string(example) + "\n";
  return text;
}

std::string manual_page() {
  std::string text =
      ".\\\" Made by msq --man; tests compare.\n.TH MSQ 1 \"\" \"msq " +
      std::to_string(MSQ_VERSION_MAJOR) + "." + std::to_string(MSQ_VERSION_MINOR) +
      "\" \"User Commands\"\n.SH NAME\nmsq \\- " + roff(ABOUT) +
      "\n.SH SYNOPSIS\n\\fBmsq\\fR \\fICOMMAND\\fR [\\fIoptions\\fR]\n.SH DESCRIPTION\n" +
      roff_sentences(DESCRIPTION) + ".PP\n" + roff_sentences(CONDUCT) + ".SH OPTIONS\n";
  for (const Option& option : main_options()) text += roff_option(option);
  const std::vector<Group> shared = shared_groups();
  std::set<std::string_view> described;
  for (const Group& group : shared) described.insert(group.title);
  text += ".SH COMMANDS\n";
  for (const Command& command : commands()) text += roff_command(command, described);
  text += ".SH OPTIONS OF SEVERAL COMMANDS\n";
  for (const Group& group : shared) {
    text += ".SS " + roff(group.title) + "\n";
    for (const Option& option : group.options) text += roff_option(option);
  }
  text += ".SH EXIT STATUS\n";
  for (const ExitCode& code : exit_codes()) {
    text += ".TP\n\\fB" + roff(code.status) + "\\fR\n" + roff(code.meaning) + "\n";
  }
  text += ".SH EXAMPLES\n.nf\n";
  for (const Command& command : commands()) {
    for (const std::string_view example : command.examples) text += roff(example) + "\n";
  }
  return text + ".fi\n";
}

std::string bash_completion() {
  std::string names;
  for (const Command& command : commands()) {
    names += (names.empty() ? "" : " ") + std::string(command.name);
  }
  std::string text =
      "# Completion of msq for bash, made by msq --completion bash; tests compare.\n"
      "_msq() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options=\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    mapfile -t COMPREPLY < <(compgen -W '" +
      names;
  for (const Option& option : main_options()) text += " --" + std::string(option.name);
  text += "' -- \"$word\")\n    return\n  fi\n  case $before in\n";
  std::set<std::string> seen;
  const auto add_values = [&](const Option& option) {
    if (option.kind == Value::NONE || !seen.insert(std::string(option.name)).second) return;
    std::string pattern = "--" + std::string(option.name);
    if (option.letter) pattern = std::string("-") + option.letter + " | " + pattern;
    text += "    " + pattern + ") ";
    if (option.kind == Value::WORDS) {
      text += "mapfile -t COMPREPLY < <(compgen -W '" + std::string(option.words) +
              "' -- \"$word\"); return";
    } else if (option.kind == Value::FILE) {
      text += "compopt -o default 2>/dev/null; return";
    } else {
      text += "return";
    }
    text += " ;;\n";
  };
  for (const Option& option : main_options()) add_values(option);
  for (const Command& command : commands()) {
    for (const Group& group : command.groups) {
      for (const Option& option : group.options) add_values(option);
    }
  }
  text += "  esac\n  case ${COMP_WORDS[1]} in\n";
  for (const Command& command : commands()) {
    text += "    " + std::string(command.name) + ") options='";
    bool is_first = true;
    for (const Group& group : command.groups) {
      for (const Option& option : group.options) {
        text += (is_first ? "--" : " --") + std::string(option.name);
        is_first = false;
      }
    }
    text += "' ;;\n";
  }
  return text +
         "  esac\n"
         "  if [[ $word == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$word\")\n"
         "  else\n"
         "    compopt -o default 2>/dev/null\n"
         "  fi\n"
         "}\n"
         "complete -F _msq msq\n";
}

std::string zsh_completion() {
  const auto described = [](std::string_view text) {
    std::string out;
    for (const char c : shell(text)) {
      if (c == '[' || c == ']' || c == ':') out += '\\';
      out += c;
    }
    return out;
  };
  std::string text =
      "#compdef msq\n"
      "# Completion of msq for zsh, made by msq --completion zsh; tests compare.\n"
      "_msq() {\n"
      "  local -a commands options\n"
      "  commands=(\n";
  for (const Command& command : commands()) {
    text += "    '" + std::string(command.name) + ":" + described(command.summary) + "'\n";
  }
  text +=
      "  )\n"
      "  if ((CURRENT == 2)) && [[ $PREFIX != -* ]]; then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n";
  const auto spec = [&](const Option& option) {
    std::string value;
    if (option.kind == Value::WORDS) {
      value = ":" + std::string(option.value) + ":(" + std::string(option.words) + ")";
    } else if (option.kind == Value::FILE) {
      value = ":" + std::string(option.value) + ":_files";
    } else if (option.kind == Value::TEXT) {
      value = ":" + described(option.value) + ": ";
    }
    const std::string help = "[" + described(option.help) + "]" + value;
    std::string lines = "      '--" + std::string(option.name) + help + "'\n";
    if (option.letter) lines += "      '-" + std::string(1, option.letter) + help + "'\n";
    return lines;
  };
  text += "  case $words[2] in\n";
  for (const Command& command : commands()) {
    text += "    " + std::string(command.name) + ") options=(\n";
    for (const Group& group : command.groups) {
      for (const Option& option : group.options) text += spec(option);
    }
    text += "    ) ;;\n";
  }
  text += "    *) options=(\n";
  for (const Option& option : main_options()) text += spec(option);
  return text +
         "    ) ;;\n"
         "  esac\n"
         "  _arguments -s $options '*:file:_files'\n"
         "}\n"
         "_msq \"$@\"\n";
}

}  // namespace command
