// The support mapping of polytopes with many vertices: the scan over all of them against the table of directions
// (engine/support/direction_map.h). One command: build/release/bin/vex_large_hulls. Markdown, for docs/performance.md.
//
// Directions are random over the whole sphere and poses over the whole ball domain, more of them than fit in a cache,
// so that large tables are met cold. Every figure is processor time, the least of some passes, in which scan and table
// take turns. Packets ask the table (of 33 vertices or more) for some poses at a time.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "apps/common/processor.h"
#include "engine/query/overlap.h"
#include "engine/query/overlap_backend.h"
#include "engine/query/packets/packet_overlap.h"
#include "engine/sampling/monte_carlo.h"
#include "shapes/polytope.h"
#include "tests/referees/polytopes.h"

namespace vex {
namespace {

/// Always scans.
class Scanned {
 public:
  Scanned(const std::vector<Vec3d>& vertices, const Polytope& like) : body_(like) {
    for (const Vec3d& v : vertices) {
      x_.push_back(v.x);
      y_.push_back(v.y);
      z_.push_back(v.z);
    }
  }
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    std::size_t best = 0;
    double most = -HUGE_VAL;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const double value = dot(Vec3d{x_[i], y_[i], z_[i]}, dir);
      if (value > most) {
        most = value;
        best = i;
      }
    }
    return {x_[best], y_[best], z_[best]};
  }
  double support_error() const { return body_.support_error(); }
  Vec3d centre() const { return body_.centre(); }
  double circumradius() const { return body_.circumradius(); }
  double inradius() const { return body_.inradius(); }
  std::optional<ExactForm> exact_form() const { return body_.exact_form(); }

 private:
  std::vector<double> x_, y_, z_;
  Polytope body_;
};

/// Always asks the table.
class Mapped {
 public:
  Mapped(std::shared_ptr<const DirectionMap> map, const Polytope& like) : map_(std::move(map)), body_(like) {}
  template <class L>
  Vec3<L> support(const Vec3<L>& dir) const {
    return all(map_->takes(dir)) ? map_->support(dir) : body_.support(dir);
  }
  double support_error() const { return body_.support_error(); }
  Vec3d centre() const { return body_.centre(); }
  double circumradius() const { return body_.circumradius(); }
  double inradius() const { return body_.inradius(); }
  std::optional<ExactForm> exact_form() const { return body_.exact_form(); }

 private:
  std::shared_ptr<const DirectionMap> map_;
  Polytope body_;
};

/// Of the processor, for this program: on a machine that is shared the wall clock tells of others.
double seconds_now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Lowers `least` to the mean time of `n` actions, in seconds.
template <class Action>
void time_pass(std::size_t n, const Action& action, double* least) {
  const double start = seconds_now();
  for (std::size_t k = 0; k < n; ++k) action(k);
  *least = std::min(*least, (seconds_now() - start) / static_cast<double>(n));
}

constexpr std::size_t kMost = std::size_t{1} << 17;
constexpr int kPasses = 7;

/// As many as the scan gets through in some tenths of a second.
std::size_t n_of_scan(std::size_t n_vertices, double calls_each) {
  const double n = 2e8 / (static_cast<double>(n_vertices) * calls_each);
  return static_cast<std::size_t>(std::clamp(n, 20.0, static_cast<double>(kMost)));
}

void report(const std::string& name, const std::vector<Vec3d>& vertices) {
  const Polytope polytope(vertices, {}, 0.0);
  std::vector<double> x, y, z;
  for (const Vec3d& v : vertices) {
    x.push_back(v.x);
    y.push_back(v.y);
    z.push_back(v.z);
  }
  double build = HUGE_VAL;
  std::shared_ptr<const DirectionMap> map;
  for (int pass = 0; pass < (vertices.size() < 100000 ? kPasses : 2); ++pass) {
    map.reset();
    time_pass(
        1, [&](std::size_t) { map = std::make_shared<const DirectionMap>(x, y, z); }, &build);
  }
  const Scanned scanned(vertices, polytope);
  const Mapped mapped(map, polytope);
  std::mt19937_64 random(1);
  std::vector<Vec3d> dirs;
  for (std::size_t k = 0; k < kMost; ++k) dirs.push_back(random_direction(random));
  const ConvexBody scanned_body = scanned, mapped_body = mapped;
  MonteCarloSettings settings;
  settings.domain = ball_domain(mapped_body, mapped_body);
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < kMost; ++k) {
    poses.push_back(Pose::unchecked(trial_pose(mapped_body, mapped_body, settings, k)));
  }

  const ConvexBody asked = polytope;
  for (std::size_t k = 0; k <= LazyDirectionMap::kCallsThatPay; ++k) asked.support(dirs[k]);
  const std::unique_ptr<OverlapBackend> packets = gjk_backend().make(asked, asked);
  std::vector<Verdict> verdicts(std::size_t{PacketOverlap::kMostTrials});

  double scan_call = HUGE_VAL, map_call = HUGE_VAL, scan_query = HUGE_VAL, map_query = HUGE_VAL, packet = HUGE_VAL;
  double sum = 0.0;  // used, so that no call is left out
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto call = [&](const auto& body) { return [&](std::size_t k) { sum += body.support(dirs[k]).x; }; };
    const auto query = [&](const ConvexBody& body) {
      return [&](std::size_t k) { sum += overlap(body, body, poses[k]).outcome == Outcome::overlap ? 1.0 : 0.0; };
    };
    time_pass(n_of_scan(vertices.size(), 1.0), call(scanned), &scan_call);
    time_pass(kMost, call(mapped), &map_call);
    time_pass(n_of_scan(vertices.size(), 8.0), query(scanned_body), &scan_query);
    time_pass(kMost, query(mapped_body), &map_query);
    const auto batch = [&](std::size_t k) {
      packets->decide({&poses[k * verdicts.size()], verdicts.size()}, verdicts);
    };
    time_pass(kMost / verdicts.size(), batch, &packet);
  }
  const auto n = static_cast<double>(vertices.size());
  std::printf("| %s | %zu | %.3g | %.3g | %.3g | %.3g | %.3g | %.2g | %.0f | %.0f |\n", name.c_str(), vertices.size(),
              1e9 * scan_call, 1e9 * map_call, 1e6 * scan_query, 1e6 * map_query,
              1e6 * packet / static_cast<double>(verdicts.size()), build, 1e9 * build / n,
              static_cast<double>(map->bytes()) / n);
  if (std::isnan(sum)) std::printf("not a number\n");
  std::fflush(stdout);
}

/// n * n vertices on each face of a cube.
std::vector<Vec3d> cube_grid(int n) {
  std::vector<Vec3d> vertices;
  const auto grid = [n](int k) { return 2.0 * k / (n - 1) - 1.0; };
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < n; ++k) {
      for (const double side : {-1.0, 1.0}) {
        vertices.push_back({side, grid(j), grid(k)});
        vertices.push_back({grid(j), side, grid(k)});
        vertices.push_back({grid(j), grid(k), side});
      }
    }
  }
  return vertices;
}

}  // namespace
}  // namespace vex

int main() {
  using namespace vex;
  std::printf("%s, g++ %s\n\n", processor().c_str(), __VERSION__);
  std::printf(
      "| body | vertices | scan, ns a call | table, ns a call | scan, us a query | table, us a query | packets, us "
      "a query | made in, s | ns a vertex | bytes a vertex |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int n : {8, 16, 24, 32, 48, 64, 100, 316, 1000, 10000, 100000, 1000000}) {
    report("ellipsoid 3:2:1", test_point_hull(n, {3, 2, 1}, 1).vertices);
  }
  report("ellipsoid 100:1:1", test_point_hull(10000, {100, 1, 1}, 1).vertices);
  for (const int n : {41, 408}) {
    const std::vector<Vec3d> cube = cube_grid(n);
    report("cube, " + std::to_string(n) + "^2 points a face", cube);
    std::mt19937_64 random(2);
    const Transformd turn = random_rotation(random);
    std::vector<Vec3d> turned;
    for (const Vec3d& v : cube) turned.push_back(turn(v));
    report("the same, turned", turned);
  }
}
