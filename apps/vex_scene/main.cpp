// vex_scene FILE: which of many bodies overlap, how near they are, and which clusters they make; in open space or in a
// periodic box, proven.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/line_reader.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "apps/common/scene_gltf.h"
#include "apps/common/status_line.h"
#include "apps/common/text.h"
#include "apps/vex_scene/beside.h"
#include "apps/vex_scene/body_colours.h"
#include "apps/vex_scene/random_scene.h"
#include "apps/vex_scene/report.h"
#include "apps/vex_scene/rows.h"
#include "apps/vex_scene/scene_file.h"
#include "apps/vex_scene/stage_picture.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Outputs {
  std::optional<OutputFile> json, save, gltf, svg;
  bool own_standard_output = false;  // one of them, so that rows are not written there
};

Outputs output_files(const SceneOptions& options, std::vector<std::string> inputs) {
  if (!options.file.empty()) inputs.push_back(options.file);
  CommandFiles files(std::move(inputs));
  Outputs outputs;
  outputs.json = files.output("--json", options.json);
  outputs.save = files.output("--save", options.save);
  outputs.gltf = files.output("--gltf", options.gltf, ".glb");
  outputs.svg = files.output("--svg", options.svg);
  for (const std::optional<OutputFile>* const file : {&outputs.json, &outputs.save, &outputs.svg}) {
    if (*file && (*file)->is_standard_output()) outputs.own_standard_output = true;
  }
  if (options.has_rows() || !options.quiet) files.print_report();
  return outputs;
}

// What the program does, piece by piece, on a thread beside the one that looks for signals: wherever one arrives, the
// program ends soon, with the document of --json.
class Pieces {
 public:
  Pieces(SceneRun& run, Clock::time_point start, const Outputs& outputs)
      : run_(run),
        start_(start),
        outputs_(outputs),
        status_(!run.options.quiet),
        results_("vex_scene", run.options.has_rows() || outputs.own_standard_output) {
    catch_interrupts();
  }

  /// Does it while the status line says what is done. `undone`: what to say where a signal ends it. `grace`: as
  /// of done_before_an_interrupt.
  void work(const std::function<void()>& action, const std::function<std::string()>& doing, const std::string& undone,
            std::chrono::milliseconds grace = {}) {
    const bool is_done = done_before_an_interrupt(
        action, [&] { status_.show("vex_scene", doing); }, grace);
    status_.erase();
    if (!is_done || interrupting_signal().load() != 0) end(undone);
  }

  /// Makes the text of a file, and writes it. A file that is replaced is written whole before the program ends.
  void write(const std::optional<OutputFile>& file, Results::Kind kind, const std::function<std::string()>& text) {
    if (!file) return;
    std::string made;
    work([&] { made = text(); }, [&] { return "writing " + file->path(); },
         "interrupted before " + file->path() + " was written");
    results_.write(file, kind, [&] { return std::move(made); });
    if (interrupting_signal().load() != 0) end("");
  }

  /// The last one, and the program's exit code.
  int write_document() {
    results_.write(outputs_.json, Results::Kind::numbers, [&] { return report_json(run_); });
    const int signal = interrupting_signal().load();
    return results_.exit_code(signal == 0 ? kSuccess : kSignalBase + signal);
  }

  Results& results() { return results_; }

 private:
  // The work may go on beside this, and ends with the program.
  [[noreturn]] void end(const std::string& undone) {
    run_.is_interrupted = true;
    run_.seconds = seconds_since(start_);
    if (!undone.empty() && !run_.options.quiet && !outputs_.own_standard_output) {
      std::fprintf(stderr, "vex_scene: %s\n", undone.c_str());
    }
    std::_Exit(write_document());
  }

  SceneRun& run_;
  Clock::time_point start_;
  const Outputs& outputs_;
  StatusLine status_;
  Results results_;
};

SceneInput input_of(const SceneOptions& options, std::atomic<std::uint64_t>& n_lines) {
  if (!options.random) return read_scene_file(options.file, options.named_bodies, &n_lines);
  SceneInput scene("--random", false);
  for (const std::string& text : options.bodies_of_command_line()) scene.shape_of_text(text, 0);
  return scene;
}

struct Loaded {
  std::vector<LoadedBody> bodies;
  std::optional<PeriodicBox> box;
};

// The bodies are loaded, and a random scene is made of them.
Loaded complete(SceneInput& input, const SceneOptions& options, const BodyOptions& body_options) {
  Loaded loaded{load_bodies(input, options, body_options), options.box};
  if (options.random) {
    const std::uint32_t shape = input.shape_of_text(options.random->body, 0);
    loaded.box = box_of_random_scene(*options.random, loaded.bodies[shape]);
    place_at_random(input, *options.random, shape, *loaded.box, options.seed);
  }
  if (options.dump_vertices) require_vertices_to_list(loaded.bodies);
  return loaded;
}

void take(SceneRun& run, Loaded&& loaded, const SceneInput& input) {
  run.bodies = std::move(loaded.bodies);
  run.box = loaded.box;
  for (const SceneInput::Shape& shape : input.shapes()) run.n_copies.push_back(shape.n_bodies);
  run.n_bodies = input.n_bodies();
  run.is_loaded = true;
}

void print(const SceneRun& run, Results& results) {
  const SceneOptions& options = run.options;
  if (options.has_rows()) {
    // After a signal no more is wanted.
    write_rows(options.query, options.rows, run.found,
               [&](std::string_view rows) { return interrupting_signal().load() == 0 && results.print_rows(rows); });
  } else if (!options.quiet) {
    results.print(summary_text(run));
  }
}

// Looked at before the scene's file is read, which may take long. What is there already under the document's name may
// be a body that the file names: until that is known, an interrupt leaves it as it is.
Outputs outputs_before_reading(const SceneOptions& options, std::string& undone) {
  Outputs outputs = output_files(options, files_of_bodies(options.bodies_of_command_line(), {}));
  if (options.random || !outputs.json || outputs.json->may_wait_for_a_reader()) return outputs;
  if (outputs.json->identity() && outputs.json->identity()->is_regular()) {
    undone += "; " + outputs.json->path() + " is left as it was, because the scene may name it";
    outputs.json.reset();
  }
  return outputs;
}

std::string gltf_text(const SceneRun& run, const Scene& scene) {
  std::vector<std::string> names;
  for (const LoadedBody& body : run.bodies) names.push_back(body.source);
  return scene_gltf(scene, names, body_colours(run.options.query, run.found, scene.end()));
}

int run_vex_scene(const SceneCommandLine& words, const std::string& command) {
  const Clock::time_point start = Clock::now();
  SceneRun run;
  run.command = command;
  run.options = interpret(words);
  const SceneOptions& options = run.options;
  std::string unread = "interrupted before the scene was read";
  Outputs outputs = outputs_before_reading(options, unread);
  Pieces pieces(run, start, outputs);

  std::optional<SceneInput> input;
  std::atomic<std::uint64_t> n_lines{0};
  pieces.work([&] { input = input_of(options, n_lines); },
              [&] { return plural(n_lines.load(), "line", "lines") + " read"; }, unread);
  if (input->open_line != 0) {
    std::fprintf(stderr, "vex_scene: %s\n", open_line_warning(input->source(), input->open_line).c_str());
  }
  const BodyOptions body_options = body_options_of(options, *input);
  outputs = output_files(options, files_of_bodies(input->texts(), body_options));
  Loaded loaded;
  pieces.work([&] { loaded = complete(*input, options, body_options); }, [] { return "loading bodies"; },
              "interrupted before the bodies were loaded");
  take(run, std::move(loaded), *input);
  run.read_seconds = seconds_since(start);

  std::optional<Scene> scene;
  Findings found;
  const auto answer = [&] {
    const Clock::time_point start_of_work = Clock::now();
    scene = scene_of(*input, run.bodies, run.box, options.settings);
    if (!outputs.save) std::vector<Transformd>().swap(input->poses);
    const double build_seconds = seconds_since(start_of_work);
    found = ask(*scene, options.query, options.distance);
    found.build_seconds = build_seconds;
  };
  const std::string doing = std::to_string(run.n_bodies) + " bodies, " + std::string(name_of(options.query));
  pieces.work(
      answer, [&] { return doing; }, "interrupted before there was an answer");
  run.found = std::move(found);
  run.seconds = seconds_since(start);

  if (!outputs.own_standard_output) {
    // A row that is begun is written to its end.
    constexpr std::chrono::milliseconds kForARow{200};
    pieces.work([&] { print(run, pieces.results()); }, [] { return "writing"; }, "interrupted while rows were written",
                kForARow);
    if (options.has_rows() && !options.quiet && !pieces.results().has_lost_standard_output()) {
      std::fprintf(stderr, "vex_scene: %s", summary_text(run).c_str());
    }
  }
  pieces.write(outputs.save, Results::Kind::numbers, [&] { return scene_file_text(*input); });
  pieces.write(outputs.gltf, Results::Kind::model, [&] { return gltf_text(run, *scene); });
  pieces.write(outputs.svg, Results::Kind::picture, [&] { return stage_picture(run); });
  return pieces.write_document();
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Which of many bodies overlap, how near they are to each other, and which clusters they make: in open space or "
      "in "
      "a periodic box, with proven answers.",
      "vex_scene");
  vex::SceneCommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv,
                          [&] { return vex::run_vex_scene(words, vex::command_line(argc, argv)); });
}
