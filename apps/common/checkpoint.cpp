#include "apps/common/checkpoint.h"

#include <cerrno>
#include <filesystem>
#include <iostream>
#include <system_error>
#include <utility>

#include "apps/common/checksum.h"
#include "apps/common/line_reader.h"
#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"

namespace vex {

void declare_checkpoint(OptionParser& options, CheckpointWords& words, const std::string& group) {
  options
      .add_option(
          "--checkpoint", words.checkpoint,
          "Save the run's state in this file, every few seconds, when interrupted, and at the end; refused where "
          "the file holds something that the run does not go on from, or another run saves itself there")
      .type_name("FILE")
      .group(group);
  options
      .add_option("--checkpoint-every", words.checkpoint_every, "Seconds from one saved state to the next (default 5)")
      .type_name("S")
      .group(group);
  options
      .add_option("--resume", words.resume,
                  "Go on from a saved state of the same run: the result is that of one run without a break, whatever "
                  "the number of threads. The --checkpoint file itself may be named, which the first time need not be "
                  "there")
      .type_name("FILE")
      .group(group);
}

CheckpointOptions interpret_checkpoint(const CheckpointWords& words) {
  CheckpointOptions options;
  if (words.checkpoint == "-") {
    throw UsageError("a state is written again and again (--checkpoint -) - name a file");
  }
  if (words.resume == "-") throw UsageError("a state is read from a file (--resume -) - name it");
  options.checkpoint = words.checkpoint;
  options.resume = words.resume;
  if (!words.checkpoint_every.empty()) {
    if (words.checkpoint.empty()) {
      throw UsageError("no state is saved (--checkpoint-every without --checkpoint) - name a file with --checkpoint");
    }
    options.seconds_between = parse_positive_number(words.checkpoint_every, "--checkpoint-every");
  }
  return options;
}

bool has_run_to_resume(const CheckpointOptions& options, const std::string& program, bool quiet) {
  if (options.resume.empty()) return false;
  std::error_code error;
  // Empty it is where a run was killed before it saved itself.
  const bool is_there = std::filesystem::exists(options.resume, error) || error;
  // A pipe would be waited for, and a device has no end.
  if (is_there && !error && !std::filesystem::is_regular_file(options.resume, error)) {
    throw InputError("a state is no regular file (" + printable(options.resume) +
                     " for --resume) - name the one that was saved");
  }
  if (!options.is_own_file() || (is_there && std::filesystem::file_size(options.resume, error) > 0)) return true;
  if (!quiet) std::cerr << program << ": no run to go on from yet (" << printable(options.resume) << "): it begins\n";
  return false;
}

Checkpoint::Checkpoint(const OutputFile& file, std::string program, const CheckpointOptions& options)
    : path_(file.path()), program_(std::move(program)), between_(options.seconds_between) {
  if (file.may_wait_for_a_reader()) {
    throw UsageError("a state replaces the one before it, and a device or a pipe cannot be replaced (" + path_ +
                     " for --checkpoint) - name a file");
  }
  file_ = std::make_unique<LockedFile>(file, "--checkpoint");
  if (!file_->was_empty() && !options.is_own_file()) {
    throw UsageError("the file of --checkpoint holds something already (" + path_ + ") - go on from it with --resume " +
                     path_ + ", name another file, or remove it");
  }
  if (!file_->has_lock()) {
    std::cerr << program_ << ": this file system has no locks (" << printable(path_)
              << "): see that no other run saves itself there\n";
  }
}

bool Checkpoint::is_due() const {
  constexpr double kSparingly = 50.0;
  const std::chrono::duration<double> since = Clock::now() - saved_;
  return since >= between_ && since >= kSparingly * cost_;
}

void Checkpoint::save(std::string_view text, const std::function<void()>& before_message) {
  const Clock::time_point start = Clock::now();
  try {
    file_->replace(text);
    unsaved_.clear();
  } catch (const std::system_error& error) {
    unsaved_ = text;
    if (!has_said_) {
      has_said_ = true;
      before_message();
      const bool is_anothers = error.code().value() == EBUSY;
      std::cerr << program_ << ": no state was saved: "
                << (is_anothers ? "another file has taken the name of this run's (" : "the file cannot be written (")
                << printable(path_) << (is_anothers ? "" : ": " + error.code().message())
                << ") - the run goes on, and tries again in a while\n";
    }
  }
  saved_ = Clock::now();
  cost_ = saved_ - start;
}

void Checkpoint::hand_over_unsaved(Results& results) const {
  if (!unsaved_.empty()) results.rescue_numbers(unsaved_, "the last state could not be saved in " + path_);
}

std::string sealed_text(std::string_view title, std::span<const std::string> of, std::string_view text) {
  std::string all = "# " + std::string(title) + "\n";
  for (const std::string& line : of) all += "# " + line + "\n";
  all += text;
  Checksum sum;
  sum.add(all);
  return all + end_line(sum) + "\n";
}

std::string read_sealed_text(const std::string& path, std::string_view title, std::span<const std::string> of) {
  LineReader lines(path, std::string(title), "give a file that --checkpoint wrote");
  const auto refuse = [&lines](const std::string& problem) {
    throw InputError(lines.name() + ", line " + std::to_string(lines.number()) + ": " + problem);
  };
  Checksum sum, before;
  std::string_view line;
  const auto next = [&] {
    before = sum;
    if (!lines.next(line)) return false;
    sum.add(line);
    sum.add("\n");
    return true;
  };
  // First whether it is whole: a damaged line would look like another run's.
  std::vector<std::string> head;
  std::string text;
  constexpr std::size_t kMostText = std::size_t{1} << 24;
  bool has_end = false;
  while (!has_end && next()) {
    has_end = line.starts_with(kEndOfFile);
    if (has_end) break;
    if (head.size() <= of.size() && text.empty() && line.starts_with("# ")) {
      head.emplace_back(line.substr(2));
    } else {
      text.append(line).append("\n");
    }
    if (text.size() > kMostText) refuse("longer than any state - give a file that --checkpoint wrote");
    if (lines.number() == 1 && (head.empty() || head.front() != title)) {
      refuse("not a " + std::string(title) + " - give a file that --checkpoint wrote");
    }
  }
  if (!has_end) refuse("no \"" + std::string(kEndOfFile) + "\" - the file is empty or cut off");
  if (line != end_line(before)) {
    refuse("the checksum \"" + printable(line) + "\" is not that of the lines before it - the file is damaged");
  }
  if (lines.next(line)) refuse("something stands behind the end - the file is damaged");
  for (std::size_t k = 0; k < of.size(); ++k) {
    if (k + 1 < head.size() && head[k + 1] == of[k]) continue;
    const std::string has = k + 1 < head.size() ? "\"" + printable(head[k + 1]) + "\"" : "nothing of it";
    throw InputError("a state of another run (" + lines.name() + " has " + has + ", and this run \"" +
                     printable(of[k]) + "\") - resume with the command that saved it");
  }
  return text;
}

}  // namespace vex
