#include "apps/vex_virial/options.h"

#include "apps/common/instruction_sets.h"
#include "apps/common/numbers.h"
#include "apps/common/orientation_options.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/poses/orientation_law_text.h"
#include "engine/sampling/virial/cluster_drawer.h"

namespace vex {
namespace {

int order_of(const std::string& word, const char* option) {
  const std::uint64_t order = parse_count(word, option);
  if (order < 3 || order > 8) throw UsageError("out of range (" + word + " for " + option + ") - give 3 to 8");
  return static_cast<int>(order);
}

// 3 of a mixture; of one body those up to --order, or --only one.
void interpret_orders(const VirialCommandLine& words, bool is_mixture, VirialSettings& settings) {
  if (!words.order.empty()) settings.order = order_of(words.order, "--order");
  if (!words.only.empty()) {
    if (!words.order.empty()) {
      throw UsageError("one coefficient, and all up to one (--only " + words.only + " --order " + words.order +
                       ") - leave out one of them");
    }
    settings.order = settings.first_order = order_of(words.only, "--only");
    if (!words.plot.empty()) {
      throw UsageError("one coefficient has no series to draw (--plot " + words.plot + ") - give --order, not --only");
    }
  }
  if (!is_mixture) return;
  const bool asks_for_others = settings.order != 3 && !(words.order.empty() && words.only.empty());
  if (asks_for_others) {
    throw UsageError("a mixture's coefficients of this order are not built (" + words.order + words.only +
                     (words.only.empty() ? " for --order" : " for --only") + ") - leave it out, or give one body");
  }
  if (!words.plot.empty()) {
    throw UsageError("a mixture has no series to draw (--plot " + words.plot + ") - give one body");
  }
  settings.order = 3;
}

void declare_run(OptionParser& options, VirialCommandLine& words) {
  const std::string stop = "When to stop (whichever comes first; without any, --rel-error 1e-3 and --seconds 60)";
  options
      .add_option("--rel-error", words.rel_error,
                  "Stop the run of each coefficient at this ratio of its standard error to its size; of one that is "
                  "nearly 0 that is never")
      .type_name("E")
      .group(stop);
  options
      .add_option("--seconds", words.seconds,
                  "Stop after this time: an equal part for each coefficient, and what one leaves of it for the next")
      .type_name("S")
      .group(stop);
  options
      .add_option("--samples", words.samples,
                  "Stop the run of each coefficient after this many samples, clusters or triangles, written like 1e9 "
                  "(rounded up to whole bunches)")
      .type_name("N")
      .group(stop);
  options
      .add_option(
          "--trials", words.trials,
          "The same in trials: bunches of 244 clusters, from the sixth coefficient on of 488, of B3 mostly of 256")
      .type_name("N")
      .group(stop);
  const std::string system = "System";
  options.add_option("--order", words.order, "The last coefficient, 3 to 8 (default 4; of a mixture 3)")
      .type_name("N")
      .group(system);
  options
      .add_option("--only", words.only,
                  "This coefficient alone, 3 to 8, in place of all up to --order: it has the whole time, and there is "
                  "no series")
      .type_name("N")
      .group(system);
  options
      .add_option("--orientations", words.orientations,
                  std::string("How each body is turned: isotropic (default); aligned, all alike; or on its own, its "
                              "axis by ") +
                      kAxisLawsHelp)
      .type_name("LAW")
      .group(system);
  declare_axis(options, words.axis, system);
  declare_instruction_set(options, words.isa, system);
  declare_seed_and_threads(options, words, system);
}

void declare_parts(OptionParser& options, VirialCommandLine& words) {
  const std::string parts = "A run in parts";
  declare_checkpoint(options, words, parts);
  options
      .add_option("--first-trial", words.first_trial,
                  "Begin with this trial of each coefficient, and make --trials of them: a part of a run, which "
                  "vex_merge puts together with others")
      .type_name("N")
      .group(parts);
}

}  // namespace

void declare_options(OptionParser& options, VirialCommandLine& words) {
  options.add_option("BODY", words.a, kBodyHelp).required();
  options.add_option("BODY_B", words.b,
                     "Another body: then the third coefficients B_AAA, B_AAB, B_ABB and B_BBB of mixtures");
  declare_run(options, words);
  declare_parts(options, words);
  declare_body_options(options, words);
  declare_json_and_quiet(options, words, "Print no report");
  options
      .add_option("--plot", words.plot,
                  "Draw the compressibility factor Z of the series against the volume fraction, beside equations of "
                  "state like Carnahan and Starling's")
      .type_name("FILE.svg")
      .group("Output");
  options
      .add_option("--report", words.report,
                  "Write a page to look at in a browser, which needs no other file and no network: the bodies to turn, "
                  "all numbers with their meaning, the equation of state; - is standard output")
      .type_name("FILE.html")
      .group("Output");
  options.footer(
      named_bodies_help() +
      "\n\nB2 is the formula's, or the exact mean over the law; B3 to B8 are by Monte Carlo, in units of powers of B2. "
      "Exit codes: 0 success, 2 wrong usage, 3 input refused, 130 or 143 interrupted (what is known is "
      "written all the same, with \"complete\": false).");
}

VirialOptions interpret(const VirialCommandLine& words) {
  VirialOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.a = words.a;
  options.b = words.b;
  std::vector<std::string> texts = {options.a};
  if (options.is_mixture()) texts.push_back(options.b);
  options.body_options = interpret_bodies(words, texts);
  VirialSettings& settings = options.settings;
  interpret_orders(words, options.is_mixture(), settings);
  if (!words.rel_error.empty()) settings.rel_error = parse_positive_number(words.rel_error, "--rel-error");
  if (!words.seconds.empty()) settings.seconds = parse_positive_number(words.seconds, "--seconds");
  if (!words.samples.empty()) settings.samples = parse_positive_count(words.samples, "--samples");
  if (!words.trials.empty()) settings.trials = parse_positive_count(words.trials, "--trials");
  if (!words.first_trial.empty()) settings.first_trial = parse_count(words.first_trial, "--first-trial");
  if (settings.first_trial > 0 && (!settings.trials || settings.rel_error || settings.seconds || settings.samples)) {
    throw UsageError("a range of trials ends by their number alone (--first-trial " + words.first_trial +
                     ") - give --trials, and no other rule");
  }
  options.checkpoint = interpret_checkpoint(words);
  settings.seconds_between_states = options.checkpoint.seconds_between;
  settings.law = law_of_bodies(words.orientations, words.axis);
  require_law_of_one_body(settings.law);
  options.law_file = file_of_law(words.orientations).value_or("");
  settings.seed = options.seed;
  settings.threads = options.n_threads;
  settings.instruction_set = instruction_set_named(words.isa);
  options.dump_vertices = words.dump_vertices;
  options.plot = words.plot;
  options.report = words.report;
  return options;
}

}  // namespace vex
