// The list of remembered pairs.
#include "engine/scene/pair_memory.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/numeric/interruption.h"
#include "engine/numeric/interval.h"
#include "engine/numeric/lane.h"
#include "engine/scene/short_sort.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

constexpr std::size_t kBodiesAShare = 4096;

// So many entries of any values, with room for a few more: a list that grows a little stays where it is.
template <class Vector>
void resize_with_room(Vector& entries, std::size_t n) {
  if (entries.capacity() < n) entries.reserve(n + n / 8);
  entries.resize(n);
}

}  // namespace

// What is there already may stay: a list writes all of it.
void PairMemory::List::make_room(std::size_t n) {
  resize_with_room(pairs, n);
  resize_with_room(known, n);
  resize_with_room(until, n);
  resize_with_room(overlaps, n);
}

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
  is_by_boxes_ = phases.chosen() == BroadPhase::tree;
  bodies_ = &bodies;
  std::swap(before_, list_);
  if (!keeps_old) before_.starts.clear();
  is_there_ = false;  // nor is it where the search ends by an exception
  find_pairs_within_skin(phases, kernel, n_threads);
  list(n_threads);
  // A second list goes where nothing has been yet: a system's first time with memory is not left to one of the steps.
  if (!keeps_old) before_.make_room(list_.pairs.size());
  clock_ = holds_until_ = 0.0;
  bodies.track();
  is_there_ = true;
}

void PairMemory::find_pairs_within_skin(const BroadPhases& phases, const SceneKernel& kernel, int n_threads) {
  // Of each shift of the broad phase, the number here; numbers are in the order of images.
  const ShiftTable& theirs = phases.shifts();
  number_.resize(theirs.size());
  for (std::uint32_t k = 0; k < theirs.size(); ++k) number_[k] = shifts_.number(theirs.image(k));
  if (found_.size() < phases.n_parts()) found_.resize(phases.n_parts());
  for (std::vector<Listed>& part : found_) part.clear();
  share_parts(n_threads, phases.n_parts(), [&](std::size_t part) {
    thread_local NearPairs near;
    const BodyId* const id = phases.bodies().id.data();
    near.n = 0;
    phases.find_near(part, kernel, near, [&] {
      end_if_interrupted();
      std::vector<Listed>& found = found_[part];
      const std::size_t n_before = found.size();
      found.resize(n_before + near.n);
      for (std::size_t k = 0; k < near.n; ++k) {
        const BodyId a = id[near.places[k] & 0xffffffffu], b = id[near.places[k] >> 32];
        const std::uint32_t shift = number_[near.shift[k]];
        const std::uint64_t number_of_b = blend(shifts_.is_reversed(a, b, shift), shifts_.opposite(shift), shift);
        found[n_before + k] = {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(number_of_b)};
      }
      near.n = 0;
      return true;
    });
  });
}

// Counting sort by the first body, and what is known of pairs that were listed before.
void PairMemory::list(int n_threads) {
  const std::size_t n_bodies = bodies_->end();
  // Of each body its number of pairs, two places on; then, one on, where its next pair goes, which ends up as the end
  // of them: the start of the next one's.
  std::vector<std::uint32_t>& starts = list_.starts;
  starts.assign(n_bodies + 2, 0);
  for (const std::vector<Listed>& part : found_) {
    for (const Listed& pair : part) ++starts[pair.a + 2];
  }
  for (std::size_t k = 2; k < starts.size(); ++k) starts[k] += starts[k - 1];
  resize_with_room(keys_, starts.back());
  for (const std::vector<Listed>& part : found_) {
    for (const Listed& pair : part) keys_[starts[pair.a + 1]++] = pair.key();
  }
  starts.pop_back();
  list_.make_room(keys_.size());
  resize_with_room(facet_, keys_.size());
  share_range(n_threads, n_bodies, kBodiesAShare, [&](std::size_t first, std::size_t end) { list_of(first, end); });
}

// The pairs whose first bodies are these.
void PairMemory::list_of(std::size_t first_body, std::size_t end_body) {
  const std::size_t first = list_.starts[first_body], end = list_.starts[end_body];
  for (std::size_t body = first_body, k = first; body < end_body; ++body) {
    const std::size_t its_end = list_.starts[body + 1];
    sort_short(std::span(keys_.data() + k, its_end - k));
    for (; k < its_end; ++k) {
      list_.pairs[k] = {static_cast<BodyId>(body), static_cast<BodyId>(keys_[k] >> 32),
                        static_cast<std::uint32_t>(keys_[k])};
    }
  }
  const std::vector<std::uint32_t>& starts = before_.starts;
  std::size_t at = first_body < starts.size() ? starts[first_body] : starts.empty() ? 0 : starts.back();
  const std::size_t at_end = starts.empty() ? 0 : starts[std::min(end_body, starts.size() - 1)];
  for (std::size_t k = first; k < end; ++k) {
    if (at_end > 0 && k + kAhead < end) bodies_->prefetch_track(list_.pairs[k + kAhead].b);
    const Listed& pair = list_.pairs[k];
    while (at < at_end && before_.pairs[at] < pair) ++at;
    if (at < at_end && before_.pairs[at] == pair) {
      carry_over(at++, k);
    } else {
      list_.known[k] = known_by_balls(list_.pairs[k]);
      list_.until[k] = kNever;
      list_.overlaps[k] = 0;
    }
  }
}

// From the list before, into the tracks that begin now, where nothing has turned and nothing has crossed a face yet.
// The shift of a body that had crossed one leads to another copy there. A clearance is about the way from centre to
// centre, whichever copy that leads to; what is known of a pair at rest, and until when a pair need not be looked at,
// is about one copy. Limits are rounded to the safe side, however often. Facets are of one list.
inline void PairMemory::carry_over(std::size_t from, std::size_t to) {
  const Listed& pair = list_.pairs[to];
  const bool is_same_copy = image(pair) == shifts_.image(pair.shift);
  Known known = before_.known[from];
  if (known.kind == Known::Kind::at_rest) {
    known = is_same_copy && known.has_travels(travels(pair)) ? Known::at_rest({}) : Known{};
  } else {
    // Which kind it is is as good as random, so no jump hangs on it.
    const double both = blend(known.kind == Known::Kind::balls_apart, 0.0, turned(pair));
    known.limit = blend(both > 0.0, next_below(known.limit - both), known.limit);
    known.kind = known.without_facet();
  }
  list_.known[to] = known;
  list_.until[to] = is_same_copy ? next_below(before_.until[from] - clock_) : kNever;
  list_.overlaps[to] = before_.overlaps[from];
}

// The clock is rounded up, so that it grows by at least what is added to it. A list of balls lacks no pair while no
// centre is farther than half the skin from where it was, whichever way it went and however the bodies turned; a tree's
// boxes change by what bodies turn, too. That is not looked at again before the clock has grown by what was left. Of
// sums with the clock kLess covers the rounding.
bool PairMemory::holds(SceneBodies& bodies, double skin) {
  if (!is_there_ || skin != skin_) return false;
  clock_ = next_above(clock_ + 2.0 * bodies.largest_step());
  if (clock_ >= holds_until_) {
    const double left = skin * kLess - (2.0 * bodies.largest_displacement(is_by_boxes_) + rounding_);
    holds_until_ = std::fmin(clock_ + left, kMostTravel * (skin + bodies.largest_radius()));
  }
  return clock_ < holds_until_;
}

// The list is in the order of the images that the bodies had when it was made. Where bodies have crossed faces since,
// all copies of a pair's second body are other ones, by the same lattice vector, so that they stand in order still.
void PairMemory::collect(int n_threads, std::vector<ScenePair>& out) {
  n_overlaps_.assign(n_blocks() + 1, 0);
  share_parts(n_threads, n_blocks(), [&](std::size_t block) {
    std::size_t n = 0;
    for (std::size_t k = block * kBlock; k < std::min((block + 1) * kBlock, list_.pairs.size()); ++k)
      n += list_.overlaps[k];
    n_overlaps_[block + 1] = n;
  });
  for (std::size_t block = 0; block < n_blocks(); ++block) n_overlaps_[block + 1] += n_overlaps_[block];
  out.resize(n_overlaps_.back());
  share_parts(n_threads, n_blocks(), [&](std::size_t block) {
    const std::size_t first = block * kBlock, end = std::min(first + kBlock, list_.pairs.size());
    std::uint32_t overlapping[kBlock];
    const std::size_t n = numbers_of(first, end, overlapping, [&](std::size_t k) { return list_.overlaps[k] != 0; });
    ScenePair* const to = out.data() + n_overlaps_[block];
    for (std::size_t j = 0; j < n; ++j) {
      const Listed& pair = list_.pairs[first + overlapping[j]];
      to[j].a = pair.a;
      to[j].b = pair.b;
      to[j].image = image(pair);
    }
  });
}

}  // namespace vex
