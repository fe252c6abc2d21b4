#include "apps/vex_virial/options.h"

#include "apps/common/instruction_sets.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// What the library asks as well: said before a body is read.
OrientationLaw law_of(const std::string& word) {
  if (word.empty() || word == "isotropic") return OrientationLaw::isotropic();
  if (word == "aligned") return OrientationLaw::aligned();
  throw UsageError("not a choice (\"" + word +
                   "\" for --orientations) - there are isotropic and aligned: of other laws a chain of bodies is no "
                   "power of B2");
}

int order_of(const std::string& word) {
  const std::uint64_t order = parse_count(word, "--order");
  if (order < 3 || order > 8) throw UsageError("out of range (" + word + " for --order) - give 3 to 8");
  return static_cast<int>(order);
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
      .add_option("--orientations", words.orientations,
                  "How each body is turned: isotropic (default) or aligned, all alike")
      .type_name("LAW")
      .group(system);
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
      "\n\nB2 is the formula's, or exact; B3 to B8 are by Monte Carlo, in units of powers of B2, which the run does "
      "not "
      "need to know. Exit codes: 0 success, 2 wrong usage, 3 input refused, 130 or 143 interrupted (what is known is "
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
  if (!words.order.empty()) settings.order = order_of(words.order);
  if (options.is_mixture()) {
    if (!words.order.empty() && settings.order != 3) {
      throw UsageError("a mixture's coefficients of this order are not built (" + words.order +
                       " for --order) - leave it out, or give one body");
    }
    if (!words.plot.empty()) {
      throw UsageError("a mixture has no series to draw (--plot " + words.plot + ") - give one body");
    }
    settings.order = 3;
  }
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
  settings.law = law_of(words.orientations);
  settings.seed = options.seed;
  settings.threads = options.n_threads;
  settings.instruction_set = instruction_set_named(words.isa);
  options.dump_vertices = words.dump_vertices;
  options.plot = words.plot;
  options.report = words.report;
  return options;
}

}  // namespace vex
