#include "apps/vex_depletion/options.h"

#include <cmath>
#include <numbers>

#include "apps/common/number_range.h"
#include "apps/common/numbers.h"
#include "apps/common/pose_numbers.h"
#include "engine/numeric/errors.h"
#include "engine/sampling/poses/orientation_law_text.h"

namespace vex {
namespace {

std::vector<std::string> numbers_of(const std::string& word, const char* option) {
  if (word.find(':') != std::string::npos) return numbers_of_range(word, option);
  parse_number(word, option);
  return {word};
}

std::array<double, 4> quaternion_of(const std::string& word) {
  std::array<double, 4> found{};
  read_numbers(word, "--rotation", found);
  if (found == std::array<double, 4>{}) {
    throw UsageError("a quaternion of length 0 (\"" + word + "\" for --rotation) - give another");
  }
  return found;
}

bool asks_for_a_mean(const DepletionCommandLine& words) {
  for (const std::string* const word :
       {&words.orientations, &words.orientations_a, &words.orientations_b, &words.axis, &words.axis_a, &words.axis_b}) {
    if (!word->empty()) return true;
  }
  return false;
}

void require_a_mean_or_a_pose(const DepletionCommandLine& words) {
  if (!asks_for_a_mean(words)) return;
  for (const auto& [word, option] : {std::pair{&words.angle, "--angle"}, std::pair{&words.direction, "--direction"},
                                     std::pair{&words.rotation, "--rotation"}}) {
    if (word->empty()) continue;
    throw UsageError("a mean over orientations has no pose (" + std::string(option) + " " + *word +
                     " beside a law of orientations) - leave out one of them");
  }
}

}  // namespace

void declare_options(OptionParser& options, DepletionCommandLine& words) {
  options.add_option("A", words.a, kBodyHelp).type_name("").required();
  options.add_option("B", words.b, "The second body; without it, A again").type_name("");
  const std::string system = "Depletant";
  options.add_option("--depletant", words.depletant, "Radius of the balls that the bodies exclude")
      .type_name("R")
      .group(system)
      .required();
  options
      .add_option("--fraction", words.fraction,
                  "Share of a reservoir's volume that the balls take: then the potential in units of kT is told too")
      .type_name("PHI")
      .group(system);
  const std::string cases = "Distances, angles, orientations";
  options.add_option("--distance", words.distance, "Of B's origin from A's: a number, or a range of them")
      .type_name("FROM:TO:STEP")
      .group(cases)
      .required();
  options
      .add_option("--angle", words.angle,
                  "B is turned about the line from A to B by this angle, in degrees, or by each of a range (default 0)")
      .type_name("FROM:TO:STEP")
      .group(cases);
  options
      .add_option("--direction", words.direction, "From A to B, in A's frame: x (default), y, z, or a direction X,Y,Z")
      .type_name("AXIS")
      .group(cases);
  options.add_option("--rotation", words.rotation, "B's quaternion in A's frame, before it is turned by the angle")
      .type_name("W,X,Y,Z")
      .group(cases);
  declare_orientations(options, words, "Means over orientations, and over all directions, instead of poses");
  const std::string stop = "When to stop, each case (whichever comes first; without any, --rel-error 1e-2)";
  options.add_option("--rel-error", words.rel_error, "Stop at this standard error relative to the overlap volume")
      .type_name("E")
      .group(stop);
  options.add_option("--trials", words.trials, "Stop after this many points, written like 1e7")
      .type_name("N")
      .group(stop);
  options.add_option("--seconds", words.seconds, "Stop after this time").type_name("S").group(stop);
  options.add_option("--max-trials", words.max_trials, "Give up after this many points (default 1e9)")
      .type_name("N")
      .group(stop);
  declare_seed_and_threads(options, words, stop);
  declare_options_of_two_bodies(options, words);
  declare_output(options, words);
  options.add_option("--csv", words.csv, "Write a row a case").type_name("FILE").group("Output");
  options
      .add_option("--plot", words.plot,
                  "Draw the overlap volume, or the potential where there is --fraction, against the distance")
      .type_name("FILE.svg")
      .group("Output");
  options.footer(named_bodies_help() +
                 "\n\nExit codes:"
                 "\n  0  success"
                 "\n  1  a fault of the program"
                 "\n  2  wrong usage"
                 "\n  3  input refused"
                 "\n  4  Monte Carlo and the closed form, of two balls, disagree"
                 "\n  130, 143  interrupted (cases that were done are reported)");
}

std::optional<double> DepletionOptions::number_density() const {
  if (!fraction) return std::nullopt;
  const double r = settings.ball_radius;
  return *fraction / (4.0 / 3.0 * std::numbers::pi * r * r * r);
}

DepletionOptions interpret(const DepletionCommandLine& words) {
  DepletionOptions options;
  static_cast<CommonOptions&>(options) = interpret_common(words);
  options.a = words.a;
  options.b = words.b.empty() ? words.a : words.b;
  std::vector<std::string> bodies = {words.a};
  if (!words.b.empty()) bodies.push_back(words.b);
  options.body_options = interpret_bodies(words, bodies);
  options.dump_vertices = words.dump_vertices;
  DepletionSettings& settings = options.settings;
  settings.ball_radius = parse_positive_number(words.depletant, "--depletant");
  settings.threads = options.n_threads;
  if (!words.rel_error.empty()) settings.rel_error = parse_positive_number(words.rel_error, "--rel-error");
  if (!words.trials.empty()) settings.trials = parse_positive_count(words.trials, "--trials");
  if (!words.seconds.empty()) settings.seconds = parse_positive_number(words.seconds, "--seconds");
  if (!words.max_trials.empty()) settings.max_trials = parse_positive_count(words.max_trials, "--max-trials");
  if (!words.fraction.empty()) {
    options.fraction = parse_positive_number(words.fraction, "--fraction");
    if (!(*options.fraction < 1.0)) {
      throw UsageError("a share of the volume that is not below 1 (" + words.fraction +
                       " for --fraction) - give one from 0 to 1");
    }
  }
  options.distances = numbers_of(words.distance, "--distance");
  for (const std::string& distance : options.distances) {
    if (parse_number(distance, "--distance") < 0.0) {
      throw UsageError("a distance below 0 (" + distance + " for --distance) - give one from 0 up");
    }
  }
  require_a_mean_or_a_pose(words);
  if (asks_for_a_mean(words)) options.law = interpret_orientations(words);
  options.angles = numbers_of(words.angle.empty() ? "0" : words.angle, "--angle");
  if (options.distances.size() * options.angles.size() > kMostCases) {
    throw UsageError("too many cases (more than " + std::to_string(kMostCases) + ") - give wider steps");
  }
  if (!words.direction.empty()) options.direction = parse_axis(words.direction, "--direction");
  const Vec3d& v = options.direction;
  const double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  const Vec3d scaled{v.x / largest, v.y / largest, v.z / largest};
  const double length = std::sqrt(dot(scaled, scaled));
  options.direction = {scaled.x / length, scaled.y / length, scaled.z / length};
  if (!words.rotation.empty()) options.rotation = quaternion_of(words.rotation);
  options.csv = words.csv;
  options.plot = words.plot;
  return options;
}

}  // namespace vex
