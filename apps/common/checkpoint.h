// Checkpoints: what a run saves of itself while it goes on, so that a killed one loses seconds.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/common/locked_file.h"
#include "apps/common/option_parser.h"
#include "apps/common/output_file.h"
#include "apps/common/results.h"

namespace vex {

/// --checkpoint, --checkpoint-every and --resume, as they stand.
struct CheckpointWords {
  std::string checkpoint, checkpoint_every, resume;
};

/// What they mean.
struct CheckpointOptions {
  std::string checkpoint, resume;
  double seconds_between = 5.0;

  /// Whether a run goes on in its own file, which is then read before it is written, and need not be there yet.
  bool is_own_file() const { return !resume.empty() && resume == checkpoint; }
};

void declare_checkpoint(OptionParser& options, CheckpointWords& words, const std::string& group);
/// Throws UsageError.
CheckpointOptions interpret_checkpoint(const CheckpointWords& words);

/// Whether there is a run to go on from. Of a job that is started again and again with the same --checkpoint and
/// --resume, the first time there is none, or an empty file: that is said, unless `quiet`, and the run begins.
bool has_run_to_resume(const CheckpointOptions& options, const std::string& program, bool quiet);

/// The file that a run saves itself in, which is its own for as long as it lives.
class Checkpoint {
 public:
  /// Throws UsageError where the file is a device or a pipe, which cannot be replaced; where another run that lives has
  /// it; and where something stands in it that this run does not go on from, whatever it is: the state of a run that
  /// took days may be all that is left of it.
  Checkpoint(const OutputFile& file, std::string program, const CheckpointOptions& options);

  /// Whether it is time: `seconds_between` after the last one, but so that no more than a fiftieth of the time is
  /// spent on it.
  bool is_due() const;
  /// Replaces the file by the text as a whole. Where the disk or the folder refuses the run goes on: that is said on
  /// standard error, once, after `before_message`.
  void save(
      std::string_view text, const std::function<void()>& before_message = [] {});
  /// The last state, in the end, where it could not be saved: what was computed is not lost.
  void hand_over_unsaved(Results& results) const;

 private:
  using Clock = std::chrono::steady_clock;
  std::string path_;
  std::unique_ptr<LockedFile> file_;
  std::string program_;
  std::chrono::duration<double> between_, cost_{0.0};
  Clock::time_point saved_ = Clock::now();
  bool has_said_ = false;
  std::string unsaved_;  // the last text, where it could not be saved
};

/// A text that is read back: the lines of what it is of, then its own, then the checksum.
std::string sealed_text(std::string_view title, std::span<const std::string> of, std::string_view text);

/// The text out of such a file. Throws InputError where the file cannot be read, is cut off or damaged, or where its
/// title or what it is of differs from what is given, naming both.
std::string read_sealed_text(const std::string& path, std::string_view title, std::span<const std::string> of);

}  // namespace vex
