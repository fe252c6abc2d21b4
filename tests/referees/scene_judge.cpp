#include "tests/referees/scene_judge.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/query/contact_manifold.h"
#include "engine/query/overlap.h"
#include "engine/query/separation.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

std::string text_of(const ScenePair& pair) {
  std::string text = std::to_string(pair.a) + "-" + std::to_string(pair.b);
  for (const int image : pair.image) text += " " + std::to_string(image);
  return text;
}

std::string difference(const std::string& what, const std::vector<ScenePair>& got, const std::vector<ScenePair>& want) {
  if (got == want) return "";
  std::string text = what + ": " + std::to_string(got.size()) + " instead of " + std::to_string(want.size());
  std::vector<ScenePair> only;
  std::set_difference(got.begin(), got.end(), want.begin(), want.end(), std::back_inserter(only));
  if (!only.empty()) text += ", too many: " + text_of(only.front());
  only.clear();
  std::set_difference(want.begin(), want.end(), got.begin(), got.end(), std::back_inserter(only));
  if (!only.empty()) text += ", missing: " + text_of(only.front());
  return text;
}

// Calls visit(pair, pose of b) for all pairs whose balls are within the margin of each other.
template <class Visit>
void for_every_pair(const Scene& scene, double margin, const Visit& visit) {
  for (BodyId a = 0; a < scene.end(); ++a) {
    for (BodyId b = a; b < scene.end(); ++b) {
      if (!scene.has(a) || !scene.has(b)) continue;
      const ConvexBody &body_a = scene.shape(scene.shape_of(a)), &body_b = scene.shape(scene.shape_of(b));
      const double reach = (body_a.circumradius() + body_b.circumradius() + margin) * (1.0 + 1e-5) +
                           1e-5 * (norm(body_a.centre()) + norm(body_b.centre()));
      ImageOffset most{};
      if (scene.box()) {
        const Vec3d faces = scene.box()->face_distances();
        const double distances[] = {faces.x, faces.y, faces.z};
        for (std::size_t k = 0; k < 3; ++k) most[k] = static_cast<int>(std::ceil(reach / distances[k])) + 1;
      }
      for (int x = -most[0]; x <= most[0]; ++x) {
        for (int y = -most[1]; y <= most[1]; ++y) {
          for (int z = -most[2]; z <= most[2]; ++z) {
            const ScenePair pair{a, b, {x, y, z}};
            if (a == b && !(pair.image > ImageOffset{})) continue;
            const Transformd pose = scene.relative_pose(pair);
            if (norm(pose(body_b.centre()) - body_a.centre()) <= reach) visit(pair, pose);
          }
        }
      }
    }
  }
}

const ConvexBody& body_of(const Scene& scene, BodyId body) { return scene.shape(scene.shape_of(body)); }

std::vector<ScenePair> those_of(BodyId body, const std::vector<ScenePair>& pairs) {
  std::vector<ScenePair> some;
  std::ranges::copy_if(pairs, std::back_inserter(some), [&](const ScenePair& p) { return p.a == body || p.b == body; });
  return some;
}

Outcome outcome_of(const std::vector<ScenePair>& pairs, const std::vector<ScenePair>& undecided) {
  if (!pairs.empty()) return Outcome::overlap;
  return undecided.empty() ? Outcome::disjoint : Outcome::undecided;
}

}  // namespace

EveryPair every_pair(const Scene& scene, double margin) {
  EveryPair every;
  for_every_pair(scene, margin, [&](const ScenePair& pair, const Transformd& pose) {
    ++every.n_asked;
    const ConvexBody& a = body_of(scene, pair.a);
    const Outcome outcome =
        overlap(margin > 0.0 ? with_margin(a, margin) : a, body_of(scene, pair.b), Pose(pose)).outcome;
    if (outcome == Outcome::undecided) every.undecided.push_back(pair);
    if (outcome != Outcome::overlap) return;
    if (pair.a == pair.b) ++every.n_own;
    const bool is_repeated = !every.pairs.empty() && every.pairs.back().a == pair.a && every.pairs.back().b == pair.b;
    if (is_repeated) ++every.n_repeated;
    every.pairs.push_back(pair);
  });
  return every;
}

std::string fault_of_pairs(Scene& scene, const EveryPair& every) {
  ScenePairs found;
  scene.overlapping_pairs(found);
  if (std::string fault = difference("overlapping pairs", found.pairs, every.pairs); !fault.empty()) return fault;
  if (std::string fault = difference("undecided pairs", found.undecided, every.undecided); !fault.empty()) return fault;
  const SceneAnswer any = scene.any_overlap();
  if (any.outcome != outcome_of(every.pairs, every.undecided)) return "any_overlap: another answer";
  if (any.outcome == Outcome::overlap ? any.n_undecided.has_value() : any.n_undecided != every.undecided.size()) {
    return "any_overlap: another number of undecided pairs";
  }
  if (any.outcome == Outcome::overlap && !std::ranges::binary_search(every.pairs, any.pair)) {
    return "any_overlap: " + text_of(any.pair) + " does not overlap";
  }
  return "";
}

std::string fault_within(Scene& scene, double margin) {
  const EveryPair every = every_pair(scene, margin);
  ScenePairs found;
  scene.pairs_within(margin, found);
  if (std::string fault = difference("pairs within", found.pairs, every.pairs); !fault.empty()) return fault;
  return difference("undecided within", found.undecided, every.undecided);
}

std::string fault_of_distances(Scene& scene, double margin) {
  SceneDistances found;
  scene.distances_within(margin, found);
  std::string fault;
  std::size_t k = 0;
  for_every_pair(scene, margin, [&](const ScenePair& pair, const Transformd& pose) {
    if (!fault.empty()) return;
    const Separation truth = distance(body_of(scene, pair.a), body_of(scene, pair.b), Pose(pose));
    const bool is_there = k < found.entries.size() && found.entries[k].pair == pair;
    const double size = margin + body_of(scene, pair.a).circumradius() + body_of(scene, pair.b).circumradius();
    const bool is_open = std::ranges::binary_search(found.undecided, pair);
    if (!is_there && !is_open && truth.upper < margin - 1e-12 * size) fault = "missing distance of " + text_of(pair);
    if (is_there && truth.lower > margin + 1e-12 * size) fault = "distance of a far pair, " + text_of(pair);
    if (!is_there) return;
    const Separation& told = found.entries[k++].separation;
    if (told.lower > truth.upper || told.upper < truth.lower || told.verdict.outcome != truth.verdict.outcome) {
      fault = "wrong distance of " + text_of(pair);
    }
  });
  if (fault.empty() && k != found.entries.size()) fault = "distances: in another order, or of pairs that are none";
  return fault;
}

std::string fault_of_manifolds(Scene& scene, double margin) {
  const EveryPair every = every_pair(scene, margin);
  SceneManifolds found;
  scene.contact_manifolds(found, margin);
  std::vector<ScenePair> pairs;
  for (const SceneManifolds::Entry& entry : found.entries) pairs.push_back(entry.pair);
  if (std::string fault = difference("manifolds", pairs, every.pairs); !fault.empty()) return fault;
  for (const SceneManifolds::Entry& entry : found.entries) {
    const ConvexBody &a = body_of(scene, entry.pair.a), &b = body_of(scene, entry.pair.b);
    const ContactManifold truth = contact_manifold(a, b, Pose(scene.relative_pose(entry.pair)), margin);
    const double size = margin + a.circumradius() + b.circumradius();
    if (entry.manifold.contacts.size() != truth.contacts.size() ||
        !(std::fabs(entry.manifold.separation.signed_distance - truth.separation.signed_distance) <= 1e-9 * size)) {
      return "another manifold of " + text_of(entry.pair);
    }
  }
  return difference("undecided manifolds", found.undecided, every.undecided);
}

std::string fault_of_single_bodies(Scene& scene, const EveryPair& every) {
  ScenePairs found;
  for (BodyId body = 0; body < scene.end(); ++body) {
    if (!scene.has(body)) continue;
    scene.overlaps_of(body, found);
    const std::string who = "overlaps of " + std::to_string(body);
    std::string fault = difference(who, found.pairs, those_of(body, every.pairs));
    if (fault.empty()) fault = difference(who + ", undecided", found.undecided, those_of(body, every.undecided));
    if (!fault.empty()) return fault;
  }
  return "";
}

std::string fault_of_trial_move(Scene& scene, BodyId body, const Pose& pose) {
  const Transformd before = scene.pose(body);
  const Outcome told = scene.would_overlap(body, pose);
  const Vec3d &t = before.translation, &now = scene.pose(body).translation;
  if (t.x != now.x || t.y != now.y || t.z != now.z) return "a trial move has moved body " + std::to_string(body);
  scene.move(body, pose);
  const EveryPair every = every_pair(scene);
  const Outcome truth = outcome_of(those_of(body, every.pairs), those_of(body, every.undecided));
  scene.move(body, before);
  if (told != truth) return "another answer to a trial move of body " + std::to_string(body);
  return "";
}

std::string fault_of_clusters(Scene& scene, const EveryPair& every, double distance) {
  Clusters found;
  scene.clusters(found, distance);
  struct Edge {
    BodyId to;
    ImageOffset image;
  };
  std::vector<std::vector<Edge>> edges(scene.end());
  for (const ScenePair& pair : every.pairs) {
    edges[pair.a].push_back({pair.b, pair.image});
    edges[pair.b].push_back({pair.a, {-pair.image[0], -pair.image[1], -pair.image[2]}});
  }
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> label(scene.end(), kNone);
  std::vector<ImageOffset> offset(scene.end());
  const std::vector<std::uint32_t> told = found.labels();
  std::uint32_t n_clusters = 0;
  for (BodyId first = 0; first < scene.end(); ++first) {
    if (label[first] != kNone) continue;
    if (!scene.has(first)) {
      if (told[first] == kNoCluster && found.n_bodies(first) == 0) continue;
      return "a number without a body, " + std::to_string(first) + ", has a cluster";
    }
    std::vector<BodyId> members = {first};
    std::array<bool, 3> wraps{};
    label[first] = n_clusters;
    for (std::size_t at = 0; at < members.size(); ++at) {
      for (const Edge& edge : edges[members[at]]) {
        ImageOffset there = offset[members[at]];
        for (std::size_t k = 0; k < 3; ++k) there[k] += edge.image[k];
        if (label[edge.to] == kNone) {
          label[edge.to] = n_clusters;
          offset[edge.to] = there;
          members.push_back(edge.to);
        }
        for (std::size_t k = 0; k < 3; ++k) wraps[k] = wraps[k] || there[k] != offset[edge.to][k];
      }
    }
    const bool is_finite = !wraps[0] && !wraps[1] && !wraps[2];
    for (const BodyId body : members) {
      const std::string who = "cluster of body " + std::to_string(body);
      if (told[body] != n_clusters) return who + ": label " + std::to_string(told[body]);
      if (found.root(body) != first) return who + ": its root is not its lowest body";
      if (found.n_bodies(body) != members.size()) return who + ": another size";
      if (found.wraps(body) != wraps) return who + ": it wraps otherwise";
      if (is_finite && found.offset(body) != offset[body]) return who + ": another offset";
    }
    ++n_clusters;
  }
  if (found.n_clusters() != n_clusters) return "another number of clusters";
  // Of pairs that are undecided only those matter whose bodies are not in one cluster anyway, or that would have it
  // wrap along one more lattice vector.
  std::vector<ScenePair> open;
  for (const ScenePair& pair : every.undecided) {
    bool matters = found.root(pair.a) != found.root(pair.b);
    const ImageOffset of_a = found.offset(pair.a), of_b = found.offset(pair.b);
    for (std::size_t k = 0; k < 3; ++k) {
      matters = matters || (!found.wraps(pair.a)[k] && of_a[k] + pair.image[k] != of_b[k]);
    }
    if (matters) open.push_back(pair);
  }
  for (const ScenePair& pair : open) {
    if (!std::ranges::binary_search(found.undecided, pair)) return "clusters keep quiet about " + text_of(pair);
  }
  return "";
}

std::string fault_of_added(Scene& scene, const EveryPair& every, BodyId first) {
  const auto of_added = [first](std::vector<ScenePair> pairs) {
    std::erase_if(pairs, [first](const ScenePair& pair) { return pair.b < first; });
    std::ranges::stable_sort(pairs, {}, &ScenePair::b);
    return pairs;
  };
  ScenePairs found;
  scene.overlaps_of_added(first, found);
  if (found.pairs != of_added(every.pairs)) return "bodies added from " + std::to_string(first) + " on: other pairs";
  if (found.undecided != of_added(every.undecided)) return "bodies added: other undecided pairs";

  // By a judge that knows nothing of stages; and clusters that grow are those of all pairs.
  const PairJudge judge = [&](ShapeId a, ShapeId b, const Transformd& pose) {
    return overlap(scene.shape(a), scene.shape(b), Pose::unchecked(pose)).outcome;
  };
  Clusters all;
  scene.clusters(all);
  for (const PairJudge* const one : {static_cast<const PairJudge*>(nullptr), &judge}) {
    Clusters grown;
    grown.reset(scene.end());
    for (const ScenePair& pair : every.pairs) {
      if (pair.b < first) grown.join(pair.a, pair.b, pair.image);
    }
    scene.overlaps_of_added(first, found, &grown, one);
    if (found.counts[SceneStage::joined].settled > found.counts[SceneStage::joined].seen)
      return "more joined than seen";
    for (BodyId body = 0; body < scene.end(); ++body) {
      if (scene.has(body) && grown.wraps(body) != all.wraps(body)) return "bodies added: clusters wrap otherwise";
      if (scene.has(body) && grown.n_bodies(body) != all.n_bodies(body)) return "bodies added: other clusters";
    }
    for (const ScenePair& pair : found.pairs) {
      if (!std::ranges::binary_search(every.pairs, pair)) return "bodies added: a pair that does not overlap";
    }
  }
  return "";
}

std::string fault_of_scene(Scene& scene, const RandomScene& made, const EveryPair& every, std::mt19937_64& random) {
  std::string fault = fault_of_pairs(scene, every);
  if (fault.empty()) fault = fault_of_clusters(scene, every);
  if (fault.empty()) fault = fault_of_single_bodies(scene, every);
  if (fault.empty()) fault = fault_of_added(scene, every, static_cast<BodyId>(random() % (scene.end() + 1)));
  const double margin = 0.1 * made.size * random_in_unit_interval(random);
  if (fault.empty()) fault = fault_within(scene, margin);
  if (fault.empty()) fault = fault_of_clusters(scene, every_pair(scene, margin), margin);
  if (fault.empty()) fault = fault_of_distances(scene, margin);
  if (fault.empty()) fault = fault_of_manifolds(scene, random() % 2 == 0 ? 0.0 : 0.3 * margin);
  for (int k = 0; k < 2 && fault.empty() && scene.size() > 0; ++k) {
    const BodyId body = static_cast<BodyId>(random() % scene.end());
    if (scene.has(body)) fault = fault_of_trial_move(scene, body, random_place(made, random));
  }
  return fault.empty() ? fault_of_pairs(scene, every) : fault;
}

}  // namespace vex
