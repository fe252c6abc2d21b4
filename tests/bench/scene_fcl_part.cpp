#include <memory>

#include "apps/peers/fcl_scene.h"
#include "tests/bench/scene_cases.h"
#include "tests/bench/scene_laps.h"
#include "tests/bench/scene_parts.h"

namespace vex {
namespace {

BenchReport beside_fcl(const SceneCase& scene, const ScenePartSettings& settings) {
  const auto made = std::make_shared<Scene>(scene.scene({.skin = 0.0}));
  const auto fcl = std::make_shared<FclScene>(scene.shapes, scene.shape_of);
  ScenePairs found;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> of_fcl;
  const auto ask_scene = [&] {
    made->move_all(scene.poses);
    made->overlapping_pairs(found);
    return found.pairs.size();
  };
  const auto ask_fcl = [&] {
    fcl->overlapping_pairs(scene.poses, of_fcl);
    return of_fcl.size();
  };
  // Each twice in turn: the first time finds the caches as the other has left them.
  const std::vector<SceneLap> laps = {
      {"scene, poses given", ask_scene},
      {"scene, at once again", ask_scene},
      {"scene, from nothing",
       [&] {
         Scene anew = scene.scene({.skin = 0.0});
         anew.overlapping_pairs(found);
         return found.pairs.size();
       }},
      {"FCL, objects given", ask_fcl},
      {"FCL, at once again", ask_fcl},
  };
  const std::vector<SceneLapTimes> times = take_laps(laps, settings.n_rounds, 5.0);
  BenchReport report;
  report.markdown = "#### " + grouped(scene.size()) + " " + scene.name + ", open space, one thread\n\n" +
                    lap_table(times, scene.size()) + "\nFCL's tree sends " + grouped(fcl->n_asked()) +
                    " pairs to its solver. " + counts_line(found.counts);
  report.rows = lap_json(times, scene.size());
  return report;
}

}  // namespace

BenchReport fcl_part(const ScenePartSettings& settings) {
  BenchReport report;
  report.markdown =
      "### FCL's DynamicAABBTreeCollisionManager\n\nPoses are set, the tree is made, pairs are asked by `collide` for "
      "yes or no. FCL bounds a turned body by the cube around its ball (its issue 509), so of needles its tree sees "
      "balls: the comparison with them flatters the scene's broad phase.\n";
  report.rows = nlohmann::ordered_json::array();
  for (const SceneCase& scene :
       {cubes(settings.bodies(1e5)), needles(settings.bodies(2e4)), hulls(settings.bodies(1e5))}) {
    const BenchReport one = beside_fcl(in_open_space(scene), settings);
    report.markdown += "\n" + one.markdown;
    for (const auto& row : one.rows) report.rows.push_back(row);
  }
  return report;
}

}  // namespace vex
