#include "engine/sampling/monte_carlo.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "engine/query/overlap.h"
#include "engine/query/packets/quick_verdict.h"
#include "engine/sampling/poses/fitted_domain.h"
#include "shapes/box.h"
#include "shapes/cylinder.h"
#include "shapes/ellipsoid.h"
#include "shapes/sphere.h"

namespace vex {
namespace {

MonteCarloSettings settings_for(const ConvexBody& a, const ConvexBody& b, std::uint64_t trials) {
  MonteCarloSettings settings;
  settings.domain = best_domain(a, b);
  settings.stop.trials = trials;
  return settings;
}

// A backend that answers what it is told.
class Scripted final : public OverlapBackend {
 public:
  using Answer = std::function<Verdict(const Transformd&)>;
  explicit Scripted(Answer answer) : answer_(std::move(answer)) {}
  void decide(std::span<const Pose> poses, std::span<Verdict> verdicts) override {
    for (std::size_t k = 0; k < poses.size(); ++k) verdicts[k] = answer_(poses[k].a_from_b());
  }

 private:
  Answer answer_;
};

BackendKind scripted(std::string name, Scripted::Answer answer) {
  return {std::move(name), true,
          [answer](const ConvexBody&, const ConvexBody&) { return std::make_unique<Scripted>(answer); }};
}

TEST(MonteCarlo, SameSeedSameTallyForAnyNumberOfThreads) {
  const ConvexBody a = Box(1, 2, 3), b = Ellipsoid(1, 1, 2);
  MonteCarloSettings settings = settings_for(a, b, 100003);
  const RunRecord one = run_monte_carlo(a, b, settings);
  EXPECT_EQ(one.tally.n_trials, 100003u);
  EXPECT_TRUE(one.complete);
  for (const int n : {2, 3, 7}) {
    settings.n_threads = n;
    EXPECT_EQ(run_monte_carlo(a, b, settings).tally, one.tally) << n << " threads";
  }
  settings.seed = 2;
  EXPECT_NE(run_monte_carlo(a, b, settings).tally.n_hits, one.tally.n_hits);
}

TEST(MonteCarlo, StopsByRelativeErrorAtTheSameTrialForAnyNumberOfThreads) {
  const ConvexBody a = Box(1, 1, 1);
  MonteCarloSettings settings = settings_for(a, a, 1);
  settings.stop.trials.reset();
  settings.stop.relative_error = 0.01;
  const RunRecord one = run_monte_carlo(a, a, settings);
  EXPECT_EQ(one.stopped_by, StopReason::relative_error);
  EXPECT_LE(hit_or_miss_estimate(one.tally, 1.0).relative_error(), 0.01);
  settings.n_threads = 4;
  EXPECT_EQ(run_monte_carlo(a, a, settings).tally, one.tally);
}

TEST(MonteCarlo, TalliesAreTheTrialsOnePerOne) {
  const ConvexBody a = Box(1, 1, 1), b = Sphere(0.5);
  const MonteCarloSettings settings = settings_for(a, b, 1000);
  Tally expected;
  const QuickVerdict quick(a, b, kDrawnRotationError);
  const std::unique_ptr<OverlapBackend> gjk = gjk_backend().make(a, b);
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const Transformd pose = trial_pose(a, b, settings, k);
    const QuickVerdict::Answer<double> answer = quick(pose);
    Verdict verdict;
    if (answer.disjoint) {
      verdict = Verdict::disjoint(DecidedBy::outer_bound);
    } else if (answer.overlap) {
      verdict = Verdict::overlap(DecidedBy::inner_bound);
    } else {
      verdict = gjk->decide(pose);
    }
    expected.add(verdict);
  }
  EXPECT_EQ(run_monte_carlo(a, b, settings).tally, expected);
}

TEST(MonteCarlo, QuickVerdictsChangeWhoDecidesNotWhatIsDecided) {
  const ConvexBody a = Box(1, 2, 3), b = Ellipsoid(1, 1, 2);
  MonteCarloSettings settings = settings_for(a, b, 50000);
  const Tally quick = run_monte_carlo(a, b, settings).tally;
  settings.quick_verdicts = false;
  const Tally slow = run_monte_carlo(a, b, settings).tally;
  EXPECT_EQ(quick.n_hits, slow.n_hits);
  EXPECT_GT(quick.n_decided_by[static_cast<std::size_t>(DecidedBy::outer_bound)], 1000u);
  EXPECT_GT(quick.n_decided_by[static_cast<std::size_t>(DecidedBy::inner_bound)], 1000u);
  EXPECT_EQ(slow.n_decided_by[static_cast<std::size_t>(DecidedBy::gjk)], 50000u);
  std::uint64_t sum = quick.n_undecided;
  for (const std::uint64_t n : quick.n_decided_by) sum += n;
  EXPECT_EQ(sum, quick.n_trials);
}

TEST(MonteCarlo, WhereEveryTrialHitsItEndsAndClaimsAnError) {
  const ConvexBody a = Sphere(1.0), b = Sphere(2.0);
  MonteCarloSettings settings = settings_for(a, b, 1);
  settings.domain = ball_domain(a, b);
  settings.stop.trials.reset();
  settings.stop.relative_error = 1e-3;
  ASSERT_TRUE(hits_by_construction(a, b, settings.law, settings.domain));
  const RunRecord record = run_monte_carlo(a, b, settings);
  EXPECT_EQ(record.stopped_by, StopReason::relative_error);
  EXPECT_EQ(record.tally.n_hits, record.tally.n_trials);
  EXPECT_GT(hit_or_miss_estimate(record.tally, settings.domain.volume).std_error, 0.0);
  EXPECT_FALSE(hits_by_construction(a, b, settings.law, box_domain(a, b)));
  EXPECT_FALSE(hits_by_construction(Box(1, 1, 1), b, settings.law, ball_domain(Box(1, 1, 1), b)));
}

TEST(MonteCarlo, WhereNoTrialHitsItEndsAtTheLimitIncomplete) {
  const ConvexBody a = Sphere(1.0);
  MonteCarloSettings settings = settings_for(a, a, 1);
  settings.stop.trials.reset();
  settings.stop.relative_error = 1e-3;
  settings.stop.max_trials = 20000;
  settings.backend = scripted("never", [](const Transformd&) { return Verdict::disjoint(DecidedBy::peer); });
  const RunRecord record = run_monte_carlo(a, a, settings);
  EXPECT_EQ(record.stopped_by, StopReason::max_trials);
  EXPECT_FALSE(record.complete);
  EXPECT_EQ(record.tally.n_trials, 20000u);
  EXPECT_EQ(record.tally.n_hits, 0u);
}

TEST(MonteCarlo, AsksAPeerAboutEveryPose) {
  const ConvexBody a = Sphere(1.0);
  MonteCarloSettings settings = settings_for(a, a, 5000);
  settings.backend = scripted("peer", [](const Transformd&) { return Verdict::overlap(DecidedBy::peer); });
  const Tally tally = run_monte_carlo(a, a, settings).tally;
  EXPECT_EQ(tally.n_decided_by[static_cast<std::size_t>(DecidedBy::peer)], 5000u);
}

TEST(MonteCarlo, CountsAndListsUndecidedTrialsAndNeverCallsThemHitsOrMisses) {
  const ConvexBody a = Sphere(1.0);
  MonteCarloSettings settings = settings_for(a, a, 6000);
  settings.n_threads = 3;
  settings.backend = scripted("unsure", [](const Transformd& pose) {
    return pose.translation.x > 0.0 ? Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap)
                                    : Verdict::disjoint(DecidedBy::peer);
  });
  const RunRecord record = run_monte_carlo(a, a, settings);
  EXPECT_NEAR(static_cast<double>(record.tally.n_undecided), 3000.0, 200.0);
  EXPECT_EQ(record.tally.n_hits, 0u);
  EXPECT_EQ(record.undecided.n_all, record.tally.n_undecided);
  ASSERT_EQ(record.undecided.kept.size(), FirstOf<UndecidedTrial>::kKept);
  for (std::size_t k = 0; k < record.undecided.kept.size(); ++k) {
    if (k > 0) {
      ASSERT_LT(record.undecided.kept[k - 1].index, record.undecided.kept[k].index);
    }
    ASSERT_GT(trial_pose(a, a, settings, record.undecided.kept[k].index).translation.x, 0.0);
  }
}

TEST(MonteCarlo, ProvesEveryVerdictAgainAndFindsTheWrongOnes) {
  const ConvexBody a = Box(1, 1, 1), b = Ellipsoid(0.5, 0.5, 1);
  MonteCarloSettings settings = settings_for(a, b, 3000);
  settings.n_threads = 2;
  settings.verify = true;
  const RunRecord right = run_monte_carlo(a, b, settings);
  EXPECT_EQ(right.n_proven_again, 3000u);
  EXPECT_EQ(right.unproven.n_all, 0u);

  // Wrong in one corner of the domain, either way; and unsure in another.
  settings.quick_verdicts = false;
  settings.backend = scripted("liar", [&](const Transformd& pose) {
    if (pose.translation.y < -0.9) return Verdict::undecided(DecidedBy::peer, UndecidedReason::rounding);
    const bool meets = (overlap(a, b, pose).outcome == Outcome::overlap) != (pose.translation.x > 0.9);
    return meets ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
  });
  const RunRecord wrong = run_monte_carlo(a, b, settings);
  EXPECT_GT(wrong.unproven.n_all, 50u);
  EXPECT_GT(wrong.tally.n_undecided, 50u);
  EXPECT_EQ(wrong.n_proven_again + wrong.unproven.n_all + wrong.tally.n_undecided, 3000u);
  for (const UnprovenTrial& trial : wrong.unproven.kept) {
    EXPECT_GT(trial_pose(a, b, settings, trial.index).translation.x, 0.9);
    EXPECT_NE(trial.fault.find("the engine says"), std::string::npos);
  }
}

TEST(MonteCarlo, ListsTrialsInTheirOrderWhateverThreadIsLast) {
  // The thread that has the first block sleeps, so that later trials come home first.
  const ConvexBody a = Sphere(1.0);
  MonteCarloSettings settings = settings_for(a, a, 5000);
  settings.n_threads = 3;
  const double first_x = trial_pose(a, a, settings, 0).translation.x;
  settings.backend = scripted("unsure and slow", [first_x](const Transformd& pose) {
    if (pose.translation.x == first_x) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return Verdict::undecided(DecidedBy::peer, UndecidedReason::rounding);
  });
  settings.cross_check.push_back(scripted("sure", [](const Transformd&) { return Verdict::overlap(DecidedBy::peer); }));
  settings.cross_check.push_back(
      scripted("contrary", [](const Transformd&) { return Verdict::disjoint(DecidedBy::peer); }));
  const RunRecord record = run_monte_carlo(a, a, settings);
  ASSERT_EQ(record.undecided.kept.size(), FirstOf<UndecidedTrial>::kKept);
  ASSERT_EQ(record.disagreements.kept.size(), FirstOf<Disagreement>::kKept);
  EXPECT_EQ(record.disagreements.n_all, 5000u);
  for (std::size_t k = 0; k < FirstOf<UndecidedTrial>::kKept; ++k) {
    ASSERT_EQ(record.undecided.kept[k].index, k);
    ASSERT_EQ(record.disagreements.kept[k].index, k);
  }
}

TEST(MonteCarlo, CrossCheckFindsALiar) {
  const ConvexBody a = Box(1, 1, 1);
  MonteCarloSettings settings = settings_for(a, a, 20000);
  settings.n_threads = 2;
  // Denies every overlap whose centre is far out: wrong now and then.
  settings.cross_check.push_back(scripted("liar", [a](const Transformd& pose) {
    if (norm(pose.translation) > 1.2) return Verdict::disjoint(DecidedBy::peer);
    return gjk_backend().make(a, a)->decide(pose);
  }));
  const RunRecord record = run_monte_carlo(a, a, settings);
  EXPECT_GT(record.disagreements.n_all, 100u);
  for (const Disagreement& found : record.disagreements.kept) {
    ASSERT_EQ(found.outcomes.size(), 2u);
    EXPECT_EQ(found.outcomes[0], Outcome::overlap);
    EXPECT_EQ(found.outcomes[1], Outcome::disjoint);
    EXPECT_EQ(found.a_from_b.translation.x, trial_pose(a, a, settings, found.index).translation.x)
        << "the pose can be replayed";
  }
  settings.cross_check.clear();
  EXPECT_EQ(run_monte_carlo(a, a, settings).tally, record.tally) << "a check changes nothing";
}

TEST(MonteCarlo, EndsAtTheTimeLimit) {
  const ConvexBody a = Box(1, 1, 1);
  MonteCarloSettings settings = settings_for(a, a, 1);
  settings.stop.trials.reset();
  settings.stop.seconds = 0.2;
  settings.n_threads = 2;
  const RunRecord record = run_monte_carlo(a, a, settings);
  EXPECT_EQ(record.stopped_by, StopReason::seconds);
  EXPECT_TRUE(record.complete);
  EXPECT_GE(record.seconds, 0.2);
  EXPECT_GT(record.tally.n_trials, 0u);
  // Whatever ended it, the trials done are the first ones: the same count gives the same hits.
  MonteCarloSettings again = settings_for(a, a, record.tally.n_trials);
  EXPECT_EQ(run_monte_carlo(a, a, again).tally, record.tally);
}

TEST(MonteCarlo, EndsWhenInterruptedAndKeepsWhatWasDone) {
  const ConvexBody a = Box(1, 1, 1);
  std::atomic<int> interrupt{0};
  MonteCarloSettings settings = settings_for(a, a, 1ull << 40);
  settings.n_threads = 2;
  settings.interrupt = &interrupt;
  int n_reports = 0;
  std::uint64_t last = 0;
  settings.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.tally.n_trials, last);
    last = progress.tally.n_trials;
    if (++n_reports == 3) interrupt = 2;
  };
  const RunRecord record = run_monte_carlo(a, a, settings);
  EXPECT_EQ(record.stopped_by, StopReason::interrupted);
  EXPECT_FALSE(record.complete);
  EXPECT_GT(record.tally.n_trials, 0u);
  MonteCarloSettings again = settings_for(a, a, record.tally.n_trials);
  EXPECT_EQ(run_monte_carlo(a, a, again).tally, record.tally);
}

TEST(MonteCarlo, PassesOnWhatABackendThrows) {
  const ConvexBody a = Box(1, 1, 1);
  MonteCarloSettings settings = settings_for(a, a, 100000);
  settings.n_threads = 3;
  settings.backend =
      scripted("broken", [](const Transformd&) -> Verdict { throw std::runtime_error("broken backend"); });
  EXPECT_THROW(run_monte_carlo(a, a, settings), std::runtime_error);
}

TEST(MonteCarlo, PassesOnWhatTheProgressCallThrows) {
  // As with a thread that cannot be started: those that run must be stopped, or joining them never ends.
  const ConvexBody a = Box(1, 1, 1);
  MonteCarloSettings settings = settings_for(a, a, 1ull << 40);
  settings.n_threads = 2;
  settings.on_progress = [](const Progress&) { throw std::runtime_error("no more"); };
  EXPECT_THROW(run_monte_carlo(a, a, settings), std::runtime_error);
}

MonteCarloSettings fitted_settings_for(const ConvexBody& a, const ConvexBody& b, std::uint64_t trials) {
  MonteCarloSettings settings = settings_for(a, b, trials);
  settings.domain = fitted_domain(a, b);
  return settings;
}

TEST(MonteCarloFitted, SameTallyWithItsSumsForAnyNumberOfThreadsAndInstructionSet) {
  const ConvexBody a = Box(1, 2, 0.01), b = Ellipsoid(1, 0.1, 2), c = Cylinder(0.5, 0.3);
  const ConvexBody* const pairs[][2] = {{&a, &b}, {&b, &c}, {&c, &a}};
  for (const auto& [first, second] : pairs) {
    for (const OrientationLaw& law : {OrientationLaw::isotropic(), OrientationLaw::cone(30), OrientationLaw::onsager(3),
                                      OrientationLaw::fixed(1, 2, 3, 4)}) {
      MonteCarloSettings settings = fitted_settings_for(*first, *second, 30011);
      settings.law = law;
      settings.instruction_set = InstructionSet::scalar;
      const RunRecord one = run_monte_carlo(*first, *second, settings);
      EXPECT_EQ(one.tally.n_trials, 30011u);
      EXPECT_GT(one.tally.n_hits, 1000u) << law.name();
      EXPECT_GT(one.tally.all.first.value(), one.tally.hits.first.value());
      for (const InstructionSet set : instruction_sets()) {
        settings.instruction_set = set;
        for (const int n : {1, 2, 3, 7}) {
          settings.n_threads = n;
          EXPECT_EQ(run_monte_carlo(*first, *second, settings).tally, one.tally)
              << name_of(set) << ", " << n << " threads, " << law.name();
        }
      }
    }
  }
}

TEST(MonteCarloFitted, SumsSharesOfUndecidedTrials) {
  const ConvexBody a = Box(1, 1, 0.1);
  MonteCarloSettings settings = fitted_settings_for(a, a, 5000);
  settings.quick_verdicts = false;
  settings.backend = scripted("unsure", [](const Transformd& pose) {
    if (pose.translation.x > 0.2) return Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
    return pose.translation.y > 0.0 ? Verdict::overlap(DecidedBy::peer) : Verdict::disjoint(DecidedBy::peer);
  });
  settings.instruction_set = InstructionSet::scalar;
  const RunRecord one = run_monte_carlo(a, a, settings);
  EXPECT_GT(one.tally.n_undecided, 500u);
  EXPECT_GT(one.tally.undecided.first.value(), 0.0);
  for (const InstructionSet set : instruction_sets()) {
    settings.instruction_set = set;
    const RunRecord record = run_monte_carlo(a, a, settings);
    EXPECT_EQ(record.tally, one.tally) << name_of(set);
    EXPECT_EQ(record.undecided.n_all, one.undecided.n_all);
    ASSERT_EQ(record.undecided.kept.size(), one.undecided.kept.size());
    for (std::size_t k = 0; k < one.undecided.kept.size(); ++k) {
      EXPECT_EQ(record.undecided.kept[k].index, one.undecided.kept[k].index);
    }
  }
}

TEST(MonteCarloFitted, TalliesAreTheTrialsOneByOne) {
  const ConvexBody a = Box(1, 1, 0.1), b = Sphere(0.3);
  const MonteCarloSettings settings = fitted_settings_for(a, b, 2000);
  Tally expected;
  const QuickVerdict quick(a, b, kDrawnRotationError);
  const std::unique_ptr<OverlapBackend> gjk = gjk_backend().make(a, b);
  const FittedDomain fitted(a, b);
  for (std::uint64_t k = 0; k < 2000; ++k) {
    const Transformd pose = trial_pose(a, b, settings, k);
    const QuickVerdict::Answer<double> answer = quick(pose);
    Verdict verdict =
        answer.disjoint ? Verdict::disjoint(DecidedBy::outer_bound) : Verdict::overlap(DecidedBy::inner_bound);
    if (!answer.disjoint && !answer.overlap) verdict = gjk->decide(pose);
    const Parallelepiped set = fitted.at(pose);
    expected.add(verdict, set.volume / settings.domain.volume);
    // Coordinates 0, 1, 2 of the point are the place within the set, as of any domain.
    MonteCarloSettings boxed = settings;
    boxed.domain = box_domain(a, b);
    const Vec3d in_box = trial_pose(a, b, boxed, k).translation - boxed.domain.middle;
    const auto u = [](double x, double half) { return 0.5 * (x / half + 1.0); };
    const Vec3d again = set.position(u(in_box.x, boxed.domain.half_extent.x), u(in_box.y, boxed.domain.half_extent.y),
                                     u(in_box.z, boxed.domain.half_extent.z));
    ASSERT_LE(norm(again - pose.translation), 1e-13);
  }
  EXPECT_EQ(run_monte_carlo(a, b, settings).tally, expected);
}

TEST(MonteCarloFitted, AlignedBoxesHitByConstructionAndOthersDoNot) {
  const ConvexBody box = Box(1, 2, 3), plate = Box(4, 4, 1e-6), ball = Sphere(1.0);
  const Domain domain = fitted_domain(box, box);
  EXPECT_TRUE(hits_by_construction(box, box, OrientationLaw::aligned(), domain));
  EXPECT_TRUE(hits_by_construction(box, plate, OrientationLaw::aligned(), fitted_domain(box, plate)));
  EXPECT_TRUE(hits_by_construction(box, box, OrientationLaw::fixed(1, 1, 1, 1), domain)) << "axis on axis";
  EXPECT_FALSE(hits_by_construction(box, box, OrientationLaw::fixed(1, 0.2, 0, 0), domain));
  EXPECT_FALSE(hits_by_construction(box, box, OrientationLaw::isotropic(), domain));
  EXPECT_FALSE(hits_by_construction(box, box, OrientationLaw::cone(0), domain));
  EXPECT_FALSE(hits_by_construction(box, box, OrientationLaw::onsager(1e9), domain));
  EXPECT_FALSE(hits_by_construction(box, box, OrientationLaw::aligned(), box_domain(box, box)));
  EXPECT_FALSE(hits_by_construction(box, ball, OrientationLaw::aligned(), fitted_domain(box, ball)));
  EXPECT_FALSE(hits_by_construction(ball, ball, OrientationLaw::aligned(), fitted_domain(ball, ball)));

  MonteCarloSettings settings = fitted_settings_for(box, box, 1);
  settings.law = OrientationLaw::aligned();
  settings.stop.trials.reset();
  settings.stop.relative_error = 1e-3;
  const RunRecord record = run_monte_carlo(box, box, settings);
  EXPECT_EQ(record.stopped_by, StopReason::relative_error);
  EXPECT_LE(record.tally.n_trials, 8192u) << "no miss is waited for";
  EXPECT_EQ(record.tally.n_hits, record.tally.n_trials);
  EXPECT_NEAR(fitted_estimate(record.tally, settings.domain.volume).excluded_volume, 48.0, 1e-9);
}

TEST(MonteCarlo, ComparisonsAddUpToADirectCount) {
  const ConvexBody a = Box(1, 1, 1);
  // One that knows no overlap far out, calls some misses hits, and is unsure now and then.
  const auto liar = [a](const Transformd& pose) {
    if (pose.translation.y > 0.9) return Verdict::undecided(DecidedBy::peer, UndecidedReason::iteration_cap);
    if (pose.translation.x > 1.0) return Verdict::disjoint(DecidedBy::peer);
    if (pose.translation.z > 1.0) return Verdict::overlap(DecidedBy::peer);
    return gjk_backend().make(a, a)->decide(pose);
  };
  for (const bool is_fitted : {false, true}) {
    MonteCarloSettings settings = is_fitted ? fitted_settings_for(a, a, 8000) : settings_for(a, a, 8000);
    settings.cross_check = {scripted("liar", liar), gjk_backend()};
    Comparison expected;
    const FittedDomain fitted(a, a);
    for (std::uint64_t k = 0; k < 8000; ++k) {
      const Transformd pose = trial_pose(a, a, settings, k);
      expected.add(gjk_backend().make(a, a)->decide(pose), liar(pose), is_fitted ? fitted.at(pose).volume / settings.domain.volume : 1.0);
    }
    EXPECT_GT(expected.n_only_run, 50u);
    EXPECT_GT(expected.n_only_other, 50u);
    EXPECT_GT(expected.n_undecided, 50u);
    for (const int n : {1, 2, 7}) {
      settings.n_threads = n;
      const RunRecord record = run_monte_carlo(a, a, settings);
      ASSERT_EQ(record.comparisons.size(), 2u);
      EXPECT_EQ(record.comparisons[0], expected) << n << " threads";
      EXPECT_EQ(record.comparisons[1].n_compared, 8000u);
      EXPECT_EQ(record.comparisons[1].n_only_run + record.comparisons[1].n_only_other, 0u) << "itself";
      EXPECT_EQ(record.disagreements.n_all, expected.n_only_run + expected.n_only_other);
    }
  }
}

}  // namespace
}  // namespace vex
