#include "apps/vex_mesh/options.h"

#include <algorithm>
#include <string>
#include <utility>

#include "apps/common/backends.h"
#include "apps/common/choices.h"
#include "apps/common/instruction_sets.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

std::string estimators_help() {
  std::string text;
  for (const Estimator* const one : estimators()) {
    text += std::string(one->name) + " (" + std::string(one->meaning) + ")" +
            (one == estimators().back()                     ? ""
             : one == estimators()[estimators().size() - 2] ? " or "
                                                            : ", ");
  }
  return text + "; the default is chosen by a pilot among those that run GJK, and named in the report";
}

}  // namespace

void declare_options(OptionParser& options, CommandLine& words) {
  options.add_option("A", words.a, kBodyHelp).type_name("").required();
  options.add_option("B", words.b, "The second body; without it, A again").type_name("");
  declare_run_options(options, words);
  options
      .add_option(
          "--report", words.report,
          "Write a page to look at in a browser, which needs no other file and no network: the bodies to turn, the "
          "excluded body, all numbers with their meaning, the way to the result; - is standard output")
      .type_name("FILE.html")
      .group("Output");

  const std::string parts = "A run in parts";
  declare_checkpoint(options, words, parts);
  options
      .add_option(
          "--first-trial", words.first_trial,
          "With --trials N: trials FIRST ... FIRST + N - 1, a part of a longer run, which vex_merge puts together")
      .type_name("FIRST")
      .group(parts);

  options.footer(named_bodies_help() +
                 "\n\nExit codes:"
                 "\n  0  success"
                 "\n  1  a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  input refused"
                 "\n  4  Monte Carlo and formula disagree"
                 "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (what was done is reported)");
}

void declare_run_options(OptionParser& options, CommandLine& words) {
  const std::string stop = "When to stop (whichever comes first; without any, --rel-error 1e-3)";
  options.add_option("--trials", words.trials, "Stop after this many trials, written like 1e7")
      .type_name("N")
      .group(stop);
  options.add_option("--rel-error", words.relative_error, "Stop at this standard error relative to the estimate")
      .type_name("E")
      .group(stop);
  options.add_option("--seconds", words.seconds, "Stop after this time").type_name("S").group(stop);
  options.add_option("--max-trials", words.max_trials, "Give up after this many trials (default 1e11)")
      .type_name("N")
      .group(stop);

  const std::string sampling = "Sampling";
  declare_orientations(options, words, sampling);
  options.add_option("--estimator", words.estimator, estimators_help()).type_name("NAME").group(sampling);
  options
      .add_option("--sequence", words.sequence,
                  "random, or sobol: quasi-random points, 32 times scrambled (default but for hit or miss)")
      .type_name("NAME")
      .group(sampling);
  options
      .add_option("--domain", words.domain, "Sampling domain of hit-or-miss: ball, box, or best (default): the smaller")
      .type_name("NAME")
      .group(sampling);
  options
      .add_option("--control-variate", words.control_variate,
                  "A simpler body, like A and B and with a formula of its own, whose known mean makes the error of "
                  "radial or mixed-volume smaller; given twice: like A, and like B. The run then leans on that formula")
      .type_name("BODY")
      .group(sampling);
  declare_seed_and_threads(options, words, sampling);

  const std::string query = "Overlap query";
  options
      .add_option(
          "--backend", words.backend,
          "gjk (default); ccd-gjk or ccd-mpr (libccd; ccd means ccd-mpr); fcl; specialised (tests made for two boxes, "
          "ellipsoids or capsules, or a sphere and one of them)")
      .type_name("NAME")
      .group(query);
  options
      .add_flag("--no-quick-verdicts", words.no_quick_verdicts,
                "Do not let the circumscribed and inscribed balls decide")
      .group(query);
  declare_instruction_set(options, words.isa, query, "the kernels that draw poses and decide them by packets");
  options.add_flag("--cross-check", words.cross_check, "Ask every backend about every pose and list each disagreement")
      .group(query);
  options
      .add_flag("--verify", words.verify,
                "Prove every verdict again from its certificate, in exact arithmetic: some hundred times slower")
      .group(query);

  declare_options_of_two_bodies(options, words);
  declare_output(options, words);
}

std::vector<std::string*> words_of_bodies_laws(CommandLine& words) {
  return {&words.orientations_a, &words.orientations_b, &words.axis, &words.axis_a, &words.axis_b};
}

std::vector<std::string*> words_of_run(CommandLine& words) {
  std::vector<std::string*> all = {
      &words.trials,   &words.relative_error, &words.seconds,         &words.max_trials,   &words.estimator,
      &words.sequence, &words.domain,         &words.backend,         &words.orientations, &words.isa,
      &words.weld,     &words.unit,           &words.format,          &words.scale,        &words.scale_a,
      &words.scale_b,  &words.max_z,          &words.convex_tolerance};
  for (std::string& body : words.control_variate) all.push_back(&body);
  for (std::string* const word : words_of_bodies_laws(words)) all.push_back(word);
  return all;
}

Options interpret(const CommandLine& words) {
  const auto or_default = [](const std::string& word, const char* value) { return word.empty() ? value : word; };
  const std::string backend = or_default(words.backend, "gjk");
  if (!words.estimator.empty()) {
    std::vector<std::string_view> names;
    for (const Estimator* const one : estimators()) names.push_back(one->name);
    require_one_of(words.estimator, "--estimator", names);
  }
  if (!words.sequence.empty()) require_one_of(words.sequence, "--sequence", {"random", "sobol"});
  if (!words.domain.empty()) require_one_of(words.domain, "--domain", {"ball", "box", "best"});

  Options options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.a = words.a;
  options.b = words.b.empty() ? words.a : words.b;
  ExcludedVolumeSettings& settings = options.settings;
  settings.seed = options.seed;
  settings.threads = options.n_threads;
  if (!words.trials.empty()) settings.trials = parse_positive_count(words.trials, "--trials");
  if (!words.relative_error.empty()) settings.rel_error = parse_positive_number(words.relative_error, "--rel-error");
  if (!words.seconds.empty()) settings.seconds = parse_positive_number(words.seconds, "--seconds");
  if (!settings.trials && !settings.rel_error && !settings.seconds) settings.rel_error = 1e-3;
  if (!words.max_trials.empty()) settings.max_trials = parse_positive_count(words.max_trials, "--max-trials");
  if (!words.first_trial.empty()) settings.first_trial = parse_count(words.first_trial, "--first-trial");
  if (settings.first_trial > 0 && (!settings.trials || settings.rel_error || settings.seconds)) {
    throw UsageError("a range of trials ends by their number alone (--first-trial " + words.first_trial +
                     ") - give --trials, and no --rel-error or --seconds");
  }
  options.checkpoint = interpret_checkpoint(words);
  settings.seconds_between_states = options.checkpoint.seconds_between;
  settings.estimator = words.estimator;
  if (!words.sequence.empty()) settings.sequence = words.sequence == "sobol" ? Sequence::sobol : Sequence::random;
  settings.domain = words.domain;
  options.control_variate = words.control_variate;
  if (options.control_variate.size() > 2) {
    throw UsageError("too many bodies (" + options.control_variate.back() + " for --control-variate) - at most two");
  }
  settings.law = interpret_orientations(words);
  settings.instruction_set = instruction_set_named(words.isa);
  settings.backend = backend_named(backend);
  options.is_cross_check = words.cross_check;
  if (words.cross_check) {
    for (BackendKind& kind : every_backend()) {
      if (kind.name != settings.backend.name) settings.cross_check.push_back(std::move(kind));
    }
  }
  // The engine's own by the kernels that were asked for, whether it answers or checks.
  const auto set_kernels = [&settings](BackendKind& kind) {
    if (kind.name == gjk_backend().name) kind = gjk_backend(settings.instruction_set);
  };
  set_kernels(settings.backend);
  std::ranges::for_each(settings.cross_check, set_kernels);
  settings.verify = words.verify;
  settings.quick_verdicts = !words.no_quick_verdicts;
  // Also where no backend is left to check against.
  if (const Estimator* const asked = estimator_asked_for(settings)) settings.estimator = asked->name;
  std::vector<std::string> bodies = {words.a};
  if (!words.b.empty()) bodies.push_back(words.b);
  bodies.insert(bodies.end(), words.control_variate.begin(), words.control_variate.end());
  options.bodies = interpret_bodies(words, bodies);
  options.dump_vertices = words.dump_vertices;
  options.report = words.report;
  return options;
}

}  // namespace vex
