// SPDX-License-Identifier: Apache-2.0
// The command msq: finds the sub-command, runs it, and turns what went wrong into one line and an
// exit status.
#include <cstdio>
#include <new>

#include "arguments.h"
#include "failure.h"
#include "options.h"
#include "output_file.h"
#include "text.h"
#include "watch.h"

namespace command {

namespace {

void print(const std::string& text) {
  OutputFile out("-");
  out.write(text);
  out.commit();
}

std::string version() {
  const uint32_t found = msq_version();
  return "msq " + std::to_string(found / 10000) + "." + std::to_string(found / 100 % 100) + "." +
         std::to_string(found % 100) + "\n";
}

// Options in place of a command.
void run_main_option(std::string_view text, std::string_view value) {
  if (text == "-h" || text == "--help") return print(main_help());
  if (text == "-V" || text == "--version") return print(version());
  if (text == "--man") return print(manual_page());
  constexpr std::string_view COMPLETION = "--completion";
  const bool has_value = text.starts_with("--completion=");
  if (text == COMPLETION || has_value) {
    if (has_value) value = text.substr(COMPLETION.size() + 1);
    if (value == "bash") return print(bash_completion());
    if (value == "zsh") return print(zsh_completion());
    throw UsageError("--completion: '" + std::string(value) + "' is none of bash, zsh");
  }
  throw UsageError("'" + std::string(text) + "' is no option; msq --help lists them");
}

void run(int argc, char** argv) {
  if (argc < 2) throw UsageError("a command is missing; msq --help lists them");
  const std::string_view name = argv[1];
  if (name.starts_with('-')) return run_main_option(name, argc > 2 ? argv[2] : "");
  const Command* command = find_command(name);
  if (!command) {
    throw UsageError("'" + std::string(name) + "' is no command; msq --help lists them");
  }
  const Arguments arguments(*command, argc - 1, argv + 1);
  if (arguments.wants_help()) return print(command_help(*command));
  command->run(arguments);
}

int run_guarded(int argc, char** argv) {
  try {
    run(argc, argv);
    return EXIT_DONE;
  } catch (const Interrupted&) {
    say("interrupted");
    return EXIT_SIGNALLED + caught_signal();
  } catch (const UsageError& error) {
    say(error.what());
    return EXIT_USAGE;
  } catch (const Failure& failure) {
    say(failure.what());
  } catch (const std::bad_alloc&) {
    say("out of memory");
  } catch (const std::exception& error) {
    say(error.what());
  }
  return EXIT_FAILED;
}

}  // namespace

}  // namespace command

int main(int argc, char** argv) {
  command::start_watch();
  const int status = command::run_guarded(argc, argv);
  command::stop_watch();
  return status;
}
