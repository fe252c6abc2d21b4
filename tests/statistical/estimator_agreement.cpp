// Random pairs of bodies of all kinds, each by every estimator: no two may differ by more than 4 combined standard
// errors. Run by hand at 1e-5 (minutes); the suite runs a few pairs at larger errors.
//   vex_estimator_agreement [PAIRS [ERROR [ERROR_OF_HITS [FIRST_SEED]]]]      (50 1e-5 2e-4 1)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "meshes/convex_mesh.h"
#include "shapes/any_shape.h"
#include "shapes/estimators/estimator.h"
#include "shapes/formula.h"

namespace vex {
namespace {

struct NamedBody {
  std::string name;
  Body shape;
};

std::string shape_text(const char* kind, std::initializer_list<double> sizes) {
  std::string text = kind;
  char separator = ':';
  for (const double size : sizes) {
    char number[32];
    std::snprintf(number, sizeof number, "%c%.4g", separator, size);
    text += number;
    separator = ',';
  }
  return text;
}

// Sizes between a fifth and five: needles, plates and lumps.
NamedBody random_body(std::mt19937_64& random) {
  std::uniform_real_distribution<double> logarithm(-1.6, 1.6);
  const auto size = [&] { return std::exp(logarithm(random)); };
  const double x = size(), y = size(), z = size();
  std::string text;
  switch (random() % 16) {
    case 0: text = shape_text("sphere", {x}); break;
    case 1:
    case 2: text = shape_text("box", {x, y, z}); break;
    case 3:
    case 4: text = shape_text("ellipsoid", {x, y, z}); break;
    case 5: text = shape_text("capsule", {x, y}); break;
    case 6: text = shape_text("cylinder", {x, y}); break;
    case 7: text = shape_text("cone", {x, y}); break;
    case 8: text = shape_text("frustum", {x, y, z}); break;
    case 9: text = shape_text("hemisphere", {x}); break;
    case 10: text = shape_text("disc", {x}); break;
    case 11: text = shape_text("plate", {x, y}); break;
    case 12: text = shape_text("tetrahedron", {x}); break;
    case 13: text = shape_text("icosahedron", {x}); break;
    case 14: text = "rounded:0.3," + shape_text("box", {x, y, z}); break;
    default: {
      std::vector<Vec3d> points;
      std::normal_distribution<float> normal;
      for (int k = 0; k < 60; ++k) {
        const float u = normal(random), v = normal(random), w = normal(random),
                    length = std::sqrt(u * u + v * v + w * w);
        points.push_back({double{static_cast<float>(x) * u / length}, double{static_cast<float>(y) * v / length},
                          double{static_cast<float>(z) * w / length}});
      }
      return {shape_text("hull", {x, y, z}), hull_of(points)};
    }
  }
  return {text, parse_shape(text)};
}

// The largest difference of two estimators in combined standard errors.
double largest_difference(const NamedBody& a, const NamedBody& b, double error, double error_of_hits) {
  struct Found {
    std::string_view name;
    VolumeEstimate estimate;
  };
  std::vector<Found> all;
  std::uint64_t seed = 0;
  for (const Estimator* const one : estimators()) {
    const Estimator& estimator = *one;
    ++seed;  // independent of each other
    if (estimator.why_not(a.shape, b.shape, {})) continue;
    MonteCarloSettings settings;
    settings.seed = seed;
    settings.n_threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    settings.sequence = estimator.pilot_sequence;
    settings.stop.relative_error = estimator.samples_poses ? error_of_hits : error;
    set_estimator(settings, estimator, a.shape, b.shape);
    const RunRecord record = run_monte_carlo(a.shape.body, b.shape.body, settings);
    if (!record.complete) {
      std::printf("   %s ended by %s\n", std::string(estimator.name).c_str(),
                  std::string(name_of(record.stopped_by)).c_str());
      return 1e300;
    }
    all.push_back({estimator.name, volume_estimate(record.tally, settings.domain)});
  }
  double largest = 0.0;
  std::string_view first, second;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double difference = std::fabs(all[i].estimate.excluded_volume - all[j].estimate.excluded_volume) /
                                std::hypot(all[i].estimate.std_error, all[j].estimate.std_error);
      if (difference <= largest) continue;
      largest = difference;
      first = all[j].name, second = all[i].name;
    }
  }
  const double exact = average_excluded_volume(a.shape.measures, b.shape.measures);
  std::printf("%-32s %-32s %14.8g  %5.2f  %s, %s\n", a.name.c_str(), b.name.c_str(), exact, largest,
              std::string(first).c_str(), std::string(second).c_str());
  std::fflush(stdout);
  return largest;
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  const auto argument = [&](int k, double value) { return argc > k ? std::atof(argv[k]) : value; };
  const int n_pairs = static_cast<int>(argument(1, 50));
  const double error = argument(2, 1e-5), error_of_hits = argument(3, 2e-4);
  std::mt19937_64 random(static_cast<std::uint64_t>(argument(4, 1)));
  double largest = 0.0;
  for (int k = 0; k < n_pairs; ++k) {
    const vex::NamedBody a = vex::random_body(random), b = vex::random_body(random);
    largest = std::max(largest, vex::largest_difference(a, b, error, error_of_hits));
  }
  std::printf("%d pairs, the largest difference of two estimators: %.2f combined standard errors\n", n_pairs, largest);
  return n_pairs > 0 && largest <= 4.0 ? 0 : 1;
}
