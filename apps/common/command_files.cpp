#include "apps/common/command_files.h"

#include <unistd.h>

#include <algorithm>

#include "engine/numeric/errors.h"

namespace vex {
namespace {

// Into a terminal or /dev/null several outputs may go.
bool are_one(const FileIdentity& a, const FileIdentity& b) { return a == b && !a.is_character_device(); }

// In words, because a dash between blanks would look like the one before the advice.
std::string in_words(const std::string& path) { return path == "-" ? "standard output" : path; }

std::string both_names(const std::string& one, const std::string& option_of_one, const std::string& other,
                       const std::string& option_of_other) {
  if (one == other) return in_words(one) + " for " + option_of_one + " and " + option_of_other;
  return in_words(one) + " for " + option_of_one + ", " + in_words(other) + " for " + option_of_other;
}

}  // namespace

std::optional<OutputFile> CommandFiles::output(const std::string& option, const std::string& path,
                                               std::string_view mesh_extension) {
  if (path.empty()) return std::nullopt;
  OutputFile file(path, inputs_, mesh_extension);
  for (const Named& other : outputs_) {
    const bool both_standard = file.is_standard_output() && other.file.is_standard_output();
    if (!both_standard &&
        !(file.identity() && other.file.identity() && are_one(*file.identity(), *other.file.identity()))) {
      continue;
    }
    throw UsageError("one file for two outputs (" + both_names(other.file.path(), other.option, path, option) +
                     ") - give each its own");
  }
  if (file.is_standard_output()) require_no_input_behind_standard_output();
  outputs_.push_back({option, file});
  return file;
}

bool CommandFiles::own_standard_output() const {
  return std::ranges::any_of(outputs_, [](const Named& output) { return output.file.is_standard_output(); });
}

void CommandFiles::print_report() {
  if (own_standard_output()) return;
  require_no_input_behind_standard_output();
  const std::optional<FileIdentity> standard_output = identity_of("-", STDOUT_FILENO);
  for (const Named& output : outputs_) {
    if (standard_output && output.file.identity() && are_one(*standard_output, *output.file.identity())) {
      throw UsageError("standard output goes into the file of another output (" + output.file.path() + " for " +
                       output.option + ") - send one of them elsewhere");
    }
  }
}

void CommandFiles::require_no_input_behind_standard_output() const {
  const std::optional<FileIdentity> standard_output = identity_of("-", STDOUT_FILENO);
  if (!standard_output) return;
  if (const std::optional<std::string> input = input_that_is(*standard_output, inputs_)) {
    throw UsageError("standard output goes into an input (" + (*input == "-" ? "standard input" : *input) +
                     ") - send it elsewhere");
  }
}

}  // namespace vex
