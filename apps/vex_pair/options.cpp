#include "apps/vex_pair/options.h"

#include "apps/vex_pair/pose_text.h"
#include "engine/numeric/errors.h"

namespace vex {
namespace {

// The one pose of the command line; none where a file of them is named.
std::optional<Transformd> pose_of_words(const PairCommandLine& words) {
  const bool has_parts = !words.rotation.empty() || !words.translation.empty();
  const int n_ways = (words.matrix.empty() ? 0 : 1) + (has_parts ? 1 : 0) + (words.poses.empty() ? 0 : 1);
  const char* const ways = "give --matrix, or --rotation and --translation or one of them, or --poses";
  if (n_ways == 0) throw UsageError(std::string("no pose is given (of B in A's frame) - ") + ways);
  if (n_ways > 1) {
    throw UsageError("poses are given in more than one way (" + std::string(words.matrix.empty() ? "" : "--matrix ") +
                     (has_parts ? "--rotation or --translation " : "") + (words.poses.empty() ? "" : "--poses") +
                     ") - " + ways);
  }
  if (!words.poses.empty()) return std::nullopt;
  if (!words.matrix.empty()) {
    std::array<double, 12> numbers{};
    read_numbers(words.matrix, "--matrix", numbers);
    return pose_of_matrix(numbers);
  }
  std::array<double, 4> wxyz = {1.0, 0.0, 0.0, 0.0};
  std::array<double, 3> t = {0.0, 0.0, 0.0};
  if (!words.rotation.empty()) read_numbers(words.rotation, "--rotation", wxyz);
  if (!words.translation.empty()) read_numbers(words.translation, "--translation", t);
  return pose_of_quaternion(wxyz, {t[0], t[1], t[2]});
}

}  // namespace

void declare_options(OptionParser& options, PairCommandLine& words) {
  options.add_option("A", words.a, kBodyHelp).type_name("").required();
  options.add_option("B", words.b, "The second body, as A is named; vex_pair box:1,1,1 box:1,1,1 for two alike")
      .type_name("")
      .required();

  const std::string pose = "B's pose in A's frame, R x + t (in one of three ways)";
  options
      .add_option(
          "--matrix", words.matrix,
          "R row by row, and t. R is taken as it is, and refused where R^T R is off by more than 1e-6, or where "
          "it mirrors")
      .type_name("r11,r12,r13,r21,...,r33,tx,ty,tz")
      .group(pose);
  options
      .add_option("--rotation", words.rotation,
                  "A quaternion of any length but 0, which is divided by its length (default 1,0,0,0)")
      .type_name("w,x,y,z")
      .group(pose);
  options.add_option("--translation", words.translation, "t, beside --rotation or alone (default 0,0,0)")
      .type_name("x,y,z")
      .group(pose);
  options
      .add_option("--poses", words.poses,
                  std::string("A pose a row, below the header ") + kHeaders + "; - is standard input")
      .type_name("FILE.csv")
      .group(pose);
  options
      .add_flag(
          "--keep-going", words.keep_going,
          "Answer what follows a bad row, too: it becomes a row with an error, and the exit code is 3 in the end. "
          "Without it, the rows before the first bad one are answered")
      .group(pose);

  const std::string query = "Query";
  declare_query_options(options, words, query);
  options.add_option("--threads", words.threads, "Threads (default: all cores); the answers do not depend on them")
      .type_name("N")
      .group(query);
  options.add_option("--seed", words.seed, "Nothing here is random; in the head of --json").type_name("N").group(query);

  declare_options_of_two_bodies(options, words);

  options.add_flag("--jsonl", words.jsonl, "Print an object of JSON a pose").group("Output");
  options
      .add_flag("--csv", words.csv,
                "Print the same as columns: a vector is three; contacts are one cell, seven numbers each (both "
                "points and their signed distance), with semicolons between")
      .group("Output");
  declare_json_and_quiet(options, words, "Print no report and no summary: only what --jsonl or --csv print");

  options.footer(named_bodies_help() +
                 "\n\nNumbers of poses, rays and motions may be decimal (0.1) or hexadecimal (0x1.999999999999ap-4)."
                 "\n\nExit codes:"
                 "\n  0  success; undecided verdicts are answers, too"
                 "\n  1  a certificate that is not proven again (--certificate), or a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  input refused: a body, a pose, a motion, or a row of --poses; a result that would overflow"
                 "\n  128 + N   ended by signal N, 130 and 143 by SIGINT and SIGTERM (the rows answered until then are written)");
}

PairOptions interpret(const PairCommandLine& words) {
  if (words.jsonl && words.csv) throw UsageError("two forms of the same rows (--jsonl and --csv) - choose one");
  if ((words.jsonl || words.csv) && words.json == "-") {
    throw UsageError(std::string("standard output is asked for twice (--json - and ") +
                     (words.jsonl ? "--jsonl" : "--csv") + ") - write one of them into a file");
  }

  PairOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.a = words.a;
  options.b = words.b;
  const std::vector<std::string> bodies = {words.a, words.b};
  options.bodies = interpret_bodies(words, bodies, words.poses);
  options.bodies.with_measures = false;
  options.dump_vertices = words.dump_vertices;
  options.pose = pose_of_words(words);
  options.poses = words.poses;
  options.keep_going = words.keep_going;
  if (options.pose && options.keep_going) {
    throw UsageError("one pose has no rows behind it (--keep-going) - it goes with --poses");
  }
  if (options.dump_vertices && options.json.empty() && (!options.pose || words.jsonl || words.csv)) {
    throw UsageError("rows have no place for a body's vertices (--dump-vertices) - add --json FILE, or give one pose");
  }
  if (words.jsonl) options.layout.format = RowLayout::Format::jsonl;
  if (words.csv) options.layout.format = RowLayout::Format::csv;
  options.query = interpret_query(words);
  options.layout.query = options.query.query;
  options.layout.with_certificate = options.query.with_certificate;
  options.layout.with_error = options.keep_going;
  return options;
}

}  // namespace vex
