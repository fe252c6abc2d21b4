// What a command hands over in the end: nothing that was computed is lost where a disk, a folder or a reader refuses
// it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "apps/common/output_file.h"

namespace vex {

class Results {
 public:
  enum class Kind {
    numbers,  // a document, a table: what was computed
    picture,  // a text that shows it
    model,    // bytes that no terminal should see
  };

  /// `program`: who speaks in messages. `gives_rows`: standard output has rows for another program.
  explicit Results(std::string program, bool gives_rows = false)
      : program_(std::move(program)), has_rows_(gives_rows) {}

  /// A report for people, on standard output; on standard error where the disk behind that is full.
  void print(std::string_view report);
  /// The rows. Whether anybody takes them.
  bool print_rows(std::string_view rows);
  bool has_lost_standard_output() const { return is_closed_; }

  /// Makes the text and writes it where the option has asked for it, if it has. What fails is told on standard error,
  /// as it happens, and drops no other output: numbers then go to standard output, behind a report, or to standard
  /// error where standard output has rows, another output's text, or fails as well; a picture goes where nothing else
  /// is. To be called in the order of what would be missed most. An interrupt ends the wait for whoever reads a pipe.
  void write(const std::optional<OutputFile>& file, Kind kind, const std::function<std::string()>& make);

  /// Numbers whose file could not be written before: as above, with the problem that is told.
  void rescue_numbers(std::string_view text, const std::string& problem);

  /// kFault where an output could not be written, 128 + signal where an interrupt ended a wait, otherwise `code`.
  int exit_code(int code) const;

 private:
  enum class Went { out, away, nowhere };  // away: the reader has gone, or an interrupt came

  Went to_standard_output(std::string_view text);
  void rescue(Kind kind, std::string_view text, const std::string& problem);
  void tell(const std::string& message) const;

  std::string program_;
  bool has_rows_;            // or another text that a program may read
  bool is_closed_ = false;   // standard output has failed, and that was told
  bool has_failed_ = false;  // something could not be written
  bool was_interrupted_ = false;
};

}  // namespace vex
