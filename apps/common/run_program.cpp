#include "apps/common/run_program.h"

#include <cstdio>
#include <iostream>
#include <new>
#include <system_error>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

int report(const CLI::App& app, const std::string& message, int code) {
  std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), message.c_str());
  if (code == kWrongUsage) std::fprintf(stderr, "%s --help lists the options\n", app.get_name().c_str());
  return code;
}

// The number of edits between two words (Levenshtein), for "did you mean".
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

std::string suggestion(const CLI::App& app, const std::string& mistyped) {
  const std::string word = mistyped.substr(0, mistyped.find('='));
  std::string best;
  std::size_t least = word.size() / 3 + 1;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      const std::size_t edits = distance(word, "--" + name);
      if (edits < least) {
        least = edits;
        best = "--" + name;
      }
    }
  }
  return best.empty() ? std::string() : " - did you mean " + best + "?";
}

}  // namespace

std::string version() { return VEX_VERSION; }

void not_built_yet(const std::string& what) {
  throw UsageError("not built yet (" + what + ") - it comes in a later version");
}

std::string command_line(int argc, char** argv) {
  std::string line;
  for (int k = 0; k < argc; ++k) {
    const std::string word = argv[k];
    const bool plain = !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
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

int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& action) {
  app.set_version_flag("--version", app.get_name() + " " + version(), "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ExtrasError&) {
    std::string words, advice;
    for (const std::string& word : app.remaining()) {
      words += (words.empty() ? "" : " ") + word;
      if (advice.empty()) advice = suggestion(app, word);
    }
    return report(app, "not understood (" + words + ")" + advice, kWrongUsage);
  } catch (const CLI::ParseError& error) {
    return report(app, error.what(), kWrongUsage);
  }
  try {
    const int code = action();
    std::cout.flush();
    if (!std::cout) return report(app, "standard output cannot be written", kFault);
    return code;
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
