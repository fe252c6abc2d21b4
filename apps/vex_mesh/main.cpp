// vex_mesh A [B]: the orientation-averaged excluded volume of two convex bodies, by Monte Carlo and by the formula.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "apps/common/command_files.h"
#include "apps/common/interrupt.h"
#include "apps/common/progress_bar.h"
#include "apps/common/run_program.h"
#include "apps/vex_mesh/options.h"
#include "apps/vex_mesh/report.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) {
    throw InputError(std::string("a result would overflow (") + what + ") - choose another unit of length");
  }
  if (value == 0.0) {
    throw InputError(std::string("a result would underflow (") + what + ") - choose another unit of length");
  }
}

// Why B can lie nowhere inside A, whatever the orientations; empty where it can.
std::string why_no_volume(const MeshRun& run, double formula) {
  if (formula == 0.0) return "two needles exclude no volume, in no orientation: <V_ex> = 0";
  if (difference_is_flat(run.a.shape.body, run.b.shape.body, run.options.law)) {
    return "flat bodies in parallel planes exclude no volume: <V_ex> = 0";
  }
  return "";
}

// Which of the two bodies the backend has no representation of, or that it has no test of the two; nothing where it
// takes the pair.
std::optional<std::string> why_left_out(const BackendKind& kind, const MeshRun& run) {
  if (kind.takes(run.a.shape.body, run.b.shape.body)) return std::nullopt;
  for (const LoadedBody* loaded : {&run.a, &run.b}) {
    if (!kind.takes(loaded->shape.body, loaded->shape.body)) {
      return kind.name + " has no shape for " + loaded->source + " (" + loaded->shape.kind + ")";
    }
  }
  return kind.name + " has no test of " + run.a.shape.kind + " and " + run.b.shape.kind;
}

void choose_backends(MeshRun& run) {
  if (const std::optional<std::string> reason = why_left_out(run.options.backend, run)) {
    throw UsageError(*reason + " - use another --backend");
  }
  std::erase_if(run.options.cross_check, [&run](const BackendKind& kind) {
    const std::optional<std::string> reason = why_left_out(kind, run);
    if (reason) run.left_out.push_back(*reason);
    return reason.has_value();
  });
}

// The second value where the formula does not hold; none where it was interrupted before it was known at all.
void average_exactly(MeshRun& run) {
  ExactAverageSettings settings;
  settings.interrupt = &interrupting_signal();
  const ExactAverage average = exact_average(run.a.shape, run.b.shape, run.options.law, settings);
  if (std::isfinite(average.error)) run.exact_average = average;
}

bool is_stopped_by_rule(const StopRule& stop) { return stop.trials || stop.relative_error || stop.seconds; }

// The driver's settings, by the estimator that was asked for or that a pilot chose.
MonteCarloSettings choose_settings(MeshRun& run) {
  const Options& options = run.options;
  MonteCarloSettings settings;
  settings.seed = options.seed;
  settings.n_threads = options.n_threads;
  settings.law = options.law;
  settings.quick_verdicts = options.quick_verdicts;
  settings.instruction_set = options.instruction_set;
  settings.verify = options.verify;
  settings.stop = options.stop;
  settings.backend = options.backend;
  settings.cross_check = options.cross_check;
  settings.interrupt = &interrupting_signal();
  const MeasuredBody &a = run.a.shape, &b = run.b.shape;
  if (options.estimator) {
    run.estimator = *options.estimator;
    run.sequence = options.sequence.value_or(usual_sequence(run.estimator));
  } else {
    run.candidates = measure_candidates(a, b, settings);
    const Candidate chosen =
        chosen_of(run.candidates, options.stop.relative_error.value_or(usual_relative_error(Estimator::radial)));
    run.estimator = chosen.estimator;
    run.sequence = options.sequence.value_or(chosen.sequence);
    // Where no pilot had an error, nothing but a limit would end a run without a rule.
    constexpr std::uint64_t kMostInVain = 10'000'000;
    const bool is_hopeless = !std::isfinite(chosen.cost.relative_error);
    if (is_hopeless && !is_stopped_by_rule(options.stop)) {
      settings.stop.max_trials = std::min(settings.stop.max_trials, kMostInVain);
    }
  }
  settings.sequence = run.sequence;
  set_estimator(settings, run.estimator, a, b, options.domain);
  if (!run.control_bodies.empty()) {
    run.control_weight =
        set_control_variate(settings, run.estimator, run.control_bodies.front().shape, run.control_bodies.back().shape);
  }
  if (!is_stopped_by_rule(options.stop)) {
    settings.stop.relative_error = usual_relative_error(options.estimator.value_or(Estimator::radial));
  }
  run.domain = settings.domain;
  if (!settings.integrand) require_finite(run.domain.volume, "the sampling volume");
  return settings;
}

void sample(MeshRun& run) {
  MonteCarloSettings settings = choose_settings(run);
  ProgressBar bar(!run.options.quiet, settings.stop);
  settings.on_progress = [&bar](const Progress& progress) { bar.show(progress); };
  run.record = run_monte_carlo(run.a.shape.body, run.b.shape.body, settings);
}

int run_vex_mesh(const CommandLine& words, const std::string& command) {
  const Options options = interpret(words);

  std::vector<std::string> bodies = {options.a, options.b};
  bodies.insert(bodies.end(), options.control_variate.begin(), options.control_variate.end());
  CommandFiles files(files_of_bodies(bodies, options.bodies));
  const std::optional<OutputFile> json = files.output("--json", options.json);
  if (!options.quiet) files.print_report();

  auto [loaded_a, loaded_b] = load_two_bodies(options.a, options.b, options.bodies);
  MeshRun run{command, options, std::move(loaded_a), std::move(loaded_b)};
  if (const std::vector<std::string>& simpler = options.control_variate; !simpler.empty()) {
    auto [like_a, like_b] = load_two_bodies(simpler.front(), simpler.back(), options.bodies);
    run.control_bodies = {std::move(like_a), std::move(like_b)};
  }
  if (options.dump_vertices) require_vertices_to_list(run.a, run.b);
  choose_backends(run);
  const ConvexBody& a = run.a.shape.body;
  const ConvexBody& b = run.b.shape.body;
  const FormulaResult formula = formula_result(run.a.shape.measures, run.b.shape.measures);
  if (formula.excluded_volume != 0.0) require_finite(formula.excluded_volume, "the excluded volume");
  if (options.law.kind() == OrientationLaw::Kind::isotropic) {
    run.formula = formula;
  } else {
    run.formula_reason = "the formula holds for isotropic orientations, not for " + options.law.name() + " ones";
  }
  require_finite(ball_domain(a, b).volume, "the sampling volume");

  run.no_run_reason = why_no_volume(run, formula.excluded_volume);
  if (run.no_run_reason.empty()) {
    catch_interrupts();
    if (!run.formula) average_exactly(run);
    sample(run);
  } else {
    run.record.complete = true;
  }
  compare(run);

  if (!options.quiet && !(json && json->is_standard_output())) std::cout << report_text(run);
  if (json) json->write(report_json(run));

  if (run.record.stopped_by == StopReason::interrupted) return kSignalBase + interrupting_signal().load();
  // A peer's verdict that has no proof is the peer's fault, and reported as such.
  if (run.record.unproven.n_all > 0 && !run.options.backend.is_peer) return kFault;
  return run.z && std::fabs(*run.z) > options.max_z ? kDisagreement : kSuccess;
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
