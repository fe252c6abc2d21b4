// What is known of remembered pairs: looks at it, and what answers leave.
#include <algorithm>
#include <cmath>

#include "engine/numeric/interval.h"
#include "engine/numeric/lane.h"
#include "engine/scene/pair_memory.h"

namespace vex {
namespace {

// A pair whose inscribed balls are at least this share of the circumscribed ones is known by them, too; a point of its
// difference is then taken for one that is nearer to the centres by so much (E26).
constexpr double kLeastCore = 0x1p-4, kLessOfTip = 1.0 - 0x1p-14;

}  // namespace

inline double PairMemory::left(const Known& known, const Listed& pair, const Vec3d& way) const {
  if (known.kind == Known::Kind::nothing || known.kind == Known::Kind::at_rest) return 0.0;
  const double most = known.kind == Known::Kind::ball ? norm(way - KnownHull::vector(known.hull.axis))
                                                      : known.hull.most_of(way, known.kind == Known::Kind::half_space);
  return blend(known.kind == Known::Kind::balls_apart, most - known.limit, (known.limit - turned(pair)) - most);
}

// What the clock may grow to, at least, while what is above 0 now shrinks by no more than it grows: below it by no less
// than its rounding, so that the sum's is covered.
inline double PairMemory::clock_when(double left) const { return (clock_ + left) * (1.0 - 0x1p-52); }

// By the circumscribed balls, where they are apart. Of no hull the most is the length of the way.
PairMemory::Known PairMemory::known_by_balls(const Listed& pair) const {
  const double radii = bodies_->bounds_of(pair.a).radius + bodies_->bounds_of(pair.b).radius;
  return {Known::Kind::balls_apart, {}, (radii + 2.0 * rounding_) / kLess};
}

bool PairMemory::keep_what_balls_tell(std::uint64_t tag, const Vec3d& way) {
  const Listed& pair = list_.pairs[tag];
  const double distance = norm(way);
  const Known apart = known_by_balls(pair);
  const double inside = core_of(pair) - distance / kLess - rounding_;
  if (distance > apart.limit) {
    list_.known[tag] = apart;
    keep(tag, false, distance - apart.limit);
  } else if (inside > 0.0) {
    if (!keep_around_core(tag, way, Vec3d{}, 0.0)) keep_ball(tag, way, inside * kLess - rounding_);
  } else {
    return false;
  }
  return true;
}

void PairMemory::look(std::size_t block, PairSearch& search) {
  const std::size_t first = block * kBlock, end = std::min(first + kBlock, list_.pairs.size());
  std::uint32_t due[kBlock];
  const std::size_t n_due = numbers_of(first, end, due, [&](std::size_t k) { return !(list_.until[k] > clock_); });
  SceneCounts::Stage &unmoved = search.counts[SceneStage::unmoved], &balls = search.counts[SceneStage::balls];
  unmoved.seen += end - first;
  unmoved.settled += (end - first) - n_due;
  // Of which pairs something is left is as good as random: no jump hangs on it.
  std::uint32_t used_up[kBlock];
  std::size_t n_used_up = 0, n_new_by_balls = 0;
  for (std::size_t j = 0; j < n_due; ++j) {
    if (j + 2 * kAhead < n_due) __builtin_prefetch(&list_.pairs[first + due[j + 2 * kAhead]]);
    if (j + kAhead < n_due) {
      const std::size_t ahead = first + due[j + kAhead];
      bodies_->prefetch_track(list_.pairs[ahead].a);
      bodies_->prefetch_track(list_.pairs[ahead].b);
      __builtin_prefetch(&list_.known[ahead]);
    }
    const std::size_t k = first + due[j];
    const double still = left(list_.known[k], list_.pairs[k], way(list_.pairs[k]));
    const bool is_left = still > 0.0;
    n_new_by_balls +=
        is_left & (list_.until[k] == kNever) & (list_.known[k].kind == Known::Kind::balls_apart) ? 1u : 0u;
    list_.until[k] = blend(is_left, clock_when(still), list_.until[k]);
    used_up[n_used_up] = due[j];
    n_used_up += is_left ? 0u : 1u;
  }
  unmoved.settled += n_due - n_used_up - n_new_by_balls;
  balls.seen += n_new_by_balls;
  balls.settled += n_new_by_balls;
  for (std::size_t j = 0; j < n_used_up; ++j) {
    if (j + kAhead < n_used_up) {
      const KnownFacet& ahead = facet_[first + used_up[j + kAhead]];
      __builtin_prefetch(ahead.corners.data());
      __builtin_prefetch(ahead.corners.data() + 2);
    }
    const std::size_t k = first + used_up[j];
    const Listed& pair = list_.pairs[k];
    const Vec3d from_a_to_b = way(pair);
    if ((list_.known[k].kind == Known::Kind::at_rest && list_.known[k].has_travels(travels(pair))) ||
        (list_.known[k].kind == Known::Kind::hull_and_facet && renew_hull(k, from_a_to_b))) {
      ++unmoved.settled;
    } else {
      look_closer(k, from_a_to_b, search);
    }
  }
}

// At a pair of which nothing is left.
inline void PairMemory::look_closer(std::size_t k, const Vec3d& way, PairSearch& search) {
  SceneCounts::Stage& balls = search.counts[SceneStage::balls];
  ++balls.seen;
  if (keep_what_balls_tell(k, way)) {
    ++balls.settled;
  } else {
    const Listed& pair = list_.pairs[k];
    search.ask(pair.a, pair.b, shifts_.number(image(pair)), k);
  }
}

// `left`: by how much the clock may grow before the pair is looked at.
void PairMemory::keep(std::uint64_t tag, bool overlaps, double left) {
  list_.overlaps[tag] = overlaps ? 1 : 0;
  list_.until[tag] = left > 0.0 ? clock_when(left) : kNever;
}

void PairMemory::keep_as_it_stands(std::uint64_t tag, Outcome outcome) {
  list_.known[tag] = outcome == Outcome::undecided ? Known{} : Known::at_rest(travels(list_.pairs[tag]));
  keep(tag, outcome == Outcome::overlap, 0.0);
}

// What is left is taken of what is kept, roundings to floats and all.
bool PairMemory::keep_if_it_has(std::uint64_t tag, Known::Kind kind, const KnownHull& hull, double limit,
                                const Vec3d& way, double least) {
  const Known known{kind, hull, next_below(limit + turned(list_.pairs[tag]))};
  const double left = this->left(known, list_.pairs[tag], way);
  if (!(left > std::fmax(least, rounding_))) return false;
  list_.known[tag] = known;
  keep(tag, kind != Known::Kind::half_space, left);
  return true;
}

void PairMemory::keep_apart(std::uint64_t tag, const Vec3d& unit_dir, double clearance) {
  const Listed& pair = list_.pairs[tag];
  const Vec3d from_a_to_b = way(pair);
  const KnownHull plane{KnownHull::floats(-unit_dir), 1.0f, 0.0f};
  // No two points of the bodies are farther from each other than this.
  const double reach = norm(from_a_to_b) + bodies_->bounds_of(pair.a).radius + bodies_->bounds_of(pair.b).radius;
  const double of_floats = norm(KnownHull::vector(plane.axis) + unit_dir) * reach;
  const double left = clearance * kLess - rounding_ - of_floats;
  const double limit = plane.most_of(from_a_to_b, true) + left;
  if (!keep_if_it_has(tag, Known::Kind::half_space, plane, limit, from_a_to_b, 0.0)) {
    keep_as_it_stands(tag, Outcome::disjoint);
  }
}

void PairMemory::keep_overlap(std::uint64_t tag, const Vec3d& point, const std::array<Vec3d, 3>& corners,
                              double clearance) {
  const Vec3d from_a_to_b = way(list_.pairs[tag]);
  const double left = clearance * kLess - rounding_;
  const auto seen_from_centres = [&](const Vec3d& p) { return kLessOfTip * (from_a_to_b + p); };
  if (keep_around_core(tag, from_a_to_b, seen_from_centres(point), 0.5 * left)) {
    list_.known[tag].kind = Known::Kind::hull_and_facet;
    for (std::size_t k = 0; k < 3; ++k) facet_[tag].corners[k] = KnownHull::floats(seen_from_centres(corners[k]));
    return;
  }
  keep_ball(tag, from_a_to_b, left);
}

// Of this radius about the way's end.
void PairMemory::keep_ball(std::uint64_t tag, const Vec3d& way, double radius) {
  const KnownHull ball{KnownHull::floats(way), 1.0f, 0.0f};
  const double of_floats = norm(KnownHull::vector(ball.axis) - way);
  if (!keep_if_it_has(tag, Known::Kind::ball, ball, radius - of_floats, way, 0.0)) {
    keep_as_it_stands(tag, Outcome::overlap);
  }
}

double PairMemory::core_of(const Listed& pair) const {
  return bodies_->bounds_of(pair.a).inner_radius + bodies_->bounds_of(pair.b).inner_radius;
}

// Of a pair whose difference has this tip, seen from that of the centres: where that leaves more than `least`.
bool PairMemory::keep_around_core(std::uint64_t tag, const Vec3d& way, const Vec3d& tip, double least) {
  const Listed& pair = list_.pairs[tag];
  const double core = core_of(pair);
  if (!(core > kLeastCore * (bodies_->bounds_of(pair.a).radius + bodies_->bounds_of(pair.b).radius))) return false;
  return keep_if_it_has(tag, Known::Kind::hull, KnownHull::around_core(core, tip), core - rounding_, way, least);
}

// With the tip in its facet that is towards the way now: what both have turned since the facet was told is counted as
// before.
bool PairMemory::renew_hull(std::size_t k, const Vec3d& way) {
  const Vec3d tip = facet_[k].towards(way);
  if (norm_1(tip) == 0.0) return false;
  Known known = list_.known[k];
  known.hull = KnownHull::around_core(core_of(list_.pairs[k]), tip);
  const double left = this->left(known, list_.pairs[k], way);
  if (!(left > rounding_)) return false;
  list_.known[k].hull = known.hull;
  list_.until[k] = clock_when(left);
  return true;
}

}  // namespace vex
