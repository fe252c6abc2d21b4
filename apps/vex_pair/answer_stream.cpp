#include "apps/vex_pair/answer_stream.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <vector>

#include "engine/numeric/errors.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// Consecutive rows of a block, which one thread answers.
struct Chunk {
  std::size_t begin = 0, end = 0;
  std::string text;        // in the layout that was asked for
  std::string json_lines;  // of rows that a document lists
  Counts counts;
  std::string first_problem;
  bool stopped = false;  // by a bad row or an interrupt
  std::exception_ptr fault;
};

class BlockAnswerer {
 public:
  BlockAnswerer(const PoseFile& file, const Question& question, const StreamSettings& settings,
                const std::atomic<int>& interrupt)
      : file_(file),
        question_(question),
        settings_(settings),
        interrupt_(interrupt),
        json_layout_(settings.layout.of_json()) {}

  /// The chunks in order; those behind one that stopped may be empty.
  std::vector<Chunk> answer_all(const RowBlock& block) const {
    constexpr std::size_t kLargestChunk = 256;  // small beside a block, large beside the cost of handing it out
    const std::size_t n_threads = static_cast<std::size_t>(settings_.n_threads);
    const std::size_t n_rows = block.rows.size();
    const std::size_t size = std::clamp<std::size_t>(n_rows / (4 * n_threads), 1, kLargestChunk);
    std::vector<Chunk> chunks((n_rows + size - 1) / size);
    for (std::size_t k = 0; k < chunks.size(); ++k) {
      chunks[k].begin = k * size;
      chunks[k].end = std::min(n_rows, (k + 1) * size);
    }
    std::atomic<std::size_t> next{0};
    std::atomic<bool> stop{false};
    const auto work = [&](int) {
      // Chunks are handed out in order, so that all before one that stops are answered.
      while (!stop.load()) {
        const std::size_t k = next.fetch_add(1);
        if (k >= chunks.size()) return;
        try {
          answer_chunk(block, chunks[k]);
        } catch (...) {
          chunks[k].fault = std::current_exception();
          chunks[k].stopped = true;
        }
        if (chunks[k].stopped) stop.store(true);
      }
    };
    on_threads(static_cast<int>(std::min(n_threads, chunks.size())), work);
    return chunks;
  }

 private:
  void answer_chunk(const RowBlock& block, Chunk& chunk) const {
    for (std::size_t k = chunk.begin; k < chunk.end && !chunk.stopped; ++k) {
      if (interrupt_.load() != 0) {
        chunk.stopped = true;
        return;
      }
      const RowBlock::Row& row = block.rows[k];
      const std::uint64_t index = block.first_index + k;
      const bool is_listed = settings_.lists_first_rows && index < kMostListedRows;
      Answer found;
      try {
        if (row.is_too_long) {
          throw InputError("too long a row (more than " + std::to_string(PoseFile::kLongestLine) +
                           " characters) - write one pose a line");
        }
        found = question_.answer(pose_of_row(block.text_of(row), file_.format()));
      } catch (const InputError& error) {
        const std::string line = "line " + std::to_string(row.line);
        if (chunk.first_problem.empty()) {
          chunk.first_problem = file_.name() + ", " + line + ", index " + std::to_string(index) + ": " + error.what();
        }
        chunk.stopped = !settings_.keep_going;
        if (chunk.stopped) return;
        chunk.counts.add_refused();
        const std::string problem = line + ": " + error.what();
        append_refused_row(chunk.text, settings_.layout, index, problem);
        if (is_listed) append_refused_row(chunk.json_lines, json_layout_, index, problem);
        continue;
      }
      chunk.counts.add(found);
      append_row(chunk.text, settings_.layout, index, found);
      if (is_listed) append_row(chunk.json_lines, json_layout_, index, found);
    }
  }

  const PoseFile& file_;
  const Question& question_;
  const StreamSettings& settings_;
  const std::atomic<int>& interrupt_;
  RowLayout json_layout_;
};

// Rows a block: as many as are answered in about a tenth of a second, so that answers come soon, whatever they cost.
class BlockSize {
 public:
  std::size_t rows() const { return rows_; }

  void adapt(std::size_t n_done, double seconds) {
    constexpr double kSlow = 0.2, kFast = 0.05;
    constexpr std::size_t kFewest = 16, kMost = 1 << 15;
    if (seconds > kSlow) rows_ = std::max(kFewest, rows_ / 2);
    if (seconds < kFast && n_done == rows_) rows_ = std::min(kMost, 2 * rows_);
  }

 private:
  std::size_t rows_ = 256;
};

}  // namespace

StreamResult answer_stream(PoseFile& file, const Question& question, const StreamSettings& settings,
                           const std::atomic<int>& interrupt, const std::function<bool(std::string_view)>& write) {
  using Clock = std::chrono::steady_clock;
  const BlockAnswerer answerer(file, question, settings, interrupt);
  StreamResult result;
  BlockSize size;
  RowBlock block;
  result.unheard = !write(row_header(settings.layout));
  bool goes_on = true;
  while (goes_on) {
    if (result.unheard && !settings.lists_first_rows) return result;
    file.read_rows(size.rows(), block, settings.while_waiting);
    if (block.rows.empty()) break;
    const Clock::time_point start = Clock::now();
    std::string text;
    for (const Chunk& chunk : answerer.answer_all(block)) {
      if (chunk.fault) std::rethrow_exception(chunk.fault);
      text += chunk.text;
      result.first_rows += chunk.json_lines;
      result.counts.add(chunk.counts);
      if (result.first_problem.empty()) result.first_problem = chunk.first_problem;
      goes_on = !chunk.stopped;
      if (!goes_on) break;
    }
    result.unheard = !write(text) || result.unheard;
    if (settings.on_block) settings.on_block(result.counts);
    size.adapt(block.rows.size(), std::chrono::duration<double>(Clock::now() - start).count());
  }
  result.interrupted = interrupt.load() != 0;
  return result;
}

}  // namespace vex
