// Whole trials of every kind of body with itself: docs/performance.md.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/common/numbers.h"
#include "apps/peers/peers.h"
#include "shapes/any_shape.h"
#include "tests/bench/pair_result.h"
#include "tests/bench/trial_rows.h"

namespace vex {
namespace {

// Sizes of those that are not told by one edge or radius of 1.
const std::map<std::string_view, std::vector<const char*>> kSizes = {
    {"box", {"1,1,1", "1,1,10", "0.01,1,1"}},
    {"ellipsoid", {"4,1,1", "1,1,0.25", "3,2,1"}},
    {"capsule", {"1,0.25", "10,0.25"}},
    {"cylinder", {"1,0.5", "10,0.5", "0.1,0.5"}},
    {"cone", {"1,0.5", "4,0.5"}},
    {"frustum", {"1,0.5,0.25"}},
    {"lens", {"1,0.5"}},
    {"cut-sphere", {"1,0.5,0.25"}},
    {"spindle", {"2,0.5"}},
    {"egg", {"1,0.5,2"}},
    {"superball", {"2,1", "0.75,1"}},
    {"superellipsoid", {"1,1,2,0.8,1.2"}},
    {"plate", {"1,1"}},
    {"prism", {"6,1,1"}},
    {"antiprism", {"5,1,1"}},
    {"pyramid", {"4,1,1"}},
    {"rounded", {"0.1,tetrahedron:1", "0.1,cylinder:1,0.5"}},
};

std::vector<std::string> texts_of_kinds() {
  std::vector<std::string> texts;
  for (const NamedShape& shape : named_shapes()) {
    const auto sizes = kSizes.find(shape.name);
    if (sizes == kSizes.end()) {
      texts.push_back(std::string(shape.name) + ":1");
      continue;
    }
    for (const char* size : sizes->second) texts.push_back(std::string(shape.name) + ":" + size);
  }
  return texts;
}

// Fewer poses than of the six pairs of compare_trials: there are many bodies.
constexpr std::size_t kPoses = std::size_t{1} << 15;

PairResult result_of(const std::string& text, const BenchSettings& settings) {
  const BenchPair pair{text, parse_shape(text).body, kPoses, 0.0, 0.0};
  const std::size_t n = n_poses_of(pair, settings);
  MonteCarloSettings trial = trial_settings(pair.body, settings.seed, n);
  std::vector<Contender> trials = {trial_contender(kTrial, pair.body, trial)};
  trial.quick_verdicts = false;
  trials.push_back(trial_contender(kTrialWithoutQuick, pair.body, trial));
  std::vector<PeerEntry> peers;
  for (BackendKind& kind : peer_backends()) {
    if (std::string_view(kind.name).starts_with("ccd")) peers.push_back({std::move(kind)});
  }
  return run_pair(pair, settings, trials,
                  {renamed(gjk_backend(), kQuery), renamed(gjk_backend(InstructionSet::scalar), kOneAtATime)}, peers);
}

std::string share(const PairResult& result, std::uint64_t n) {
  return percent(static_cast<double>(n) / static_cast<double>(result.tally.n_trials));
}

}  // namespace

BenchReport trials_of_kinds(const BenchSettings& settings) {
  const std::vector<std::string> ccd = {"ccd-gjk", "ccd-mpr"};
  MarkdownTable table({"body with itself", "hits", "quick verdicts", "whole trial", "without quick verdicts", "query",
                       "query one at a time", "libccd's faster", "libccd / whole trial", "verdicts otherwise"});
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const std::string& text : texts_of_kinds()) {
    const PairResult result = result_of(text, settings);
    const auto decided = [&](DecidedBy by) { return result.tally.n_decided_by[static_cast<std::size_t>(by)]; };
    const std::string* const peer = result.fastest(ccd);
    table.add({"`" + text + "`", share(result, result.n_hits),
               share(result, decided(DecidedBy::outer_bound) + decided(DecidedBy::inner_bound)),
               result.timing_cell(kTrial), result.timing_cell(kTrialWithoutQuick), result.timing_cell(kQuery),
               result.timing_cell(kOneAtATime), peer == nullptr ? "-" : result.timing_cell(*peer),
               peer == nullptr ? "-" : three_digits(result.ratio_of(*peer)),
               peer == nullptr ? "-" : result.differences_cell(*peer)});
    rows.push_back(result.json());
  }
  return {"### Every kind of body\n\n" + std::string(kHowTimed) +
              "libccd calls the engine's own support mappings, and is taken by its faster query; the last column is "
              "what it misses + what it invents, in brackets what it gives up.\n\n" +
              table.text(),
          rows};
}

}  // namespace vex
