// Whole trials of the engine beside the peers, on the same poses, in one process: docs/performance.md.
#include <cstdio>
#include <optional>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "apps/common/output_file.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"
#include "tests/bench/bench_report.h"
#include "tests/bench/rounds.h"
#include "tests/bench/thread_scaling.h"
#include "tests/bench/trial_rows.h"
#include "tests/bench/vertex_cost.h"

namespace vex {
namespace {

struct Words {
  std::string rounds, turn_ms, poses, seed, most_vertices, most_peer_vertices, json, svg;
  bool all = false, kinds = false, parts = false, vertices = false, threads = false, peers_best = false;
};

void declare(OptionParser& options, Words& words) {
  const char* const modes = "What is measured (without any: whole trials beside the peers)";
  options.add_flag("--peers-best", words.peers_best, "The same with the peers at their own best settings, each named")
      .group(modes);
  options.add_flag("--kinds", words.kinds, "Whole trials of every kind of body, beside libccd").group(modes);
  options.add_flag("--parts", words.parts, "What a trial cannot do without, by itself, beside whole trials")
      .group(modes);
  options.add_flag("--vertices", words.vertices, "Cost of a trial against the number of vertices, 8 to 10^6")
      .group(modes);
  options.add_flag("--threads", words.threads, "One process with two threads against two processes with one")
      .group(modes);
  options.add_flag("--all", words.all, "All of these, one after another").group(modes);
  options.add_option("--json", words.json, "Write all figures to FILE (- is standard output, then without tables)")
      .type_name("FILE");
  options.add_option("--svg", words.svg, "Of --vertices: write the plot to FILE").type_name("FILE");
  options.add_option("--rounds", words.rounds, "Rounds in which every contender takes a turn (default 11)")
      .type_name("N");
  options.add_option("--turn-ms", words.turn_ms, "Repeat each turn until it has taken so long (default 25)")
      .type_name("MS");
  options
      .add_option("--poses", words.poses, "Poses a turn, trials of --threads (default: as many as take minutes in all)")
      .type_name("N");
  options.add_option("--seed", words.seed, "Of the poses (default 1)").type_name("N");
  options.add_option("--most-vertices", words.most_vertices, "Of --vertices: stop there (default 1e6)").type_name("N");
  options
      .add_option("--most-peer-vertices", words.most_peer_vertices,
                  "Of --vertices: FCL, and libccd by scans, stop there (default 1e6)")
      .type_name("N");
}

BenchSettings interpret(const Words& words) {
  BenchSettings settings;
  if (!words.rounds.empty()) {
    const std::uint64_t n = parse_positive_count(words.rounds, "--rounds");
    if (n > 10000) throw UsageError("more rounds than anybody waits for (" + words.rounds + ") - at most 10000");
    settings.n_rounds = static_cast<int>(n);
  }
  if (!words.turn_ms.empty()) {
    settings.least_turn_ms = static_cast<double>(parse_count(words.turn_ms, "--turn-ms"));
  }
  if (!words.poses.empty()) settings.n_poses = parse_positive_count(words.poses, "--poses");
  if (!words.seed.empty()) settings.seed = parse_count(words.seed, "--seed");
  if (!words.most_vertices.empty()) {
    settings.most_vertices = parse_positive_count(words.most_vertices, "--most-vertices");
  }
  if (!words.most_peer_vertices.empty()) {
    settings.most_peer_vertices = parse_positive_count(words.most_peer_vertices, "--most-peer-vertices");
  }
  if (words.kinds + words.parts + words.vertices + words.threads + words.peers_best + words.all > 1) {
    throw UsageError(
        "--kinds, --parts, --vertices, --threads, --peers-best and --all are one measurement each - give one of them");
  }
  if (!words.svg.empty() && !words.vertices && !words.all)
    throw UsageError("--svg without --vertices - there is one plot, of these");
  return settings;
}

struct Mode {
  const char* name;  // in the document
  bool is_asked;
  BenchReport (*measure)(const BenchSettings& settings);
};

std::vector<Mode> modes(const Words& words) {
  const bool is_default = !words.kinds && !words.parts && !words.vertices && !words.threads && !words.peers_best;
  return {{"trials", is_default, compare_trials},
          {"peers_best", words.peers_best || words.all, compare_best_peers},
          {"kinds", words.kinds || words.all, trials_of_kinds},
          {"parts", words.parts || words.all, trial_parts},
          {"vertices", words.vertices || words.all, vertex_costs},
          {"thread_scaling", words.threads || words.all, thread_scaling}};
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  OptionParser options(
      "Nanoseconds of whole trials of the engine (random numbers, pose, proof, tally) beside queries alone of libccd "
      "and "
      "FCL, on the same poses in the same process. Prints Markdown. Machine at rest, minutes.",
      "vex_trial_bench");
  Words words;
  declare(options, words);
  return run_program(options, argc, argv, [&] {
    const BenchSettings settings = interpret(words);
    std::optional<OutputFile> json, svg;
    if (!words.json.empty()) json.emplace(words.json, std::span<const std::string>{});
    if (!words.svg.empty()) svg.emplace(words.svg, std::span<const std::string>{});
    const bool prints = !json || !json->is_standard_output();
    if (prints) std::printf("%s\n", machine_line().c_str());
    const double start = wall_ns();
    nlohmann::ordered_json measured = nlohmann::ordered_json::object();
    Results results("vex_trial_bench");
    for (const Mode& mode : modes(words)) {
      if (!mode.is_asked) continue;
      const BenchReport report = mode.measure(settings);
      measured[mode.name] = report.rows;
      if (!report.picture.empty()) {
        results.write(svg, Results::Kind::picture, [&] { return report.picture; });
      }
      if (prints) std::printf("\n%s", report.markdown.c_str());
      std::fflush(stdout);
    }
    if (json) {
      CommonOptions common;
      common.seed = settings.seed;
      common.n_threads = words.threads || words.all ? settings.n_threads : 1;
      nlohmann::ordered_json document =
          document_head(command_line(argc, argv), common, true, 1e-9 * (wall_ns() - start));
      document.update(machine_json());
      document["rounds"] = settings.n_rounds;
      document.update(measured);
      results.write(json, Results::Kind::numbers, [&] { return document.dump(2) + "\n"; });
    }
    return results.exit_code(kSuccess);
  });
}
