#include "engine/scene/pair_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/numeric/interruption.h"
#include "engine/numeric/interval.h"
#include "engine/scene/threads.h"

namespace vex {
namespace {

// Of lengths, as kStretch of scene_bodies.cpp: what rotations that are ones to within 2e-7 change, twice over.
constexpr double kLess = 1.0 - 0x1p-18;

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
  is_there_ = false;  // nor is it where the search ends by an exception
  find_pairs_within_skin(phases, kernel, n_threads);
  list(keeps_old);
  is_there_ = true;
  bodies.track();
}

void PairMemory::find_pairs_within_skin(const BroadPhases& phases, const SceneKernel& kernel, int n_threads) {
  if (found_.size() < phases.n_parts()) found_.resize(phases.n_parts());
  for (std::vector<Listed>& part : found_) part.clear();
  share_parts(n_threads, phases.n_parts(), [&](std::size_t part) {
    thread_local NearPairs near;
    near.n = 0;
    phases.find_near(part, kernel, near, [&] {
      end_if_interrupted();
      for (std::size_t k = 0; k < near.n; ++k) {
        BodyId a = phases.bodies().id[near.places[k] & 0xffffffffu], b = phases.bodies().id[near.places[k] >> 32];
        ImageOffset image = phases.shifts().image(near.shift[k]);
        if (a > b || (a == b && !(image > ImageOffset{}))) {
          std::swap(a, b);
          image = {-image[0], -image[1], -image[2]};
        }
        found_[part].push_back({a, b, shifts_.number(image)});
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
  listed_.resize(next_.back());
  for (const std::vector<Listed>& part : found_) {
    for (const Listed& pair : part) listed_[next_[pair.a]++] = pair;
  }
  for (std::size_t first = 0; first < listed_.size();) {
    const std::size_t end = next_[listed_[first].a];
    std::sort(listed_.begin() + static_cast<std::ptrdiff_t>(first), listed_.begin() + static_cast<std::ptrdiff_t>(end));
    first = end;
  }
}

void PairMemory::list(bool keeps_old) {
  known_before_.swap(known_);
  if (!keeps_old) known_before_.clear();
  known_.clear();
  auto at = known_before_.begin();
  for (const Listed& pair : listed_) {
    while (at != known_before_.end() && Listed{at->a, at->b, at->shift} < pair) ++at;
    const bool is_known = at != known_before_.end() && Listed{at->a, at->b, at->shift} == pair;
    if (is_known) {
      known_.push_back(*at);
      carry_over(known_.back());
    } else {
      known_.push_back({pair.a, pair.b, pair.shift, Known::Kind::nothing, {}, 0.0});
    }
  }
}

// Into the tracks that begin now, where nothing has turned and nothing has crossed a face yet. The shift of a body that
// had crossed one leads to another copy there. A clearance is about the way from centre to centre, whichever copy that
// leads to; what is known of a pair at rest is about one copy. Limits are rounded to the safe side, however often.
void PairMemory::carry_over(Known& known) const {
  switch (known.kind) {
    case Known::Kind::apart: known.limit = next_above(known.limit + turned(known)); break;
    case Known::Kind::overlap: known.limit = next_below(known.limit - turned(known)); break;
    case Known::Kind::apart_at_rest:
    case Known::Kind::overlap_at_rest:
      if (bodies_->track_of(known.a).crossed != bodies_->track_of(known.b).crossed) known.kind = Known::Kind::nothing;
      break;
    case Known::Kind::nothing: break;
  }
}

bool PairMemory::holds(const SceneBodies& bodies, double skin) const {
  return is_there_ && skin == skin_ && 2.0 * bodies.largest_travel() < skin * kLess;
}

Vec3d PairMemory::way(const Known& known) const {
  return (bodies_->track_of(known.b).centre - bodies_->track_of(known.a).centre) + shifts_.shift(known.shift);
}
double PairMemory::turned(const Known& known) const {
  return bodies_->track_of(known.a).turned + bodies_->track_of(known.b).turned;
}
double PairMemory::n_moves(const Known& known) const {
  return static_cast<double>(bodies_->track_of(known.a).n_moves + bodies_->track_of(known.b).n_moves);
}

ImageOffset PairMemory::image(const Known& known) const {
  const ImageOffset &then = shifts_.image(known.shift), &of_a = bodies_->track_of(known.a).crossed,
                    &of_b = bodies_->track_of(known.b).crossed;
  return {then[0] + of_b[0] - of_a[0], then[1] + of_b[1] - of_a[1], then[2] + of_b[2] - of_a[2]};
}

bool PairMemory::holds(const Known& known, const Vec3d& way) const {
  switch (known.kind) {
    case Known::Kind::apart: return dot(known.at, way) - turned(known) > known.limit;
    case Known::Kind::overlap: return norm(way - known.at) + turned(known) < known.limit;
    case Known::Kind::apart_at_rest:
    case Known::Kind::overlap_at_rest: return n_moves(known) == known.limit;
    case Known::Kind::nothing: break;
  }
  return false;
}

bool PairMemory::keep_what_balls_tell(std::uint64_t tag, const Vec3d& way) {
  const Known& known = known_[tag];
  const double distance = norm(way);
  const ShapeBounds& of_a = bodies_->bounds(bodies_->track_of(known.a).shape);
  const ShapeBounds& of_b = bodies_->bounds(bodies_->track_of(known.b).shape);
  const double apart = distance * kLess - (of_a.radius + of_b.radius) - rounding_;
  const double inside = (of_a.inner_radius + of_b.inner_radius) - distance / kLess - rounding_;
  if (apart > 0.0) {
    keep_apart(tag, (1.0 / distance) * way, apart);
  } else if (inside > 0.0) {
    keep_overlap(tag, inside);
  } else {
    return false;
  }
  return true;
}

void PairMemory::look(std::size_t first, std::size_t end, PairSearch& search) {
  SceneCounts::Stage& unmoved = search.counts[SceneStage::unmoved];
  SceneCounts::Stage& balls = search.counts[SceneStage::balls];
  unmoved.seen += end - first;
  for (std::size_t k = first; k < end; ++k) {
    if (k + kAhead < end) {
      bodies_->prefetch_track(known_[k + kAhead].a);
      bodies_->prefetch_track(known_[k + kAhead].b);
    }
    const Known& known = known_[k];
    const Vec3d from_a_to_b = way(known);
    if (holds(known, from_a_to_b)) {
      ++unmoved.settled;
    } else {
      ++balls.seen;
      if (!keep_what_balls_tell(k, from_a_to_b)) {
        search.ask(known.a, known.b, shifts_.number(image(known)), k);
        continue;
      }
      ++balls.settled;
    }
    if (known.kind == Known::Kind::overlap || known.kind == Known::Kind::overlap_at_rest) {
      search.pairs.push_back({known.a, known.b, image(known)});
    }
  }
}

void PairMemory::keep_as_it_stands(std::uint64_t tag, Outcome outcome) {
  Known& known = known_[tag];
  known.kind = outcome == Outcome::overlap    ? Known::Kind::overlap_at_rest
               : outcome == Outcome::disjoint ? Known::Kind::apart_at_rest
                                              : Known::Kind::nothing;
  known.limit = n_moves(known);
}

void PairMemory::keep_apart(std::uint64_t tag, const Vec3d& unit_dir, double clearance) {
  Known& known = known_[tag];
  if (!(clearance * kLess > 2.0 * rounding_)) {
    keep_as_it_stands(tag, Outcome::disjoint);
    return;
  }
  known.kind = Known::Kind::apart;
  known.at = unit_dir;
  known.limit = dot(unit_dir, way(known)) - turned(known) - clearance * kLess + rounding_;
}

void PairMemory::keep_overlap(std::uint64_t tag, double clearance) {
  Known& known = known_[tag];
  if (!(clearance * kLess > 2.0 * rounding_)) {
    keep_as_it_stands(tag, Outcome::overlap);
    return;
  }
  known.kind = Known::Kind::overlap;
  known.at = way(known);
  known.limit = clearance * kLess - rounding_ + turned(known);
}

}  // namespace vex
