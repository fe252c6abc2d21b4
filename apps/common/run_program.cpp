#include "apps/common/run_program.h"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/common/help_formatter.h"
#include "apps/common/interrupt.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/scene/threads.h"
#include "shapes/closest_word.h"

namespace vex {
namespace {

// One line; what to do is at least to look into the help.
int report(const CLI::App& app, const std::string& message, int code) {
  std::string line = app.get_name() + ": " + message;
  if (code == kWrongUsage && message.find(" - ") == std::string::npos) {
    line += " - " + app.get_name() + " --help lists the options";
  }
  std::fprintf(stderr, "%s\n", printable(line).c_str());
  return code;
}

// A caller may have closed them; then the next file that is opened would take their place, and a report or a message
// would go into it. Writing to what stands in for standard output fails, as it should.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1 && errno == EBADF) {
      static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
  }
}

// CLI11 names the option first and explains in terms of its own.
std::string problem_in_words(CLI::App& app, const CLI::ParseError& error) {
  const std::string text = error.what();
  std::string name = text.substr(0, text.find_first_of(": "));
  const CLI::Option* option = app.get_option_no_throw(name);
  if (option == nullptr) {
    name = "--" + name;
    option = app.get_option_no_throw(name);
  }
  if (option == nullptr) return text;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    return "nothing is given for " + name + " - " + option->get_description();
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    if (option->get_expected_max() == 0) return "an option takes no value (" + name + ") - give it alone";
    if (option->count() > 1) return "an option is given more than once (" + name + ") - give it once";
    return "a value is missing (after " + name + ") - write " + name + " " + option->get_type_name();
  }
  if (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr) {
    return "an empty text is no value (for " + name + ") - give one, or leave it out";
  }
  return text;
}

std::string suggestion(const CLI::App& app, const std::string& mistyped) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string meant = closest_word(mistyped.substr(0, mistyped.find('=')), names);
  return meant.empty() ? std::string() : " - did you mean " + meant + "?";
}

bool is_first_copy() {
  for (const char* const name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK"}) {
    if (const char* const rank = std::getenv(name)) return std::string_view(rank) == "0";
  }
  return true;
}

}  // namespace

std::string version() { return VEX_VERSION; }

// Open MPI's mpirun, PMIx and PMI, as Slurm and MPICH have them.
int n_copies_started() {
  for (const char* const name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* const size = std::getenv(name)) return std::max(std::atoi(size), 1);
  }
  return std::getenv("PMIX_RANK") != nullptr ? 0 : 1;
}

std::string command_line(int argc, char** argv) {
  std::string line;
  for (int k = 0; k < argc; ++k) {
    const std::string word = argv[k];
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=.,:/@%") == std::string::npos;
    if (!line.empty()) line += ' ';
    if (plain) {
      line += word;
    } else {
      line += '\'';
      for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
      line += '\'';
    }
  }
  return line;
}

int run_program(OptionParser& options, int argc, char** argv, const std::function<int()>& action, bool shares_work) {
  CLI::App& app = options.app();
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_version_flag("--version", app.get_name() + " " + version(), "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  hold_standard_streams();
  end_on_interrupts(app.get_name());
  std::signal(SIGPIPE, SIG_IGN);  // a reader that went away is a write that fails, and --json FILE is still written
  const auto written = [&app](int code) { return std::cout.flush() ? code : report(app, kNoStandardOutput, kFault); };
  for (CLI::Option* option : app.get_options()) {
    option->check([](const std::string& word) { return word.empty() ? "empty" : ""; }, "");
    if (option->get_expected_max() == 0) option->disable_flag_override();
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    app.exit(help_or_version);
    return written(kSuccess);
  } catch (const CLI::ExtrasError&) {
    std::string words, advice;
    for (const std::string& word : app.remaining()) {
      words += (words.empty() ? "" : " ") + word;
      if (advice.empty()) advice = suggestion(app, word);
    }
    return report(app, "not understood (" + words + ")" + advice, kWrongUsage);
  } catch (const CLI::ParseError& error) {
    return report(app, problem_in_words(app, error), kWrongUsage);
  }
  if (const int n = n_copies_started(); n > 1 && !shares_work && is_first_copy()) {
    report(app,
           std::to_string(n) +
               " copies were started together, and each of them does all of the work - start one, or give "
               "each its own seed and outputs",
           kSuccess);
  }
  try {
    const int code = action();
    if (const std::optional<ThreadShortage> shortage = thread_shortage()) {
      report(
          app,
          "this system gave " + std::to_string(shortage->n_had) + " of " + std::to_string(shortage->n_wanted) +
              " threads, which costs time and changes no result - look at ulimit -u and at what confines the program",
          code);
    }
    return written(code);
  } catch (const UsageError& error) {
    return report(app, error.what(), kWrongUsage);
  } catch (const InputError& error) {
    return report(app, error.what(), kInputRefused);
  } catch (const std::bad_alloc&) {
    return report(app, "the input is too large for this machine's memory", kInputRefused);
  } catch (const std::exception& error) {
    return report(app, error.what(), kFault);
  }
}

}  // namespace vex
