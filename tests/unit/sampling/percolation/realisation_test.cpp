#include "engine/sampling/percolation/realisation.h"

#include <gtest/gtest.h>

#include <deque>

#include "engine/numeric/errors.h"
#include "engine/query/overlap.h"
#include "shapes/box.h"
#include "shapes/capsule.h"
#include "shapes/cone.h"
#include "shapes/disc.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

PercolationSystem system_of(std::vector<BodyPart> parts, double edge, std::uint64_t seed = 1) {
  return {Placements(std::move(parts), {}, seed), edge};
}

// One body after another, every pair and every image by `overlap`, and after each the clusters anew by a search through
// the graph: along which axes some loop comes back elsewhere.
class BruteForce {
 public:
  explicit BruteForce(const PercolationSystem& system) : system_(system), box_(PeriodicBox::cube(system.edge)) {}

  WrappingNumbers run(std::uint32_t realisation) {
    poses_.clear();
    parts_.clear();
    neighbours_.clear();
    WrappingNumbers numbers{{kNotYet, kNotYet, kNotYet}};
    while (numbers.all() == kNotYet) {
      add(system_.placements({system_.size, realisation}, static_cast<std::uint32_t>(poses_.size()), system_.edge));
      const std::array<bool, 3> wraps = wrapped_axes();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (wraps[axis] && numbers.along[axis] == kNotYet) {
          numbers.along[axis] = static_cast<std::uint32_t>(poses_.size());
        }
      }
    }
    return numbers;
  }

 private:
  static constexpr std::uint32_t kNotYet = ~0u;
  struct Edge {
    std::size_t to;
    ImageOffset image;
  };

  const ConvexBody& body(std::size_t k) const { return system_.placements.parts()[parts_[k]].body; }

  void add(const Placements::Placed& placed) {
    poses_.push_back(placed.world_from_body.a_from_b());
    parts_.push_back(placed.part);
    neighbours_.emplace_back();
    const std::size_t b = poses_.size() - 1;
    for (std::size_t a = 0; a <= b; ++a) {
      for (int i = -2; i <= 2; ++i) {
        for (int j = -2; j <= 2; ++j) {
          for (int k = -2; k <= 2; ++k) {
            const ImageOffset image = {i, j, k};
            if (a == b && image == ImageOffset{}) continue;
            if (!meets(a, b, image)) continue;
            neighbours_[a].push_back({b, image});
            neighbours_[b].push_back({a, {-i, -j, -k}});
          }
        }
      }
    }
  }

  bool meets(std::size_t a, std::size_t b, const ImageOffset& image) const {
    const Transformd& pose_a = poses_[a];
    Transformd pose_b = poses_[b];
    pose_b.translation = pose_b.translation + box_.shift(image);
    const auto column = [](const Transformd& pose, int k) -> Vec3d {
      if (k == 0) return {pose.row_x.x, pose.row_y.x, pose.row_z.x};
      if (k == 1) return {pose.row_x.y, pose.row_y.y, pose.row_z.y};
      return {pose.row_x.z, pose.row_y.z, pose.row_z.z};
    };
    Transformd relative;
    Vec3d* const rows[] = {&relative.row_x, &relative.row_y, &relative.row_z};
    for (int k = 0; k < 3; ++k) {
      const Vec3d of_a = column(pose_a, k);
      *rows[k] = {dot(of_a, column(pose_b, 0)), dot(of_a, column(pose_b, 1)), dot(of_a, column(pose_b, 2))};
    }
    relative.translation = pose_a.direction_to_b(pose_b.translation - pose_a.translation);
    return overlap(body(a), body(b), Pose(relative)).outcome == Outcome::overlap;
  }

  std::array<bool, 3> wrapped_axes() const {
    std::array<bool, 3> wraps{};
    std::vector<std::optional<ImageOffset>> seen(poses_.size());
    for (std::size_t first = 0; first < poses_.size(); ++first) {
      if (seen[first]) continue;
      seen[first] = ImageOffset{};
      std::deque<std::size_t> queue = {first};
      for (; !queue.empty(); queue.pop_front()) {
        const std::size_t from = queue.front();
        for (const Edge& edge : neighbours_[from]) {
          const ImageOffset there = image_sum(*seen[from], edge.image);
          if (!seen[edge.to]) {
            seen[edge.to] = there;
            queue.push_back(edge.to);
          }
          for (std::size_t axis = 0; axis < 3; ++axis)
            wraps[axis] = wraps[axis] || (*seen[edge.to])[axis] != there[axis];
        }
      }
    }
    return wraps;
  }

  const PercolationSystem& system_;
  PeriodicBox box_;
  std::vector<Transformd> poses_;
  std::vector<std::uint32_t> parts_;
  std::vector<std::vector<Edge>> neighbours_;
};

TEST(Realisation, WrapsWithTheSameBodiesAsBruteForce) {
  const std::vector<PercolationSystem> systems = {
      system_of({{Box(1.0, 1.0, 1.0), 1.0}}, 3.6),
      system_of({{Sphere(0.5), 1.0}}, 2.5),
      system_of({{Disc(0.7), 1.0}}, 3.0),
      system_of({{Capsule(2.0, 0.2), 1.0}}, 3.0),  // 2.4 long: it meets several images
      system_of({{Capsule(3.0, 0.15), 1.0}, {Cone(1.0, 0.5), 2.0}}, 2.6),
  };
  int n_axes_apart = 0;
  for (const PercolationSystem& system : systems) {
    Realisation realisation(system);
    BruteForce brute_force(system);
    for (std::uint32_t k = 0; k < 12; ++k) {
      const WrappingNumbers wanted = brute_force.run(k);
      const std::optional<WrappingNumbers> found = realisation.run(k);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->along, wanted.along) << "edge " << system.edge << ", realisation " << k;
      if (wanted.any() != wanted.all()) ++n_axes_apart;
    }
  }
  EXPECT_GT(n_axes_apart, 20) << "axes nearly always wrap together: the order was not tested";
}

TEST(Realisation, ThreadsSetsAndBackendsChangeNothing) {
  PercolationSystem system = system_of({{Box(1.0, 0.8, 0.5), 1.0}, {Capsule(1.0, 0.3), 0.5}}, 6.0, 9);
  PercolationCounts counts;
  const std::vector<WrappingNumbers> wanted = run_realisations(system, 5, 40, 1, counts);
  ASSERT_EQ(wanted.size(), 40u);
  for (const std::uint32_t usual : {100u, 5000u}) {
    PercolationCounts other;
    system.usual_bodies = usual;
    EXPECT_EQ(run_realisations(system, 5, 40, 2, other), wanted);
    system.usual_bodies = 0;
  }
  for (const int n_threads : {2, 3, 8}) {
    PercolationCounts other;
    EXPECT_EQ(run_realisations(system, 5, 40, n_threads, other), wanted);
    EXPECT_EQ(other.n_bodies, counts.n_bodies);
    for (const SceneStage stage : {SceneStage::joined, SceneStage::bounds, SceneStage::packets}) {
      EXPECT_EQ(other.stages[stage].seen, counts.stages[stage].seen) << name_of(stage);
      EXPECT_EQ(other.stages[stage].settled, counts.stages[stage].settled) << name_of(stage);
    }
  }
  EXPECT_GT(counts.stages[SceneStage::joined].settled, 0u);
  for (const InstructionSet set : instruction_sets()) {
    system.instruction_set = set;
    EXPECT_EQ(run_realisations(system, 5, 40, 2, counts), wanted) << name_of(set);
  }
  system.instruction_set = best_instruction_set();
  system.backend = gjk_backend();
  EXPECT_EQ(run_realisations(system, 5, 40, 2, counts), wanted);
}

// What is placed at once only has pairs searched in another order; also where a cluster wraps before all is placed.
TEST(Realisation, HowManyBodiesArePlacedAtOnceChangesNothing) {
  const BodyOrientations aligned{OrientationLaw::aligned(), false};
  std::vector<PercolationSystem> systems = {
      system_of({{Sphere(0.5), 1.0}}, 9.0, 3), system_of({{Box(1.0, 1.0, 1.0), 1.0}}, 14.0, 4),
      system_of({{Capsule(1.0, 0.3), 1.0}, {Box(1.0, 0.8, 0.5), 0.5}}, 12.0, 5),
      PercolationSystem{Placements({{Box(1.0, 1.0, 1.0), 1.0}}, aligned, 6), 12.0}};
  for (PercolationSystem& system : systems) {
    PercolationCounts counts, at_once;
    const std::vector<WrappingNumbers> wanted = run_realisations(system, 0, 12, 2, counts);
    std::uint32_t fewest = ~0u, most = 0;
    for (const WrappingNumbers& numbers : wanted) {
      fewest = std::min(fewest, numbers.any());
      most = std::max(most, numbers.all());
    }
    ASSERT_GT(fewest, 260u);
    for (const std::uint32_t usual : {0u, most}) {
      system.usual_bodies = usual;
      for (const std::uint32_t placed : {1u, 260u, fewest - 1, fewest, (fewest + most) / 2, most, most + 100}) {
        system.at_once = placed;
        SCOPED_TRACE(placed);
        EXPECT_EQ(run_realisations(system, 0, 12, 2, at_once), wanted);
        for (const InstructionSet set : instruction_sets()) {
          system.instruction_set = set;
          EXPECT_EQ(run_realisations(system, 0, 2, 1, at_once), std::vector(wanted.begin(), wanted.begin() + 2))
              << name_of(set);
        }
        system.instruction_set = best_instruction_set();
      }
    }
    EXPECT_EQ(at_once.n_undecided, 0u);
  }
}

// Of thirty realisations most end before the last, and few bodies are too many.
TEST(Realisation, WhatIsPlacedAtOnceIsMostOfIt) {
  for (PercolationSystem system : {system_of({{Sphere(0.5), 1.0}}, 12.0), system_of({{Disc(0.5), 1.0}}, 11.0)}) {
    const std::uint32_t at_once = system.at_once = best_at_once(system);
    EXPECT_EQ(best_at_once(system), at_once);
    PercolationCounts counts;
    const std::vector<WrappingNumbers> found = run_realisations(system, 0, 30, 2, counts);
    EXPECT_LE(std::ranges::count_if(found, [&](auto& numbers) { return numbers.all() > at_once; }), 8);
    EXPECT_LE(std::ranges::count_if(found, [&](auto& numbers) { return 4 * numbers.all() < 3 * at_once; }), 8);
    EXPECT_LT(static_cast<double>(counts.n_bodies), 30 * 1.1 * at_once);
    system.edge = 5.0;
    EXPECT_EQ(best_at_once(system), 0u) << "small cubes are not worth it";
  }
}

// Few large bodies among many small ones: in a grid for the large ones every small one would look at hundreds.
TEST(Realisation, OfUnlikeSizesLooksAtFewPairs) {
  PercolationSystem system = system_of({{Sphere(1.0), 0.01}, {Sphere(0.2), 1.0}}, 8.0);
  PercolationCounts one_by_one, at_once;
  const std::vector<WrappingNumbers> wanted = run_realisations(system, 0, 2, 1, one_by_one);
  system.at_once = wanted[0].all() + 100;
  EXPECT_EQ(run_realisations(system, 0, 2, 1, at_once), wanted);
  EXPECT_GT(at_once.n_bodies, 2000u);
  EXPECT_LT(at_once.n_seen(), 20 * at_once.n_bodies);
  EXPECT_LT(at_once.stages[SceneStage::balls].seen, 60 * at_once.n_bodies);
}

TEST(Realisation, SizesAndSeedsDrawOtherBodies) {
  PercolationSystem system = system_of({{Sphere(0.5), 1.0}}, 5.0);
  PercolationCounts counts;
  const std::vector<WrappingNumbers> first = run_realisations(system, 0, 20, 1, counts);
  system.size = 1;
  EXPECT_NE(run_realisations(system, 0, 20, 1, counts), first);
  EXPECT_NE(run_realisations(system_of({{Sphere(0.5), 1.0}}, 5.0, 2), 0, 20, 1, counts), first);
}

TEST(Realisation, StopsWhereItIsTold) {
  const PercolationSystem system = system_of({{Sphere(0.5), 1.0}}, 6.0);
  PercolationCounts counts, all;
  const std::vector<WrappingNumbers> wanted = run_realisations(system, 0, 10, 1, all);
  int n_asked = 0;
  const std::vector<WrappingNumbers> found = run_realisations(system, 0, 10, 1, counts, [&] { return ++n_asked > 60; });
  ASSERT_LT(found.size(), 10u);
  ASSERT_GT(found.size(), 0u);
  EXPECT_TRUE(std::equal(found.begin(), found.end(), wanted.begin()));
  std::uint64_t n_bodies = 0;
  Realisation realisation(system);
  for (std::uint32_t k = 0; k < found.size(); ++k) {
    ASSERT_TRUE(realisation.run(k));
    n_bodies += realisation.counts().n_bodies;
  }
  EXPECT_EQ(counts.n_bodies, n_bodies) << "what was not finished counts";
}

TEST(Realisation, WhatNeverWrapsIsRefused) {
  PercolationSystem system = system_of({{Sphere(0.1), 1.0}}, 10.0);
  system.most_bodies = 500;
  PercolationCounts counts;
  EXPECT_THROW(run_realisations(system, 0, 2, 1, counts), UsageError);
  EXPECT_THROW(run_realisations(system, 0, 2, 0, counts), UsageError);
  EXPECT_THROW(run_realisations(system, kMostRealisations - 1, 2, 1, counts), UsageError);
  system.size = kMostSizes;
  EXPECT_THROW(Realisation{system}, UsageError);
}

// However many are placed at once, or in a batch.
TEST(Realisation, ThatNeedsMoreBodiesThanThereMayBeIsRefused) {
  PercolationSystem system = system_of({{Sphere(0.5), 1.0}}, 6.0);
  const std::uint32_t needed = Realisation(system).run(0)->all();
  ASSERT_GT(needed, 100u);
  for (const std::uint32_t at_once : {0u, needed / 2, needed - 1, needed, 2 * needed}) {
    system.at_once = at_once;
    system.most_bodies = needed;
    EXPECT_EQ(Realisation(system).run(0)->all(), needed) << at_once;
    system.most_bodies = needed - 1;
    EXPECT_THROW(Realisation(system).run(0), UsageError) << at_once;
  }
}

// A checkpoint was once written only where a round of 64 realisations of every size had ended.
TEST(Realisations, AreToldOfAsTheyAreFinished) {
  const PercolationSystem system = system_of({{Sphere(0.5), 1.0}}, 4.0);
  PercolationCounts wanted_counts;
  const std::vector<WrappingNumbers> wanted = run_realisations(system, 3, 40, 1, wanted_counts);
  for (const int n_threads : {1, 3}) {
    std::vector<WrappingNumbers> told;
    PercolationCounts counts;
    std::size_t n_calls = 0;
    const OnRealisations take = [&](std::span<const WrappingNumbers> finished, const PercolationCounts& theirs) {
      EXPECT_FALSE(finished.empty());
      told.insert(told.end(), finished.begin(), finished.end());
      counts += theirs;
      ++n_calls;
    };
    run_realisations(system, 3, 40, n_threads, take);
    EXPECT_EQ(told, wanted);
    EXPECT_EQ(counts.n_bodies, wanted_counts.n_bodies);
    EXPECT_EQ(counts.n_seen(), wanted_counts.n_seen());
    // Several threads may tell of all at once: the one that has the first realisation may be the last to run again.
    EXPECT_TRUE(n_threads > 1 || n_calls == 40u) << n_calls;
  }
}

TEST(Realisations, CountWhatTheirStagesCount) {
  for (const ConvexBody& body : {ConvexBody(Box(1.0, 1.0, 1.0)), ConvexBody(Sphere(0.5)), ConvexBody(Disc(1.0))}) {
    PercolationCounts counts;
    run_realisations(system_of({{body, 1.0}}, 4.0 * body.circumradius() * 2.0), 0, 10, 2, counts);
    const SceneCounts::Stage& bounds = counts.stages[SceneStage::bounds];
    EXPECT_GT(counts.n_seen(), 0u);
    EXPECT_EQ(counts.n_seen(), counts.n_skipped() + counts.n_tested());
    EXPECT_GE(counts.n_tested(), bounds.settled);
    // What no stage before has settled or left out comes to the packets.
    const SceneCounts::Stage& cylinders = counts.stages[SceneStage::cylinders];
    EXPECT_EQ(counts.n_tested(), cylinders.settled + bounds.settled + counts.stages[SceneStage::packets].seen);
  }
}

}  // namespace
}  // namespace vex
