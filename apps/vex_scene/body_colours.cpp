#include "apps/vex_scene/body_colours.h"

namespace vex {
namespace {

void colour_clusters(const Findings& found, std::vector<std::uint8_t>& colours) {
  std::vector<std::uint8_t> of_cluster(found.clusters.size(), kSingle);
  constexpr std::uint8_t kTurns = kNBodyColours - kFirstOfClusters;
  std::uint8_t turn = 0;
  for (const FoundCluster& cluster : found.clusters) {
    if (cluster.n_bodies < 2) continue;
    if (cluster.label == found.largest_cluster) {
      of_cluster[cluster.label] = kStandsOut;
    } else {
      of_cluster[cluster.label] = static_cast<std::uint8_t>(kFirstOfClusters + turn);
      turn = static_cast<std::uint8_t>((turn + 1) % kTurns);
    }
  }
  for (std::size_t k = 0; k < colours.size(); ++k) colours[k] = of_cluster[found.labels[k]];
}

void colour_pair(const ScenePair& pair, std::uint8_t colour, std::vector<std::uint8_t>& colours) {
  for (const BodyId body : {pair.a, pair.b}) {
    if (colours[body] != kStandsOut) colours[body] = colour;
  }
}

}  // namespace

std::vector<std::uint8_t> body_colours(SceneQuery query, const Findings& found, std::size_t n_bodies) {
  std::vector<std::uint8_t> colours(n_bodies, kPlain);
  if (query == SceneQuery::clusters) {
    colour_clusters(found, colours);
    return colours;
  }
  for (const FoundPair& row : found.pairs) {
    colour_pair(row.pair, row.is_undecided ? kUndecidedColour : kStandsOut, colours);
  }
  if (query == SceneQuery::any && found.answer.outcome != Outcome::disjoint) {
    colour_pair(found.answer.pair, found.answer.outcome == Outcome::overlap ? kStandsOut : kUndecidedColour, colours);
  }
  return colours;
}

}  // namespace vex
