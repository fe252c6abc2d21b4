// The peer libraries of this build beside the engine on the same random poses.
#include "apps/peers/peers.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/sampling/monte_carlo.h"
#include "shapes/any_shape.h"
#include "tests/referees/bodies.h"

namespace vex {
namespace {

class PeersOnPairs : public testing::TestWithParam<NamedPair> {};

TEST_P(PeersOnPairs, AgreeOnNearlyEveryRandomPose) {
  const ConvexBody a = parse_shape(GetParam().a).body, b = parse_shape(GetParam().b).body;
  MonteCarloSettings settings;
  settings.domain = ball_domain(a, b);
  settings.stop.trials = 20000;
  for (BackendKind& kind : peer_backends()) {
    if (kind.takes(a, b)) settings.cross_check.push_back(std::move(kind));
  }
  const RunRecord record = run_monte_carlo(a, b, settings);
  EXPECT_EQ(record.tally.n_undecided, 0u);
  EXPECT_GT(record.tally.n_hits, 100u);
  // Their known error rates are below 2.5e-5 (curved bodies); a fault of ours or in the adapter would show on far more
  // poses.
  EXPECT_LE(record.disagreements.n_all, 4u);
}

INSTANTIATE_TEST_SUITE_P(FormlessPairs, PeersOnPairs, testing::ValuesIn(formless_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });
INSTANTIATE_TEST_SUITE_P(Pairs, PeersOnPairs, testing::ValuesIn(unordered_pairs()),
                         [](const auto& pair) { return test_name(pair.param); });

TEST(PeerBackends, AreThoseThatTheBuildHas) {
  std::size_t n_expected = 0;
#ifdef VEX_WITH_CCD
  n_expected += 2;
#endif
#ifdef VEX_WITH_FCL
  n_expected += 1;
#endif
  const std::vector<BackendKind> kinds = peer_backends();
  EXPECT_EQ(kinds.size(), n_expected);
  for (const BackendKind& kind : kinds) {
    EXPECT_TRUE(kind.is_peer);
    EXPECT_TRUE(std::ranges::any_of(kPeerNames, [&](const PeerName& peer) { return peer.name == kind.name; }));
  }
}

}  // namespace
}  // namespace vex
