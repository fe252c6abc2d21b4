// Virial coefficients against what is known: spheres to B8, aligned cubes to B7, and B_AAB of random pairs of bodies
// against brute force. A table, with how many standard errors each is off; ends with 1 where one is off by more than
// 4.5.
//   vex_virial_truth [SECONDS]
//   vex_virial_truth pairs
// SECONDS (default 600) of all threads for the spheres, a quarter of it for the cubes, as much for the pairs. `pairs`
// are these alone, with numbers of trials that take some seconds, half of them turned by a law of one body.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "shapes/any_shape.h"
#include "shapes/estimators/virial_coefficients.h"
#include "tests/referees/virial_brute_force.h"

namespace vex {
namespace {

constexpr double kMostErrors = 4.5;
int n_wrong = 0;

void show(const std::string& what, double value, double error, double known, double known_error) {
  const double z = (value - known) / std::hypot(error, known_error);
  if (!(std::fabs(z) < kMostErrors)) ++n_wrong;
  std::printf("%-44s %12.8f +- %.1e   known %12.8f +- %.0e   z %5.2f\n", what.c_str(), value, error, known, known_error,
              z);
  std::fflush(stdout);
}

struct Known {
  double value, error;
};

void judge(const std::string& text, const OrientationLaw& law, double seconds, const std::vector<Known>& known) {
  VirialSettings settings;
  settings.order = static_cast<int>(known.size()) + 2;
  settings.law = law;
  settings.seconds = seconds;
  const VirialCoefficients found = virial_coefficients(parse_shape(text), settings);
  for (std::size_t k = 0; k < known.size(); ++k) {
    const VirialCoefficient& one = found.higher[k];
    show(text + ", " + law.name() + ", B" + std::to_string(one.n), one.reduced, one.std_error, known[k].value,
         known[k].error);
  }
}

std::string random_body(std::mt19937_64& random) {
  const auto size = [&random] {
    return std::to_string(std::exp(std::uniform_real_distribution<double>(-0.9, 0.9)(random)));
  };
  switch (random() % 6) {
    case 0: return "box:" + size() + "," + size() + "," + size();
    case 1: return "ellipsoid:" + size() + "," + size() + "," + size();
    case 2: return "capsule:" + size() + "," + size();
    case 3: return "cylinder:" + size() + "," + size();
    case 4: return "cone:" + size() + "," + size();
    default: return "tetrahedron:" + size();
  }
}

// Every other one turned by Onsager's trial function. `seconds`: of all pairs, or none for as many clusters.
void judge_pairs(std::optional<double> seconds, std::uint64_t n_trials) {
  constexpr int kPairs = 20;
  constexpr double kAlpha = 4.0;
  std::mt19937_64 random(26);
  for (int k = 0; k < kPairs; ++k) {
    const std::string text_a = random_body(random), text_b = random_body(random);
    const Body a = parse_shape(text_a), b = parse_shape(text_b);
    VirialSettings settings;
    if (seconds) {
      settings.seconds = *seconds / kPairs;
    } else {
      settings.samples = 100'000;
      settings.threads = 1;
    }
    const bool is_turned = k % 2 == 1;
    if (is_turned) settings.law = OrientationLaw::onsager(kAlpha);
    const MixedVirial found = third_virials_of_mixture(a, b, settings)[1];
    const VolumeEstimate direct =
        third_virial_by_brute_force({a.body, a.body, b.body}, n_trials, static_cast<std::uint64_t>(100 + 2 * k),
                                    is_turned ? onsager_turn(kAlpha) : uniform_turn);
    const double unit = direct.excluded_volume;
    show(text_a + " " + text_b + " " + settings.law.name(), found.value / unit, found.std_error / unit, 1.0,
         direct.std_error / unit);
  }
}

}  // namespace
}  // namespace vex

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "pairs") {
    vex::judge_pairs(std::nullopt, 300'000);
    return vex::n_wrong == 0 ? 0 : 1;
  }
  const double seconds = argc > 1 ? std::atof(argv[1]) : 600.0;
  using vex::OrientationLaw;
  // N. Clisby and B. M. McCoy, J. Stat. Phys. 122, 15 (2006).
  vex::judge("sphere:0.5", OrientationLaw::isotropic(), seconds,
             {{0.625, 1e-12},
              {0.28694950598, 1e-11},
              {0.110252, 1e-6},
              {0.03888198, 9.1e-7},
              {0.01302354, 9.1e-7},
              {0.0041832, 1.1e-6}});
  // W. G. Hoover and A. G. De Rocco, J. Chem. Phys. 36, 3141 (1962): 9, 34/3, 455/144, -2039/108, -169149119/3888000.
  // The sums over all biconnected graphs of the cubes of rods' integrals, which are whole numbers over (n - 1)!, are
  // the same.
  vex::judge("box:1,1,1", OrientationLaw::aligned(), seconds / 4.0,
             {{9.0 / 16.0, 1e-12},
              {34.0 / 3.0 / 64.0, 1e-12},
              {455.0 / 144.0 / 256.0, 1e-12},
              {-2039.0 / 108.0 / 1024.0, 1e-12},
              {-169149119.0 / 3888000.0 / 4096.0, 1e-12}});
  vex::judge_pairs(seconds / 4.0, 1'000'000);
  return vex::n_wrong == 0 ? 0 : 1;
}
