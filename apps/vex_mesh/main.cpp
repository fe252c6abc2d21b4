// vex_mesh A [B]: the orientation-averaged excluded volume of two convex bodies, by Monte Carlo and by the formula.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "apps/common/backends.h"
#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/run_program.h"
#include "apps/vex_mesh/history.h"
#include "apps/vex_mesh/html_report.h"
#include "apps/vex_mesh/options.h"
#include "apps/vex_mesh/report.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::string why_left_out(const BackendKind& kind, const MeshRun& run) {
  return why_left_out(kind, {&run.a.shape.body, run.a.source, run.a.shape.kind},
                      {&run.b.shape.body, run.b.source, run.b.shape.kind});
}

void choose_backends(MeshRun& run) {
  if (const std::string reason = why_left_out(run.options.settings.backend, run); !reason.empty()) {
    throw UsageError(reason + " - use another --backend");
  }
  std::erase_if(run.options.settings.cross_check, [&run](const BackendKind& kind) {
    const std::string reason = why_left_out(kind, run);
    if (!reason.empty()) run.left_out.push_back(reason);
    return !reason.empty();
  });
}

void sample(MeshRun& run, History* history) {
  ExcludedVolumeSettings& settings = run.options.settings;
  for (const LoadedBody& simpler : run.control_bodies) settings.control_variate.push_back(simpler.shape);
  settings.interrupt = &interrupting_signal();
  ProgressBar bar(!run.options.quiet);
  settings.on_progress = [&bar, history](const Progress& progress) {
    bar.show(progress);
    history->add(progress);
  };
  run.result = excluded_volume(run.a.shape, run.b.shape, settings);
}

int run_vex_mesh(const CommandLine& words, const std::string& command) {
  const Options options = interpret(words);

  std::vector<std::string> bodies = {options.a, options.b};
  bodies.insert(bodies.end(), options.control_variate.begin(), options.control_variate.end());
  CommandFiles files(files_of_bodies(bodies, options.bodies));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  const std::optional<OutputFile> page = files.output("--report", options.report);
  if (!options.quiet) files.print_report();

  auto [loaded_a, loaded_b] = load_two_bodies(options.a, options.b, options.bodies);
  MeshRun run{command, options, std::move(loaded_a), std::move(loaded_b)};
  if (const std::vector<std::string>& simpler = options.control_variate; !simpler.empty()) {
    auto [like_a, like_b] = load_two_bodies(simpler.front(), simpler.back(), options.bodies);
    run.control_bodies = {std::move(like_a), std::move(like_b)};
  }
  if (options.dump_vertices) require_vertices_to_list(run.a, run.b);
  choose_backends(run);
  catch_interrupts();
  History history;
  sample(run, &history);

  const bool is_standard_output_taken = (json && json->is_standard_output()) || (page && page->is_standard_output());
  if (!options.quiet && !is_standard_output_taken) std::cout << report_text(run) << std::flush;
  if (json || page) {
    const std::string document = report_json(run);
    std::string html;
    if (page) {
      html =
          html_report(run, history_of(run.result, history, run.a.shape, run.b.shape, run.options.settings), document);
    }
    if (json) json->write(document);
    if (page) page->write(html);
  }

  if (run.result.record.stopped_by == StopReason::interrupted) return kSignalBase + interrupting_signal().load();
  // A peer's verdict that has no proof is the peer's fault, and reported as such.
  if (run.result.record.unproven.n_all > 0 && !run.options.settings.backend.is_peer) return kFault;
  return run.result.z && std::fabs(*run.result.z) > options.max_z ? kDisagreement : kSuccess;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  vex::OptionParser options(
      "Average excluded volume <V_ex> of two convex bodies: by Monte Carlo, and by the formula from V, S and M.",
      "vex_mesh");
  vex::CommandLine words;
  vex::declare_options(options, words);
  return vex::run_program(options, argc, argv, [&] { return vex::run_vex_mesh(words, vex::command_line(argc, argv)); });
}
