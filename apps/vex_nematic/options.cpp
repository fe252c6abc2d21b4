#include "apps/vex_nematic/options.h"

#include "apps/common/choices.h"

namespace vex {

void declare_options(OptionParser& options, NematicCommandLine& words) {
  options.add_option("BODY", words.body, std::string(kBodyHelp) + "; its z axis is the one that aligns")
      .type_name("")
      .required();
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
  options.body_options = interpret_bodies(words, {&words.body, 1});
  options.dump_vertices = words.dump_vertices;
  return options;
}

std::string name_of(NematicTheory theory) { return theory == NematicTheory::onsager ? "onsager" : "parsons-lee"; }

}  // namespace vex
