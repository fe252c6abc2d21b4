// The answers of a file of poses: computed in parallel, written in order, block after block.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>

#include "apps/vex_pair/answer.h"
#include "apps/vex_pair/pose_file.h"
#include "apps/vex_pair/row_text.h"

namespace vex {

struct StreamSettings {
  RowLayout layout;
  bool keep_going = false;        // behind bad rows
  bool lists_first_rows = false;  // for a document
  int n_threads = 1;
  std::function<void(const Counts&)> on_block{};  // of all rows answered so far
  std::function<void()> while_waiting{};          // for rows, several times a second
};

/// A document lists the rows of at most so many poses.
inline constexpr std::uint64_t kMostListedRows = 1000;

struct StreamResult {
  Counts counts;
  bool interrupted = false;
  bool unheard = false;       // nobody takes the rows any more, and so the rest was not computed
  std::string first_problem;  // of a bad row, with its place; empty where all were good
  std::string first_rows;     // the first kMostListedRows as JSON lines, where they were asked for
};

/// Answers all rows of `file`, whose header has been read; without `keep_going`, those before the first bad one.
/// `write` receives the rows in the order of the file, and returns whether anybody listens. The text does not depend on
/// the number of threads.
StreamResult answer_stream(PoseFile& file, const Question& question, const StreamSettings& settings,
                           const std::atomic<int>& interrupt, const std::function<bool(std::string_view)>& write);

}  // namespace vex
