// vex_pair A B: whether two convex bodies overlap, how far apart or how deep in each other they are, and when a motion
// brings them into contact; in one pose or in each of a file of poses, and how that is proven.
#include <chrono>
#include <cstdio>
#include <memory>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/line_reader.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/common/text.h"
#include "apps/vex_pair/report.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::optional<OutputFile> output_file(const PairOptions& options) {
  const std::vector<std::string> bodies = {options.a, options.b};
  std::vector<std::string> inputs = files_of_bodies(bodies, options.bodies);
  if (!options.poses.empty()) inputs.push_back(options.poses);
  CommandFiles files(std::move(inputs));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  if (!options.quiet || options.layout.format != RowLayout::Format::screen) files.print_report();
  return json;
}

void answer_one(PairRun& run, const Question& question) {
  run.one = question.answer(*run.options.pose);
  run.found.counts.add(*run.one);
  append_row(run.found.first_rows, run.options.layout.of_json(), 0, *run.one);
}

std::string text_of_one(const PairRun& run) {
  const RowLayout& layout = run.options.layout;
  if (layout.format == RowLayout::Format::screen) return run.options.quiet ? "" : report_text(run);
  std::string text = row_header(layout);
  append_row(text, layout, 0, *run.one);
  return text;
}

int run_vex_pair(const PairCommandLine& words, const std::string& command) {
  const auto start = std::chrono::steady_clock::now();
  const PairOptions options = interpret(words);
  const std::optional<OutputFile> json = output_file(options);
  const bool owns_output = json && json->is_standard_output();

  // Opened before the bodies are loaded, which may take long; a pipe's header comes when it comes.
  std::unique_ptr<PoseFile> poses;
  if (!options.pose) poses = std::make_unique<PoseFile>(options.poses, interrupting_signal());
  auto [a, b] = load_two_bodies(options.a, options.b, options.bodies);
  PairRun run{command, options, std::move(a), std::move(b)};
  if (options.dump_vertices) require_vertices_to_list(run.a, run.b);

  catch_interrupts();
  const Question question(run.a.shape.body, run.b.shape.body, options.query);
  Results results("vex_pair", options.layout.format != RowLayout::Format::screen);
  if (poses) {
    Counts answered;
    const auto answer = [&] {
      answer_if_asked([&] { return plural(answered.n_rows, "pose", "poses") + " answered"; });
    };
    poses->read_header(answer);
    StreamSettings settings{options.layout, options.keep_going, json.has_value(), options.n_threads};
    const bool is_silent = owns_output || (options.quiet && options.layout.format == RowLayout::Format::screen);
    settings.on_block = [&](const Counts& counts) {
      answered = counts;
      answer();
    };
    settings.while_waiting = answer;
    run.found = answer_stream(*poses, question, settings, interrupting_signal(),
                              [&](std::string_view rows) { return is_silent || results.print_rows(rows); });
    if (poses->open_line() != 0) {
      std::fprintf(stderr, "vex_pair: %s\n", open_line_warning(poses->name(), poses->open_line()).c_str());
    }
  } else {
    answer_one(run, question);
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  if (!run.found.first_problem.empty() && !options.keep_going) throw InputError(run.found.first_problem);
  if (run.one && !owns_output) {
    const std::string text = text_of_one(run);
    if (options.layout.format == RowLayout::Format::screen) {
      results.print(text);
    } else {
      results.print_rows(text);
    }
  }
  if (poses && !options.quiet && !owns_output && !results.has_lost_standard_output()) {
    std::fprintf(stderr, "vex_pair: %s", summary_text(run).c_str());
  }
  results.write(json, Results::Kind::numbers, [&] { return report_json(run); });
  if (run.found.interrupted) return results.exit_code(kSignalBase + interrupting_signal().load());
  if (run.found.counts.n_not_reproven > 0) return kFault;
  if (run.found.counts.n_refused > 0) {
    throw InputError(std::to_string(run.found.counts.n_refused) + " of " + std::to_string(run.found.counts.n_rows) +
                     " rows were refused - the first: " + run.found.first_problem);
  }
  return results.exit_code(kSuccess);
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Whether two convex bodies overlap, how far apart or how deep in each other they are, and when a motion brings "
      "them into contact, with proven bounds: in one pose, or in each of a file of poses.",
      "vex_pair");
  vex::PairCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv, [&] { return vex::run_vex_pair(words, vex::command_line(argc, argv)); });
}
