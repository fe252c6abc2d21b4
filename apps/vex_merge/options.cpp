#include "apps/vex_merge/options.h"

#include "apps/common/numbers.h"

namespace vex {

void declare_options(OptionParser& options, MergeCommandLine& words) {
  options
      .add_option("FILES", words.files,
                  "JSON documents of vex_mesh or vex_virial --first-trial FIRST --trials N, or of vex_percolate "
                  "--first-realisation FIRST --realisations N, in any order; what vex_merge --part wrote is one, too")
      .type_name("")
      .required();
  const std::string what = "What must be there";
  options
      .add_option("--trials", words.trials,
                  "Refuse another number of trials, or realisations, in all: the last document may be missing")
      .type_name("N")
      .group(what);
  options.add_flag("--part", words.part, "The trials may begin behind trial 0: their result is itself a part")
      .group(what);
  declare_output(options, words);
  options.footer(
      "Exit codes:"
      "\n  0  success"
      "\n  1  a fault of the program"
      "\n  2  wrong usage"
      "\n  3  documents refused: unreadable, of unlike runs, trials missing or twice there"
      "\n  4  Monte Carlo and formula disagree");
}

MergeOptions interpret(const MergeCommandLine& words) {
  MergeOptions options;
  const CommonOptions common = interpret_common(words);
  options.files = words.files;
  if (!words.trials.empty()) options.trials = parse_positive_count(words.trials, "--trials");
  options.is_part = words.part;
  options.max_z = common.max_z;
  options.json = common.json;
  options.quiet = common.quiet;
  return options;
}

}  // namespace vex
