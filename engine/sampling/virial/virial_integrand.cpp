#include "engine/sampling/virial/virial_integrand.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/numeric/errors.h"
#include "engine/numeric/expect.h"
#include "engine/sampling/points/random_stream.h"

namespace vex {
namespace {

// a_from_b and b_from_c make a_from_c.
Transformd composed(const Transformd& a_from_b, const Transformd& b_from_c) {
  const auto row = [&](const Vec3d& r) { return r.x * b_from_c.row_x + r.y * b_from_c.row_y + r.z * b_from_c.row_z; };
  return {row(a_from_b.row_x), row(a_from_b.row_y), row(a_from_b.row_z), a_from_b(b_from_c.translation)};
}

// R_a^T R_b, without translation.
Transformd relative_rotation(const Transformd& a, const Transformd& b) {
  const auto row = [&](double x, double y, double z) { return x * b.row_x + y * b.row_y + z * b.row_z; };
  return {row(a.row_x.x, a.row_y.x, a.row_z.x),
          row(a.row_x.y, a.row_y.y, a.row_z.y),
          row(a.row_x.z, a.row_y.z, a.row_z.z),
          {}};
}

// All 52 bits that a coordinate has.
std::uint64_t whole_of(double coordinate) { return static_cast<std::uint64_t>(coordinate * 0x1p52); }

}  // namespace

// Bodies that hang together by neighbours' poses, and what is known of their other pairs.
struct VirialIntegrand::Cluster {
  std::array<Transformd, kMostClusterBodies> world_from_body;
  OverlapGraph graph{kMostClusterBodies};  // of a tree; pairs that are not asked yet are taken for overlaps
  std::array<BodyPair, kMostClusterBodies * kMostClusterBodies / 2> pairs;  // of a tree, that are no neighbours
  std::uint32_t answers = 0;                                                // of a chain
  bool is_tree = false, may_count = true;
};

void require_factorising_law(const OrientationLaw& law) {
  if (law.kind() == OrientationLaw::Kind::isotropic || law.kind() == OrientationLaw::Kind::aligned) return;
  throw UsageError("no virial coefficients for orientations " + law.name() +
                   ": a chain of bodies is no power of B2 then - use isotropic or aligned");
}

VirialIntegrand::VirialIntegrand(std::vector<ConvexBody> bodies, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, std::shared_ptr<VirialCounts> counts,
                                 InstructionSet set)
    : bodies_(std::move(bodies)),
      weights_(std::move(weights)),
      counts_(std::move(counts)),
      n_pairs_(weights_->pairs().size()),
      neighbours_(bodies_.front(), bodies_[bodies_.size() / 2], law, set),
      decider_(bodies_.front(), bodies_.back(), set),
      clusters_(kPoses),
      table_(kPoseColumns * PacketOverlap::kStride),
      rows_(kPoses),
      verdicts_(kPoses) {
  require_factorising_law(law);
  if (bodies_.size() > 1) {
    if (weights_->order() != 3) throw UsageError("a mixture's coefficients of this order are not built - give order 3");
    second_neighbours_ = std::make_unique<OverlappingPairs>(bodies_[1], bodies_[2], law, set);
  }
}

VirialIntegrand::VirialIntegrand(const ConvexBody& body, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, std::shared_ptr<VirialCounts> counts,
                                 InstructionSet set)
    : VirialIntegrand(std::vector<ConvexBody>{body}, law, std::move(weights), std::move(counts), set) {}

VirialIntegrand::VirialIntegrand(const std::array<ConvexBody, 3>& bodies, const OrientationLaw& law,
                                 std::shared_ptr<const ClusterWeights> weights, std::shared_ptr<VirialCounts> counts,
                                 InstructionSet set)
    : VirialIntegrand(std::vector<ConvexBody>(bodies.begin(), bodies.end()), law, std::move(weights), std::move(counts),
                      set) {}

VirialIntegrand::~VirialIntegrand() = default;

double VirialIntegrand::absolute_rounding() const {
  return weights_->largest_weight() * static_cast<double>(n_pairs_) * 0x1p-40;
}

double VirialIntegrand::cost() const {
  constexpr double kOfPose = 100.0, kOfPair = 40.0;
  return kOfPose * static_cast<double>(kPoses) + kOfPair * static_cast<double>(n_pairs_ * kClusters);
}

void VirialIntegrand::set_chain(Cluster& cluster, std::size_t first, std::size_t step) const {
  cluster.is_tree = false;
  cluster.may_count = true;
  cluster.answers = 0;
  std::size_t pose = first;
  for (std::size_t k = 1; k < static_cast<std::size_t>(weights_->order()); ++k) {
    const bool is_of_second = k == 2 && second_neighbours_ != nullptr;
    const Transformd& next = is_of_second ? second_poses_[pose] : poses_[pose];
    cluster.world_from_body[k] = k == 1 ? next : composed(cluster.world_from_body[k - 1], next);
    pose = (pose + step) % kPoses;
  }
}

// By Pruefer's code, n - 2 numbers of a body, which each tree has just one of (H. Pruefer, Arch. Math. Phys. 27, 742,
// 1918).
void VirialIntegrand::set_tree(Cluster& cluster, std::size_t first, std::size_t step,
                               std::span<const double> point) const {
  const int n = weights_->order();
  std::array<int, kMostClusterBodies> code{}, n_edges{}, leaf{}, parent{};
  for (int k = 0; k < n; ++k) n_edges[static_cast<std::size_t>(k)] = 1;
  for (int k = 0; k + 2 < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    code[at] = static_cast<int>(point[at] * n);
    ++n_edges[static_cast<std::size_t>(code[at])];
  }
  cluster.is_tree = true;
  cluster.may_count = true;
  cluster.graph = OverlapGraph(n);
  OverlapGraph tree(n);
  int n_done = 0;
  const auto cut = [&](int to) {
    int k = 0;
    while (n_edges[static_cast<std::size_t>(k)] != 1 || k == to) ++k;
    const auto at = static_cast<std::size_t>(n_done++);
    leaf[at] = k;
    parent[at] = to;
    --n_edges[static_cast<std::size_t>(k)];
    --n_edges[static_cast<std::size_t>(to)];
    tree.join(k, to);
  };
  for (int k = 0; k + 2 < n; ++k) cut(code[static_cast<std::size_t>(k)]);
  int last = n - 1;
  while (n_edges[static_cast<std::size_t>(last)] != 1) --last;
  cut(last);
  // Parents before their leaves.
  cluster.world_from_body[static_cast<std::size_t>(last)] = {};
  std::size_t pose = first;
  for (int k = n_done - 1; k >= 0; --k) {
    const auto at = static_cast<std::size_t>(k);
    cluster.world_from_body[static_cast<std::size_t>(leaf[at])] =
        composed(cluster.world_from_body[static_cast<std::size_t>(parent[at])], poses_[pose]);
    pose = (pose + step) % kPoses;
  }
  std::size_t n_pairs = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      cluster.graph.join(i, j);
      if (!tree.overlaps(i, j)) cluster.pairs[n_pairs++] = {i, j};
    }
  }
}

void VirialIntegrand::take(Cluster& cluster, std::size_t k, Outcome outcome) const {
  const bool overlaps = outcome == Outcome::overlap;
  if (!cluster.is_tree) {
    if (overlaps) cluster.answers |= 1u << k;
    cluster.may_count = weights_->may_count(static_cast<int>(k) + 1, cluster.answers);
  } else if (!overlaps) {
    const auto [i, j] = cluster.pairs[k];
    cluster.graph.part(i, j);
    // A body with one neighbour at most is told at once; the rest is looked at now and then, as it takes longer.
    const auto has_few = [&cluster](int body) { return std::popcount(cluster.graph.neighbours(body)) < 2; };
    constexpr std::size_t kBetween = 4;
    cluster.may_count = !has_few(i) && !has_few(j) && (k % kBetween != 0 || is_biconnected(cluster.graph));
  }
}

// Pair after pair, of all clusters that may count: what bounds do not tell is searched together.
void VirialIntegrand::ask(std::span<Cluster> clusters, Outcome undecided, PairQuestions& questions) {
  const Vec3d centre = bodies_.back().centre();
  for (std::size_t k = 0; k < n_pairs_; ++k) {
    std::size_t n_open = 0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      Cluster& cluster = clusters[c];
      if (!cluster.may_count) continue;
      const BodyPair pair = cluster.is_tree ? cluster.pairs[k] : weights_->pairs()[k];
      const Transformd& b = cluster.world_from_body[static_cast<std::size_t>(pair.j)];
      const bool is_in_world = !cluster.is_tree && pair.i == 0;
      const Transformd& a = cluster.world_from_body[static_cast<std::size_t>(pair.i)];
      const Vec3d centre_b = is_in_world ? b(centre) : a.direction_to_b(b(centre) - a.translation);
      Outcome outcome = decider_.by_bounds(centre_b);
      if (outcome == Outcome::undecided) {
        Transformd pose = b;
        if (!is_in_world) {
          pose = relative_rotation(a, b);
          pose.translation = a.direction_to_b(b.translation - a.translation);
        }
        outcome = decider_.by_bounds_turned(pose);
        if (outcome == Outcome::undecided) {
          set_pose(table_.data(), PacketOverlap::kStride, n_open, pose);
          rows_[n_open++] = c;
          continue;
        }
      }
      ++questions.n_by_bounds;
      take(cluster, k, outcome);
    }
    decider_.search({table_.data(), PacketOverlap::kStride, n_open}, std::span(verdicts_).first(n_open));
    questions.n_searched += n_open;
    for (std::size_t row = 0; row < n_open; ++row) {
      Outcome outcome = verdicts_[row].outcome;
      if (outcome == Outcome::undecided) {
        ++questions.n_undecided;
        outcome = undecided;
      }
      take(clusters[rows_[row]], k, outcome);
    }
  }
}

double VirialIntegrand::weight(const Cluster& cluster) const {
  if (!cluster.may_count) return 0.0;
  return cluster.is_tree ? weights_->weight(cluster.graph) : weights_->weight_of_chain(cluster.answers);
}

double VirialIntegrand::bunch(std::uint64_t seed, std::uint64_t first, Outcome undecided, std::uint64_t& n_undecided) {
  PairQuestions of_neighbours, of_pairs;
  neighbours_.draw(seed, first, undecided, poses_, of_neighbours);
  // Another stream for the second pair of a mixture: the seeds of all points are even.
  if (second_neighbours_ != nullptr) second_neighbours_->draw(seed + 1, first, undecided, second_poses_, of_neighbours);
  const auto n_rounds_of_trees = static_cast<std::size_t>(weights_->share_of_trees() * kRounds);
  double sum = 0.0;
  for (std::size_t round = 0; round < kRounds; ++round) {
    const bool are_trees = round < n_rounds_of_trees;
    for (std::size_t c = 0; c < kPoses; ++c) {
      if (are_trees) {
        std::array<double, kMostClusterBodies> point;
        const auto n_numbers = static_cast<std::size_t>(weights_->order() - 2);
        draw_unit_cube(seed + 1, Stream::virial_trees, first + round * kPoses + c, std::span(point).first(n_numbers));
        set_tree(clusters_[c], c, round + 1, point);
      } else {
        set_chain(clusters_[c], c, round + 1);
      }
    }
    ask(clusters_, undecided, of_pairs);
    for (const Cluster& cluster : clusters_) sum += weight(cluster);
  }
  n_undecided = of_neighbours.n_undecided + of_pairs.n_undecided;
  constexpr std::memory_order kRelaxed = std::memory_order_relaxed;
  counts_->n_pairs.fetch_add(n_pairs_ * kClusters, kRelaxed);
  counts_->n_by_bounds.fetch_add(of_pairs.n_by_bounds, kRelaxed);
  counts_->n_searched.fetch_add(of_pairs.n_searched, kRelaxed);
  counts_->n_undecided.fetch_add(n_undecided, kRelaxed);
  counts_->n_candidates.fetch_add(of_neighbours.n_by_bounds + of_neighbours.n_searched, kRelaxed);
  return sum / static_cast<double>(kClusters);
}

Doubts VirialIntegrand::evaluate(std::span<const double> points, std::span<double> values) {
  VEX_EXPECT(points.size() == 2 * values.size());
  constexpr int kRoomForCandidates = 12;
  Doubts doubts;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::uint64_t seed = whole_of(points[k]) << 1, first = whole_of(points[values.size() + k])
                                                                 << kRoomForCandidates;
    std::uint64_t n_undecided = 0, n_undecided_then = 0;
    values[k] = bunch(seed, first, Outcome::disjoint, n_undecided);
    if (n_undecided == 0) continue;
    // Of one undecided pair the two values are what is possible; of more, nothing is known but the largest weight.
    const double other = bunch(seed, first, Outcome::overlap, n_undecided_then);
    if (n_undecided == 1 && n_undecided_then <= 1) {
      doubts.push_back({k, 0.5 * std::fabs(other - values[k])});
      values[k] = 0.5 * (values[k] + other);
    } else {
      values[k] = 0.0;
      doubts.push_back({k, weights_->largest_weight()});
    }
  }
  return doubts;
}

}  // namespace vex
