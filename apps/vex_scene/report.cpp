#include "apps/vex_scene/report.h"

#include <algorithm>

#include "apps/common/numbers.h"
#include "apps/common/text.h"
#include "engine/numeric/number_text.h"

namespace vex {
namespace {

std::string space_text(const std::optional<PeriodicBox>& box) {
  if (!box) return "open space";
  const Vec3d& edges = box->edges();
  std::string text =
      "a periodic box " + shortest_number(edges.x) + "," + shortest_number(edges.y) + "," + shortest_number(edges.z);
  if (box->xy() != 0.0 || box->xz() != 0.0 || box->yz() != 0.0) {
    for (const double tilt : {box->xy(), box->xz(), box->yz()}) text += "," + shortest_number(tilt);
  }
  return text;
}

std::string vectors_text(const std::array<bool, 3>& wraps) {
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    if (wraps[k]) text += (text.empty() ? "" : ", ") + std::string(1, static_cast<char>('x' + k));
  }
  return text;
}

std::string pair_text(const ScenePair& pair) {
  std::string text = "bodies " + std::to_string(pair.a) + " and " + std::to_string(pair.b);
  if (pair.image == ImageOffset{}) return text;
  return text + " (image " + std::to_string(pair.image[0]) + "," + std::to_string(pair.image[1]) + "," +
         std::to_string(pair.image[2]) + ")";
}

std::string clusters_text(const SceneRun& run) {
  const Findings& found = run.found;
  std::string text = plural(found.clusters.size(), "cluster", "clusters");
  if (run.options.distance > 0.0) text += " of bodies within " + shortest_number(run.options.distance);
  if (found.clusters.empty()) return text;
  const FoundCluster& largest = found.clusters[found.largest_cluster];
  text += "; the largest is cluster " + std::to_string(largest.label) + ", of " +
          plural(largest.n_bodies, "body", "bodies");
  if (!run.box) return text;
  const std::size_t n_wrapping = found.n_wrapping_clusters();
  if (n_wrapping == 0) return text + "; none wraps around the box";
  text += "; " + std::to_string(n_wrapping) + (n_wrapping == 1 ? " wraps around the box" : " wrap around the box");
  const auto first = std::ranges::find_if(found.clusters, &FoundCluster::wraps_at_all);
  return text + ": cluster " + std::to_string(first->label) + " along " + vectors_text(first->wraps);
}

// Where no pair overlaps all were looked at, and the number of the undecided ones is known.
std::string any_text(const SceneAnswer& answer) {
  switch (answer.outcome) {
    case Outcome::overlap: return "two bodies OVERLAP: " + pair_text(answer.pair);
    case Outcome::disjoint: return "no two bodies overlap";
    case Outcome::undecided: break;
  }
  const std::uint64_t n_undecided = answer.n_undecided.value_or(1);
  return "UNDECIDED: whether two bodies overlap is not proven, of " + pair_text(answer.pair) +
         (n_undecided == 1 ? "" : " and " + plural(n_undecided - 1, "other pair", "other pairs"));
}

std::string answer_text(const SceneRun& run) {
  const Findings& found = run.found;
  if (!found.is_complete) return "interrupted before the answer: nothing is known";
  std::string text;
  switch (run.options.query) {
    case SceneQuery::any: return any_text(found.answer);
    case SceneQuery::clusters: text = clusters_text(run); break;
    case SceneQuery::within:
      text = plural(found.n_pairs, "pair", "pairs") + " within " + shortest_number(run.options.distance);
      break;
    case SceneQuery::pairs:
    case SceneQuery::counts:
      text = found.n_pairs == 1 ? "1 pair overlaps" : std::to_string(found.n_pairs) + " pairs overlap";
      if (run.n_bodies > 0) {
        text += ", neighbours a body: " +
                short_number(2.0 * static_cast<double>(found.n_pairs) / static_cast<double>(run.n_bodies), 6);
      }
      break;
  }
  return text + "; " + plural(found.n_undecided.value_or(0), "pair is UNDECIDED", "pairs are undecided");
}

std::string stages_text(const SceneCounts& counts) {
  std::vector<std::vector<std::string>> lines = {{"stage", "saw", "settled", "left"}};
  for (int k = 0; k < kNSceneStages; ++k) {
    const SceneStage stage = static_cast<SceneStage>(k);
    const auto& [seen, settled] = counts[stage];
    if (seen == 0) continue;
    lines.push_back(
        {std::string(name_of(stage)), std::to_string(seen), std::to_string(settled), std::to_string(seen - settled)});
  }
  return lines.size() == 1 ? "" : table_text(lines);
}

}  // namespace

std::string summary_text(const SceneRun& run) {
  std::string text = plural(run.n_bodies, "body", "bodies") + " of " + plural(run.bodies.size(), "shape", "shapes") +
                     " in " + space_text(run.box) + "\n";
  text += answer_text(run) + "\n";
  text += stages_text(run.found.counts);
  text += short_number(run.seconds, 3) + " s on " +
          plural(static_cast<std::uint64_t>(run.options.n_threads), "thread", "threads");
  text += ": " + short_number(run.read_seconds, 3) + " s to load";
  if (run.found.is_complete) {
    text += ", " + short_number(run.found.build_seconds, 3) + " s to build, " +
            short_number(run.found.query_seconds, 3) + " s to answer";
  }
  return text + "\n";
}

}  // namespace vex
