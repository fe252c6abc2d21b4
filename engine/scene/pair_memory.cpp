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

// So many entries of any values, with room for a few more: a list that grows a little stays where it is.
template <class Vector>
void resize_with_room(Vector& entries, std::size_t n) {
  if (entries.capacity() < n) entries.reserve(n + n / 8);
  entries.resize(n);
}

}  // namespace

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
      std::vector<Listed>& found = found_[part];
      const std::size_t n_before = found.size();
      found.resize(n_before + near.n);
      for (std::size_t k = 0; k < near.n; ++k) {
        const BodyId a = id[near.places[k] & 0xffffffffu], b = id[near.places[k] >> 32];
        const std::uint32_t shift = number[near.shift[k]];
        const std::uint64_t number_of_b = blend(shifts_.is_reversed(a, b, shift), shifts_.opposite(shift), shift);
        found[n_before + k] = {std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(number_of_b)};
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
    sort_short(std::span(listed_.data() + first, end - first), std::less<Listed>());
    first = end;
  }
}

// What is known of pairs that were listed before moves to the front of the columns, in the order of both lists, and
// from there, the last first, to where each stands now. Other columns would be memory that no list has touched yet, and
// it is lists that have a step take long.
void PairMemory::list(bool keeps_old) {
  const std::size_t n = listed_.size(), n_before = keeps_old ? listed_before_.size() : 0;
  resize_with_room(was_listed_, n);
  std::size_t n_kept = 0;
  for (std::size_t k = 0, at = 0; k < n; ++k) {
    const Listed& pair = listed_[k];
    if (n_before > 0 && k + kAhead < n) bodies_->prefetch_track(listed_[k + kAhead].b);
    while (at < n_before && listed_before_[at] < pair) ++at;
    was_listed_[k] = at < n_before && listed_before_[at] == pair ? 1 : 0;
    if (was_listed_[k] == 0) continue;
    const bool is_same_copy = image(pair) == shifts_.image(pair.shift);
    known_[n_kept] = known_[at];
    carry_over(pair, is_same_copy, known_[n_kept]);
    until_[n_kept] = is_same_copy ? next_below(until_[at] - clock_) : -HUGE_VAL;
    overlaps_[n_kept] = overlaps_[at];
    ++n_kept;
    ++at;
  }
  resize_with_room(known_, n);
  resize_with_room(facet_, n);
  resize_with_room(until_, n);
  resize_with_room(overlaps_, n);
  // No more pairs before one were listed than are before it, so that none is written over before it has moved.
  for (std::size_t k = n; k-- > 0;) {
    const bool was_listed = was_listed_[k] != 0;
    if (was_listed) --n_kept;
    known_[k] = was_listed ? known_[n_kept] : Known{};
    until_[k] = was_listed ? until_[n_kept] : -HUGE_VAL;
    overlaps_[k] = was_listed ? overlaps_[n_kept] : 0;
  }
}

// Into the tracks that begin now, where nothing has turned and nothing has crossed a face yet. The shift of a body that
// had crossed one leads to another copy there. A clearance is about the way from centre to centre, whichever copy that
// leads to; what is known of a pair at rest, and until when a pair need not be looked at, is about one copy. Limits are
// rounded to the safe side, however often. Facets are of one list.
void PairMemory::carry_over(const Listed& pair, bool is_same_copy, Known& known) const {
  if (known.kind == Known::Kind::hull_and_facet) known.kind = Known::Kind::hull;
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

}  // namespace vex
