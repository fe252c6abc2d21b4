// Distance and penetration depth of the engine beside the peers', on the same poses, in one process: times and errors.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "apps/common/common_options.h"
#include "apps/common/numbers.h"
#include "apps/common/output_file.h"
#include "apps/common/results.h"
#include "apps/common/run_program.h"
#include "shapes/any_shape.h"
#include "tests/bench/bench_pairs.h"
#include "tests/bench/query_contenders.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

struct NamedBody {
  std::string name;
  ConvexBody body;
};

// The bodies of whole trials, and others that have queries of their own elsewhere.
std::vector<NamedBody> query_bodies() {
  std::vector<NamedBody> bodies;
  for (const BenchPair& pair : bench_pairs()) bodies.push_back({pair.name, pair.body});
  bodies.insert(bodies.begin() + 3, {{"cylinder L = 1, R = .5", parse_shape("cylinder:1,0.5").body},
                                     {"cone H = 1, R = .5", parse_shape("cone:1,0.5").body}});
  bodies.insert(bodies.end() - 2, {"hull of 20 points, 3:2:1", test_point_hull(20, {3, 2, 1}, 1).body});
  return bodies;
}

// Of one contender: what its answers are off by, relative to R_A + R_B, beyond the engine's proven bounds.
struct Errors {
  double largest = 0.0;
  std::size_t n_asked = 0, n_failed = 0;

  std::string text() const {
    std::string text = n_failed == n_asked ? "-" : largest == 0.0 ? "0" : short_number(largest, 2);
    if (n_failed > 0) text += " (" + percent(static_cast<double>(n_failed) / static_cast<double>(n_asked)) + ")";
    return text;
  }
};

Errors errors_of(const SeparationAnswer& answer, const SeparationPoses& poses, std::size_t n) {
  Errors errors;
  for (std::size_t k = 0; k < n; ++k) {
    const double value = answer(k);
    ++errors.n_asked;
    if (!std::isfinite(value)) {
      ++errors.n_failed;
      continue;
    }
    const Separation& proven = poses.proven[k];
    errors.largest = std::max(errors.largest, std::max(value - proven.upper, proven.lower - value) / poses.size());
  }
  return errors;
}

// As many poses as are answered in a tenth of a second, to go by the first of them: all, or a power of two.
std::size_t n_affordable(const SeparationAnswer& answer, std::size_t n_poses) {
  const std::size_t n_first = std::min<std::size_t>(16, n_poses);
  for (std::size_t k = 0; k < n_first; ++k) answer(k);  // fills caches
  const double start = processor_ns();
  for (std::size_t k = 0; k < n_first; ++k) answer(k);
  const double n = 1e8 * static_cast<double>(n_first) / (processor_ns() - start + 1.0);
  return n >= static_cast<double>(n_poses) ? n_poses : std::max(n_first, std::bit_floor(static_cast<std::size_t>(n)));
}

struct Row {
  std::string body;
  std::size_t n_poses = 0;
  std::map<std::string, Timing> timings;
  std::map<std::string, Errors> errors;

  // Walks are compared with walks.
  double ratio_of(const SeparationContender& contender) const {
    return ratio(timings.at(contender.name), timings.at(contender.walks ? kEngineInMotion : kEngine));
  }
};

Row measure(SeparationGoal goal, const NamedBody& named, const BenchSettings& settings,
            const std::vector<SeparationContender>& contenders) {
  const std::size_t n = settings.n_poses.value_or(4096);
  const SeparationPoses poses = independent_poses(goal, named.body, settings.seed, n);
  const SeparationPoses motion = poses_in_motion(goal, named.body, settings.seed, n);
  Row row{named.name, n, {}, {}};
  std::vector<Contender> turns;
  for (const SeparationContender& one : contenders) {
    const SeparationPoses& asked = one.walks ? motion : poses;
    const SeparationAnswer answer = one.make(asked);
    if (!answer) continue;
    const std::size_t n_asked = n_affordable(answer, asked.poses.size());
    row.errors[one.name] = errors_of(answer, asked, n_asked);
    turns.push_back({one.name, n_asked, [answer, n_asked] {
                       for (std::size_t k = 0; k < n_asked; ++k) answer(k);
                     }});
  }
  const std::vector<Timing> timings = take_turns(turns, settings.n_rounds, settings.least_turn_ms);
  for (std::size_t k = 0; k < turns.size(); ++k) row.timings[turns[k].name] = timings[k];
  return row;
}

template <class Cell>
std::string table(const std::vector<Row>& rows, const std::vector<SeparationContender>& contenders, const Cell& cell) {
  std::vector<std::string> heads = {"body with itself"};
  std::vector<SeparationContender> shown;
  for (const SeparationContender& one : contenders) {
    if (std::ranges::none_of(rows, [&one](const Row& row) { return row.timings.contains(one.name); })) continue;
    heads.push_back(one.name);
    shown.push_back(one);
  }
  MarkdownTable result(heads);
  for (const Row& row : rows) {
    std::vector<std::string> cells = {row.body};
    for (const SeparationContender& one : shown) {
      cells.push_back(row.timings.contains(one.name) ? cell(row, one) : "-");
    }
    result.add(cells);
  }
  return result.text();
}

Json json_of(const Row& row, const std::vector<SeparationContender>& contenders) {
  Json queries = Json::array();
  for (const SeparationContender& one : contenders) {
    if (!row.timings.contains(one.name)) continue;
    const Errors& errors = row.errors.at(one.name);
    Json query = {{"name", one.name}, {"setting", one.setting}};
    query.update(timing_json(row.timings.at(one.name)));
    query["ratio"] = row.ratio_of(one);
    query["largest_error"] = errors.largest;
    query["asked"] = errors.n_asked;
    query["failed"] = errors.n_failed;
    queries.push_back(query);
  }
  return {{"body", row.body}, {"poses", row.n_poses}, {"queries", queries}};
}

BenchReport compare(SeparationGoal goal, const BenchSettings& settings) {
  const bool is_distance = goal == SeparationGoal::distance;
  const std::vector<SeparationContender> contenders = separation_contenders();
  std::vector<Row> rows;
  BenchReport report;
  report.rows = Json::array();
  for (const NamedBody& named : query_bodies()) {
    rows.push_back(measure(goal, named, settings, contenders));
    report.rows.push_back(json_of(rows.back(), contenders));
  }
  const char* const poses =
      "Poses: orientations isotropic, B's centre uniform in the ball of radius R_A + R_B about A's, those that ";
  report.markdown =
      std::string(is_distance ? "### Distance\n\n" : "### Penetration depth\n\n") + poses +
      (is_distance ? "are apart" : "overlap") +
      "; in motion: from such a pose steps of a thousandth of R_A + R_B and turns of a thousandth of a full one, up to "
      "32. Who is slow is asked about the first of them, as many as take a tenth of a second. Nanoseconds a query: "
      "median of rounds in which everyone takes a turn, and their spread.\n\n" +
      table(rows, contenders,
            [](const Row& row, const SeparationContender& one) { return timing_text(row.timings.at(one.name)); }) +
      "\nTimes what the engine takes at full precision on the same poses.\n\n" +
      table(rows, contenders,
            [](const Row& row, const SeparationContender& one) { return three_digits(row.ratio_of(one)); }) +
      "\nLargest error over R_A + R_B beyond the engine's proven bounds, and in brackets what got no answer.\n\n" +
      table(rows, contenders,
            [](const Row& row, const SeparationContender& one) { return row.errors.at(one.name).text(); });
  return report;
}

std::string settings_list() {
  std::string text = "\n";
  for (const SeparationContender& one : separation_contenders()) text += "- " + one.name + ": " + one.setting + "\n";
  return text;
}

struct Words {
  std::string rounds, turn_ms, poses, seed, json;
};

BenchSettings interpret(const Words& words) {
  BenchSettings settings;
  settings.least_turn_ms = 5.0;
  if (!words.rounds.empty()) settings.n_rounds = static_cast<int>(parse_positive_count(words.rounds, "--rounds"));
  if (!words.turn_ms.empty()) {
    settings.least_turn_ms = static_cast<double>(parse_count(words.turn_ms, "--turn-ms"));
  }
  if (!words.poses.empty()) settings.n_poses = parse_positive_count(words.poses, "--poses");
  if (!words.seed.empty()) settings.seed = parse_count(words.seed, "--seed");
  return settings;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  using namespace vex;
  OptionParser options(
      "Nanoseconds and errors of distance and of penetration depth: the engine, libccd and FCL on the same poses in "
      "the "
      "same process. Prints Markdown. Machine at rest, minutes.",
      "vex_query_bench");
  Words words;
  options.add_option("--json", words.json, "Write all figures to FILE (- is standard output, then without tables)")
      .type_name("FILE");
  options.add_option("--rounds", words.rounds, "Rounds in which every contender takes a turn (default 11)")
      .type_name("N");
  options.add_option("--turn-ms", words.turn_ms, "Repeat each turn until it has taken so long (default 5)")
      .type_name("MS");
  options.add_option("--poses", words.poses, "Poses of each kind (default 4096)").type_name("N");
  options.add_option("--seed", words.seed, "Of the poses (default 1)").type_name("N");
  return run_program(options, argc, argv, [&] {
    const BenchSettings settings = interpret(words);
    std::optional<OutputFile> json;
    if (!words.json.empty()) json.emplace(words.json, std::span<const std::string>{});
    const bool prints = !json || !json->is_standard_output();
    if (prints) std::printf("%s\n%s", machine_line().c_str(), settings_list().c_str());
    const double start = wall_ns();
    Json measured = Json::object();
    for (const SeparationGoal goal : {SeparationGoal::distance, SeparationGoal::depth}) {
      const BenchReport report = compare(goal, settings);
      measured[goal == SeparationGoal::distance ? "distance" : "depth"] = report.rows;
      if (prints) std::printf("\n%s", report.markdown.c_str());
      std::fflush(stdout);
    }
    Results results("vex_query_bench");
    if (json) {
      CommonOptions common;
      common.seed = settings.seed;
      Json document = document_head(command_line(argc, argv), common, true, 1e-9 * (wall_ns() - start));
      document.update(machine_json());
      document["rounds"] = settings.n_rounds;
      document.update(measured);
      results.write(json, Results::Kind::numbers, [&] { return document.dump(2) + "\n"; });
    }
    return results.exit_code(kSuccess);
  });
}
