// All files of one command: no output may be an input, and no two outputs may be one file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/output_file.h"

namespace vex {

class CommandFiles {
 public:
  /// `inputs`: the paths of all files that the command reads; "-" is standard input.
  explicit CommandFiles(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}

  /// The file of an output option (`option`: "--json"); none where its value is empty. Throws UsageError as OutputFile
  /// does, and where it is the file of another output. `mesh_extension`: as of OutputFile.
  std::optional<OutputFile> output(const std::string& option, const std::string& path,
                                   std::string_view mesh_extension = {});

  /// The program also prints a report or rows on standard output; to be called behind all outputs. Nothing happens
  /// where an output is standard output, which then is not printed to otherwise. Throws UsageError where standard
  /// output goes into an input, or into the file of an output.
  void print_report();

  /// Whether one of the outputs is standard output, where then nothing else is printed.
  bool own_standard_output() const;

 private:
  struct Named {
    std::string option;
    OutputFile file;
  };
  void require_no_input_behind_standard_output() const;

  std::vector<std::string> inputs_;
  std::vector<Named> outputs_;
};

}  // namespace vex
