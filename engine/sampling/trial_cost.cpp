#include "engine/sampling/trial_cost.h"

#include <memory>
#include <optional>
#include <vector>

#include "engine/query/overlap.h"
#include "engine/query/packets/core_form.h"
#include "engine/query/packets/packet_pair.h"
#include "engine/query/packets/quick_verdict.h"
#include "engine/query/search/overlap_filter.h"
#include "engine/sampling/points/random_stream.h"
#include "engine/sampling/poses/pose_map.h"
#include "engine/sampling/radial/radial_function.h"
#include "engine/sampling/radial/radial_packets.h"
#include "engine/sampling/trial_runner.h"

namespace vex {
namespace {

// All prices in nanoseconds.
constexpr double kOfOneByOne = 40.0;     // a support call outside of packets, besides its body's price
constexpr double kOfLongFacets = 0.4;    // and of each vertex of a body with facets too long for a table
constexpr double kOfEscalation = 2e4;    // a trial that double precision leaves open
constexpr double kOfPeersTrial = 400.0;  // of a peer's search
constexpr std::uint64_t kTrials = 256;   // poses that are searched
constexpr std::uint64_t kRays = 64;

double price_of(const CoreForm& core) {
  switch (core.kind) {
    case CoreForm::Kind::box: return 0.7;
    case CoreForm::Kind::ellipsoid: return 2.5;
    case CoreForm::Kind::vertices: return 1.0 + 0.55 * static_cast<double>(core.x.size());
    case CoreForm::Kind::table: return 11.0;
    case CoreForm::Kind::powers: return 25.0;
    case CoreForm::Kind::profile: return 8.0;
    case CoreForm::Kind::pieces: break;
  }
  double price = 2.0;
  for (const CoreForm::Piece& piece : core.pieces) price += piece.is_like_last ? 0.8 : 4.0;
  return price;
}

double price_of(const ConvexBody& body, const CoreForm* core) {
  const double of_ball = body.ball_radius() > 0.0 ? 1.0 : 0.0;
  if (core != nullptr && core->kind == CoreForm::Kind::table && core->table.cells == nullptr) {
    // Searches end at facets, so that a good part of their calls scan one.
    return of_ball + kOfOneByOne + kOfLongFacets * static_cast<double>(body.exact_form()->points.size());
  }
  return of_ball + (core != nullptr ? price_of(*core) : kOfOneByOne);
}

struct PairPrice {
  double of_call;  // of the difference's support mapping
  bool has_kernels;
};

/// Finds the cores once: of a large hull that is a copy of all vertices.
PairPrice price_of_pair(const ConvexBody& a, const ConvexBody& b) {
  if (const std::unique_ptr<PacketPair> pair = PacketPair::make(a, b)) {
    const PacketPairForms forms = pair->forms();
    return {price_of(a, forms.a) + price_of(b, forms.b), true};
  }
  return {support_price(a) + support_price(b), false};
}

}  // namespace

double support_price(const ConvexBody& body) {
  const std::optional<CoreForm> core = core_form(body);
  return price_of(body, core ? &*core : nullptr);
}

double pose_cost(const ConvexBody& a, const ConvexBody& b, const MonteCarloSettings& settings) {
  constexpr double kOfPose = 18.0, kOfFittedPose = 50.0, kHeightsOfFitted = 8.0, kOfNetsCoordinate = 3.0;
  constexpr double kOfSupportCall = 2.0;  // the rest of a search, spread over its calls
  constexpr int kMostSupportCalls = 256;
  const bool is_fitted = settings.domain.kind == Domain::Kind::fitted;
  const auto [price, has_kernels] = price_of_pair(a, b);
  double cost = is_fitted ? kOfFittedPose + kHeightsOfFitted * price : kOfPose;
  if (settings.sequence == Sequence::sobol) cost += kOfNetsCoordinate * (3.0 + settings.law.dimension());
  if (settings.backend.is_peer) return cost + kOfPeersTrial;

  const QuickVerdict quick = settings.quick_verdicts ? QuickVerdict(a, b, kDrawnRotationError) : QuickVerdict();
  const PoseSampler sampler(a, b, points_of_poses(a, b, settings), settings.law, settings.domain);
  double searches = 0.0;
  for (std::uint64_t k = 0; k < kTrials; ++k) {
    const PosedTrial trial = sampler(k);
    const QuickVerdict::Answer<double> answer = quick(trial.a_from_b, trial.position);
    if (answer.disjoint || answer.overlap) continue;
    const FilterResult found = filter_overlap(a, b, trial.a_from_b, kMostSupportCalls);
    searches += found.n_support_calls * (kOfSupportCall + price + (has_kernels ? 0.0 : kOfOneByOne));
    if (found.verdict.outcome == Outcome::undecided) searches += kOfEscalation;
  }
  return cost + searches / static_cast<double>(kTrials);
}

double ray_cost(const ConvexBody& a, const ConvexBody& b, const RadialMap& map) {
  constexpr double kOfRay = 50.0, kOfSupportCall = 6.5, kOfBisection = 4e4;
  const auto [of_call, has_kernels] = price_of_pair(a, b);
  const double price = kOfSupportCall + of_call;
  std::vector<double> point(static_cast<std::size_t>(map.dimension()));
  double rays = 0.0;
  for (std::uint64_t k = 0; k < kRays; ++k) {
    draw_unit_cube(0, Stream::pilot, k + 1, point);
    const RadialRay<double> ray = map(std::span<const double>(point));
    const RadialBounds found = radial_function(a, b, map.points(), Pose::unchecked(ray.rotation), ray.dir, kRadialGap);
    // What stalls, packets leave open, and it is bisected by verdicts.
    rays += found.n_support_calls * (price + (has_kernels && !found.is_bisected ? 0.0 : kOfOneByOne));
    if (found.is_bisected) rays += kOfBisection;
  }
  return kOfRay + rays / static_cast<double>(kRays);
}

}  // namespace vex
