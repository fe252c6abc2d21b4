#include "apps/vex_nematic/options.h"

#include "apps/common/choices.h"
#include "apps/common/number_range.h"
#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

/// Ascending, from 0 to 1.
std::vector<std::string> shares_of(const std::string& word) {
  const std::string range = word.empty() ? "0:1:0.1" : word;
  std::vector<std::string> shares = {range};
  if (range.find(':') != std::string::npos) shares = numbers_of_range(range, "--composition");
  double before = 0.0;
  for (const std::string& share : shares) {
    const double x = parse_number(share, "--composition");
    if (!(x >= before && x <= 1.0)) {
      throw UsageError("not a share that ascends from 0 to 1 (" + share +
                       " for --composition) - give FROM:TO:STEP within");
    }
    before = x;
  }
  constexpr std::size_t kMostShares = 1000;
  if (shares.size() > kMostShares) {
    throw UsageError("too many shares (" + std::to_string(shares.size()) + " for --composition) - give at most 1000");
  }
  return shares;
}

}  // namespace

void declare_options(OptionParser& options, NematicCommandLine& words) {
  options.add_option("BODY", words.body, std::string(kBodyHelp) + "; its z axis is the one that aligns")
      .type_name("")
      .required();
  options
      .add_option("BODY_B", words.other,
                  "Another body: then the fluids of mixtures of both, which begin at the transition of BODY alone")
      .type_name("");
  options
      .add_option("--composition", words.composition,
                  "Of a mixture: the share of BODY_B in the number of bodies of the isotropic fluid (default 0:1:0.1)")
      .type_name("FROM:TO:STEP")
      .group("Mixture");
  const std::string theory = "Theory";
  options
      .add_option(
          "--theory", words.theory,
          "onsager (default): the second virial coefficient alone, exact for bodies that are infinitely thin; or "
          "parsons-lee: all others scaled as those of hard spheres, for bodies with a volume")
      .type_name("NAME")
      .group(theory);
  options
      .add_option("--trial-function", words.trial_function,
                  "onsager: orientations by his trial function cosh(alpha cos theta) instead of the density that has "
                  "the least free energy")
      .type_name("NAME")
      .group(theory);
  declare_seed_and_threads(options, words, "Of every program; here nothing is random, and one thread is enough");
  declare_body_options(options, words);
  declare_json_and_quiet(options, words, "Print no report");
  options
      .add_option("--plot", words.plot,
                  "Draw the density of orientations, and the pressure of both fluids against the density")
      .type_name("FILE.svg")
      .group("Output");
  options.footer(named_bodies_help() +
                 "\n\nExit codes:"
                 "\n  0  success, also where a body has no such transition"
                 "\n  1  a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  input refused"
                 "\n  130, 143  interrupted");
}

NematicOptions interpret(const NematicCommandLine& words) {
  NematicOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  if (!words.theory.empty()) require_one_of(words.theory, "--theory", {"onsager", "parsons-lee"});
  if (!words.trial_function.empty()) require_one_of(words.trial_function, "--trial-function", {"onsager"});
  options.theory = words.theory == "parsons-lee" ? NematicTheory::parsons_lee : NematicTheory::onsager;
  options.trial_function = !words.trial_function.empty();
  options.body = words.body;
  options.plot = words.plot;
  options.other = words.other;
  std::vector<std::string> bodies = {words.body};
  if (!words.other.empty()) bodies.push_back(words.other);
  options.body_options = interpret_bodies(words, bodies);
  if (!words.composition.empty() && words.other.empty()) {
    throw UsageError("one body has no composition (--composition " + words.composition + ") - give a second body");
  }
  if (!words.other.empty()) options.compositions = shares_of(words.composition);
  if (!words.other.empty() && options.trial_function) {
    throw UsageError("mixtures are of the density that minimises (--trial-function " + words.trial_function +
                     ") - leave it out");
  }
  if (!words.other.empty() && !words.plot.empty()) {
    throw UsageError("mixtures have no picture yet (--plot " + words.plot +
                     ") - leave it out, and draw the numbers of --json");
  }
  options.dump_vertices = words.dump_vertices;
  return options;
}

std::string name_of(NematicTheory theory) { return theory == NematicTheory::onsager ? "onsager" : "parsons-lee"; }

}  // namespace vex
