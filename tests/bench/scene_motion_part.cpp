#include <cmath>
#include <random>

#include "engine/numeric/pose_algebra.h"
#include "tests/bench/rounds.h"
#include "tests/bench/scene_cases.h"
#include "tests/bench/scene_laps.h"
#include "tests/bench/scene_parts.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

constexpr int kSteps = 60;

struct StepTimes {
  std::vector<double> move_ns, query_ns;
  SceneCounts counts;  // of all steps
  std::size_t n_pairs = 0;
};

constexpr double kPace = 0.01;

Vec3d random_step(std::mt19937_64& random) {
  const Vec3d dir = random_direction(random);
  return (kPace / norm(dir)) * dir;
}

// By an angle of kPace, about any axis.
Transformd turned(const Transformd& pose, std::mt19937_64& random) {
  const Vec3d part = std::sin(0.5 * kPace) / kPace * random_step(random);
  Transformd turn = (pose_of({std::cos(0.5 * kPace), part.x, part.y, part.z}, {}) * Pose::unchecked(pose)).a_from_b();
  turn.translation = pose.translation;
  return turn;
}

enum class Course { straight_on, at_random, at_random_and_turned };

// The same motion for everyone who asks: each body goes straight on, or to and fro at random, and then may turn at
// random, too.
class Motion {
 public:
  Motion(Course course, std::size_t n) : course_(course) {
    for (std::size_t k = 0; k < n; ++k) steps_.push_back(random_step(random_));
  }

  // Where they are, as a simulation does it: poses that are all read from other memory at each step would be measured
  // with it.
  void move(std::vector<Pose>& poses) {
    for (std::size_t body = 0; body < poses.size(); ++body) {
      Transformd pose = poses[body].a_from_b();
      if (course_ == Course::at_random_and_turned) pose = turned(pose, random_);
      if (course_ != Course::straight_on) steps_[body] = random_step(random_);
      pose.translation = pose.translation + steps_[body];
      poses[body] = Pose::unchecked(pose);
    }
  }

 private:
  Course course_;
  std::mt19937_64 random_{3};
  std::vector<Vec3d> steps_;
};

StepTimes move_along(const SceneCase& scene, Motion motion, double skin, int n_threads) {
  Scene made = scene.scene({.n_threads = n_threads, .skin = skin});
  ScenePairs found;
  made.overlapping_pairs(found);
  std::vector<Pose> poses = scene.poses;
  StepTimes times;
  for (int k = 0; k < kSteps; ++k) {
    motion.move(poses);
    const double start = processor_ns();
    made.move_all(poses);
    const double moved = processor_ns();
    made.overlapping_pairs(found);
    times.query_ns.push_back(processor_ns() - moved);
    times.move_ns.push_back(moved - start);
    times.counts += found.counts;
  }
  times.n_pairs = found.pairs.size();
  return times;
}

double mean_ms(const std::vector<double>& ns) {
  double sum = 0.0;
  for (const double x : ns) sum += 1e-6 * x;
  return sum / static_cast<double>(ns.size());
}

double from_nothing_ms(SceneCase now, Motion motion, int n_rounds) {
  std::vector<double> ns;
  for (int k = 0; k <= n_rounds; ++k) {
    motion.move(now.poses);
    const double start = processor_ns();
    Scene made = now.scene({.skin = 0.0});
    ScenePairs found;
    made.overlapping_pairs(found);
    if (k > 0) ns.push_back(processor_ns() - start);
  }
  return 1e-6 * Timing{ns}.median();
}

}  // namespace

BenchReport motion_part(const ScenePartSettings& settings) {
  const SceneCase as_they_come = hulls(settings.bodies(1e5)), by_place = numbered_by_place(as_they_come);
  BenchReport report;
  report.rows = nlohmann::ordered_json::array();
  MarkdownTable table({"motion", "skin", "move_all, ms", "query, ms", "median query, ms", "slowest query, ms",
                       "query, of a scene from nothing", "with move_all", "pairs"});
  std::string lines;
  struct Case {
    const char* name;
    Course course;
    bool is_by_place;
  };
  for (const auto& [name, course, is_by_place] :
       {Case{"straight on", Course::straight_on, false},
        Case{"straight on, numbered by place", Course::straight_on, true}, Case{"at random", Course::at_random, false},
        Case{"at random, and turned", Course::at_random_and_turned, false}}) {
    const SceneCase& scene = is_by_place ? by_place : as_they_come;
    const Motion motion(course, scene.size());
    const double whole = from_nothing_ms(scene, motion, settings.n_rounds);
    lines += "A scene from nothing (bodies added, pairs found) takes " + three_digits(whole) + " ms, " +
             std::string(name) + ".\n";
    for (const double skin : {0.0, 0.1, 0.2, 0.3, 0.4}) {
      const StepTimes times = move_along(scene, motion, skin, 1);
      const double move = mean_ms(times.move_ns), query = mean_ms(times.query_ns);
      const double median = 1e-6 * Timing{times.query_ns}.median();
      const double slowest = 1e-6 * *std::max_element(times.query_ns.begin(), times.query_ns.end());
      table.add({name, three_digits(skin), three_digits(move), three_digits(query), three_digits(median),
                 three_digits(slowest), percent(query / whole), percent((move + query) / whole),
                 grouped(times.n_pairs)});
      lines += "Skin " + three_digits(skin) + ", " + std::to_string(kSteps) + " steps " + name + ". " +
               counts_line(times.counts) + "\n";
      report.rows.push_back({{"motion", name},
                             {"skin", skin},
                             {"move_ms", move},
                             {"query_ms", query},
                             {"median_query_ms", median},
                             {"slowest_query_ms", slowest},
                             {"from_nothing_ms", whole},
                             {"pairs", times.n_pairs}});
    }
  }
  report.markdown = "### " + grouped(as_they_come.size()) + " " + as_they_come.name +
                    ", moved by .01 diameters a step\n\n" + "One thread, processor time, means of " +
                    std::to_string(kSteps) +
                    " steps, those in which the list is made anew among them; a body that turns does so by .01 "
                    "radians, too.\n\n" +
                    table.text() + "\n" + lines;
  return report;
}

}  // namespace vex
