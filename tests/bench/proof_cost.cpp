// What proofs cost: how often the filter leaves a pair open, and what each stage takes, on random and on near-contact
// pairs. One command: build/release/bin/vex_proof_cost. Markdown, for docs/performance.md.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/common/processor.h"
#include "engine/query/overlap.h"
#include "engine/query/search/overlap_filter.h"
#include "engine/sampling/domain.h"
#include "shapes/any_shape.h"
#include "tests/referees/polytopes.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

struct Pair {
  const char* name;
  ConvexBody a, b;
};

std::vector<Pair> pairs() {
  const auto both_of = [](const char* name, const ConvexBody& body) { return Pair{name, body, body}; };
  const auto shape = [](const char* text) { return parse_shape(text).body; };
  return {both_of("cubes", shape("box:1,1,1")),
          both_of("capsules L = 1, R = .25", shape("capsule:1,.25")),
          {"sphere and cube", shape("sphere:0.6"), shape("box:1,1,1")},
          both_of("hulls of 100 points", test_point_hull(100, {1, 1, 1}, 100).body),
          both_of("plates 1e-6:1:1", shape("box:1e-6,1,1")),
          {"cube and box 1e6:1:1", shape("box:1,1,1"), shape("box:1e6,1,1")},
          both_of("ellipsoids 4:1:1", shape("ellipsoid:4,1,1")),
          both_of("ellipsoids 1000:1:1", shape("ellipsoid:1000,1,1")),
          both_of("cones H = 1, R = .5", shape("cone:1,.5")),
          both_of("cylinders L = .1, R = 1", shape("cylinder:.1,1")),
          both_of("discs", shape("disc:1"))};
}

struct Microseconds {
  double total = 0.0;
  template <class Action>
  void add(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    total += std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  }
};

// A pose in which B is at `distance` (R_A + R_B) beyond contact along a random ray from A's centre.
Transformd near_contact(const Pair& pair, double distance, std::mt19937_64& random) {
  Transformd pose = random_rotation(random);
  const Vec3d dir = random_direction(random);
  const Vec3d unit_dir = (1.0 / norm(dir)) * dir;
  const double scale = pair.a.circumradius() + pair.b.circumradius();
  const auto put_at = [&](double s) {
    pose.translation = {};
    pose.translation = (pair.a.centre() - pose(pair.b.centre())) + s * unit_dir;
  };
  double low = 0.0, high = 1.01 * scale;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    put_at(middle);
    (overlap(pair.a, pair.b, pose).outcome == Outcome::disjoint ? high : low) = middle;
  }
  put_at(low + distance * scale);
  return pose;
}

void report(const Pair& pair, const char* where, const std::vector<Transformd>& poses) {
  Microseconds filter, rest, proof, check;
  std::size_t n_open = 0, n_undecided = 0;
  std::vector<Transformd> open;
  for (const Transformd& pose : poses) {
    FilterResult found;
    filter.add([&] { found = filter_overlap(pair.a, pair.b, pose, kMaxSupportCalls); });
    if (found.verdict.outcome == Outcome::undecided) open.push_back(pose);
  }
  for (const Transformd& pose : open) {
    // The filter runs again in there; its own share is taken off.
    Verdict verdict;
    Microseconds whole, again;
    whole.add([&] { verdict = overlap(pair.a, pair.b, pose); });
    again.add([&] { filter_overlap(pair.a, pair.b, pose, kMaxSupportCalls); });
    rest.total += whole.total - again.total;
    ++n_open;
    if (verdict.outcome == Outcome::undecided) ++n_undecided;
  }
  const std::size_t n_checked = std::min<std::size_t>(poses.size(), 500);
  for (std::size_t k = 0; k < n_checked; ++k) {
    OverlapCertificate certificate;
    Verdict verdict;
    proof.add([&] { verdict = overlap(pair.a, pair.b, poses[k], &certificate); });
    if (verdict.outcome == Outcome::undecided) continue;
    check.add([&] { check_certificate(pair.a, pair.b, poses[k], verdict.outcome, certificate); });
  }
  const auto n = static_cast<double>(poses.size());
  std::printf("| %s | %s | %.3g %% | %.2f | ", pair.name, where, 100.0 * static_cast<double>(n_open) / n,
              filter.total / n);
  if (n_open > 0) {
    std::printf("%.0f", rest.total / static_cast<double>(n_open));
  } else {
    std::printf("-");
  }
  std::printf(" | %zu | %.0f | %.0f |\n", n_undecided, proof.total / static_cast<double>(n_checked),
              check.total / static_cast<double>(n_checked));
  std::fflush(stdout);
}

}  // namespace
}  // namespace vex

int main() {
  using namespace vex;
  std::printf("%s, g++ %s\n\n", processor().c_str(), __VERSION__);
  std::printf(
      "| pair | poses | left open by the filter | filter, us | what decides those, us | undecided | verdict with "
      "certificate, us | checker, us |\n|---|---|---|---|---|---|---|---|\n");
  for (const Pair& pair : pairs()) {
    std::mt19937_64 random(5);
    const Domain domain = ball_domain(pair.a, pair.b);
    std::vector<Transformd> poses;
    for (int k = 0; k < 20000; ++k) poses.push_back(random_pose(random, domain, pair.b));
    report(pair, "random", poses);
    for (const auto& [where, distance] : {std::pair{"±1e-6", 1e-6}, {"±1e-12", 1e-12}, {"±1e-14", 1e-14}}) {
      poses.clear();
      for (int k = 0; k < 500; ++k) poses.push_back(near_contact(pair, k % 2 == 0 ? distance : -distance, random));
      report(pair, where, poses);
    }
  }
}
