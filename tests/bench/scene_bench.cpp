// Scenes of many bodies, beside a plain grid and FCL's manager, in one process: times, pairs, and what the stages did.
#include <cstdio>
#include <functional>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "apps/common/output_file.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "engine/numeric/errors.h"
#include "tests/bench/rounds.h"
#include "tests/bench/scene_parts.h"

namespace vex {
namespace {

struct Part {
  const char* name;
  std::function<BenchReport(const ScenePartSettings&)> run;
};

std::vector<Part> parts() {
  std::vector<Part> all = {{"cubes", cubes_part},   {"growth", growth_part}, {"thin_and_unlike", thin_and_unlike_part},
                           {"prices", prices_part}, {"motion", motion_part}, {"trial_moves", trial_moves_part}};
#ifdef VEX_WITH_FCL
  all.push_back({"fcl", fcl_part});
#endif
  return all;
}

struct Words {
  std::string rounds, share, threads, json;
  std::vector<std::string> parts;
};

ScenePartSettings interpret(const Words& words) {
  ScenePartSettings settings;
  if (!words.rounds.empty()) settings.n_rounds = static_cast<int>(parse_positive_count(words.rounds, "--rounds"));
  if (!words.threads.empty()) settings.n_threads = static_cast<int>(parse_positive_count(words.threads, "--threads"));
  if (!words.share.empty()) {
    settings.share = 1.0 / static_cast<double>(parse_positive_count(words.share, "--divide-by"));
  }
  for (const std::string& name : words.parts) {
    bool is_known = false;
    for (const Part& part : parts()) is_known = is_known || name == part.name;
    if (!is_known) throw UsageError("no part is named \"" + name + "\" - see --help");
  }
  return settings;
}

bool is_wanted(const Words& words, const std::string& part) {
  if (words.parts.empty()) return true;
  for (const std::string& name : words.parts) {
    if (name == part) return true;
  }
  return false;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  std::string names;
  for (const Part& part : parts()) names += (names.empty() ? "" : ", ") + std::string(part.name);
  OptionParser options("Times of scenes of many bodies. Prints Markdown. Machine at rest, minutes, 8 GB of memory.",
                       "vex_scene_bench");
  Words words;
  options.add_option("--json", words.json, "Write all figures to FILE (- is standard output, then without tables)")
      .type_name("FILE");
  options.add_option("--rounds", words.rounds, "Rounds in which every contender takes a turn (default 5)")
      .type_name("N");
  options.add_option("--divide-by", words.share, "Take so many times fewer bodies (default 1)").type_name("N");
  options.add_option("--threads", words.threads, "Of the rows with several threads (default 2)").type_name("N");
  options.add_option("PART", words.parts, "Only these: " + names);
  return run_program(options, argc, argv, [&] {
    const ScenePartSettings settings = interpret(words);
    std::optional<OutputFile> json;
    if (!words.json.empty()) json.emplace(words.json, std::span<const std::string>{});
    const bool prints = !json || !json->is_standard_output();
    if (prints) std::printf("%s\n", machine_line().c_str());
    const double start = wall_ns();
    nlohmann::ordered_json measured = nlohmann::ordered_json::object();
    for (const Part& part : parts()) {
      if (!is_wanted(words, part.name)) continue;
      const BenchReport report = part.run(settings);
      measured[part.name] = report.rows;
      if (prints) std::printf("\n%s", report.markdown.c_str());
      std::fflush(stdout);
    }
    Results results("vex_scene_bench");
    if (json) {
      nlohmann::ordered_json document =
          document_head(command_line(argc, argv), CommonOptions{}, true, 1e-9 * (wall_ns() - start));
      document.update(machine_json());
      document["rounds"] = settings.n_rounds;
      document["share"] = settings.share;
      document.update(measured);
      results.write(json, Results::Kind::numbers, [&] { return document.dump(2) + "\n"; });
    }
    return results.exit_code(kSuccess);
  });
}
