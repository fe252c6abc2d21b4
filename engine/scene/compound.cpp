#include "engine/scene/compound.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/numeric/errors.h"
#include "engine/numeric/interruption.h"
#include "engine/query/world_queries.h"
#include "engine/scene/compound_boxes.h"
#include "engine/scene/threads.h"
#include "engine/support/triangle_body.h"

namespace vex {
namespace {

constexpr double kFarthestCorner = 1e100;
constexpr std::size_t kPosesAShare = 16;

bool is_identity(const Transformd& pose) {
  const auto is = [](const Vec3d& v, double x, double y, double z) { return v.x == x && v.y == y && v.z == z; };
  return is(pose.row_x, 1.0, 0.0, 0.0) && is(pose.row_y, 0.0, 1.0, 0.0) && is(pose.row_z, 0.0, 0.0, 1.0) &&
         is(pose.translation, 0.0, 0.0, 0.0);
}

// Which stage spoke last of all that were needed.
DecidedBy later(DecidedBy a, DecidedBy b) { return std::max(a, b); }

// B, or one of its parts, in A's frame.
struct PartOfB {
  const ConvexBody& body;
  Pose a_from_part;
  std::uint32_t number;
};

// visit(part of B, bound) -> bound, for those parts of which something may be within `bound` of A, in the order of
// their boxes' distance; a negative bound ends it.
template <class Visit>
void each_part_near(const Compound& a, const Compound& b, const Pose& a_from_b, double bound, const Visit& visit) {
  b.tree().by_distance(box_seen(a.bounds(), inverse(a_from_b)), bound, [&](std::uint32_t part, double now) {
    return visit(PartOfB{b.body(part), b.frame_from_part(part, a_from_b), part}, now);
  });
}
template <class Visit>
void each_part_near(const Compound& /*a*/, const ConvexBody& b, const Pose& a_from_b, double bound,
                    const Visit& visit) {
  visit(PartOfB{b, a_from_b, 0}, bound);
}

template <class B>
CompoundVerdict overlap_of(const Compound& a, const B& b, const Pose& a_from_b) {
  CompoundVerdict answer;
  answer.verdict = Verdict::disjoint(DecidedBy::outer_bound);
  each_part_near(a, b, a_from_b, 0.0, [&](const PartOfB& of_b, double bound) {
    a.tree().by_distance(box_seen(of_b.body, of_b.a_from_part), 0.0, [&](std::uint32_t part, double within) {
      ++answer.n_pairs;
      const Verdict verdict = overlap(a.body(part), of_b.body, a.part_from_b(part, of_b.a_from_part));
      if (verdict.outcome == Outcome::overlap ||
          (verdict.outcome == Outcome::undecided && answer.verdict.outcome == Outcome::disjoint)) {
        answer.verdict = verdict;
        answer.part_a = part;
        answer.part_b = of_b.number;
      } else if (answer.verdict.outcome == Outcome::disjoint) {
        answer.verdict.by = later(answer.verdict.by, verdict.by);
      }
      return verdict.outcome == Outcome::overlap ? -1.0 : within;
    });
    return answer.verdict.outcome == Outcome::overlap ? -1.0 : bound;
  });
  return answer;
}

template <class B>
void overlapping_parts_of(const Compound& a, const B& b, const Pose& a_from_b, PartPairs& out) {
  out.pairs.clear();
  out.undecided.clear();
  each_part_near(a, b, a_from_b, 0.0, [&](const PartOfB& of_b, double bound) {
    a.tree().meeting(box_seen(of_b.body, of_b.a_from_part), [&](std::uint32_t part) {
      const Outcome outcome = overlap(a.body(part), of_b.body, a.part_from_b(part, of_b.a_from_part)).outcome;
      if (outcome == Outcome::disjoint) return;
      (outcome == Outcome::overlap ? out.pairs : out.undecided).push_back({part, of_b.number});
    });
    return bound;
  });
  std::sort(out.pairs.begin(), out.pairs.end());
  std::sort(out.undecided.begin(), out.undecided.end());
}

// What the pairs seen so far say of the union.
class LeastDistance {
 public:
  explicit LeastDistance(const SeparationSettings& settings) : settings_(settings) {}

  // How far a box may be away and matter.
  double bound() const { return is_over() ? -1.0 : distance_seen(std::fmin(least_upper(), settings_.max_distance)); }
  bool is_over() const { return is_any() && best_.separation.verdict.outcome == Outcome::overlap; }

  void ask(const Compound& a, std::uint32_t part, const PartOfB& of_b) {
    SeparationSettings settings = settings_;
    settings.max_distance = std::fmin(settings.max_distance, least_upper());
    const Separation found = vex::distance(a.body(part), of_b.body, a.part_from_b(part, of_b.a_from_part), settings);
    ++best_.n_pairs;
    least_lower_ = std::fmin(least_lower_, found.lower);
    by_ = later(by_, found.verdict.by);
    if (found.verdict.outcome == Outcome::undecided && !undecided_) undecided_ = found.verdict;
    const bool meets = found.verdict.outcome == Outcome::overlap;
    if (!meets && is_any() && !(found.upper < best_.separation.upper)) return;
    const std::uint32_t n_pairs = best_.n_pairs;
    best_ = {a.is_in_place(part) ? found : in_world(found, a.compound_from_part(part)), part, of_b.number, n_pairs};
    const bool are_polytopes = a.body(part).is_rounded_polytope() && of_b.body.is_rounded_polytope();
    promised_ = std::fmax(settings_.relative_gap, are_polytopes ? 1e-12 : 1e-9) *
                (std::fabs(found.signed_distance) + a.body(part).circumradius() + of_b.body.circumradius());
  }

  CompoundSeparation answer() const {
    CompoundSeparation answer = best_;
    Separation& found = answer.separation;
    if (is_over()) return answer;
    if (!undecided_ && least_lower_ >= settings_.max_distance) {  // boxes beyond it were not opened
      answer = {};
      answer.n_pairs = best_.n_pairs;
      found.verdict = Verdict::disjoint(by_);
      found.signed_distance = found.lower = settings_.max_distance;
      return answer;
    }
    found.verdict = undecided_ ? *undecided_ : Verdict::disjoint(by_);
    found.lower = std::fmin(least_lower_, found.upper);
    if (found.upper > settings_.max_distance) found.lower = std::fmin(found.lower, settings_.max_distance);
    found.is_rough = found.is_rough || !(found.upper - found.lower <= promised_);
    return answer;
  }

 private:
  bool is_any() const { return best_.n_pairs > 0; }
  double least_upper() const { return is_any() ? std::fmax(best_.separation.upper, 0.0) : HUGE_VAL; }

  SeparationSettings settings_;
  CompoundSeparation best_;
  double least_lower_ = HUGE_VAL, promised_ = 0.0;
  DecidedBy by_ = DecidedBy::outer_bound;
  std::optional<Verdict> undecided_;
};

template <class B>
CompoundSeparation distance_of(const Compound& a, const B& b, const Pose& a_from_b,
                               const SeparationSettings& settings) {
  if (!(settings.max_distance >= 0.0)) {
    throw UsageError("the largest distance of interest is negative or no number - give one from 0 up");
  }
  LeastDistance least(settings);
  each_part_near(a, b, a_from_b, least.bound(), [&](const PartOfB& of_b, double) {
    a.tree().by_distance(box_seen(of_b.body, of_b.a_from_part), least.bound(), [&](std::uint32_t part, double) {
      least.ask(a, part, of_b);
      return least.bound();
    });
    return least.bound();
  });
  return least.answer();
}

template <class Answer, class Ask>
void answer_each(std::span<const Pose> poses, std::span<Answer> out, int n_threads, const Ask& ask) {
  if (poses.size() != out.size()) {
    throw UsageError("a compound is asked of " + std::to_string(poses.size()) + " poses, and there is room for " +
                     std::to_string(out.size()) + " answers - give spans of one length");
  }
  if (n_threads < 1) throw UsageError("a query has no threads (" + std::to_string(n_threads) + ") - give one at least");
  share_range(n_threads, poses.size(), kPosesAShare, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) out[k] = ask(poses[k]);
  });
}

}  // namespace

Compound::Compound(std::vector<CompoundPart> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) throw InputError("a compound has no part - give at least one convex body");
  if (parts_.size() >= kNoPart) {
    throw InputError("a compound has " + std::to_string(parts_.size()) + " parts - give fewer than 2^32 - 1");
  }
  std::vector<Aabb> boxes;
  boxes.reserve(parts_.size());
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    if (k % 256 == 0) end_if_interrupted();
    boxes.push_back(box_seen(parts_[k].body, parts_[k].compound_from_part));
    const auto is_near = [](double x) { return std::fabs(x) <= kFarthestCorner; };
    const auto& [lower, upper] = boxes.back();
    if (!(is_near(lower.x) && is_near(lower.y) && is_near(lower.z) && is_near(upper.x) && is_near(upper.y) &&
          is_near(upper.z))) {
      throw InputError("part " + std::to_string(k) +
                       " of a compound reaches farther than 1e100 from the origin - move it nearer");
    }
    bounds_ = k == 0 ? boxes.back() : hull_of(bounds_, boxes.back());
    is_in_place_.push_back(is_identity(parts_[k].compound_from_part.a_from_b()));
  }
  tree_.build(boxes);
}

Pose Compound::part_from_b(std::size_t part, const Pose& compound_from_b) const {
  return is_in_place_[part] ? compound_from_b : relative_pose(parts_[part].compound_from_part, compound_from_b);
}

Pose Compound::frame_from_part(std::size_t part, const Pose& frame_from_compound) const {
  return is_in_place_[part] ? frame_from_compound : frame_from_compound * parts_[part].compound_from_part;
}

Compound compound_of_triangles(std::span<const std::array<Vec3d, 3>> triangles) {
  std::vector<CompoundPart> parts;
  parts.reserve(triangles.size());
  for (const std::array<Vec3d, 3>& triangle : triangles) {
    if (parts.size() % 256 == 0) end_if_interrupted();
    parts.push_back({TriangleBody(triangle), Pose()});
  }
  return Compound(std::move(parts));
}

CompoundVerdict overlap(const Compound& a, const ConvexBody& b, const Pose& a_from_b) {
  return overlap_of(a, b, a_from_b);
}
CompoundVerdict overlap(const Compound& a, const Compound& b, const Pose& a_from_b) {
  return overlap_of(a, b, a_from_b);
}

void overlapping_parts(const Compound& a, const ConvexBody& b, const Pose& a_from_b, PartPairs& out) {
  overlapping_parts_of(a, b, a_from_b, out);
}
void overlapping_parts(const Compound& a, const Compound& b, const Pose& a_from_b, PartPairs& out) {
  overlapping_parts_of(a, b, a_from_b, out);
}

CompoundSeparation distance(const Compound& a, const ConvexBody& b, const Pose& a_from_b,
                            const SeparationSettings& settings) {
  return distance_of(a, b, a_from_b, settings);
}
CompoundSeparation distance(const Compound& a, const Compound& b, const Pose& a_from_b,
                            const SeparationSettings& settings) {
  return distance_of(a, b, a_from_b, settings);
}

CompoundSeparation signed_distance(const HalfSpace& a, const Compound& b, const Pose& a_from_b) {
  CompoundSeparation least;
  double least_lower = HUGE_VAL;
  Verdict verdict = Verdict::disjoint(DecidedBy::gjk);
  for (std::size_t part = 0; part < b.size(); ++part) {
    const Separation found = signed_distance(a, b.body(part), b.frame_from_part(part, a_from_b));
    least_lower = std::fmin(least_lower, found.lower);
    const auto rank = [](Outcome outcome) {
      return outcome == Outcome::overlap ? 2 : outcome == Outcome::undecided ? 1 : 0;
    };
    if (rank(found.verdict.outcome) > rank(verdict.outcome)) {
      verdict = found.verdict;
    } else if (found.verdict.outcome == verdict.outcome) {
      verdict.by = later(verdict.by, found.verdict.by);
    }
    if (part == 0 || found.upper < least.separation.upper) {
      least.separation = found;
      least.part_b = static_cast<std::uint32_t>(part);
    }
  }
  least.part_a = 0;
  least.n_pairs = static_cast<std::uint32_t>(b.size());
  least.separation.verdict = verdict;
  least.separation.lower = std::fmin(least_lower, least.separation.upper);
  if (verdict.outcome == Outcome::disjoint) least.separation.lower = std::fmax(least.separation.lower, 0.0);
  least.separation.is_rough =
      least.separation.is_rough || detail::are_wide_beside(b.body(least.part_b), least.separation);
  return least;
}

void overlap(const Compound& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<CompoundVerdict> out,
             int n_threads) {
  answer_each(a_from_b, out, n_threads, [&](const Pose& pose) { return overlap(a, b, pose); });
}

void distance(const Compound& a, const ConvexBody& b, std::span<const Pose> a_from_b, std::span<CompoundSeparation> out,
              const SeparationSettings& settings, int n_threads) {
  answer_each(a_from_b, out, n_threads, [&](const Pose& pose) { return distance(a, b, pose, settings); });
}

}  // namespace vex
