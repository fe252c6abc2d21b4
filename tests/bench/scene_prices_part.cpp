#include "engine/scene/body_tree.h"
#include "engine/scene/cell_grid.h"
#include "tests/bench/rounds.h"
#include "tests/bench/scene_cases.h"
#include "tests/bench/scene_laps.h"
#include "tests/bench/scene_parts.h"

namespace vex {
namespace {

struct Prices {
  double body_ns = 0.0, pair_ns = 0.0;
  std::uint64_t n_seen = 0, n_near = 0;
};

// Index first, then all near pairs, which nothing is done with.
template <class Phase, class Build>
Prices prices_of(const SceneBodies& bodies, int n_rounds, const Build& build) {
  Phase phase;
  const SceneKernel kernel = scene_kernel(best_instruction_set());
  std::vector<double> of_build, of_search;
  const auto near = std::make_unique<NearPairs>();
  Prices prices;
  for (int round = 0; round <= n_rounds; ++round) {
    const double start = processor_ns();
    build(phase);
    const double built = processor_ns();
    prices.n_seen = prices.n_near = 0;
    for (std::size_t part = 0; part < phase.n_parts(); ++part) {
      near->n = 0;
      near->n_seen = 0;
      phase.find_near(part, kernel, *near, [&] {
        prices.n_near += near->n;
        prices.n_seen += near->n_seen;
        near->n = 0;
        near->n_seen = 0;
        return true;
      });
      prices.n_seen += near->n_seen;
    }
    const double found = processor_ns();
    if (round == 0) continue;  // fills caches
    of_build.push_back(built - start);
    of_search.push_back(found - built);
  }
  prices.body_ns = Timing{of_build}.median() / static_cast<double>(bodies.size());
  prices.pair_ns = Timing{of_search}.median() / static_cast<double>(std::max<std::uint64_t>(prices.n_seen, 1));
  return prices;
}

}  // namespace

BenchReport prices_part(const ScenePartSettings& settings) {
  BenchReport report;
  report.rows = nlohmann::ordered_json::array();
  MarkdownTable table({"scene", "phase", "index, ns a body", "search, ns a pair seen", "pairs seen", "near pairs"});
  const SceneCase scenes[] = {cubes(settings.bodies(1e5)),        cubes(settings.bodies(1e6)),
                              cubes(settings.bodies(1e5), 0.02),  needles(settings.bodies(1e5)),
                              unlike_cubes(settings.bodies(2e4)), hulls(settings.bodies(1e5))};
  for (const SceneCase& scene : scenes) {
    SceneBodies bodies(scene.box);
    for (const ConvexBody& shape : scene.shapes) bodies.add_shape(shape);
    for (std::size_t k = 0; k < scene.size(); ++k) bodies.add(scene.shape_of[k], scene.poses[k]);
    const double reach = 2.0 * bodies.largest_radius() * (1.0 + 0x1p-18);
    const Prices of_grid = prices_of<CellGrid>(bodies, settings.n_rounds,
                                               [&](CellGrid& grid) { grid.build(bodies, reach, false, true, 1); });
    const Prices of_tree = prices_of<BodyTree>(bodies, settings.n_rounds, [&](BodyTree& tree) {
      tree.build(bodies, reach, 0.0, false, 1);
      tree.sort(bodies, true, 1);
    });
    const Prices of_fitting = prices_of<BodyTree>(bodies, settings.n_rounds, [&](BodyTree& tree) {
      tree.build(bodies, reach, 0.0, true, 1);
      tree.sort(bodies, true, 1);
    });
    const std::pair<const char*, const Prices*> rows[] = {
        {"grid", &of_grid}, {"tree", &of_tree}, {"tree, fitted", &of_fitting}};
    for (const auto& [name, prices] : rows) {
      table.add({grouped(scene.size()) + " " + scene.name, name, three_digits(prices->body_ns),
                 three_digits(prices->pair_ns), grouped(prices->n_seen), grouped(prices->n_near)});
      report.rows.push_back({{"scene", scene.name},
                             {"bodies", scene.size()},
                             {"phase", name},
                             {"body_ns", prices->body_ns},
                             {"pair_ns", prices->pair_ns},
                             {"seen", prices->n_seen},
                             {"near", prices->n_near}});
    }
  }
  report.markdown = "### The broad phases by themselves, one thread\n\n" + table.text();
  return report;
}

}  // namespace vex
