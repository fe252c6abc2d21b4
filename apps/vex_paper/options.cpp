#include "apps/vex_paper/options.h"

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {

void declare_options(CLI::App& app, PaperCommandLine& words) {
  const std::string parts = "Parts (without one: all but --curve and --referees)";
  app.add_option("--table", words.tables, "1: boxes of 14 aspect ratios; 2: spheroids of 11. May be given twice")
      ->type_name("N")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group(parts);
  app.add_flag("--text", words.text,
               "The cases of the text: capsules, sphere and cube, aligned cubes, fixed and restricted orientations")
      ->group(parts);
  app.add_flag("--erratum", words.erratum,
               "Table 1 by the one-sided overlap test, against the paper's faulty values; and by other wrong tests")
      ->group(parts);
  app.add_flag("--curve", words.curve, "The wrong tests' deficits at aspect ratios between those of the paper")
      ->group(parts);
  app.add_flag("--referees", words.referees,
               "GJK against the specialised overlap tests, pose by pose; exact arithmetic judges where they differ")
      ->group(parts);

  const std::string sampling = "Sampling";
  app.add_option("--trials", words.trials, "Trials of every row, written like 1e7 (default 1e6)")
      ->type_name("N")
      ->group(sampling);
  app.add_option("--seed", words.seed, "The same seed gives the same hits on any number of threads (default 1)")
      ->type_name("N")
      ->group(sampling);
  app.add_option("--threads", words.threads, "Threads (default: all cores)")->type_name("N")->group(sampling);

  const std::string output = "Output";
  app.add_option("--json", words.json,
                 "Write one JSON document; - is standard output, where then nothing else is printed")
      ->type_name("FILE")
      ->group(output);
  app.add_option("--max-z", words.max_z, "Exit with 4 where a row is off by more standard errors (default 6)")
      ->type_name("Z")
      ->group(output);
  app.add_flag("--quiet", words.quiet, "Print no tables and draw no progress bar")->group(output);

  app.footer(
      "The paper: S. Sreenivasan, D. R. Baker, G. Paul, H. E. Stanley, cond-mat/0207739 (2002).\n\n"
      "Exit codes:"
      "\n  0  success"
      "\n  1  a fault of the program"
      "\n  2  wrong usage"
      "\n  4  a row disagrees with its exact value, or a verdict of the engine with exact arithmetic"
      "\n  130, 143  interrupted (what was done is reported)");
}

PaperOptions interpret(const PaperCommandLine& words) {
  PaperOptions options;
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
  if (!words.seed.empty()) options.seed = parse_count(words.seed, "--seed");
  options.n_threads = parse_threads(words.threads);
  if (!words.max_z.empty()) options.max_z = parse_positive_number(words.max_z, "--max-z");
  options.json = words.json;
  options.quiet = words.quiet;
  return options;
}

}  // namespace vex
