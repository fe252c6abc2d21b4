// vex_mesh A [B]: the orientation-averaged excluded volume of two convex bodies, by Monte Carlo and by the formula.
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>

#include "apps/common/backends.h"
#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/run_program.h"
#include "apps/ranks/program_ranks.h"
#include "apps/vex_mesh/announcement.h"
#include "apps/vex_mesh/options.h"
#include "apps/vex_mesh/report.h"
#include "apps/vex_mesh/run_identity.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

constexpr const char* kProgram = "vex_mesh";

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

void sample(MeshRun& run, Checkpoint* checkpoint, ProgramRanks* ranks) {
  ExcludedVolumeSettings& settings = run.options.settings;
  std::optional<RunState> resumed;
  const bool leads = ranks == nullptr || ranks->leads();
  if (ranks != nullptr) {
    settings.ranks = ranks;
    std::string identity;
    for (const std::string& line : run_identity(run)) identity += line + "\n";
    ranks->introduce(identity);
  }
  if (leads && has_run_to_resume(run.options.checkpoint, kProgram, run.options.quiet)) {
    resumed = read_checkpoint(run.options.checkpoint.resume, run);
    settings.resume = &*resumed;
  }
  for (const LoadedBody& simpler : run.control_bodies) settings.control_variate.push_back(simpler.shape);
  settings.interrupt = &interrupting_signal();
  ProgressBar bar(!run.options.quiet);
  settings.on_progress = [&bar](const Progress& progress) { bar.show(progress); };
  if (!run.options.quiet) {
    settings.on_start = [&run](const Outlook& outlook) {
      const std::string text = announcement(outlook, run.options);
      if (!text.empty()) std::cerr << kProgram << ": " << text;
    };
  }
  if (checkpoint != nullptr) {
    settings.on_state = [&](const RunState& state) {
      checkpoint->save(checkpoint_text(run, state), [&bar] { bar.erase(); });
    };
  }
  run.result = excluded_volume(run.a.shape, run.b.shape, settings);
  settings.resume = nullptr;
}

int run_vex_mesh(const CommandLine& words, const std::string& command, ProgramRanks* ranks) {
  const Options options = interpret(words);

  std::vector<std::string> bodies = {options.a, options.b};
  bodies.insert(bodies.end(), options.control_variate.begin(), options.control_variate.end());
  std::vector<std::string> inputs = files_of_bodies(bodies, options.bodies);
  if (!options.checkpoint.resume.empty() && !options.checkpoint.is_own_file()) {
    inputs.push_back(options.checkpoint.resume);
  }
  CommandFiles files(std::move(inputs));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  std::optional<Checkpoint> checkpoint;
  if (const std::optional<OutputFile> file = files.output("--checkpoint", options.checkpoint.checkpoint)) {
    checkpoint.emplace(*file, kProgram, options.checkpoint.seconds_between);
  }
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
  sample(run, checkpoint ? &*checkpoint : nullptr, ranks);
  if (ranks != nullptr && !ranks->leads()) return kSuccess;

  if (!options.quiet && !(json && json->is_standard_output())) std::cout << report_text(run);
  if (json) json->write(report_json(run));

  if (run.result.record.stopped_by == StopReason::interrupted) return kSignalBase + interrupting_signal().load();
  // A peer's verdict that has no proof is the peer's fault, and reported as such.
  if (run.result.record.unproven.n_all > 0 && !run.options.settings.backend.is_peer) return kFault;
  return run.result.z && std::fabs(*run.result.z) > options.max_z ? kDisagreement : kSuccess;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  const std::unique_ptr<vex::ProgramRanks> ranks = vex::join_ranks();
  vex::OptionParser options(
      "Average excluded volume <V_ex> of two convex bodies: by Monte Carlo, and by the formula from V, S and M.",
      "vex_mesh");
  vex::CommandLine words;
  vex::declare_options(options, words);
  const std::function<int()> action = [&] {
    return vex::run_vex_mesh(words, vex::command_line(argc, argv), ranks.get());
  };
  const int code =
      vex::run_program(options, argc, argv, [&] { return ranks == nullptr ? action() : ranks->run(action); });
  return ranks == nullptr ? code : ranks->leave(code);
}
