#include "apps/vex_percolate/realisations_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "apps/common/body_identity.h"
#include "apps/common/checksum.h"
#include "apps/common/line_reader.h"
#include "apps/common/numbers.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace {

constexpr std::string_view kHeader = "size,realisation,x,y,z";

std::string first_line(const PercolateRun& run) {
  return "# first realisation: " + std::to_string(run.first_realisation());
}

std::string counts_line(const SizeRun& size) {
  std::string line =
      "# counts: " + std::to_string(size.counts.n_bodies) + " " + std::to_string(size.counts.n_undecided);
  for (const SceneCounts::Stage& stage : size.counts.stages.stages) {
    line += " " + std::to_string(stage.seen) + " " + std::to_string(stage.settled);
  }
  return line;
}

// Whole numbers with this mark between them, exactly so many.
bool read_numbers(std::string_view text, char mark, std::span<std::uint64_t> numbers) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0 && (at == end || *at++ != mark)) return false;
    const auto [next, error] = std::from_chars(at, end, numbers[k]);
    if (error != std::errc() || next == at) return false;
    at = next;
  }
  return at == end;
}

// As bodies are placed, and of pairs.
constexpr std::uint64_t kLargestBatch = 512, kMostCounted = std::uint64_t{1} << 60;

class Realisations {
 public:
  using NextLine = std::function<bool(std::string_view& line)>;
  Realisations(std::string name, NextLine next_line, std::span<const std::string> of, PercolateRun& run)
      : name_(std::move(name)), next_line_(std::move(next_line)), of_(of.begin(), of.end()), run_(run) {
    if (run.first_realisation() > 0) of_.push_back(first_line(run));
  }

  void read() {
    for (const std::string& wanted : of_) {
      if (next() != wanted) {
        refuse("of another system (it has \"" + printable(line_) + "\", and this run \"" + printable(wanted) +
               "\") - resume with the command that wrote it");
      }
    }
    read_seconds();
    for (SizeRun& size : run_.sizes) read_counts(size.counts);
    if (next() != kHeader) refuse("not the header " + std::string(kHeader) + " - give a file that vex_percolate wrote");
    // A file that was cut off, in the middle of a number perhaps, has no end.
    while (!next().starts_with(kEndOfFile)) {
      if (line_.empty()) refuse("no \"" + std::string(kEndOfFile) + "\" - the file is cut off");
      read_row();
    }
    if (line_ != end_line(last_before_)) {
      refuse("the checksum \"" + printable(line_) + "\" is not that of the lines before it, \"" +
             end_line(last_before_) + "\" - the file is damaged");
    }
    if (next_line_(line_)) refuse("something stands behind the end - the file is damaged");
    for (const SizeRun& size : run_.sizes) check_counts(size);
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw InputError(name_ + ", line " + std::to_string(number_) + ": " + problem);
  }
  std::string_view next() {
    last_before_ = sum_;
    if (next_line_(line_)) {
      ++number_;
    } else {
      line_ = {};
    }
    sum_.add(line_);
    sum_.add("\n");
    return line_;
  }

  // As many bodies as the realisations need, which are placed in batches, and no stage that settles more than it sees.
  void check_counts(const SizeRun& size) const {
    std::uint64_t needed = 0;
    for (const WrappingNumbers& numbers : size.found) needed += numbers.all();
    const PercolationCounts& counts = size.counts;
    bool makes_sense = counts.n_bodies >= needed && counts.n_bodies - needed <= kLargestBatch * size.found.size();
    for (const SceneCounts::Stage& stage : counts.stages.stages) {
      makes_sense = makes_sense && stage.settled <= stage.seen && stage.seen <= kMostCounted;
    }
    makes_sense = makes_sense && counts.n_skipped() <= counts.n_seen() && counts.n_undecided <= counts.n_seen();
    if (!makes_sense) refuse("counts that these realisations cannot have made - the file is damaged");
  }

  void read_seconds() {
    constexpr std::string_view kKey = "# seconds: ";
    next();
    if (line_.starts_with("# first realisation: ")) {
      refuse("of another part of the run (it has \"" + printable(line_) + "\", and this run \"" + first_line(run_) +
             "\") - resume with the command that wrote it");
    }
    double seconds = -1.0;
    if (line_.starts_with(kKey)) {
      const std::string_view number = line_.substr(kKey.size());
      const char* const end = number.data() + number.size();
      const std::from_chars_result read = std::from_chars(number.data(), end, seconds);
      if (read.ec != std::errc() || read.ptr != end) seconds = -1.0;
    }
    if (!(seconds >= 0.0 && seconds <= 1e12)) refuse("no \"# seconds: \" and a number - the file is damaged");
    run_.seconds_before = seconds;
  }

  void read_counts(PercolationCounts& counts) {
    constexpr std::string_view kKey = "# counts: ";
    std::array<std::uint64_t, 2 + 2 * kNSceneStages> numbers{};
    next();
    if (!line_.starts_with(kKey) || !read_numbers(line_.substr(kKey.size()), ' ', numbers)) {
      refuse("no \"# counts: \" and " + std::to_string(numbers.size()) + " numbers - the file is damaged");
    }
    counts.n_bodies = numbers[0];
    counts.n_undecided = numbers[1];
    for (std::size_t k = 0; k < counts.stages.stages.size(); ++k) {
      counts.stages.stages[k] = {numbers[2 + 2 * k], numbers[3 + 2 * k]};
    }
  }

  // size,realisation,x,y,z: sizes by their numbers, realisations from 0 on without a gap.
  void read_row() {
    std::array<std::uint64_t, 5> row{};
    if (!read_numbers(line_, ',', row)) refuse("not five whole numbers - the file is damaged");
    if (row[0] >= run_.sizes.size()) refuse("size " + std::to_string(row[0]) + " is none - the file is damaged");
    SizeRun& size = run_.sizes[row[0]];
    const std::uint64_t due = std::uint64_t{run_.first_realisation()} + size.found.size();
    if (row[1] != due) {
      refuse("realisation " + std::to_string(row[1]) + " where " + std::to_string(due) +
             " is due - the file is damaged");
    }
    if (size.found.size() >= kMostRealisations) refuse("too many realisations - the file is damaged");
    WrappingNumbers numbers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (row[2 + axis] == 0 || row[2 + axis] > std::uint64_t{size.most_bodies()} + kLargestBatch) {
        refuse(std::to_string(row[2 + axis]) + " bodies are none that a cluster wraps with - the file is damaged");
      }
      numbers.along[axis] = static_cast<std::uint32_t>(row[2 + axis]);
    }
    size.found.push_back(numbers);
  }

  std::string name_;
  NextLine next_line_;
  std::vector<std::string> of_;
  PercolateRun& run_;
  std::uint64_t number_ = 0;  // of the line
  std::string_view line_;
  Checksum sum_, last_before_;  // of all lines, and of those before the last one
};

}  // namespace

std::vector<std::string> system_lines(const PercolateRun& run) {
  const PercolateOptions& options = run.options;
  std::vector<std::string> lines = {"# vex_percolate " + version() + ": realisations, stream " +
                                    std::to_string(kStreamVersion)};
  for (std::size_t k = 0; k < run.bodies.size(); ++k) {
    lines.push_back("# body: " + body_identity(run.bodies[k].shape) + ", fraction " +
                    shortest_number(options.bodies[k].fraction));
  }
  lines.push_back("# orientations: " + options.law);
  lines.push_back("# shell: " + shortest_number(options.shell));
  lines.push_back("# backend: " + options.backend_name);
  lines.push_back("# seed: " + std::to_string(options.seed));
  std::string sizes = "# sizes:";
  for (const SizeRun& size : run.sizes) sizes += " " + shortest_number(size.size);
  lines.push_back(sizes);
  return lines;
}

std::string realisations_text(const PercolateRun& run) { return realisations_text(run, system_lines(run)); }

std::string realisations_text(const PercolateRun& run, std::span<const std::string> of) {
  std::string text;
  for (const std::string& line : of) text += line + "\n";
  if (run.first_realisation() > 0) text += first_line(run) + "\n";
  text += "# seconds: " + shortest_number(run.seconds_before + run.seconds) + "\n";
  for (const SizeRun& size : run.sizes) text += counts_line(size) + "\n";
  text += std::string(kHeader) + "\n";
  for (std::size_t k = 0; k < run.sizes.size(); ++k) {
    const std::vector<WrappingNumbers>& found = run.sizes[k].found;
    for (std::size_t j = 0; j < found.size(); ++j) {
      text += std::to_string(k) + "," + std::to_string(run.first_realisation() + j);
      for (const std::uint32_t n : found[j].along) text += "," + std::to_string(n);
      text += "\n";
    }
  }
  Checksum sum;
  sum.add(text);
  return text + end_line(sum) + "\n";
}

void resume_from(const std::string& path, PercolateRun& run) {
  LineReader lines(path, "realisations");
  Realisations(
      lines.name(), [&lines](std::string_view& line) { return lines.next(line); }, system_lines(run), run)
      .read();
  const std::uint64_t most = run.options.realisations.value_or(kMostRealisations);
  for (const SizeRun& size : run.sizes) {
    if (size.found.size() <= most) continue;
    throw InputError("the state to go on from has more realisations than the run may have (" + printable(path) + ": " +
                     std::to_string(size.found.size()) + " of " + std::to_string(most) + ") - give as many or more");
  }
}

void read_realisations(const std::string& name, std::span<const std::string> lines, std::span<const std::string> of,
                       PercolateRun& run) {
  const auto next = [&lines](std::string_view& line) {
    if (lines.empty()) return false;
    line = lines.front();
    lines = lines.subspan(1);
    return true;
  };
  Realisations(name, next, of, run).read();
}

}  // namespace vex
