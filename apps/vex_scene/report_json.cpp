// The document of --json.
#include <nlohmann/json.hpp>

#include "apps/common/body_report.h"
#include "apps/vex_scene/report.h"
#include "apps/vex_scene/rows.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

Json box_json(const std::optional<PeriodicBox>& box) {
  if (!box) return nullptr;
  const Vec3d& edges = box->edges();
  return {edges.x, edges.y, edges.z, box->xy(), box->xz(), box->yz()};
}

Json pair_json(const ScenePair& pair) { return {{"a", pair.a}, {"b", pair.b}, {"image", pair.image}}; }

Json cluster_json(const FoundCluster& cluster) {
  return {{"cluster", cluster.label}, {"bodies", cluster.n_bodies}, {"wraps", cluster.wraps}};
}

// All of them, or null and why.
template <class Entry>
void add_list(Json& json, const std::string& key, std::size_t n, const std::string& reason, const Entry& entry) {
  json[key] = nullptr;
  if (n > kMostListed) {
    json[key + "_reason"] = "more than " + std::to_string(kMostListed) + ": " + reason;
    return;
  }
  json[key] = Json::array();
  for (std::size_t k = 0; k < n; ++k) json[key].push_back(entry(k));
}

void add_shapes(Json& json, const SceneRun& run) {
  json["shapes"] = nullptr;
  if (!run.is_loaded) return;
  add_list(json, "shapes", run.bodies.size(), "they stand in the scene's file", [&](std::size_t k) {
    Json shape = body_json(run.bodies[k], run.options.dump_vertices);
    shape["copies"] = run.n_copies[k];
    return shape;
  });
}

void add_clusters(Json& json, const Findings& found) {
  json["largest_cluster"] = nullptr;
  if (!found.clusters.empty()) json["largest_cluster"] = cluster_json(found.clusters[found.largest_cluster]);
  std::vector<FoundCluster> wrapping;
  for (const FoundCluster& cluster : found.clusters) {
    if (cluster.wraps_at_all()) wrapping.push_back(cluster);
  }
  add_list(json, "wrapping_clusters", wrapping.size(), "their number is wrapping",
           [&](std::size_t k) { return cluster_json(wrapping[k]); });
  json["wrapping"] = wrapping.size();
}

void add_undecided(Json& json, const Findings& found) {
  std::vector<ScenePair> undecided;
  for (const FoundPair& row : found.pairs) {
    if (row.is_undecided) undecided.push_back(row.pair);
  }
  add_list(json, "undecided_pairs", undecided.size(), "--query pairs lists them",
           [&](std::size_t k) { return pair_json(undecided[k]); });
}

void add_answer(Json& json, const SceneRun& run) {
  const Findings& found = run.found;
  const SceneQuery query = run.options.query;
  const bool has_pairs = query != SceneQuery::any && query != SceneQuery::clusters;
  json["pairs"] = nullptr;
  json["clusters"] = nullptr;
  json["undecided"] = nullptr;
  if (!found.is_complete) return;
  if (has_pairs) json["pairs"] = found.n_pairs;
  if (query == SceneQuery::clusters) json["clusters"] = found.clusters.size();
  if (found.n_undecided) json["undecided"] = *found.n_undecided;
  if (has_pairs) {
    json["mean_neighbours"] = nullptr;
    if (run.n_bodies > 0) {
      json["mean_neighbours"] = 2.0 * static_cast<double>(found.n_pairs) / static_cast<double>(run.n_bodies);
    }
  }
  if (query != SceneQuery::any) add_undecided(json, found);
  if (query == SceneQuery::clusters) add_clusters(json, found);
  if (query == SceneQuery::any) {
    json["verdict"] = name_of(found.answer.outcome);
    json["pair"] = nullptr;
    if (found.answer.outcome != Outcome::disjoint) json["pair"] = pair_json(found.answer.pair);
  }
}

void add_stages(Json& json, const Findings& found) {
  json["stages"] = Json::array();
  if (!found.is_complete) return;
  for (int k = 0; k < kNSceneStages; ++k) {
    const SceneStage stage = static_cast<SceneStage>(k);
    const SceneCounts::Stage& count = found.counts[stage];
    json["stages"].push_back({{"name", name_of(stage)}, {"seen", count.seen}, {"settled", count.settled}});
  }
}

void add_results(Json& json, const SceneRun& run) {
  const SceneQuery query = run.options.query;
  if (!run.found.is_complete || !run.options.has_rows()) return;
  add_list(json, "results", n_rows(query, run.found), "standard output has them all", [&](std::size_t k) {
    std::string row;
    append_row(row, query, RowFormat::jsonl, run.found, k);
    return Json::parse(row);
  });
}

}  // namespace

std::string report_json(const SceneRun& run) {
  Json json = document_head(run.command, run.options, run.found.is_complete && !run.is_interrupted, run.seconds);
  json["bodies"] = nullptr;
  if (run.is_loaded) json["bodies"] = run.n_bodies;
  json["box"] = box_json(run.box);
  json["query"] = name_of(run.options.query);
  if (run.options.query == SceneQuery::within || run.options.query == SceneQuery::clusters)
    json["distance"] = run.options.distance;
  json["broad_phase"] = name_of(run.options.settings.broad_phase);
  json["isa"] = name_of(run.options.settings.instruction_set);
  add_answer(json, run);
  json["read_seconds"] = nullptr;
  if (run.is_loaded) json["read_seconds"] = run.read_seconds;
  json["build_seconds"] = nullptr;
  json["query_seconds"] = nullptr;
  if (run.found.is_complete) {
    json["build_seconds"] = run.found.build_seconds;
    json["query_seconds"] = run.found.query_seconds;
  }
  add_stages(json, run.found);
  add_shapes(json, run);
  add_results(json, run);
  return document_text(json);
}

}  // namespace vex
