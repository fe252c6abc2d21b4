// vex_scene FILE: which of many bodies overlap, how near they are, and which clusters they make; in open space or in a
// periodic box, proven.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/run_program.h"
#include "apps/vex_scene/beside.h"
#include "apps/vex_scene/random_scene.h"
#include "apps/vex_scene/report.h"
#include "apps/vex_scene/rows.h"
#include "apps/vex_scene/scene_file.h"
#include "apps/vex_scene/scene_gltf.h"
#include "apps/vex_scene/stage_picture.h"
#include "apps/vex_scene/status_line.h"
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

// Whether the text went out; nothing to write is written.
bool write_out(std::string_view text) {
  if (!text.empty()) std::cout << text << std::flush;
  return static_cast<bool>(std::cout);
}

SceneInput input_of(const SceneOptions& options) {
  if (!options.random) return read_scene_file(options.file, options.named_bodies, !options.quiet);
  SceneInput scene("--random", false);
  for (const std::string& text : options.bodies_of_command_line()) scene.shape_of_text(text, 0);
  return scene;
}

// The bodies are loaded, and a random scene is made of them.
void complete(SceneInput& input, const BodyOptions& body_options, SceneRun& run) {
  const SceneOptions& options = run.options;
  run.bodies = load_bodies(input, options, body_options);
  run.box = options.box;
  if (options.random) {
    const std::uint32_t shape = input.shape_of_text(options.random->body, 0);
    run.box = box_of_random_scene(*options.random, run.bodies[shape]);
    place_at_random(input, *options.random, shape, *run.box, options.seed);
  }
  for (const SceneInput::Shape& shape : input.shapes()) run.n_copies.push_back(shape.n_bodies);
  run.n_bodies = input.n_bodies();
}

void write_files(const SceneRun& run, const SceneInput& input, const Scene& scene, const Outputs& outputs) {
  if (outputs.save) outputs.save->write(scene_file_text(input));
  if (outputs.gltf) outputs.gltf->write(scene_gltf(run, scene));
  if (outputs.svg) outputs.svg->write(stage_picture(run));
  if (outputs.json) outputs.json->write(report_json(run));
}

void print(const SceneRun& run, const Outputs& outputs) {
  const SceneOptions& options = run.options;
  if (outputs.own_standard_output) return;
  if (!options.has_rows()) {
    if (!options.quiet) write_out(summary_text(run));
    return;
  }
  write_rows(options.query, options.rows, run.found, write_out);
  if (!options.quiet && std::cout) std::fprintf(stderr, "vex_scene: %s", summary_text(run).c_str());
}

// The work goes on beside this, and ends with the program.
[[noreturn]] void end_interrupted(SceneRun& run, const Outputs& outputs, Clock::time_point start) {
  const int code = kSignalBase + interrupting_signal().load();
  run.seconds = seconds_since(start);
  if (!run.options.quiet && !outputs.own_standard_output) {
    std::fprintf(stderr, "vex_scene: interrupted before there was an answer\n");
  }
  try {
    if (outputs.json) outputs.json->write(report_json(run));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vex_scene: %s\n", error.what());
    std::_Exit(kFault);
  }
  std::_Exit(code);
}

int run_vex_scene(const SceneCommandLine& words, const std::string& command) {
  const Clock::time_point start = Clock::now();
  SceneRun run;
  run.command = command;
  run.options = interpret(words);
  const SceneOptions& options = run.options;
  // Before the file is read, which may take long; and again when the files that it names are known.
  output_files(options, files_of_bodies(options.bodies_of_command_line(), {}));
  SceneInput input = input_of(options);
  const BodyOptions body_options = body_options_of(options, input);
  const Outputs outputs = output_files(options, files_of_bodies(input.texts(), body_options));
  complete(input, body_options, run);
  if (options.dump_vertices) require_vertices_to_list(run.bodies);
  run.read_seconds = seconds_since(start);

  catch_interrupts();
  std::optional<Scene> scene;
  Findings found;
  const auto work = [&] {
    const Clock::time_point start_of_work = Clock::now();
    scene = scene_of(input, run.bodies, run.box, options.settings);
    if (!outputs.save) std::vector<Transformd>().swap(input.poses);
    const double build_seconds = seconds_since(start_of_work);
    found = ask(*scene, options.query, options.distance);
    found.build_seconds = build_seconds;
  };
  StatusLine status(!options.quiet);
  const std::string doing =
      "vex_scene: " + std::to_string(run.n_bodies) + " bodies, " + std::string(name_of(options.query));
  if (!done_before_an_interrupt(work, [&] { status.show(doing); })) {
    status.erase();
    end_interrupted(run, outputs, start);
  }
  status.erase();
  stop_catching_interrupts();
  run.found = std::move(found);
  run.seconds = seconds_since(start);
  print(run, outputs);
  write_files(run, input, *scene, outputs);
  return kSuccess;
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
