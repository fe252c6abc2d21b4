#include "tests/bench/vertex_cost.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>

#include "apps/common/numbers.h"
#include "apps/common/processor.h"
#include "apps/peers/peers.h"
#include "engine/support/direction_map.h"
#include "meshes/exact_hull.h"
#include "shapes/polytope.h"
#include "tests/bench/bench_pairs.h"
#include "tests/bench/best_peers.h"
#include "tests/bench/log_plot.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPoses = std::size_t{1} << 17;  // their vertices lie all over the table: no cache keeps it
constexpr double kTurnSeconds = 0.1;                      // of a peer's turn; fewer poses where it would take longer

// A contender as the table, the plot and the JSON document name it.
struct Line {
  std::string name, head, plot_name, colour;
  bool is_dashed, is_bold;
};
const Line kLines[] = {
    {"trial", "whole trial", "vex: whole trial\n(pose, proof, tally)", "#0b5fa5", false, true},
    {"ccd-mpr", "libccd MPR on vex's table", "libccd MPR, query alone,\non vex's direction table", "#c2571a", true,
     false},
    {"ccd-mpr-plain", "libccd MPR, scan", "libccd MPR, query alone,\nscan over the vertices", "#c2571a", false, false},
    {"fcl", "FCL, climbing", "FCL, query alone,\nclimbs along edges", "#5b3a8e", false, false},
};

struct VertexRow {
  std::size_t n_vertices = 0;
  std::map<std::string, Timing> timings;
  double hull_seconds = 0.0, table_seconds = 0.0;
  std::size_t table_bytes = 0;

  std::optional<double> ns(const std::string& name) const {
    const auto at = timings.find(name);
    return at == timings.end() ? std::nullopt : std::optional(at->second.median());
  }
};

template <class Action>
double seconds_of(const Action& action) {
  const double start = processor_ns();
  action();
  return 1e-9 * (processor_ns() - start);
}

// What is made once for a body, on copies of what the queries have.
void time_preparations(const std::vector<Vec3d>& vertices, VertexRow& row) {
  std::vector<double> x, y, z;
  for (const Vec3d& v : vertices) x.push_back(v.x), y.push_back(v.y), z.push_back(v.z);
  row.table_seconds = seconds_of([&] { row.table_bytes = DirectionMap(x, y, z).bytes(); });
  row.hull_seconds = seconds_of([&] { exact_hull(vertices); });
}

VertexRow run_row(std::size_t n_vertices, const BenchSettings& settings) {
  VertexRow row;
  row.n_vertices = n_vertices;
  const TestPolytope hull = test_point_hull(static_cast<int>(n_vertices), {3, 2, 1}, 1);
  time_preparations(hull.vertices, row);
  const std::vector<Pose> poses = stored_poses(hull.body, settings.seed, settings.n_poses.value_or(kMostPoses));
  std::vector<Contender> contenders = {
      trial_contender("trial", hull.body, trial_settings(hull.body, settings.seed, poses.size()))};
  contenders[0].turn();  // makes the table, which the peer that asks for it is not to wait for
  std::vector<BackendKind> kinds;
  for (const BackendKind& kind : peer_backends()) {
    if (kind.name == "ccd-mpr" || (kind.name == "fcl" && n_vertices <= settings.most_peer_vertices)) {
      kinds.push_back(kind);
    }
  }
#ifdef VEX_WITH_CCD
  if (n_vertices <= settings.most_peer_vertices) kinds.push_back(ccd_scan_mpr().kind);
#endif
  std::deque<StoredQuery> queries;
  for (const BackendKind& kind : kinds) {
    queries.emplace_back(kind, hull.body, poses);
    contenders.push_back(queries.back().contender(queries.back().n_answered_in(kTurnSeconds)));
  }
  const std::vector<Timing> timings = take_turns(contenders, settings.n_rounds, settings.least_turn_ms);
  for (std::size_t k = 0; k < contenders.size(); ++k) row.timings[contenders[k].name] = timings[k];
  return row;
}

std::vector<std::size_t> numbers_of_vertices(std::size_t most) {
  std::vector<std::size_t> all;
  for (const int n : {8, 16, 32, 64, 100, 316, 1000, 3162, 10000, 31623, 100000, 316228, 1000000}) {
    if (static_cast<std::size_t>(n) <= most) all.push_back(static_cast<std::size_t>(n));
  }
  if (all.empty()) all.push_back(8);
  return all;
}

// Of whole trials; none where the settings left out one of the two.
std::optional<double> million_to_thousand(const std::vector<VertexRow>& rows) {
  const auto ns = [&](std::size_t n) -> std::optional<double> {
    for (const VertexRow& row : rows) {
      if (row.n_vertices == n) return row.ns("trial");
    }
    return std::nullopt;
  };
  const std::optional<double> thousand = ns(1000), million = ns(1'000'000);
  return thousand && million ? std::optional(*million / *thousand) : std::nullopt;
}

LogPlot plot_of(const std::vector<VertexRow>& rows, const std::string& subtitle) {
  LogPlot plot{"Two convex hulls overlap or not: cost against their vertices",
               subtitle,
               "vertices of each hull",
               "nanoseconds a pair",
               {}};
  for (const Line& line : kLines) {
    Curve curve{line.plot_name, line.colour, line.is_dashed, line.is_bold, {}};
    for (const VertexRow& row : rows) {
      if (const auto ns = row.ns(line.name)) curve.points.emplace_back(static_cast<double>(row.n_vertices), *ns);
    }
    if (line.name == "trial") {
      if (const auto growth = million_to_thousand(rows)) {
        curve.name += "\nfrom 10³ to 10⁶: × " + short_number(*growth, 2);
      }
    }
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  return plot;
}

}  // namespace

BenchReport vertex_costs(const BenchSettings& settings) {
  std::vector<VertexRow> rows;
  for (const std::size_t n : numbers_of_vertices(settings.most_vertices)) rows.push_back(run_row(n, settings));

  std::vector<std::string> heads = {"vertices"};
  for (const Line& line : kLines) heads.push_back(line.head);
  for (const char* head : {"hull, s", "table, s", "table, bytes a vertex"}) heads.emplace_back(head);
  MarkdownTable table(heads);
  Json json = Json::array();
  for (const VertexRow& row : rows) {
    std::vector<std::string> cells = {grouped(row.n_vertices)};
    Json one = {{"vertices", row.n_vertices}};
    Json contenders = Json::object();
    for (const Line& line : kLines) {
      const auto at = row.timings.find(line.name);
      cells.push_back(at == row.timings.end() ? "-" : timing_text(at->second));
      if (at != row.timings.end()) contenders[line.name] = timing_json(at->second);
    }
    const double n = static_cast<double>(row.n_vertices);
    cells.push_back(short_number(row.hull_seconds, 2));
    cells.push_back(short_number(row.table_seconds, 2));
    cells.push_back(fixed_number(0, static_cast<double>(row.table_bytes) / n));
    table.add(cells);
    one["contenders"] = contenders;
    one["hull_seconds"] = row.hull_seconds;
    one["table_seconds"] = row.table_seconds;
    one["table_bytes"] = row.table_bytes;
    json.push_back(one);
  }
  const std::optional<double> growth = million_to_thousand(rows);
  std::string growth_text;
  if (growth) {
    growth_text = "\nA whole trial of 10^6 vertices takes " + three_digits(*growth) +
                  " times as long as of 10^3 (asked for: 6).\n";
    json.push_back({{"million_to_thousand", *growth}, {"goal", 6.0}});
  }
  const std::string subtitle =
      "random points on an ellipsoid 3:2:1, isotropic poses in the ball domain, one core of " + processor();
  return {
      "### Vertices\n\nHulls of random points on an ellipsoid 3:2:1, each with itself: nanoseconds a pair, the median "
      "of the "
      "rounds, in brackets what lies between the quartiles. Poses differ from trial to trial, cache misses are part of "
      "it. "
      "Hull and table of directions are made once for a body and timed apart, once.\n\n" +
          table.text() + growth_text,
      json, svg_of(plot_of(rows, subtitle))};
}

}  // namespace vex
