// What a whole trial cannot do without, by itself: random numbers, poses, support points. docs/performance.md.
#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/peers/peers.h"
#include "engine/query/packets/packet_pair.h"
#include "engine/sampling/poses/pose_columns.h"
#include "tests/bench/pair_result.h"
#include "tests/bench/search_parts.h"
#include "tests/bench/trial_rows.h"

namespace vex {
namespace {

constexpr const char *kNumbers = "four numbers", *kPosition = "position", *kPose = "pose",
                     *kPoseAndBounds = "pose and bounds", *kSupport = "support";

// Poses as a run draws them: all there is of them, or a part.
class Poses {
 public:
  Poses(const ConvexBody& body, const BenchSettings& settings, OrientationLaw law, Domain domain, bool has_bounds)
      : law_(std::move(law)),
        domain_(std::move(domain)),
        bounds_(body, body, kDrawnRotationError),
        recipe_{settings.seed, &law_, &domain_, body.centre(), has_bounds ? &bounds_ : nullptr, nullptr, nullptr} {}
  Poses(const Poses&) = delete;
  Poses& operator=(const Poses&) = delete;

  /// Those left open, by `visit(columns)`.
  template <class Visit>
  void draw(std::size_t n, const Visit& visit) {
    const DrawPoses draw_poses = pose_kernel(best_instruction_set());
    for (std::size_t first = 0; first < n; first += PoseColumns::kMostTrials) {
      draw_poses(recipe_, first, std::min(PoseColumns::kMostTrials, n - first), *columns_);
      visit(*columns_);
    }
  }

 private:
  OrientationLaw law_;
  Domain domain_;
  QuickVerdict bounds_;
  PoseRecipe recipe_;
  std::unique_ptr<PoseColumns> columns_ = std::make_unique<PoseColumns>();
};

Contender poses_contender(const char* name, const std::shared_ptr<Poses>& poses, std::size_t n) {
  return {name, n, [poses, n] { poses->draw(n, [](const PoseColumns&) {}); }};
}

// Of the poses that the bounds leave open.
struct Search {
  std::size_t n_left = 0, n_supports = 0;
  std::vector<double> columns, directions;  // of the first batch
  std::size_t n_stored = 0;
};

Search search_of(const ConvexBody& body, const PacketPair* pair, Poses& poses, std::size_t n) {
  const SearchParts& parts = search_parts(best_instruction_set());
  Search search;
  poses.draw(n, [&](const PoseColumns& drawn) {
    search.n_left += drawn.n_open;
    if (pair == nullptr) return;
    for (std::size_t first = 0; first < drawn.n_open; first += PacketOverlap::kMostTrials) {
      const std::size_t n_batch = std::min(PacketOverlap::kMostTrials, drawn.n_open - first);
      search.n_supports += parts.n_supports(pair->forms(), {drawn.poses[0] + first, PoseColumns::kStride, n_batch});
    }
    if (!search.columns.empty()) return;
    search.columns.assign(drawn.poses[0], drawn.poses[0] + kPoseColumns * PoseColumns::kStride);
    search.n_stored = drawn.n_open;
    // From centre to centre: as good as any, and unlike from pose to pose.
    search.directions.resize(3 * PoseColumns::kStride, 1.0);
    for (std::size_t k = 0; k < drawn.n_open; ++k) {
      const Vec3d dir =
          PoseTable{drawn.poses[0], PoseColumns::kStride, drawn.n_open}.pose(k)(body.centre()) - body.centre();
      search.directions[k] = dir.x;
      search.directions[PoseColumns::kStride + k] = dir.y;
      search.directions[2 * PoseColumns::kStride + k] = dir.z;
    }
  });
  return search;
}

}  // namespace

BenchReport trial_parts(const BenchSettings& settings) {
  const SearchParts& parts = search_parts(best_instruction_set());
  const std::vector<std::string> ccd = {"ccd-gjk", "ccd-mpr"};
  MarkdownTable drawn({"pair", "four random numbers", "position in a ball", "pose", "pose and bounds", "left by these",
                       "whole trial", "a tenth of libccd's faster", "libccd / pose and bounds"});
  MarkdownTable searched({"pair", "support points of a trial that is left", "ns each",
                          "pose, bounds and support points", "whole trial",
                          "libccd / pose, bounds and support points"});
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const BenchPair& pair : bench_pairs()) {
    const std::size_t n = n_poses_of(pair, settings);
    const ConvexBody& body = pair.body;
    const Domain ball = ball_domain(body, body);
    const auto left = std::make_shared<Poses>(body, settings, OrientationLaw::isotropic(), ball, true);
    const auto part = [&](const OrientationLaw& law, const Domain& domain) {
      return std::make_shared<Poses>(body, settings, law, domain, false);
    };
    std::vector<Contender> contenders = {
        trial_contender(kTrial, body, trial_settings(body, settings.seed, n)),
        poses_contender(kNumbers, part(OrientationLaw::aligned(), box_domain(body, body)), n),
        poses_contender(kPosition, part(OrientationLaw::aligned(), ball), n),
        poses_contender(kPose, part(OrientationLaw::isotropic(), ball), n), poses_contender(kPoseAndBounds, left, n)};
    const std::unique_ptr<PacketPair> packets = PacketPair::make(body, body);
    const bool has_table = packets != nullptr && packets->forms().a->kind == CoreForm::Kind::table;
    const Search search = search_of(body, has_table ? packets.get() : nullptr, *left, n);
    if (has_table) {
      contenders.push_back({kSupport, search.n_stored, [&] {
                              parts.ask(packets->forms(),
                                        {search.columns.data(), PoseColumns::kStride, search.n_stored},
                                        search.directions.data());
                            }});
    }
    std::vector<PeerEntry> peers;
    for (BackendKind& kind : peer_backends()) {
      if (std::ranges::find(ccd, kind.name) != ccd.end()) peers.push_back({std::move(kind)});
    }
    const PairResult result = run_pair(pair, settings, contenders, {renamed(gjk_backend(), kQuery)}, peers);
    const std::string* const peer = result.fastest(ccd);
    const auto ns = [&](const char* name) { return result.of(name).median(); };
    const double of_all = static_cast<double>(n), n_left = static_cast<double>(search.n_left);
    drawn.add({pair.name, result.timing_cell(kNumbers), result.timing_cell(kPosition), result.timing_cell(kPose),
               result.timing_cell(kPoseAndBounds), percent(n_left / of_all), result.timing_cell(kTrial),
               peer == nullptr ? "-" : three_digits(0.1 * result.of(*peer).median()),
               peer == nullptr ? "-" : three_digits(result.ratio_of(*peer, kPoseAndBounds))});
    nlohmann::ordered_json row = result.json();
    row["left"] = search.n_left;
    if (has_table) {
      const double n_supports = static_cast<double>(search.n_supports);
      const double least = ns(kPoseAndBounds) + n_supports / of_all * ns(kSupport);
      row["supports_of_one_left"] = n_supports / n_left;
      row["pose_bounds_and_supports_ns"] = least;
      searched.add({pair.name, three_digits(n_supports / n_left), result.timing_cell(kSupport), three_digits(least),
                    result.timing_cell(kTrial),
                    peer == nullptr ? "-" : three_digits(result.of(*peer).median() / least)});
    }
    rows.push_back(row);
  }
  return {"### What a trial cannot do without\n\n" + std::string(kHowTimed) +
              "The engine's own kernels: four random numbers (a position in a box), a position in the ball (sine, "
              "cosine and cube root besides), a whole pose (two more numbers, sines and cosines, a rotation), and a "
              "pose with the bounds by balls, boxes and ellipsoids, after which only what these leave is turned.\n\n" +
              drawn.text() +
              "\nOf hulls, the support points of both bodies that the search asks for, whole packets counted, and what "
              "one takes alone: a row of the table of directions for each vertex that is looked at, and both "
              "rotations.\n\n" +
              searched.text(),
          rows};
}

}  // namespace vex
