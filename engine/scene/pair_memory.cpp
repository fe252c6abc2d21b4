#include "engine/scene/pair_memory.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/numeric/interruption.h"
#include "engine/numeric/interval.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// Of lengths, as kStretch of scene_bodies.cpp: what rotations that are ones to within 2e-7 change, twice over.
constexpr double kLess = 1.0 - 0x1p-18;

// A pair whose inscribed balls are at least this share of the circumscribed ones is known by them, too; a point of its
// difference is then taken for one that is nearer to the centres by so much (E26).
constexpr double kLeastCore = 0x1p-4, kLessOfTip = 1.0 - 0x1p-14;

// So many entries of any values, with room for a few more: a list that grows a little stays where it is.
template <class Vector>
void resize_with_room(Vector& entries, std::size_t n) {
  if (entries.capacity() < n) {
    entries = Vector();
    entries.reserve(n + n / 8);
  }
  entries.resize(n);
}

// The numbers, counted from `first`, of those of which something is true; how many. Whether it is true is as good as
// random: each number is written in any case.
template <class IsTrue>
std::size_t numbers_of(std::size_t first, std::size_t end, std::uint32_t* numbers, const IsTrue& is_true) {
  std::size_t n = 0;
  for (std::size_t k = first; k < end; ++k) {
    numbers[n] = static_cast<std::uint32_t>(k - first);
    n += is_true(k) ? 1u : 0u;
  }
  return n;
}

}  // namespace

inline Vec3d PairMemory::way(const Listed& pair) const {
  return bodies_->tracked(pair.b).centre - bodies_->tracked(pair.a).centre + shifts_.shift(pair.shift);
}
inline double PairMemory::turned(const Listed& pair) const {
  return bodies_->tracked(pair.a).turned + bodies_->tracked(pair.b).turned;
}
inline std::array<double, 2> PairMemory::travels(const Listed& pair) const {
  return {bodies_->travel(pair.a), bodies_->travel(pair.b)};
}

inline PairMemory::Known PairMemory::Known::at_rest(const std::array<double, 2>& travels) {
  Known known{Kind::at_rest, {}, travels[0]};
  std::memcpy(known.hull.axis.data(), &travels[1], sizeof(double));
  return known;
}
inline bool PairMemory::Known::has_travels(const std::array<double, 2>& travels) const {
  return limit == travels[0] && std::memcmp(hull.axis.data(), &travels[1], sizeof(double)) == 0;
}

inline ImageOffset PairMemory::image(const Listed& pair) const {
  const ImageOffset& then = shifts_.image(pair.shift);
  if (!(bodies_->has_crossed(pair.a) | bodies_->has_crossed(pair.b))) return then;
  return image_sum(then, image_difference(bodies_->crossed(pair.b), bodies_->crossed(pair.a)));
}

inline double PairMemory::left(const Known& known, const Listed& pair, const Vec3d& way) const {
  if (known.kind == Known::Kind::nothing || known.kind == Known::Kind::at_rest) return 0.0;
  const double most = known.kind == Known::Kind::ball ? norm(way - KnownHull::vector(known.hull.axis))
                                                      : known.hull.most_of(way, known.kind == Known::Kind::half_space);
  return (known.limit - turned(pair)) - most;
}

// What the clock may grow to, at least, while what is above 0 now shrinks by no more than it grows: below it by no less
// than its rounding, so that the sum's is covered.
inline double PairMemory::clock_when(double left) const { return (clock_ + left) * (1.0 - 0x1p-52); }

void PairMemory::build(SceneBodies& bodies, const BroadPhases& phases, const SceneKernel& kernel, double skin,
                       int n_threads) {
  // Bodies that cross faces of the box between two steps change the image: each by one, and by one for each box that
  // half of the skin reaches over.
  std::array<int, 3> n_images = phases.shifts().n_images();
  if (bodies.box()) {
    const Vec3d faces = bodies.box()->face_distances();
    const double distances[] = {faces.x, faces.y, faces.z};
    for (std::size_t k = 0; k < 3; ++k) n_images[k] += 2 + static_cast<int>(std::ceil(skin / distances[k]));
  }
  const bool is_like_before = is_there_ && skin == skin_ && n_images == shifts_.n_images() && bodies.is_tracked();
  if (!is_like_before) shifts_ = ShiftTable(bodies.box(), n_images);
  const double coordinates = 2.0 * bodies.largest_distance() + 3.0 * shifts_.largest_shift();
  const double rounding = 0x1p-45 * (coordinates + 2.0 * bodies.largest_radius() + skin) +
                          0x1p-17 * bodies.largest_offset() + 0x1p-19 * bodies.largest_ball();
  // Of what was kept with much less rounding in mind nothing is true for sure any more.
  const bool keeps_old = is_like_before && rounding <= 2.0 * rounding_;
  if (!keeps_old) rounding_ = rounding;
  skin_ = skin;
  bodies_ = &bodies;
  listed_before_.swap(listed_);
  is_there_ = false;  // nor is it where the search ends by an exception
  find_pairs_within_skin(phases, kernel, n_threads);
  list(keeps_old);
  clock_ = 0.0;
  bodies.track();
  is_there_ = true;
}

void PairMemory::find_pairs_within_skin(const BroadPhases& phases, const SceneKernel& kernel, int n_threads) {
  // Of each shift of the broad phase, the number here; numbers are in the order of images.
  const ShiftTable& theirs = phases.shifts();
  std::vector<std::uint32_t> number(theirs.size());
  for (std::uint32_t k = 0; k < theirs.size(); ++k) number[k] = shifts_.number(theirs.image(k));
  if (found_.size() < phases.n_parts()) found_.resize(phases.n_parts());
  for (std::vector<Listed>& part : found_) part.clear();
  share_parts(n_threads, phases.n_parts(), [&](std::size_t part) {
    thread_local NearPairs near;
    const BodyId* const id = phases.bodies().id.data();
    near.n = 0;
    phases.find_near(part, kernel, near, [&] {
      end_if_interrupted();
      for (std::size_t k = 0; k < near.n; ++k) {
        const BodyId a = id[near.places[k] & 0xffffffffu], b = id[near.places[k] >> 32];
        const std::uint32_t shift = number[near.shift[k]];
        if (a > b || (a == b && shift < shifts_.home())) {
          found_[part].push_back({b, a, static_cast<std::uint32_t>(shifts_.opposite(shift))});
        } else {
          found_[part].push_back({a, b, shift});
        }
      }
      near.n = 0;
      return true;
    });
  });
  // Counting sort by the first body; each has few pairs.
  next_.assign(std::size_t{bodies_->end()} + 1, 0);
  for (const std::vector<Listed>& part : found_) {
    for (const Listed& pair : part) ++next_[pair.a + 1];
  }
  for (std::size_t k = 1; k < next_.size(); ++k) next_[k] += next_[k - 1];
  resize_with_room(listed_, next_.back());
  for (const std::vector<Listed>& part : found_) {
    for (const Listed& pair : part) listed_[next_[pair.a]++] = pair;
  }
  for (std::size_t first = 0; first < listed_.size();) {
    const std::size_t end = next_[listed_[first].a];
    std::sort(listed_.data() + first, listed_.data() + end);
    first = end;
  }
}

void PairMemory::list(bool keeps_old) {
  known_before_.swap(known_);
  until_before_.swap(until_);
  overlaps_before_.swap(overlaps_);
  const std::size_t n = listed_.size(), n_before = keeps_old ? listed_before_.size() : 0;
  resize_with_room(known_, n);
  resize_with_room(until_, n);
  resize_with_room(overlaps_, n);
  std::size_t at = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Listed& pair = listed_[k];
    if (n_before > 0 && k + kAhead < n) bodies_->prefetch_track(listed_[k + kAhead].b);
    while (at < n_before && listed_before_[at] < pair) ++at;
    if (at == n_before || !(listed_before_[at] == pair)) {
      known_[k] = {};
      until_[k] = -HUGE_VAL;
      overlaps_[k] = 0;
      continue;
    }
    known_[k] = known_before_[at];
    overlaps_[k] = overlaps_before_[at];
    const bool is_same_copy = image(pair) == shifts_.image(pair.shift);
    carry_over(pair, is_same_copy, known_[k]);
    until_[k] = is_same_copy ? next_below(until_before_[at] - clock_) : -HUGE_VAL;
  }
}

// Into the tracks that begin now, where nothing has turned and nothing has crossed a face yet. The shift of a body that
// had crossed one leads to another copy there. A clearance is about the way from centre to centre, whichever copy that
// leads to; what is known of a pair at rest, and until when a pair need not be looked at, is about one copy. Limits are
// rounded to the safe side, however often.
void PairMemory::carry_over(const Listed& pair, bool is_same_copy, Known& known) const {
  if (known.kind != Known::Kind::at_rest) {
    const double both = turned(pair);
    if (both > 0.0) known.limit = next_below(known.limit - both);
  } else {
    known = is_same_copy && known.has_travels(travels(pair)) ? Known::at_rest({}) : Known{};
  }
}

// The clock is rounded up, so that it grows by at least what is added to it.
bool PairMemory::holds(SceneBodies& bodies, double skin) {
  if (!is_there_ || skin != skin_) return false;
  const SceneBodies::Travel travel = bodies.largest_travel();
  clock_ = next_above(clock_ + 2.0 * travel.since_asked);
  return 2.0 * travel.since_track < skin * kLess;
}

bool PairMemory::keep_what_balls_tell(std::uint64_t tag, const Vec3d& way) {
  const Listed& pair = listed_[tag];
  const double distance = norm(way);
  const ShapeBounds& of_a = bodies_->bounds_of(pair.a);
  const ShapeBounds& of_b = bodies_->bounds_of(pair.b);
  const double apart = distance * kLess - (of_a.radius + of_b.radius) - rounding_;
  const double inside = (of_a.inner_radius + of_b.inner_radius) - distance / kLess - rounding_;
  if (apart > 0.0) {
    keep_apart(tag, (1.0 / distance) * way, apart);
  } else if (inside > 0.0) {
    if (!keep_around_core(tag, way, Vec3d{}, 0.0)) keep_overlap(tag, Vec3d{}, inside);
  } else {
    return false;
  }
  return true;
}

void PairMemory::look(std::size_t block, PairSearch& search) {
  const std::size_t first = block * kBlock, end = std::min(first + kBlock, listed_.size());
  std::uint32_t due[kBlock];
  const std::size_t n_due = numbers_of(first, end, due, [&](std::size_t k) { return !(until_[k] > clock_); });
  SceneCounts::Stage& unmoved = search.counts[SceneStage::unmoved];
  SceneCounts::Stage& balls = search.counts[SceneStage::balls];
  unmoved.seen += end - first;
  unmoved.settled += (end - first) - n_due;
  for (std::size_t j = 0; j < n_due; ++j) {
    if (j + 2 * kAhead < n_due) __builtin_prefetch(&listed_[first + due[j + 2 * kAhead]]);
    if (j + kAhead < n_due) {
      const std::size_t ahead = first + due[j + kAhead];
      bodies_->prefetch_track(listed_[ahead].a);
      bodies_->prefetch_track(listed_[ahead].b);
      __builtin_prefetch(&known_[ahead]);
    }
    const std::size_t k = first + due[j];
    const Listed& pair = listed_[k];
    const Known& known = known_[k];
    const Vec3d from_a_to_b = way(pair);
    const double still = left(known, pair, from_a_to_b);
    if (still > 0.0) {
      until_[k] = clock_when(still);
      ++unmoved.settled;
    } else if (known.kind == Known::Kind::at_rest && known.has_travels(travels(pair))) {
      ++unmoved.settled;
    } else {
      ++balls.seen;
      if (keep_what_balls_tell(k, from_a_to_b)) {
        ++balls.settled;
      } else {
        search.ask(pair.a, pair.b, shifts_.number(image(pair)), k);
      }
    }
  }
}

// The list is in the order of the images that the bodies had when it was made. Where bodies have crossed faces since,
// all copies of a pair's second body are other ones, by the same lattice vector, so that they stand in order still.
void PairMemory::collect(int n_threads, std::vector<ScenePair>& out) {
  n_overlaps_.assign(n_blocks() + 1, 0);
  share_parts(n_threads, n_blocks(), [&](std::size_t block) {
    std::size_t n = 0;
    for (std::size_t k = block * kBlock; k < std::min((block + 1) * kBlock, listed_.size()); ++k) n += overlaps_[k];
    n_overlaps_[block + 1] = n;
  });
  for (std::size_t block = 0; block < n_blocks(); ++block) n_overlaps_[block + 1] += n_overlaps_[block];
  out.resize(n_overlaps_.back());
  share_parts(n_threads, n_blocks(), [&](std::size_t block) {
    const std::size_t first = block * kBlock, end = std::min(first + kBlock, listed_.size());
    std::uint32_t overlapping[kBlock];
    const std::size_t n = numbers_of(first, end, overlapping, [&](std::size_t k) { return overlaps_[k] != 0; });
    ScenePair* const to = out.data() + n_overlaps_[block];
    for (std::size_t j = 0; j < n; ++j) {
      const Listed& pair = listed_[first + overlapping[j]];
      to[j].a = pair.a;
      to[j].b = pair.b;
      to[j].image = image(pair);
    }
  });
}

// `left`: by how much the clock may grow before the pair is looked at.
void PairMemory::keep(std::uint64_t tag, bool overlaps, double left) {
  overlaps_[tag] = overlaps ? 1 : 0;
  until_[tag] = left > 0.0 ? clock_when(left) : -HUGE_VAL;
}

void PairMemory::keep_as_it_stands(std::uint64_t tag, Outcome outcome) {
  known_[tag] = outcome == Outcome::undecided ? Known{} : Known::at_rest(travels(listed_[tag]));
  keep(tag, outcome == Outcome::overlap, 0.0);
}

// What is left is taken of what is kept, roundings to floats and all.
bool PairMemory::keep_if_it_has(std::uint64_t tag, Known::Kind kind, const KnownHull& hull, double limit,
                                const Vec3d& way, double least) {
  const Known known{kind, hull, next_below(limit + turned(listed_[tag]))};
  const double left = this->left(known, listed_[tag], way);
  if (!(left > std::fmax(least, rounding_))) return false;
  known_[tag] = known;
  keep(tag, kind != Known::Kind::half_space, left);
  return true;
}

void PairMemory::keep_apart(std::uint64_t tag, const Vec3d& unit_dir, double clearance) {
  const Listed& pair = listed_[tag];
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

void PairMemory::keep_overlap(std::uint64_t tag, const Vec3d& point, double clearance) {
  const Vec3d from_a_to_b = way(listed_[tag]);
  const double left = clearance * kLess - rounding_;
  if (keep_around_core(tag, from_a_to_b, kLessOfTip * (from_a_to_b + point), 0.5 * left)) return;
  const KnownHull ball{KnownHull::floats(from_a_to_b), 1.0f, 0.0f};
  const double of_floats = norm(KnownHull::vector(ball.axis) - from_a_to_b);
  if (!keep_if_it_has(tag, Known::Kind::ball, ball, left - of_floats, from_a_to_b, 0.0)) {
    keep_as_it_stands(tag, Outcome::overlap);
  }
}

// Of a pair whose difference has this tip, seen from that of the centres: where that leaves more than `least`.
bool PairMemory::keep_around_core(std::uint64_t tag, const Vec3d& way, const Vec3d& tip, double least) {
  const Listed& pair = listed_[tag];
  const ShapeBounds& of_a = bodies_->bounds_of(pair.a);
  const ShapeBounds& of_b = bodies_->bounds_of(pair.b);
  const double core = of_a.inner_radius + of_b.inner_radius;
  if (!(core > kLeastCore * (of_a.radius + of_b.radius))) return false;
  return keep_if_it_has(tag, Known::Kind::hull, KnownHull::around_core(core, tip), core - rounding_, way, least);
}

}  // namespace vex
