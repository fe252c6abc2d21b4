#include "apps/common/results.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <iostream>
#include <system_error>

#include "apps/common/interrupt.h"
#include "apps/common/patient_write.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"

namespace vex {

void Results::tell(const std::string& message) const {
  std::fprintf(stderr, "%s: %s\n", program_.c_str(), printable(message).c_str());
}

Results::Went Results::to_standard_output(std::string_view text) {
  if (is_closed_) return Went::nowhere;
  try {
    if (std::cout.flush() && write_until_interrupted(STDOUT_FILENO, text)) return Went::out;
    was_interrupted_ = true;
    return Went::away;
  } catch (const std::system_error& error) {
    is_closed_ = has_failed_ = true;
    tell(kNoStandardOutput);
    return error.code().value() == EPIPE ? Went::away : Went::nowhere;
  }
}

void Results::print(std::string_view report) {
  if (to_standard_output(report) != Went::nowhere) return;
  std::fwrite(report.data(), 1, report.size(), stderr);
}

bool Results::print_rows(std::string_view rows) { return !is_closed_ && to_standard_output(rows) == Went::out; }

void Results::rescue(Kind kind, std::string_view text, const std::string& problem) {
  if (kind == Kind::model || (kind == Kind::picture && (has_rows_ || is_closed_))) {
    tell(problem);
    return;
  }
  if (!has_rows_ && !is_closed_) {
    tell(problem + "; its text is on standard output");
    has_rows_ = true;
    if (to_standard_output(text) != Went::nowhere || kind == Kind::picture) return;
  }
  tell(problem + "; its text follows");
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void Results::write(const std::optional<OutputFile>& file, Kind kind, const std::function<std::string()>& make) {
  if (!file) return;
  std::string text;
  try {
    text = make();
  } catch (const std::exception& error) {
    has_failed_ = true;
    tell(error.what());
    return;
  }
  try {
    if (file->is_standard_output()) {
      has_rows_ = true;
      if (to_standard_output(text) == Went::nowhere && kind == Kind::numbers) {
        std::fwrite(text.data(), 1, text.size(), stderr);
      }
    } else if (!file->write(text)) {
      was_interrupted_ = true;
      rescue(kind, text, "interrupted before " + file->path() + " was written - read it while the program runs");
    }
  } catch (const std::exception& error) {
    has_failed_ = true;
    rescue(kind, text, error.what());
  }
}

void Results::rescue_numbers(std::string_view text, const std::string& problem) {
  has_failed_ = true;
  rescue(Kind::numbers, text, problem);
}

int Results::exit_code(int code) const {
  if (has_failed_) return kFault;
  return was_interrupted_ && code == kSuccess ? kSignalBase + interrupting_signal().load() : code;
}

}  // namespace vex
