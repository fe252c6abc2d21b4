#include "apps/vex_bench/options.h"

#include <filesystem>
#include <utility>

#include "apps/common/numbers.h"
#include "engine/numeric/errors.h"

namespace vex {

void declare_options(OptionParser& options, BenchCommandLine& words) {
  options
      .add_option("BODY", words.bodies,
                  "Mesh files (- for standard input) or named bodies, each with itself; without any: cube, plate .01, "
                  "needle 64, ellipsoid 4:1:1, capsule, hull of 100 points")
      .type_name("");
  const std::string sampling = "Measurement";
  options.add_flag("--standard", words.standard, "Those six too, before the bodies that are named").group(sampling);
  options
      .add_option("--seconds", words.seconds,
                  "Time for each curve, about (default 1); longer runs reach smaller errors")
      .type_name("S")
      .group(sampling);
  declare_seed_and_threads(options, words, sampling);
  declare_body_options(options, words);
  const std::string output = "Output";
  declare_json_and_quiet(options, words, "Print no table and no progress");
  options.add_option("--csv", words.csv, "Write every point of every curve as a row of numbers")
      .type_name("FILE")
      .group(output);
  options
      .add_option(
          "--plot", words.plot,
          "Draw error over run time (SVG): the estimators that GJK runs, each with its usual points, and libccd "
          "and FCL")
      .type_name("FILE")
      .group(output);
  options.add_option("--plot-others", words.plot_others, "The same of all others").type_name("FILE").group(output);
  options.footer(named_bodies_help() +
                 "\n\nExit codes:"
                 "\n  0  success"
                 "\n  1  a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  input refused"
                 "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (what was measured is reported)");
}

BenchOptions interpret(const BenchCommandLine& words) {
  BenchOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.bodies = words.bodies;
  options.standard = words.standard || words.bodies.empty();
  if (!words.seconds.empty()) options.seconds = parse_positive_number(words.seconds, "--seconds");
  options.csv = words.csv;
  options.plot = words.plot;
  options.plot_others = words.plot_others;
  for (const auto& [file, option] : {std::pair(words.plot, "--plot"), std::pair(words.plot_others, "--plot-others")}) {
    const std::string suffix = std::filesystem::path(file).extension().string();
    if (suffix.empty() || suffix == ".svg" || file == "-") continue;
    throw UsageError("only SVG is drawn (" + file + " for " + option +
                     ") - name it .svg; rsvg-convert makes other formats");
  }
  if (words.dump_vertices) throw UsageError("no vertices are listed here (--dump-vertices) - vex_mesh lists them");
  options.body_options = interpret_bodies(words, words.bodies);
  return options;
}

}  // namespace vex
