#include "apps/common/body_options.h"
#include "apps/vex_scan/scan.h"

namespace vex {

void declare_options(OptionParser& options, ScanCommandLine& words) {
  options
      .add_option("BODIES", words.bodies, "Mesh files, or named bodies such as 'capsule:{L},0.5', each run with itself")
      .type_name("");
  const std::string cases = "Cases";
  options
      .add_option("--for", words.ranges,
                  "Runs every case for each of these numbers, which takes the place of {NAME} in bodies and options; "
                  "given several times, for all combinations. NAME of letters and digits; TO is among them where STEPs "
                  "lead there")
      .type_name("NAME=FROM:TO:STEP")
      .group(cases);
  options
      .add_option(
          "--angle", words.angle,
          "Runs every case at each of these angles between the two bodies' z axes, each body spun about its own "
          "(vex_mesh --orientations angle:DEG): V_ex(gamma)")
      .type_name("FROM:TO:STEP")
      .group(cases);
  options.add_flag("--pairs", words.pairs, "All pairs of the bodies, each with itself among them").group(cases);
  options.add_option("--with", words.with, "Each body with this one, not with itself").type_name("BODY").group(cases);

  declare_run_options(options, words);

  const std::string output = "Output";
  options
      .add_option(
          "--csv", words.csv,
          "Write a row a case. Rows that this file already holds are kept and not run again, where their input "
          "is the same: so an interrupted scan goes on, and a finer or longer one runs what is new. Rows of no case "
          "of this scan are left out at its end, which is said. A file with anything else in it, or other variables, "
          "is refused")
      .type_name("FILE")
      .group(output);
  options.add_option("--jsonl", words.jsonl, "The same as JSON, an object a line, with more of each run")
      .type_name("FILE")
      .group(output);
  options
      .add_option("--plot", words.plot,
                  "Draw <V_ex> against the variable, with error bars, and the exact curve where it is known")
      .type_name("FILE.svg")
      .group(output);
  options
      .add_option("--report", words.report,
                  "Write a page to look at in a browser, which needs no other file and no network: the curve, every "
                  "number, the first case's bodies to turn; - is standard output")
      .type_name("FILE.html")
      .group(output);
  options.footer(named_bodies_help() +
                 "\n\nExit codes:"
                 "\n  0  success"
                 "\n  1  a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  a case was refused (the others are done)"
                 "\n  4  Monte Carlo and formula disagree in a case"
                 "\n  130, 143  interrupted (rows that were done are kept)");
}

}  // namespace vex
