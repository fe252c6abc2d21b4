// How close to contact must bodies be for a verdict to stay undecided? One command:
// build/release/bin/vex_undecided_width.
//
// Along 2000 random rays from A's centre, at random orientations, the interval of distances without a verdict is found
// by bisection, and given relative to the pair's reach.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/query/overlap.h"
#include "shapes/any_shape.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

struct Pair {
  const char* name;
  ConvexBody a, b;
};

// The largest distance along the ray that `is_below` accepts; it accepts all smaller ones.
template <class Predicate>
double boundary(double longest, Predicate is_below) {
  double low = 0.0, high = longest;
  for (int step = 0; step < 100; ++step) {
    const double middle = 0.5 * (low + high);
    (is_below(middle) ? low : high) = middle;
  }
  return low;
}

double undecided_width(const Pair& pair, double longest, std::mt19937_64& random) {
  Transformd pose = random_rotation(random);
  const Vec3d dir = random_direction(random);
  const Vec3d unit_dir = (1.0 / norm(dir)) * dir;
  const auto outcome_at = [&](double distance) {
    pose.translation = distance * unit_dir;
    return overlap(pair.a, pair.b, pose).outcome;
  };
  const double last_overlap = boundary(longest, [&](double d) { return outcome_at(d) == Outcome::overlap; });
  const double last_undecided = boundary(longest, [&](double d) { return outcome_at(d) != Outcome::disjoint; });
  return (last_undecided - last_overlap) / (pair.a.reach() + pair.b.reach());
}

std::vector<Pair> pairs() {
  const auto both_of = [](const char* name, const ConvexBody& body) { return Pair{name, body, body}; };
  const auto shape = [](const char* text) { return parse_shape(text).body; };
  return {both_of("cubes", shape("box:1,1,1")),
          both_of("ellipsoids 4:1:1", shape("ellipsoid:4,1,1")),
          both_of("capsules L=1 R=.25", shape("capsule:1,.25")),
          {"sphere and cube", shape("sphere:0.6"), shape("box:1,1,1")},
          both_of("hulls of 100 points", test_point_hull(100, {1, 1, 1}, 100).body),
          both_of("plates 1e-6:1:1", shape("box:1e-6,1,1")),
          both_of("needles 64:1:1", shape("box:64,1,1")),
          both_of("ellipsoids 1000:1:1", shape("ellipsoid:1000,1,1")),
          both_of("cones H=1 R=.5", shape("cone:1,.5")),
          both_of("cylinders L=.1 R=1", shape("cylinder:.1,1")),
          both_of("discs, flat", shape("disc:1")),
          {"disc and needle", shape("disc:1"), shape("needle:2")},
          {"cube and box 1e6:1:1", shape("box:1,1,1"), shape("box:1e6,1,1")},
          {"sphere 1e-6 and needle", shape("sphere:1e-6"), shape("needle:1")}};
}

}  // namespace
}  // namespace vex

int main() {
  using namespace vex;
  std::printf("%-22s %10s %10s %10s\n", "undecided width/reach", "median", "99 %", "widest");
  for (const Pair& pair : pairs()) {
    std::mt19937_64 random(5);
    const double longest = 1.01 * (pair.a.reach() + pair.b.reach());
    std::vector<double> widths;
    for (int k = 0; k < 2000; ++k) widths.push_back(undecided_width(pair, longest, random));
    std::sort(widths.begin(), widths.end());
    std::printf("%-22s %10.1e %10.1e %10.1e\n", pair.name, widths[1000], widths[1980], widths.back());
  }
}
