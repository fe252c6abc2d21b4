// What a compound of triangles costs beside a loop over them and beside FCL's tree, on the same poses in one process;
// and what queries of two poses and of a floor cost beside the query of one pose. One command:
// build/release/bin/vex_compound_bench [rounds]. Nanoseconds a pose of processor time, medians; docs/performance.md.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>

#include "engine/query/half_space.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound.h"
#include "engine/scene/pose_batches.h"
#include "shapes/any_shape.h"
#include "tests/bench/bench_report.h"
#include "tests/bench/compound_cases.h"
#include "tests/bench/rounds.h"
#include "tests/referees/random_poses.h"

namespace vex {
namespace {

double height_at(double x, double y) {
  return 0.3 * std::sin(2.0 * x) * std::cos(3.0 * y) + 0.05 * std::sin(17.0 * x + 5.0 * y);
}

// n x n squares of edge 0.1, cut in two: the body is some three of them wide.
CompoundCase landscape(int n, const char* body, std::size_t n_poses) {
  CompoundCase made{{}, body, parse_shape(body).body, {}};
  const auto at = [](int i, int j) { return Vec3d{0.1 * i, 0.1 * j, height_at(0.1 * i, 0.1 * j)}; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      made.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      made.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  std::mt19937_64 random(401);
  while (made.poses.size() < n_poses) {
    Transformd pose = random_rotation(random);
    const double x = 0.1 * n * random_in_unit_interval(random), y = 0.1 * n * random_in_unit_interval(random);
    pose.translation = {x, y, height_at(x, y) + 0.5 * (random_in_unit_interval(random) - 0.1)};
    made.poses.emplace_back(pose);
  }
  return made;
}

bool overlaps_one_by_one(const Compound& mesh, const ConvexBody& body, const Pose& pose) {
  for (std::size_t k = 0; k < mesh.size(); ++k) {
    if (overlap(mesh.body(k), body, pose).outcome == Outcome::overlap) return true;
  }
  return false;
}

double distance_one_by_one(const Compound& mesh, const ConvexBody& body, const Pose& pose) {
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < mesh.size() && least > 0.0; ++k) {
    const Separation found = distance(mesh.body(k), body, pose, {.max_distance = least});
    least = std::fmin(least, std::fmax(found.upper, 0.0));
  }
  return least;
}

std::string cell(double ns) { return three_digits(ns); }

void compare(int n_squares, const char* body, std::size_t n_poses, int n_rounds, MarkdownTable& table) {
  const CompoundCase made = landscape(n_squares, body, n_poses);
  const Compound mesh = compound_of_triangles(made.triangles);
  const CompoundPeer fcl = fcl_compound(made);
  std::vector<CompoundVerdict> verdicts(n_poses);
  std::vector<CompoundSeparation> distances(n_poses);
  volatile double sink = 0.0;
  const auto each = [&](auto ask) {
    return [&, ask] {
      double sum = 0.0;
      for (std::size_t k = 0; k < n_poses; ++k) sum += static_cast<double>(ask(k));
      sink = sink + sum;
    };
  };
  // Many triangles one by one take long: of the first poses alone.
  const std::size_t n_slow = std::max<std::size_t>(1, std::min(n_poses, 200'000 / made.triangles.size()));
  const auto slow = [&](auto ask) {
    return [&, ask] {
      double sum = 0.0;
      for (std::size_t k = 0; k < n_slow; ++k) sum += static_cast<double>(ask(k));
      sink = sink + sum;
    };
  };
  std::vector<Contender> contenders = {
      {"overlap", n_poses, [&] { overlap(mesh, made.body, made.poses, verdicts); }},
      {"overlap, triangle by triangle", n_slow,
       slow([&](std::size_t k) { return overlaps_one_by_one(mesh, made.body, made.poses[k]); })},
      {"distance", n_poses, [&] { distance(mesh, made.body, made.poses, distances); }},
      {"distance, triangle by triangle", n_slow,
       slow([&](std::size_t k) { return distance_one_by_one(mesh, made.body, made.poses[k]); })}};
  const bool has_fcl = static_cast<bool>(fcl.overlap);
  if (has_fcl) {
    contenders.push_back({"FCL collide", n_poses, each([&](std::size_t k) { return fcl.overlap(k); })});
    contenders.push_back({"FCL distance", n_poses, each([&](std::size_t k) { return fcl.distance(k); })});
  }
  const std::vector<Timing> timings = take_turns(contenders, n_rounds, 0.0);
  std::size_t n_overlaps = 0, n_unlike = 0;
  for (std::size_t k = 0; k < n_poses; ++k) {
    const bool overlaps = verdicts[k].verdict.outcome == Outcome::overlap;
    n_overlaps += overlaps ? 1 : 0;
    if (has_fcl && fcl.overlap(k) != overlaps) ++n_unlike;
  }
  std::vector<std::string> cells = {grouped(made.triangles.size()) + ", " + body,
                                    percent(static_cast<double>(n_overlaps) / static_cast<double>(n_poses))};
  for (const std::size_t k : {0u, 1u, 2u, 3u}) cells.push_back(cell(timings[k].median()));
  for (const std::size_t k : {4u, 5u}) cells.push_back(has_fcl ? cell(timings[k].median()) : "-");
  cells.push_back(has_fcl ? std::to_string(n_unlike) : "-");
  table.add(cells);
}

void single_queries(int n_rounds) {
  std::mt19937_64 random(402);
  const ConvexBody a = parse_shape("box:1,1,1").body, b = parse_shape("cylinder:1,0.5").body;
  const HalfSpace floor({0.0, 0.0, 1.0}, 0.0);
  const ConvexBody large = parse_shape("box:1000,1000,1000").body;
  std::vector<Pose> of_a, of_b, relative, above;
  for (int k = 0; k < 1000; ++k) {
    Transformd one = random_rotation(random), other = random_rotation(random);
    one.translation = 100.0 * random_direction(random);
    other.translation = one.translation + 1.5 * random_direction(random);
    of_a.emplace_back(one);
    of_b.emplace_back(other);
    relative.push_back(relative_pose(of_a.back(), of_b.back()));
    one.translation = {0.0, 0.0, 0.4 + random_in_unit_interval(random)};
    above.emplace_back(one);
  }
  volatile double sink = 0.0;
  const auto each = [&](auto ask) {
    return [&, ask] {
      double sum = 0.0;
      for (std::size_t k = 0; k < 1000; ++k) sum += static_cast<double>(ask(k));
      sink = sink + sum;
    };
  };
  const Pose under = Transformd{.translation = {0.0, 0.0, -500.0}};
  const std::vector<Contender> contenders = {
      {"overlap, box and cylinder, one pose", 1000,
       each([&](std::size_t k) { return overlap(a, b, relative[k]).outcome == Outcome::overlap; })},
      {"the same, two poses", 1000,
       each([&](std::size_t k) { return overlap(a, of_a[k], b, of_b[k]).outcome == Outcome::overlap; })},
      {"signed distance, box and cylinder, one pose", 1000,
       each([&](std::size_t k) { return signed_distance(a, b, relative[k]).signed_distance; })},
      {"the same, two poses", 1000,
       each([&](std::size_t k) { return signed_distance(a, of_a[k], b, of_b[k]).signed_distance; })},
      {"overlap, half-space and cylinder", 1000,
       each([&](std::size_t k) { return overlap(floor, b, above[k]).outcome == Outcome::overlap; })},
      {"signed distance, half-space and cylinder", 1000,
       each([&](std::size_t k) { return signed_distance(floor, b, above[k]).signed_distance; })},
      {"signed distance, a box of edge 1000 and a cylinder", 1000,
       each([&](std::size_t k) { return signed_distance(large, under, b, above[k]).signed_distance; })},
  };
  const std::vector<Timing> timings = take_turns(contenders, n_rounds, 5.0);
  MarkdownTable table({"query", "ns"});
  for (std::size_t k = 0; k < contenders.size(); ++k) table.add({contenders[k].name, cell(timings[k].median())});
  std::printf("\n%s", table.text().c_str());
}

// Uniform in the ball.
Vec3d random_in_ball(double radius, std::mt19937_64& random) {
  const Vec3d dir = random_direction(random);
  return (radius * std::cbrt(random_in_unit_interval(random)) / norm(dir)) * dir;
}

// Random poses of a body with itself, its centre anywhere in the ball in which half of them overlap.
std::vector<Pose> half_overlapping(const ConvexBody& body, std::size_t n, std::mt19937_64& random) {
  std::vector<Pose> poses;
  double radius = 2.5 * body.reach();
  for (std::size_t n_overlaps = 0; n_overlaps * 2 < n; radius *= 0.97) {
    poses.clear();
    n_overlaps = 0;
    while (poses.size() < n) {
      Transformd pose = random_rotation(random);
      pose.translation = random_in_ball(radius, random);
      poses.emplace_back(pose);
      n_overlaps += overlap(body, body, poses.back()).outcome == Outcome::overlap ? 1u : 0u;
    }
  }
  return poses;
}

// From poses farther away, motions towards a place within .8 reaches of the body's centre.
struct Casts {
  std::vector<Pose> poses;
  std::vector<Vec3d> motions;
};
Casts casts_towards(const ConvexBody& body, std::size_t n, std::mt19937_64& random) {
  Casts casts;
  while (casts.poses.size() < n) {
    Transformd pose = random_rotation(random);
    pose.translation = random_in_ball(4.0 * body.reach(), random);
    if (norm(pose.translation) < 2.0 * body.reach()) continue;
    casts.motions.push_back(random_in_ball(0.8 * body.reach(), random) - pose.translation);
    casts.poses.emplace_back(pose);
  }
  return casts;
}

// A loop of single queries, and the batch of one thread.
void batches(int n_rounds, std::size_t n_poses) {
  MarkdownTable table(
      {"pair", "overlap", "distance, loop", "batch", "depth, loop", "batch", "casts that meet", "cast, loop", "batch"});
  std::mt19937_64 random(403);
  for (const char* name : {"box:1,1,1", "capsule:1,0.25", "cylinder:1,0.5", "ellipsoid:2,0.5,0.5", "icosahedron:0.7"}) {
    const ConvexBody body = parse_shape(name).body;
    const std::vector<Pose> poses = half_overlapping(body, n_poses, random);
    const Casts casts = casts_towards(body, n_poses, random);
    std::vector<Separation> found(n_poses);
    std::vector<FirstContact> met(n_poses);
    const auto loop = [&](auto& out, auto ask) {
      return [&, ask] {
        for (std::size_t k = 0; k < n_poses; ++k) out[k] = ask(k);
      };
    };
    const std::vector<Contender> contenders = {
        {"distance", n_poses, loop(found, [&](std::size_t k) { return distance(body, body, poses[k]); })},
        {"distances", n_poses, [&] { distance(body, body, poses, found); }},
        {"depth", n_poses, loop(found, [&](std::size_t k) { return penetration_depth(body, body, poses[k]); })},
        {"depths", n_poses, [&] { penetration_depth(body, body, poses, found); }},
        {"cast", n_poses,
         loop(met, [&](std::size_t k) { return linear_cast(body, body, casts.poses[k], casts.motions[k]); })},
        {"casts", n_poses, [&] { linear_cast(body, body, casts.poses, casts.motions, met); }}};
    const std::vector<Timing> timings = take_turns(contenders, n_rounds, 0.0);
    const auto share = [&](std::size_t n) { return percent(static_cast<double>(n) / static_cast<double>(n_poses)); };
    std::size_t n_overlaps = 0, n_hits = 0;
    for (const Pose& pose : poses) n_overlaps += overlap(body, body, pose).outcome == Outcome::overlap ? 1u : 0u;
    for (const FirstContact& contact : met) n_hits += contact.verdict.outcome == Outcome::overlap ? 1u : 0u;
    std::vector<std::string> cells = {name, share(n_overlaps)};
    for (std::size_t k = 0; k < timings.size(); k += 2) {
      if (k == 4) cells.push_back(share(n_hits));
      cells.push_back(cell(timings[k].median()));
      cells.push_back(cell(timings[k + 1].median()) + " (" + three_digits(ratio(timings[k + 1], timings[k])) + ")");
    }
    table.add(cells);
  }
  std::printf("\n%s", table.text().c_str());
}

}  // namespace

#ifndef VEX_BENCH_HAS_FCL
CompoundPeer fcl_compound(const CompoundCase& /*of*/) { return {}; }
#endif

}  // namespace vex

int main(int argc, char** argv) {
  const int n_rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  const bool is_quick = argc > 2;  // few triangles, for a test that it runs
  std::printf("%s\n\n", vex::machine_line().c_str());
  vex::MarkdownTable table({"triangles, body", "overlap", "overlap, ns", "one by one", "distance, ns", "one by one",
                            "FCL collide", "FCL distance", "FCL otherwise"});
  const std::vector<int> sizes = is_quick ? std::vector<int>{5} : std::vector<int>{10, 50, 224};
  for (const int n : sizes) {
    for (const char* body : {"box:0.3,0.2,0.4", "capsule:0.3,0.1", "icosahedron:0.2"}) {
      vex::compare(n, body, is_quick ? 10 : 500, n_rounds, table);
    }
  }
  std::printf("%s", table.text().c_str());
  vex::single_queries(n_rounds);
  vex::batches(n_rounds, is_quick ? 20 : 4000);
  return 0;
}
