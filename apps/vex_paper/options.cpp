#include "apps/vex_paper/options.h"

#include "apps/common/numbers.h"
#include "apps/vex_paper/rows.h"
#include "engine/numeric/errors.h"

namespace vex {

void declare_options(OptionParser& options, PaperCommandLine& words) {
  const std::string parts = "Parts (without one: all but --curve and --referees)";
  options.add_option("--table", words.tables, "1: boxes of 14 aspect ratios; 2: spheroids of 11. May be given twice")
      .type_name("N")
      .group(parts);
  options
      .add_flag("--text", words.text,
                "The cases of the text: capsules, sphere and cube, aligned cubes, fixed and restricted orientations")
      .group(parts);
  options
      .add_flag("--erratum", words.erratum,
                "Table 1 by the one-sided overlap test, against the paper's faulty values; and by other wrong tests")
      .group(parts);
  options.add_flag("--curve", words.curve, "The wrong tests' deficits at aspect ratios between those of the paper")
      .group(parts);
  options
      .add_flag("--referees", words.referees,
                "GJK against the specialised overlap tests, pose by pose; exact arithmetic judges where they differ")
      .group(parts);

  const std::string sampling = "Sampling";
  options.add_option("--trials", words.trials, "Trials of every row, written like 1e7 (default 1e6)")
      .type_name("N")
      .group(sampling);
  declare_seed_and_threads(options, words, sampling);
  declare_output(options, words);

  options.footer(
      "The paper: S. Sreenivasan, D. R. Baker, G. Paul, H. E. Stanley, cond-mat/0207739 (2002).\n\n"
      "Exit codes:"
      "\n  0  success"
      "\n  1  a fault of the program"
      "\n  2  wrong usage"
      "\n  4  a row disagrees with its exact value, or a verdict of the engine with exact arithmetic"
      "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (what was done is reported)");
}

PaperOptions interpret(const PaperCommandLine& words) {
  PaperOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  for (const std::string& table : words.tables) {
    if (table == "1") {
      options.table_1 = true;
    } else if (table == "2") {
      options.table_2 = true;
    } else {
      throw UsageError("no such table (\"" + table + "\" for --table) - the paper has 1 and 2");
    }
  }
  options.text = words.text;
  options.erratum = words.erratum;
  options.curve = words.curve;
  options.referees = words.referees;
  if (words.tables.empty() && !words.text && !words.erratum && !words.curve && !words.referees) {
    options.table_1 = options.table_2 = options.text = options.erratum = true;
  }
  options.trials = words.trials.empty() ? 1'000'000 : parse_positive_count(words.trials, "--trials");
  if (options.seed > Sampling::kLargestSeed) {
    throw UsageError("too large a seed (" + words.seed + " for --seed) - at most " +
                     std::to_string(Sampling::kLargestSeed) + ": every row makes one of its own from it");
  }
  return options;
}

}  // namespace vex
